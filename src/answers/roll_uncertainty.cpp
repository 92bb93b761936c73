#include "answers/roll_uncertainty.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/Core>

#include "answers/errors.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/course.hpp"
#include "contensou/si/description.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::answers {

namespace {

/// A number of a ball or of its start.
struct Place {
  Spreadable known;
  const si::Quantity* quantity;
  std::size_t component;
};

std::vector<Place> places_of(const si::Experiment& experiment) {
  constexpr std::string_view corner = "the events have a corner";
  std::vector<Place> places;
  const bool flat = experiment.ball.body.lies_flat();
  for (const auto& [quantity, values] : si::given_by(experiment)) {
    const auto add = [&, of = quantity](const std::string& name, double value, std::size_t component, bool corners) {
      places.push_back({{{name, value}, of->unit, corners ? corner : ""}, of, component});
    };
    if (values.size() > 1 && quantity->section != si::slip.section) continue;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool vector = values.size() > 1, about_vertical = quantity == &si::angular_velocity && i == 2;
      if (flat && quantity == &si::angular_velocity && !about_vertical) continue;
      if (quantity != &si::inertia_factor)
        add(si::Component{quantity, i}.name(), values[i], i, !vector || about_vertical);
    }
  }
  return places;
}

/// In the order of names_of_events.
using Values = Eigen::Matrix<double, 10, 1>;

struct NameOfEvent {
  const char *event, *of, *unit;
};
constexpr std::array<NameOfEvent, 10> names_of_events{{{"rolls_after", "t", "s"},
                                                       {"rolls_after", "x", "m"},
                                                       {"rolls_after", "y", "m"},
                                                       {"spin_ends", "t", "s"},
                                                       {"spin_ends", "x", "m"},
                                                       {"spin_ends", "y", "m"},
                                                       {"slip_length", "", "m"},
                                                       {"turns", "", ""},
                                                       {"path", "", "m"},
                                                       {"t_stop", "", "s"}}};

/// One ball with one start or another.
class Shot {
 public:
  Shot(const si::Experiment& experiment, const reduction::Law& law, double rolling_below)
      : described_(si::describe(experiment)), law_(law), rolling_below_(rolling_below) {}

  /// The experiment with these numbers in place of its own.
  /// @throws std::domain_error  if there is no such experiment
  si::Experiment with(const std::vector<Place>& places, const Eigen::VectorXd& values) const {
    si::Description changed = described_;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::vector<double> numbers = changed.find(*places[i].quantity)->numbers;
      numbers[places[i].component] = values[static_cast<Eigen::Index>(i)];
      changed.set(*places[i].quantity, std::move(numbers), {"", places[i].known.number.name, ""});
    }
    return si::experiment_of(changed);
  }

  Values operator()(const si::Experiment& experiment, const reduction::Flow& flow) const {
    const si::BallMotion motion(experiment, flow);
    const si::Course<si::BallMotion> course(experiment, motion, rolling_below_, 0);
    const auto [rolls, spin_ends, rest, slip_length, turns, path] = si::events_of(course);
    Values values;
    values << rolls.t, rolls.place.x(), rolls.place.y(), spin_ends.t, spin_ends.place.x(), spin_ends.place.y(),
        slip_length, turns, path, motion.stop_time();
    return values;
  }

  Values operator()(const si::Experiment& experiment) const {
    return (*this)(experiment, reduction::Flow(si::undriven_system(experiment, law_)));
  }

 private:
  si::Description described_;
  reduction::Law law_;
  double rolling_below_;
};

}  // namespace

