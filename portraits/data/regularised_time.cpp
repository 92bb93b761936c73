#include "data/regularised_time.hpp"

#include <algorithm>
#include <cmath>

namespace contensou::portraits {

bool is_one_orbit(const reduction::Flow& flow, const PortraitOrbit& motion) {
  constexpr double same = 1e-9;
  const double stop = flow.orbit({motion.u[0], motion.v[0]}).stop_time();
  return std::abs(motion.tau_left[0] - stop) <= same * stop;
}

Eigen::ArrayXd regularised_times(const reduction::Flow& flow, const PortraitOrbit& motion) {
  if (!is_one_orbit(flow, motion)) return {};
  const reduction::Orbit orbit = flow.orbit({motion.u[0], motion.v[0]});
  Eigen::ArrayXd betas(motion.rows());
  for (Eigen::Index row = 0; row < motion.rows(); ++row) {
    betas[row] = row == 0 ? 0 : orbit.at_time_left(std::min(motion.tau_left[row], orbit.stop_time())).beta;
  }
  return betas;
}

}  // namespace contensou::portraits
