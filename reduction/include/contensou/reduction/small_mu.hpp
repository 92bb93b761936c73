#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Coefficients of the expansion m(k; r) = first + r second + O(r^2) for small r. m is the sliding coefficient of
/// theory.md (R4); r = gamma mu^2/chi is far below r_low = Phi'(0)/Psi(0). The error is r^2 O(ln^3 k/k) for k ->
/// infinity.
struct CoefficientExpansion {
  double first;
  double second;
};

/// Computes both coefficients at one k, for any law, as m and its derivative by r in the limit r -> 0 (theory.md
/// (R12)).
///
/// @param ln_k  any finite number
/// @throws std::domain_error  if ln_k is not finite
///
/// Accuracy  first 1e-13 relative for k above 4e-18, second 1e-12 of its maximum (2e-3 to 0.3).
/// Cost      that of two curves.
CoefficientExpansion coefficient_expansion(const Law& law, double ln_k);

/// Constants of the expansion k first(k) = k - logarithm ln k - constant + O(1/k) as k -> infinity (theory.md (R13)).
struct FarCoefficient {
  double logarithm;
  double constant;
};

/// Computes the constants. The result is empty for a law whose Phi tends to 1 only like 1/k (the Pade law). Under such
/// a law the term in ln k has another cause and the opposite sign.
///
/// Accuracy  logarithm 1e-13, constant 1e-9.
std::optional<FarCoefficient> far_coefficient(const Law& law);

/// One estimate of a stop time.
struct StopEstimate {
  std::string_view name;
  std::string_view formula;  ///< formula as text
  double tau;                ///< the time tau of ReducedSystem, as in StopTime
};

/// Returns the estimates of the stop time for small mu, the roughest first. P is the stop time of pure pivoting, S that
/// of pure sliding, k0 = v0/(mu |u0|), and m(k; r) the coefficient of CoefficientExpansion:
///
///   log  P + S (1 - (logarithm ln k0 + constant)/k0), FarCoefficient; for k0 > 1 and a law with a FarCoefficient
///   E1   P + m(k0; 0) S; relative error O(mu^4 ln^2 mu), uniformly in k0
///   E2   E1 + r second S; relative error O(mu^6 ln^3 mu)
///
/// On the axes all three are exact.
///
/// @throws std::domain_error  if start is not a state, for a drive, or unless r < Phi'(0)/Psi(0) (then k -> 0)
std::vector<StopEstimate> small_mu_estimates(const ReducedSystem& system, State start);

/// The motion from one start to leading order for r = gamma mu^2/chi far below r_low = Phi'(0)/Psi(0) (theory.md
/// (R15)).
///
/// One formula covers two stages. In the first stage, w = mu |u| hardly changes (the layer of sliding). In the second
/// stage, the spin-down, w falls in proportion to the time left, and v falls as a power of the time left. The motion
/// stops at the time E1 of small_mu_estimates.
///
/// Accuracy  at one k0, and at fixed fractions of the layer or of the stop time, the relative error of u is O(mu^4),
///           that of v is O(mu^2). For k0 -> infinity both errors get a factor ln^2 mu. The start and, except for
///           rounding, the axes are exact. If r is near or above r_low, the errors are as large as the speeds.
class SmallMuMotion {
 public:
  struct Speeds {
    double u;
    double v;     ///< sliding speed; 0 if it underflows, while ln_v stays finite
    double ln_v;  ///< natural logarithm of v in the unit of the start
  };

  /// Computes the constants of the motion, at the cost of coefficient_expansion.
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
  double pivoting_;       ///< P of theory.md (R5), the stop time of pure pivoting
  double sliding_;        ///< S of theory.md (R5), the stop time of pure sliding
  double pivoting_rate_;  ///< r Psi(0) = -dw/ds at k = 0
  double unit_rate_ = 0;  ///< d(s/w0)/dtau; s is the scaled time, w0 = mu |u0|
  double ln_k0_ = 0;
};

}  // namespace contensou::reduction