RollUncertainty roll_uncertainty(const si::Experiment& experiment, const reduction::Law& law, double rolling_below,
                                 const std::string& typed) {
  if (experiment.contact.rolling_friction != 0 || experiment.environment.slope != 0)
    throw BadInput("it is of a motion without rolling friction and without a slope: leave it out");
  const bool spins = si::spin_at_start(experiment) != 0;
  if (!spins && si::slip_at_start(experiment) == 0) throw BadInput("it is of a motion, and this is rest: leave it out");
  std::vector<Spreadable> known;
  std::vector<Place> all = places_of(experiment), places;
  for (const Place& place : all) known.push_back(place.known);
  const Spreads spreads = read_spreads(typed, known, experiment.spreads);
  for (const Spread& number : spreads.numbers)
    places.push_back(*std::ranges::find(all, number.name, [](const Place& of) { return of.known.number.name; }));

  const Shot shot(experiment, law, rolling_below);
  const reduction::ReducedSystem system = si::undriven_system(experiment, law);
  const Values values = shot(experiment);
  RollUncertainty result{};
  for (std::size_t i = 0; i < names_of_events.size(); ++i) {
    const auto [event, of, unit] = names_of_events[i];
    const std::string name = experiment.ball.body.lies_flat() && i < 3 ? "rest" : event;
    result.parts.push_back({name, of, unit, values[static_cast<Eigen::Index>(i)], {}});
  }
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::VectorXd at(count), mu_shares = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(values.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) at[i] = spreads.numbers[static_cast<std::size_t>(i)].value;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [name, value, standard] = spreads.numbers[static_cast<std::size_t>(i)];
    if (standard == 0) continue;
    const double step = std::max(1e-5 * std::abs(value), 1e-3 * standard);
    const Eigen::VectorXd to = Eigen::VectorXd::Unit(count, i) * step;
    const si::Experiment more = shot.with(places, at + to), less = shot.with(places, at - to);
    const double steps = standard / (2 * step);
    shares.col(i) = steps * (shot(more) - shot(less));
    mu_shares[i] = steps * std::log(si::patch_ratio(more, law) / si::patch_ratio(less, law));
  }
  for (std::size_t j = 0; j < result.parts.size(); ++j)
    result.parts[j].known.set_shares(spreads, shares.row(static_cast<Eigen::Index>(j)));

  FlowsOfMu flows(system, spreads.standard_of(mu_shares) / 8);
  std::vector<std::vector<double>> samples(result.parts.size());
  static_cast<Sampled&>(result) = sample(spreads, 10'000, [&](const Eigen::VectorXd& numbers) {
    try {
      const si::Experiment moved = shot.with(places, numbers);
      const Values then =
          flows(si::patch_ratio(moved, law), [&](const reduction::Flow& flow) { return shot(moved, flow); });
      for (std::size_t j = 0; j < samples.size(); ++j) samples[j].push_back(then[static_cast<Eigen::Index>(j)]);
      return true;
    } catch (const std::domain_error&) {
      return false;  // no ball has such numbers
    }
  });
  for (std::size_t j = 0; j < samples.size(); ++j) result.parts[j].known.compare(result.parts[j].value, samples[j]);
  if (!spins)
    std::erase_if(result.parts, [](const auto& part) { return part.event == "spin_ends" || part.event == "turns"; });
  return result;
}

Json members_of(const RollUncertainty& uncertainty) {
  Json members = Json::object();
  for (const auto& [event, of, unit, value, known] : uncertainty.parts)
    (of.empty() ? members[event] : members[event][of]) = members_of(known);
  members.update({{"samples", uncertainty.samples}, {"outside", uncertainty.outside}});
  return members;
}

std::string text_of(const RollUncertainty& uncertainty, const Digits& digits) {
  std::string text =
      fmt::format("known to, one standard deviation to first order; 95 % of {} samples\n", uncertainty.samples);
  const int width = digits.count + 8;
  bool all_hold = true;
  for (const auto& [event, of, unit, value, known] : uncertainty.parts) {
    if (known.standard == 0) continue;
    std::string label = of.empty() ? event : fmt::format("{} {}", event, of);
    std::ranges::replace(label, '_', ' ');
    text +=
        fmt::format("{:<24}{:>{}} +-{:<{}} from {:>{}} to {:>{}}{}{}{}\n", label, digits(value), width,
                    digits(known.standard), width, digits(known.quantiles.front()), width,
                    digits(known.quantiles.back()), width, unit.empty() ? "" : "  ", unit, known.holds ? "" : "  *");
    all_hold = all_hold && known.holds;
  }
  if (!all_hold)
    text += "* the first order does not do here: it is off by more than a tenth of itself; take the samples\n";
  if (uncertainty.outside > 0)
    text += fmt::format("{:.2g} % of the samples were left out: no ball has such numbers\n", 100 * uncertainty.outside);
  return text;
}

}  // namespace contensou::answers
