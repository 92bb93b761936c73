// Notation (theory.md (R12), (R13)): g = (1 - Psi/Psi(0))/Phi; m0 = first, m1 = second of the expansion. For r -> 0 the
// equation (R7) of m becomes that of m0, and its derivative by r, (R35), that of m1:
//   Phi (m0' + m0) = 1 - Psi/Psi(0),   Phi (m1' + m1) = k Psi m0',   ' = d/d ln k,   m0' = g - m0
// The integral I of (R14) is the limit of ln w/(r Psi(0)), (R2).
#include "contensou/reduction/small_mu.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "similarity/curves.hpp"
#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

namespace {

/// An r that changes no digit of Phi - r k Psi at any k of the library. Curves of this r have the values for r -> 0.
constexpr double vanishing_r = 0x1p-200;

void require_free(const char* function, const ReducedSystem& system) {
  if (system.drive() == 0) return;
  throw std::domain_error(fmt::format("{}: there is no estimate with a drive, got {}", function, system.drive()));
}

double coefficient_rate(const Law& law, double k) {
  const Slip slip = slip_of_ratio(k);
  return law.moment_deficit(slip) / law(slip).force;
}

/// Returns m0 for all k.
RegularSolution first_coefficient(const Law& law) {
  return sliding_solution(law, vanishing_r, TerminalChart::to_zero(), 0);
}

}  // namespace

CoefficientExpansion coefficient_expansion(const Law& law, double ln_k) {
  if (!std::isfinite(ln_k)) {
    throw std::domain_error(fmt::format("coefficient_expansion: ln k must be finite, got {}", ln_k));
  }
  const RegularSolution first = first_coefficient(law);
  const auto source = [&](double k) {
    return k * law(slip_of_ratio(k)).moment * (coefficient_rate(law, k) - first(std::log(k)));
  };
  const RegularSolution second = sliding_equation(law, vanishing_r, TerminalChart::to_zero(), 0, false, source);
  return {first(ln_k), second(ln_k)};
}

std::optional<FarCoefficient> far_coefficient(const Law& law) {
  constexpr double far = 0x1p20;
  if (std::abs(1 - law(slip_of_ratio(far)).force) * far > 1e-3) return std::nullopt;
  constexpr double fastest = 0x1p100;
  const double c = fastest * law(slip_of_ratio(fastest)).moment / law.pivoting_moment();

  // From this k on, g - 1 + c/k equals its leading term, in 1/k^2. At a larger k the difference 1 - m0 loses digits.
  constexpr double ln_k = 11;
  const double k = std::exp(ln_k), rest = coefficient_rate(law, k) - 1 + c / k;
  return FarCoefficient{c, k * (1 - first_coefficient(law)(ln_k) - rest) - c * ln_k};
}

std::vector<StopEstimate> small_mu_estimates(const ReducedSystem& system, State start) {
  require_state("small_mu_estimates", start);
  require_free("small_mu_estimates", system);
  const Law& law = system.law();
  const double limit = law.force_slope() / law.pivoting_moment();
  if (!(system.r() < limit)) {
    throw std::domain_error(fmt::format(
        "small_mu_estimates: r = gamma mu^2/chi = {:.6g} is not small: law {} has estimates for r << {:.6g} "
        "only, where k tends to 0",
        system.r(), law.name(), limit));
  }
  const double pivoting = system.pivoting_limit(start.u);
  const double sliding = system.sliding_limit(start.v);
  const bool on_axis = start.u == 0 || start.v == 0;
  const double ln_k = on_axis ? 0 : std::log(start.v) - std::log(system.mu()) - std::log(std::abs(start.u));

  std::vector<StopEstimate> estimates;
  const auto far = far_coefficient(law);
  if (far && (start.u == 0 || ln_k > 0)) {
    // S/k0 is the time of pure sliding from the rim speed to 0.
    const double rim = on_axis ? 0 : sliding * std::exp(-ln_k) * (far->logarithm * ln_k + far->constant);
    estimates.push_back({"log", "E1 for k0 >> 1, P + S (1 - (c ln k0 + d)/k0)", pivoting + sliding - rim});
  }
  const CoefficientExpansion m = on_axis ? CoefficientExpansion{} : coefficient_expansion(law, ln_k);
  const auto with_coefficient = [&](double value) { return start.v == 0 ? pivoting : pivoting + value * sliding; };
  estimates.push_back({"E1", "relative error O(mu^4 ln^2 mu)", start.u == 0 ? sliding : with_coefficient(m.first)});
  estimates.push_back({"E2", "relative error O(mu^6 ln^3 mu)",
                       start.u == 0 ? sliding : with_coefficient(m.first + system.r() * m.second)});
  return estimates;
}

