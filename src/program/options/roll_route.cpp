#include "options/roll_route.hpp"

#include "contensou/si/integrated_motion.hpp"

namespace contensou::program {

std::string_view name_of(RollRoute route) { return roll_route_names[static_cast<std::size_t>(route)]; }

si::MotionColumns roll_motion(const si::Shot& shot, const reduction::Law& law, RollRoute route,
                              const Eigen::ArrayXd& times) {
  return route == RollRoute::reduced ? si::WholeMotion(shot, law).at_times(times)
                                     : si::integrate_motion(shot, law, times).points;
}

double rolling_time(const si::Shot& shot, const si::WholeMotion& motion) {
  return si::spin_at_start(shot) == 0 ? motion.stop_time() : motion.slip_time(rolling_share);
}

double standard_end(const si::Shot& shot, const reduction::Law& law) {
  const double stop = si::WholeMotion(shot, law).stop_time();
  return stop > 0 ? 1.1 * stop : 1;
}

}  // namespace contensou::program
