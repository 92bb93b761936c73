#pragma once

#if __cplusplus < 202002L
#error "C++20 is needed: compile contensou with -std=c++20"
#endif

#include <limits>

#ifdef __FAST_MATH__
#error "contensou needs infinities, NaN and sums in the order that is written: compile without -ffast-math"
#endif

namespace contensou::reduction {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53,
              "contensou needs doubles of 64 bits after IEEE 754");

/// The motion of a circular contact patch over the plane: two speeds in one unit, both >= 0 and not both 0.
///
/// Two speeds need no infinity, unlike their ratio k = sliding/pivoting: pure sliding (pivoting = 0) and pure pivoting
/// (sliding = 0) are ordinary values.
struct Slip {
  double sliding;   ///< speed v of the patch centre
  double pivoting;  ///< rim speed w = (patch radius) |omega_z| = mu |u| of the rotation about the normal
};

/// Force and moment of friction in dimensionless form, the result of a law.
struct Resistance {
  double force;   ///< Phi = F/(N f), opposes sliding
  double moment;  ///< Psi = M/(N f (patch radius)), opposes pivoting
};

/// Returns a slip with the ratio k = sliding/pivoting, whose larger speed is 1.
///
/// @param k  from 0 (pure pivoting) to infinity (pure sliding)
/// @throws std::domain_error  if k is negative or not a number
Slip slip_of_ratio(double k);

/// Throws for a slip at which no friction law has a value.
///
/// @param law  name of the law, with which the message begins
/// @throws std::domain_error  if a speed is negative or not finite, or if both are 0: friction has no limit at rest
///                            (V. F. Zhuravlev, 1998, remark 3)
void require_slip(const char* law, Slip slip);

}  // namespace contensou::reduction
