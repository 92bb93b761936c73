#pragma once

#include <optional>

#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The state of a stepper: logarithms of w = mu |u| and v, scaled time s and regularised time beta since the start.
struct LogState {
  double ln_w;
  double ln_v;
  double s;
  double beta;  ///< integral of ds/((16 w + 15 pi v)(8 w + 3 pi v))
};

/// The tail of a motion, in which either pivoting alone or sliding alone determines the friction. Letters as in
/// ReducedSystem, k = v/w. For k -> 0, w falls at the rate r Psi(0) in s, and v is a power of w by the linearised law.
/// For k -> infinity, v falls at the rate 1 - rho, and w is a power of v.
class AsymptoticTail {
 public:
  /// Returns the tail from this state on, with an error below 1e-17 of the time s; empty if there is no such tail.
  static std::optional<AsymptoticTail> at(const ReducedSystem& system, const LogState& state);

  /// Returns the scaled time from the start to the stop.
  double stop() const { return from_.s + left_; }

  /// Returns the state at a scaled time between `from` and stop().
  LogState at_time(double s) const { return at_fraction((stop() - s) / left_); }

  /// Returns the state at which the given fraction of the tail's time is left, 0 < fraction <= 1.
  LogState at_fraction(double fraction) const;

 private:
  AsymptoticTail(const ReducedSystem& system, const LogState& from, bool pivoting);

  LogState from_;
  double left_;
  double ln_v_slope_;  ///< d ln v/d ln (time left)
  double ln_w_slope_;
  double beta_scale_;  ///< beta since `from` is beta_scale_ (1/f - 1); f is the share left of the tail's time
};

}  // namespace contensou::reduction
