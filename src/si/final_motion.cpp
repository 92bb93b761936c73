#include "contensou/si/final_motion.hpp"

namespace contensou::si {

FinalMotion final_motion(const Shot& shot) {
  const double speed = shot.start.slip * (5.0 / 7.0);
  return {{speed, 0}, {0, speed / shot.ball.radius, 0}};
}

}  // namespace contensou::si
