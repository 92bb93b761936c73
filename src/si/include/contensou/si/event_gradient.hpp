#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/description.hpp"

namespace contensou::si {

/// A number of an event of a motion: {"rolls_after", "t", "s"}; of one that is a number by itself, "path", `of` is empty.
struct EventNumber {
  std::string_view event, of, unit;
};

/// The numbers of the events of a ball's motions, each with numbers of its own or of its start in place of the ball's: when
/// and where it rolls or, lying flat, rests; when and where its spin ends; with rolling friction or on a slope when and
/// where it rests, if it does; slip length, turns, path (as Events); stop time.
class EventNumbers {
 public:
  /// @param rolling_below  as of Motion::rolls; the rolling friction is the experiment's own
  /// @throws std::domain_error  as Motion::reduced and finite, and for one at rest
  EventNumbers(const Experiment& experiment, const reduction::Law& law, double rolling_below);

  const std::vector<EventNumber>& names() const { return names_; }
  const Eigen::VectorXd& values() const { return values_; }
  bool resisted() const;

  /// The components that it is given by, and what they are.
  const std::vector<Component>& components() const { return components_; }
  double value(const Component& of) const;

  /// The experiment with these in place of its own.
  /// @throws std::domain_error  if there is no such experiment
  Experiment with(const std::vector<Component>& components, const Eigen::VectorXd& values) const;

  /// Of such an experiment.
  /// @param flow  of undriven_system(other, law)
  /// @throws std::domain_error  as Motion::reduced and finite, and where it rolls for ever and this one rests
  Eigen::VectorXd of(const Experiment& other, const reduction::Flow& flow) const;
  Eigen::VectorXd of(const Experiment& other) const;

  /// How they change with a component, the others kept, by differences of fourth order, a thousandth of it apart: those by
  /// the start and by friction to 1e-8 against the algebra of (R61); the time of rest of a motion that is integrated in
  /// steps to 1e-8, too. None where they have a corner, as at a spin of 0 and by what moves a slip that is the
  /// threshold of rolling to 1e-6, and at the end of what a ball can have.
  std::optional<Eigen::VectorXd> slopes(const Component& by) const;

 private:
  Experiment experiment_;
  Description described_;
  reduction::Law law_;
  double rolling_below_;
  reduction::Flow flow_;
  std::vector<EventNumber> names_;
  std::vector<Component> components_;
  Eigen::VectorXd values_;
};

/// The slopes of all events by all components that have them.
struct EventGradient {
  std::vector<EventNumber> events;
  std::vector<Component> by;
  Eigen::MatrixXd slopes;  ///< a row for each event, a column for each component, in SI units
};
EventGradient event_gradient(const EventNumbers& numbers);

}  // namespace contensou::si
