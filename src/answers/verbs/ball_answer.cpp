#include "answers/verbs/ball_answers.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "contensou/si/quantity.hpp"

namespace contensou::answers {

Json members_of_ball(const si::Experiment& experiment, const reduction::Law& law) {
  const auto& [ball, contact, start, environment, spreads] = experiment;
  Json members{{"name", ball.name},
               {"body", ball.body.name},
               {"radius", ball.radius},
               {"mass", si::mass_is_known(ball) ? Json(ball.mass) : Json()},
               {"friction", contact.friction},
               {"gravity", environment.gravity},
               {"patch_radius", si::patch_radius_of(experiment, law)}};
  for (const auto& [quantity, values] : si::given_by(experiment)) {
    if (quantity->section == si::slip.section) continue;
    members[std::string(quantity->name)] = values.size() == 1 ? Json(values[0]) : Json(values);
  }
  return members;
}

Json members_of(const si::Event& event) { return {{"t", event.t}, {"x", event.place.x()}, {"y", event.place.y()}}; }

Json members_of(const si::LoadHistory& load) { return {{"t", load.instants()}, {"load", load.loads()}}; }

std::string ball_heading(const si::Experiment& experiment, const reduction::Law& law, const Digits& digits) {
  const auto& [ball, contact, start, environment, spreads] = experiment;
  return fmt::format(
      "{}: {}radius {} m, mass {}, friction {}, {}\n"
      "patch radius {} m, {}: mu = {}\n",
      ball.name,
      fmt::format("{}{}", ball.body.name != si::Body{}.name ? fmt::format("{}, ", ball.body.name) : "",
                  ball.body.factor ? fmt::format("inertia {} m R^2, ", digits(*ball.body.factor)) : ""),
      digits(ball.radius), si::mass_is_known(ball) ? fmt::format("{} kg", digits(ball.mass)) : "not known",
      digits(contact.friction),
      environment.load ? fmt::format("load {} N", digits(*environment.load))
                       : fmt::format("gravity {} m/s^2", digits(environment.gravity)),
      digits(si::patch_radius_of(experiment, law)), si::origin_of(contact.patch),
      digits(si::patch_ratio(experiment, law)));
}

std::string to_two_digits(double number) {
  if (number == 0) return "0";
  if (!(number >= 1e-5 && number < 1e6)) return fmt::format("{:.1e}", number);
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(number)));
  return fmt::format("{:.{}f}", number, std::max(decimals, 0));
}

std::string length_in_words(double metres) {
  if (metres == 0 || (metres >= 1 && metres < 1e4)) return to_two_digits(metres) + " m";
  if (metres >= 1e4) return to_two_digits(metres / 1e3) + " km";
  return metres < 1e-2 ? to_two_digits(1e3 * metres) + " mm" : to_two_digits(1e2 * metres) + " cm";
}

std::string time_in_words(double seconds) { return to_two_digits(seconds) + " s"; }

}  // namespace contensou::answers
