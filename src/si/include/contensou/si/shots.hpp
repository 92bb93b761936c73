#pragma once

#include <memory>
#include <utility>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/course.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::si {

/// Many motions of one ball that differ in their starts alone: what they share is solved once. Threads may share it.
class Shots {
 public:
  /// @param ball              its start does not count
  /// @param rolling_below     as Course's
  /// @param u_r               in place of the ball's own
  /// @throws std::domain_error  as undriven_system and require_stop
  Shots(Experiment ball, const reduction::Law& law, double rolling_below, double u_r)
      : experiment_(std::move(ball)),
        flow_(undriven_system(experiment_, law)),
        rolling_below_(rolling_below),
        rolling_friction_(u_r) {
    require_stop(experiment_);
  }

  /// @throws std::domain_error  as require_experiment and Course
  Course<BallMotion> from(const Start& start) const {
    Experiment experiment = experiment_;
    experiment.start = start;
    require_experiment(experiment);
    return {experiment, BallMotion(experiment, flow_), rolling_below_, rolling_friction_, flows_};
  }

 private:
  Experiment experiment_;
  reduction::Flow flow_;
  std::shared_ptr<ResistedFlows> flows_ = std::make_shared<ResistedFlows>();
  double rolling_below_, rolling_friction_;
};

}  // namespace contensou::si
