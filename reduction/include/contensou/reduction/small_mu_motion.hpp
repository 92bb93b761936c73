#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The motion under the Pade law as two explicit functions of time, for small r = gamma mu^2/chi: the sliding layer, in
/// which v dies out while u has hardly changed, joined to the spin-down that follows. One formula for both, from the
/// start to the stop (README (R24)).
///
/// Accuracy  uniformly in k0 and until all but a fixed share of the stop time is over: u/u0 to O(r^2), ln v to O(r),
///           times powers of ln(1 + k0). It stops at the estimate E1 of small_mu.hpp.
class SmallMuMotion {
 public:
  struct Point {
    double u;     ///< keeps the sign of u0; 0 at the stop
    double ln_v;  ///< -inf at the stop
  };

  /// @throws std::domain_error  as ReducedSystem; if start is not a state; unless r < 2
  SmallMuMotion(double patch_ratio, State start, Inertia inertia = homogeneous_ball);

  /// The paper's time at which u and v vanish.
  double stop_time() const { return stop_time_; }

  /// @param tau  the paper's time since the start; past the stop, rest
  /// @throws std::domain_error  if tau is negative or not a number
  Point at_time(double tau) const;

 private:
  double r_;
  double u0_, ln_v0_;
  double sliding_, pivoting_;  ///< S and P
  double stop_time_;
  double fast_, ln_fast_;  ///< K0 = 3 pi k0/8: sliding speed at the start in the unit in which the layer is W
  double layer_rate_;      ///< K0/S
};

}  // namespace contensou::reduction
