#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Coefficients of the expansion m(k; r) = first + r second + O(r^2). m is the sliding coefficient of README (R4); r =
/// gamma mu^2/chi is far below r_low = Phi'(0)/Psi(0). The error is r^2 O(ln^3 k/k) as k -> infinity.
struct CoefficientExpansion {
  double first;
  double second;
};

/// Computes both coefficients at one k, for any law, by two nested integrals (README (R21)).
///
/// @param ln_k  any finite number
/// @throws std::domain_error  if ln_k is not finite
///
/// Accuracy  first 1e-13 relative, second 1e-12 of its maximum (2e-3 to 0.3), for a law whose only kink is k = 1.
/// Cost      up to 3000 calls of the law.
CoefficientExpansion coefficient_expansion(const Law& law, double ln_k);

/// Constants of the expansion k first(k) = k - logarithm ln k - constant + O(1/k) as k -> infinity (README (R23)).
struct FarCoefficient {
  double logarithm;
  double constant;
};

/// Computes the constants. The result is empty for a law whose Phi tends to 1 only like 1/k (the Pade law). Under such
/// a law the logarithm has another origin and the opposite sign.
///
/// Accuracy  logarithm 1e-13, constant 1e-9.
std::optional<FarCoefficient> far_coefficient(const Law& law);

/// One estimate of a stop time.
struct StopEstimate {
  std::string_view name;
  std::string_view formula;  ///< formula as text
  double tau;                ///< the time tau of ReducedSystem, as in StopTime
};

/// Returns the estimates of the stop time for small mu, the roughest first. P and S are the stop times of pure pivoting
/// and pure sliding, k0 = v0/(mu |u0|), and m is that of CoefficientExpansion:
///
///   log  P + S - logarithm of FarCoefficient; for k0 > 1 and a law with a FarCoefficient
///   E1   P + m(k0; 0) S; relative error O(mu^4 ln^2), uniformly in k0
///   E2   E1 and the next term; relative error O(mu^6 ln^3)
///
/// On the axes all of them are exact.
///
/// @throws std::domain_error  if start is not a state, with a drive, or unless r < Phi'(0)/Psi(0) (then k -> 0)
std::vector<StopEstimate> small_mu_estimates(const ReducedSystem& system, State start);

/// The motion from one start to leading order for r = gamma mu^2/chi far below r_low = Phi'(0)/Psi(0) (README (R47)).
///
/// One formula covers two stages. In the first stage, the layer of sliding, w = mu |u| hardly changes. In the second
/// stage, the spin-down, w falls in proportion to the time left, and v falls as a power of the time left. The motion
/// stops at the time E1 of small_mu_estimates.
///
/// Accuracy  at one k0, and at fixed fractions of the layer or of the stop time, the relative error of u is O(mu^4),
///           and that of v (the error of ln v) O(mu^2). As k0 -> infinity each has a factor ln^2 mu. The start and,
///           except for rounding, the axes are exact. Near r_low and above, the errors are as large as the speeds.
class SmallMuMotion {
 public:
  struct Speeds {
    double u;
    double v;     ///< sliding speed; 0 if it underflows, unlike ln_v
    double ln_v;  ///< natural logarithm of v in the unit of the start
  };

  /// Computes the constants of the motion, with as many calls of the law as coefficient_expansion.
  /// @throws std::domain_error  if start is not a state, or with a drive
  SmallMuMotion(const ReducedSystem& system, State start);

  /// Returns the estimate E1 of small_mu_estimates.
  double stop_time() const;

  /// Returns the speeds at the time tau after the start, without a call of the law; rest from stop_time() on.
  /// @throws std::domain_error  if tau is negative or not a number
  Speeds at_time(double tau) const;

 private:
  class Layer;
  std::shared_ptr<const Layer> layer_;  ///< null on the axes
  State start_;
  double pivoting_;       ///< P of README (R18), the stop time of pure pivoting
  double sliding_;        ///< S of README (R18), the stop time of pure sliding
  double pivoting_rate_;  ///< r Psi(0) = -dw/ds at k = 0
  double unit_rate_ = 0;  ///< s/w0 divided by tau, s the scaled time
  double ln_k0_ = 0;
};

}  // namespace contensou::reduction