/// k m0 and the integral I of (R14) for all k, and the inverse of the function k m0 + I of k, for k up to k0.
class SmallMuMotion::Layer {
 public:
  Layer(const Law& law, double ln_k0) : curve_(law, vanishing_r), law_(law), ln_k0_(ln_k0), start_(at(ln_k0)) {}

  struct Values {
    double gain;      ///< the product k m0
    double pivoting;  ///< the integral I
    double both() const { return gain + pivoting; }
  };

  const Values& start() const { return start_; }

  double start_coefficient() const { return curve_.sliding_coefficient(ln_k0_); }  ///< m0(k0)

  struct Point {
    double ln_k;
    Values values;
  };

  Point where(double both) const {
    if (both >= start_.both()) return {ln_k0_, start_};
    // Below this k, Psi = Psi(0) and Phi is linear, so I is linear in ln k and k m0 is negligible.
    const double linear_below = std::min(min_ln_k, ln_k0_), beyond = both - at(linear_below).both();
    const double ln_k = beyond <= 0 ? linear_below + law_.force_slope() * beyond
                                    : root_between([&](double x) { return at(x).both() - both; }, linear_below, ln_k0_);
    return {ln_k, at(ln_k)};
  }

 private:
  Values at(double ln_k) const {
    return {std::exp(ln_k) * curve_.sliding_coefficient(ln_k),
            curve_.ln_w(ln_k) / (vanishing_r * law_.pivoting_moment())};
  }

  QuadratureCurve curve_;
  Law law_;
  double ln_k0_;
  Values start_;
};

SmallMuMotion::SmallMuMotion(const ReducedSystem& system, State start)
    : start_(start),
      pivoting_(system.pivoting_limit(start.u)),
      sliding_(system.sliding_limit(start.v)),
      pivoting_rate_(system.r() * system.law().pivoting_moment()) {
  require_state("SmallMuMotion", start);
  require_free("SmallMuMotion", system);
  if (start.u == 0 || start.v == 0) return;
  // A rim speed below v exp(-max_ln_k) has no effect on the sliding.
  const double ln_w0 = std::max(std::log(system.mu()) + std::log(std::abs(start.u)), std::log(start.v) - max_ln_k);
  ln_k0_ = std::log(start.v) - ln_w0;
  unit_rate_ = std::exp(std::log(system.scaled_time_rate()) - ln_w0);
  layer_ = std::make_shared<Layer>(system.law(), ln_k0_);
}

double SmallMuMotion::stop_time() const { return pivoting_ + sliding_ * (layer_ ? layer_->start_coefficient() : 1); }

SmallMuMotion::Speeds SmallMuMotion::at_time(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("SmallMuMotion::at_time: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  if (tau >= stop) return {0, 0, -infinity};
  if (!layer_) {
    const double left = 1 - tau / stop;
    return {left * start_.u, left * start_.v, std::log(start_.v) + std::log(left)};
  }
  const auto& [gain0, pivoting0] = layer_->start();
  const double theta = gain0 - unit_rate_ * tau;
  if (pivoting_rate_ * theta <= -1) return {0, 0, -infinity};
  const double clock = theta >= 0 ? theta : std::log1p(pivoting_rate_ * theta) / pivoting_rate_;
  const auto [ln_k, now] = layer_->where(pivoting0 + clock);
  // For theta >= 0 both formulas are equal, but the difference theta - k m0 loses digits.
  const double fall = theta >= 0 ? now.pivoting - pivoting0 : theta - now.gain;
  const double ln_v_ratio = ln_k - ln_k0_;
  return {start_.u * std::max(1 + pivoting_rate_ * fall, 0.0), start_.v * std::exp(ln_v_ratio),
          std::log(start_.v) + ln_v_ratio};
}

}  // namespace contensou::reduction
