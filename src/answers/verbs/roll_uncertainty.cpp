#include "answers/verbs/roll_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <Eigen/Core>

#include "answers/input/errors.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::answers {

using Eigen::Index;

namespace {

/// "rolls after t"; "path".
std::string label_of(std::string_view event, std::string_view of) {
  std::string label = of.empty() ? std::string(event) : fmt::format("{} {}", event, of);
  std::ranges::replace(label, '_', ' ');
  return label;
}

}  // namespace

RollUncertainty roll_uncertainty(const si::Experiment& experiment, const reduction::Law& law, double rolling_below,
                                 const std::string& typed) {
  constexpr std::string_view corner = "the events have a corner";
  std::optional<si::EventNumbers> made;
  try {
    made.emplace(experiment, law, rolling_below);
  } catch (const std::domain_error& error) {
    throw BadInput(fmt::format("{}: leave it out", error.what()));
  }
  const si::EventNumbers& events = *made;
  std::vector<Spreadable> known;
  for (const si::Component& each : events.components()) {
    const bool vector = each.quantity->count() > 1, about_vertical = each.name() == "wz";
    known.push_back({{each.name(), events.value(each)},
                     each.quantity->unit,
                     !vector || about_vertical ? corner : std::string_view()});
  }
  const Spreads spreads = read_spreads(typed, known, experiment.spreads);

  RollUncertainty result{};
  const auto count = static_cast<Index>(spreads.numbers.size());
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(events.values().size(), count);
  Eigen::VectorXd mu_shares = Eigen::VectorXd::Zero(count);
  std::vector<si::Component> places;
  const double mu = si::patch_ratio(experiment, law);
  for (Index i = 0; i < count; ++i) {
    const auto& [name, value, standard] = spreads.numbers[static_cast<std::size_t>(i)];
    const si::Component& by = places.emplace_back(*si::find_component(name));
    if (standard == 0) continue;
    const auto slopes = events.slopes(by);
    if (!slopes)
      throw BadInput(fmt::format("{} is {}, where {} and no first order: leave it out", name, value, corner));
    shares.col(i) = standard * *slopes;
    // Their mu needs to be known to an eighth only.
    constexpr double step = 1e-3;
    const double more = value + step * (value == 0 ? standard : std::abs(value));
    const si::Experiment beside = events.with({by}, Eigen::VectorXd::Constant(1, more));
    mu_shares[i] = std::log(si::patch_ratio(beside, law) / mu) / (more - value) * standard;
  }
  for (Index j = 0; j < events.values().size(); ++j) {
    const auto& [event, of, unit] = events.names()[static_cast<std::size_t>(j)];
    result.parts.push_back({std::string(event), std::string(of), std::string(unit), events.values()[j], {}});
    result.parts.back().known.set_shares(spreads, shares.row(j));
  }

  FlowsOfMu flows(si::undriven_system(experiment, law), spreads.standard_of(mu_shares) / 8);
  std::vector<std::vector<double>> samples(result.parts.size());
  const long wanted = events.resisted() ? 1'000 : 10'000;  // with a drive each has solutions of its own
  static_cast<Sampled&>(result) = sample(spreads, wanted, [&](const Eigen::VectorXd& numbers) {
    try {
      const si::Experiment moved = events.with(places, numbers);
      const Eigen::VectorXd then =
          events.resisted() ? events.of(moved)
                            : flows(si::patch_ratio(moved, law), [&](const reduction::Flow& flow) -> Eigen::VectorXd {
                                return events.of(moved, flow);
                              });
      for (std::size_t j = 0; j < samples.size(); ++j) samples[j].push_back(then[static_cast<Index>(j)]);
      return true;
    } catch (const std::domain_error&) {
      return false;  // no ball has such numbers
    }
  });
  for (std::size_t j = 0; j < samples.size(); ++j) result.parts[j].known.compare(result.parts[j].value, samples[j]);
  if (si::spin_at_start(experiment) == 0)
    std::erase_if(result.parts, [](const auto& part) { return part.event == "spin_ends" || part.event == "turns"; });
  return result;
}

Json members_of(const si::EventGradient& gradient) {
  Json members = Json::object();
  for (std::size_t i = 0; i < gradient.events.size(); ++i) {
    const auto& [event, of, unit] = gradient.events[i];
    Json slopes = Json::object();
    for (std::size_t j = 0; j < gradient.by.size(); ++j)
      slopes[gradient.by[j].name()] = gradient.slopes(static_cast<Index>(i), static_cast<Index>(j));
    const std::string name(event);
    (of.empty() ? members[name] : members[name][std::string(of)]) = slopes;
  }
  return members;
}

std::string text_of(const si::EventGradient& gradient, const Digits& digits) {
  const auto width = [&](const si::Component& by) {
    return std::max(digits.width(), static_cast<int>(by.name().size()) + 2);
  };
  std::string text = fmt::format("{:<22}", "derivatives, SI, by");
  for (const si::Component& by : gradient.by) text += fmt::format("{:>{}}", by.name(), width(by));
  text += '\n';
  for (std::size_t i = 0; i < gradient.events.size(); ++i) {
    text += fmt::format("{:<22}", label_of(gradient.events[i].event, gradient.events[i].of));
    for (Index j = 0; j < gradient.slopes.cols(); ++j)
      text += fmt::format("{:>{}}", digits(gradient.slopes(static_cast<Index>(i), j)),
                          width(gradient.by[static_cast<std::size_t>(j)]));
    text += '\n';
  }
  return text;
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
  if (std::ranges::all_of(uncertainty.parts, [](const auto& part) { return part.known.standard == 0; }))
    text = "known to: none of these numbers changes it\n";
  bool all_hold = true;
  for (const auto& [event, of, unit, value, known] : uncertainty.parts) {
    if (known.standard == 0) continue;
    text +=
        fmt::format("{:<24}{:>{}} +-{:<{}} from {:>{}} to {:>{}}{}{}{}\n", label_of(event, of), digits(value), width,
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
