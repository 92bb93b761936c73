#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// m(k; r) = first + r second + O(r^2): the sliding coefficient of README (R4) for r = gamma mu^2/chi far below
/// r_low = Phi'(0)/Psi(0). The error is r^2 O(ln^3 k/k) as k -> infinity.
struct CoefficientExpansion {
  double first;
  double second;
};

/// Both coefficients at one k, for any law, by two nested integrals (README (R21)).
///
/// @param ln_k  any finite number
/// @throws std::domain_error  if ln_k is not finite
///
/// Accuracy  first 1e-13 relative, second 1e-12 of the largest |second| over all k (2e-3 to 0.3, by law), for a law
///           whose only kink is at k = 1. Cost: up to 3000 calls of the law.
CoefficientExpansion coefficient_expansion(const Law& law, double ln_k);

/// k first(k) = k - logarithm ln k - constant + O(1/k) as k -> infinity (README (R23)).
struct FarCoefficient {
  double logarithm;
  double constant;
};

/// Empty for a law whose Phi nears 1 like 1/k only (the Pade law): its logarithm has another origin, and in it the
/// other sign.
///
/// Accuracy  logarithm 1e-13, constant 1e-9.
std::optional<FarCoefficient> far_coefficient(const Law& law);

/// One estimate of a stop time.
struct StopEstimate {
  std::string_view name;
  std::string_view formula;  ///< in words for people
  double tau;                ///< the paper's time, as StopTime::tau
};

/// The estimates of the stop time that this law has for a small mu, the roughest first:
///
///   log  P + S less the logarithm of the far coefficient; for k0 > 1, and a law that has a FarCoefficient
///   E1   P + m(k0; 0) S; relative error O(mu^4 ln^2), uniformly in k0
///   E2   the next term; O(mu^6 ln^3)
///
/// On the axes all of them are exact.
///
/// @throws std::domain_error  if start is not a state, with a drive, or for r >= Phi'(0)/Psi(0): there k does not tend to
///                            0, and nothing is small
std::vector<StopEstimate> small_mu_estimates(const ReducedSystem& system, State start);

/// The motion from one start to the leading order for r = gamma mu^2/chi far below r_low = Phi'(0)/Psi(0), for any law
/// (README (R47)): a layer of sliding, in which w hardly changes, then spin-down, in which w falls in proportion to the
/// time left and v as a power of it, as one formula for both. It stops at E1.
///
/// Accuracy  at one k0, and at fixed fractions of the layer or of the stop time, the relative error of u is O(mu^4), and
///           that of v, which is the error of ln v, O(mu^2); as k0 -> infinity each has a factor ln^2 mu. Exact at the
///           start and, but for rounding, on the axes. Any r is taken: near r_low and above it nothing is small, and
///           the errors are as large as the speeds.
class SmallMuMotion {
 public:
  struct Speeds {
    double u;
    double v;     ///< 0 where it underflows; ln_v does not
    double ln_v;  ///< natural logarithm of v in the unit of the start
  };

  /// Calls the law as often as coefficient_expansion does.
  /// @throws std::domain_error  if start is not a state, or with a drive
  SmallMuMotion(const ReducedSystem& system, State start);

  /// E1 of small_mu_estimates.
  double stop_time() const;

  /// The speeds tau after the start, without a call of the law; rest from stop_time() on.
  /// @throws std::domain_error  if tau is negative or not a number
  Speeds at_time(double tau) const;

 private:
  class Layer;
  std::shared_ptr<const Layer> layer_;  ///< null on the axes
  State start_;
  double pivoting_;       ///< P
  double sliding_;        ///< S
  double pivoting_rate_;  ///< r Psi(0) = -dw/ds at k = 0
  double unit_rate_ = 0;  ///< of s/w0 over tau
  double ln_k0_ = 0;
};

}  // namespace contensou::reduction
