#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/detail/stop_times_of_mu.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/si/description.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

/// The numbers of the events of a ball's motion, as functions of the numbers by which the experiment is given.
///
/// The events are: the ball begins to roll (a body that lies flat comes to rest), the spin ends, and, with rolling
/// friction or on a slope, the ball comes to rest. Each event has a time and a place. The other numbers are slip
/// length, turns, path and stop time.
class EventNumbers {
 public:
  /// @param rolling_below  as in Motion::rolls; if it is empty, the stop time is the only number. The experiment
  ///                       contains the rolling friction
  /// @throws std::domain_error  as Motion::reduced and finite; for a ball at rest
  EventNumbers(const Experiment& experiment, const reduction::Law& law, std::optional<double> rolling_below);

  const std::vector<EventNumber>& names() const { return names_; }
  const Eigen::VectorXd& values() const { return values_; }
  bool resisted() const;

  /// Returns the components of the quantities by which the experiment is given.
  const std::vector<Component>& components() const { return components_; }
  double value(const Component& of) const;

  /// Returns the experiment with other values of some components.
  /// @throws std::domain_error  if there is no such experiment
  Experiment with(const std::vector<Component>& components, const Eigen::VectorXd& values) const;

  /// Returns the numbers of another experiment of this kind.
  /// @throws std::domain_error  as Motion::reduced and finite; if the other ball rolls for ever and this one comes to
  ///                            rest
  Eigen::VectorXd of(const Experiment& other) const;

  /// Returns the derivatives of the numbers by one component, by fourth-order differences over a thousandth of its
  /// value. Empty if the numbers have no derivative: at a spin of 0, at the limits of the component, and, for a
  /// component that changes the slip, if the slip is within 1e-6 of the threshold of rolling.
  ///
  /// Accuracy  1e-8 for the derivatives by the start and by friction, compared with reduction/theory.md (R11), and for
  ///           the time of rest of a motion that is integrated in steps.
  std::optional<Eigen::VectorXd> slopes(const Component& by) const;

 private:
  /// @param flow  flow of undriven_system(other, law)
  Eigen::VectorXd of(const Experiment& other, const reduction::Flow& flow) const;

  Experiment experiment_;
  Description described_;
  reduction::Law law_;
  std::optional<double> rolling_below_;
  reduction::Flow flow_;
  reduction::StopTimesOfMu stop_times_;  ///< stop times of other experiments, which need no solution of their own
  std::vector<EventNumber> names_;
  std::vector<Component> components_;
  Eigen::VectorXd values_;
};

/// The derivatives of all events by all components. Components without a derivative are left out.
struct EventGradient {
  std::vector<EventNumber> events;
  std::vector<Component> by;
  Eigen::MatrixXd slopes;  ///< in SI units; one row for each event, one column for each component
};
EventGradient event_gradient(const EventNumbers& numbers);

}  // namespace contensou::si
