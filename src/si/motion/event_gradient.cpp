#include "contensou/si/event_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::si {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

Experiment without_spreads(Experiment experiment) {
  experiment.spreads = {};
  return experiment;
}

}  // namespace

EventNumbers::EventNumbers(const Experiment& experiment, const reduction::Law& law, std::optional<double> rolling_below)
    : experiment_(without_spreads(experiment)),
      described_(describe(experiment_)),
      law_(law),
      rolling_below_(rolling_below),
      flow_(undriven_system(experiment, law)),
      stop_times_(law, flow_.system().inertia()) {
  const bool flat = experiment.ball.body.lies_flat();
  if (slip_at_start(experiment) == 0 && spin_at_start(experiment) == 0)
    throw std::domain_error("a body at rest has no events");
  if (rolling_below) {
    const bool rolls_and_rests = !flat && Motion::reduced(experiment_, flow_).finite().rest();
    for (EventNumber number : event_numbers()) {
      if (number.event == "rest" && !rolls_and_rests) continue;
      if (number.event == "rolls_after" && flat) number.event = "rest";
      names_.push_back(number);
    }
  }
  names_.push_back({"t_stop", "", "s"});
  for (const Component& each : uncertain_components()) {
    const bool fixed = flat && each.quantity == &angular_velocity && each.index < 2;
    if (described_.find(*each.quantity) && !fixed) components_.push_back(each);
  }
  values_ = of(experiment_, flow_);
}

bool EventNumbers::resisted() const { return is_driven(experiment_); }

double EventNumbers::value(const Component& of) const { return described_.find(*of.quantity)->numbers[of.index]; }

Experiment EventNumbers::with(const std::vector<Component>& components, const VectorXd& values) const {
  Description changed = described_;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const auto& [quantity, index] = components[i];
    std::vector<double> numbers = changed.find(*quantity)->numbers;
    numbers[index] = values[static_cast<Index>(i)];
    changed.set(*quantity, std::move(numbers), {"", components[i].name(), ""});
  }
  return experiment_of(changed);
}

VectorXd EventNumbers::of(const Experiment& other, const reduction::Flow& flow) const {
  const Motion motion = Motion::reduced(other, flow).finite();
  if (!rolling_below_) return VectorXd::Constant(1, motion.stop_time());
  const Events events = motion.events(*rolling_below_);
  VectorXd values = VectorXd::Constant(static_cast<Index>(names_.size()), motion.stop_time());
  for (Index i = 0; i + 1 < values.size(); ++i) values[i] = names_[static_cast<std::size_t>(i)].value(events);
  if (!values.allFinite()) throw std::domain_error("it rolls for ever");
  return values;
}

VectorXd EventNumbers::of(const Experiment& other) const {
  if (!rolling_below_ && !resisted()) {
    const double stop = seconds(other, stop_times_(patch_ratio(other, law_), reduced_start(other)));
    require_finite_motion(other, stop);
    return VectorXd::Constant(1, stop);
  }
  const bool same = patch_ratio(other, law_) == flow_.system().mu();
  return of(other, same ? flow_ : reduction::Flow(undriven_system(other, law_)));
}

std::optional<VectorXd> EventNumbers::slopes(const Component& by) const {
  const bool by_velocities = std::holds_alternative<Velocities>(experiment_.start);
  const Eigen::Vector2d rolls = velocities_of(experiment_.start).angular_velocity.head<2>();
  const double slip_speed = slip_at_start(experiment_), at = value(by);
  // Steps must not cross points at which the numbers have no derivative. Such points are the value 0 of a component,
  // the slip 0, because the slip is the length of a vector, and the threshold of rolling for all components that change
  // the slip.
  constexpr double share = 1e-3, reach = 2.5 * share;
  const double beyond = std::abs(slip_speed - (experiment_.ball.body.lies_flat() ? 0 : rolling_below_.value_or(0)));
  const double free = std::min(slip_speed, beyond / reach);
  double scale = std::abs(at);
  const auto limit = [&](double slip_by_it, double own) {
    constexpr double too_near = 1e-6;
    scale = beyond < too_near * slip_speed ? 0 : std::min(own, free / slip_by_it);
  };
  if (by.quantity == &slip) limit(1, scale);
  if (by.quantity == &velocity) limit(1, infinity);
  if (by.quantity == &angular_velocity && by.index < 2) limit(experiment_.ball.radius, infinity);
  if (by.quantity == &radius && by_velocities && rolls != Eigen::Vector2d::Zero()) limit(rolls.norm(), scale);
  if (scale == 0) return std::nullopt;
  const double step = share * scale;
  const auto beside = [&](double steps) { return of(with({by}, VectorXd::Constant(1, at + steps * step))); };
  try {
    return (8 * (beside(1) - beside(-1)) - (beside(2) - beside(-2))) / (12 * step);
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

EventGradient event_gradient(const EventNumbers& numbers) {
  EventGradient gradient{numbers.names(), {}, Eigen::MatrixXd(numbers.values().size(), 0)};
  for (const Component& by : numbers.components()) {
    const auto slopes = numbers.slopes(by);
    if (!slopes) continue;
    gradient.by.push_back(by);
    gradient.slopes.conservativeResize(Eigen::NoChange, gradient.slopes.cols() + 1);
    gradient.slopes.rightCols<1>() = *slopes;
  }
  return gradient;
}

}  // namespace contensou::si
