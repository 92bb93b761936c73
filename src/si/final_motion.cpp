#include "contensou/si/final_motion.hpp"

namespace contensou::si {

namespace {

struct Rolling {
  const Shot& shot;

  FinalMotion operator()(const SlipAndSpin& start) const {
    const double speed = start.slip * (5.0 / 7.0);
    return {{speed, 0}, {0, speed / shot.ball.radius, 0}};
  }

  FinalMotion operator()(const Velocities& start) const {
    const Eigen::Vector2d rolling = start.velocity - slip_velocity_at_start(shot) * (2.0 / 7.0);
    const double R = shot.ball.radius;
    return {rolling, {(0 - rolling.y()) / R, rolling.x() / R, 0}};  // 0 - y: no -0
  }
};

}  // namespace

FinalMotion final_motion(const Shot& shot) { return std::visit(Rolling{shot}, shot.start); }

}  // namespace contensou::si
