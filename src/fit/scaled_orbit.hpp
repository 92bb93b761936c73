#pragma once

#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/flow.hpp"

namespace contensou::fit {

/// Columns over instants T = f g t, a speed.
struct OrbitColumns {
  Eigen::ArrayXd v, u;          ///< sliding and pivoting, m/s
  Eigen::ArrayXd slid, turned;  ///< their integrals over T
  Eigen::ArrayXd dv, du;        ///< their derivatives by T
};

/// An orbit of the reduced system in T = f g t, where friction is in no equation, for many instants at once: nodes of
/// the closed orbit, as dense as cubics between them need to be.
class ScaledOrbit {
 public:
  /// @param start  v of either sign: the motion of -v is that of v, mirrored
  /// @param end       T up to which it is asked for
  /// @param accuracy  in speeds at the start
  ScaledOrbit(const reduction::Flow& flow, reduction::State start, double end, double accuracy = standard_accuracy);

  static constexpr double standard_accuracy = 1e-9;

  /// T of the stop.
  double stop() const { return stop_; }

  /// @param at  T >= 0; quick where it increases
  OrbitColumns operator()(const Eigen::ArrayXd& at) const;

 private:
  struct Node {
    double T, v, u, dv, du, slid = 0, turned = 0;
  };
  std::vector<Node> nodes_;
  double stop_;
};

}  // namespace contensou::fit
