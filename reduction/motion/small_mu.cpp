// Notation (README (R21), (R23)): g = (1 - Psi/Psi(0))/Phi, q = k Psi/Phi; m0 = first, m1 = second of the expansion:
//   k m0 = integral of g dk over (0, k),   k m1 = integral of q (g - m0) dk over (0, k)
// and of (R46) I = integral of Psi/(Psi(0) Phi) dk, here 0 at min_ln_k. In y = ln k each integrand gains a factor k.
#include "contensou/reduction/small_mu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/root.hpp"
#include "numerics/legendre_series.hpp"
#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
using Samples = LegendreSeries::Samples;

void require_free(const char* function, const ReducedSystem& system) {
  if (system.drive() == 0) return;
  throw std::domain_error(fmt::format("{}: there is no estimate with a drive, got {}", function, system.drive()));
}

double coefficient_rate(const Law& law, double k) {
  const Slip slip = slip_of_ratio(k);
  return law.moment_deficit(slip) / law(slip).force;
}

/// Returns the edges of panels of width 1, halved repeatedly towards y = 0 (k = 1), at which a law can have a kink.
std::vector<double> panel_edges(double low, double high) {
  constexpr int halvings = 40;
  std::vector<double> edges{low};
  const auto add = [&](double edge) {
    if (edge > edges.back() && edge < high) edges.push_back(edge);
  };
  for (double edge = std::ceil(low); edge <= -1; ++edge) add(edge);
  for (int i = 1; i <= halvings; ++i) add(-std::exp2(-i));
  add(0);
  for (int i = halvings; i >= 1; --i) add(std::exp2(-i));
  for (double edge = 1; edge < high; ++edge) add(edge);
  edges.push_back(high);
  return edges;
}

/// Calls visit(y, half) with the Gauss points and the half width of every panel between low and high, in order.
template <class Visit>
void for_each_panel(double low, double high, Visit visit) {
  const std::vector<double> edges = panel_edges(low, high);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const double half = (edges[i] - edges[i - 1]) / 2;
    visit(Samples(edges[i - 1] + half * (1 + LegendreSeries::points())), half);
  }
}

}  // namespace

CoefficientExpansion coefficient_expansion(const Law& law, double ln_k) {
  if (!std::isfinite(ln_k)) {
    throw std::domain_error(fmt::format("coefficient_expansion: ln k must be finite, got {}", ln_k));
  }
  const double top = std::min(ln_k, max_ln_k);
  // Below min_ln_k the derivative of the integral by k counts as constant, because the integral is so small.
  const double k_low = std::exp(std::clamp(top, std::log(std::numeric_limits<double>::min()), min_ln_k));
  double first = k_low * coefficient_rate(law, k_low);
  double second = 0;
  if (top <= min_ln_k) return {first / k_low, 0};

  for_each_panel(min_ln_k, top, [&](const Samples& y, double half) {
    const Samples k = y.exp();
    Samples rate, moment_over_force;
    for (int i = 0; i < LegendreSeries::order; ++i) {
      const Slip slip = slip_of_ratio(k[i]);
      const auto [force, moment] = law(slip);
      rate[i] = law.moment_deficit(slip) / force;
      moment_over_force[i] = k[i] * moment / force;
    }
    LegendreSeries gain = LegendreSeries::through(k * rate).antiderivative();
    gain *= half;
    LegendreSeries change =
        LegendreSeries::through(moment_over_force * (k * rate - (first + gain.samples()))).antiderivative();
    change *= half;
    first += gain(1);
    second += change(1);
  });
  const double k = std::exp(top);
  return {first / k, second / k};
}

std::optional<FarCoefficient> far_coefficient(const Law& law) {
  constexpr double far = 0x1p20;
  if (std::abs(1 - law(slip_of_ratio(far)).force) * far > 1e-3) return std::nullopt;
  constexpr double fastest = 0x1p100;
  const double c = fastest * law(slip_of_ratio(fastest)).moment / law.pivoting_moment();

  // From this k on, g - 1 + c/k equals its leading term, in 1/k^2. At smaller k the rounding of the sum is negligible.
  constexpr double ln_top = 11;
  const auto rest = [&](double k) { return coefficient_rate(law, k) - 1 + c / k; };
  double integral = 0;
  for_each_panel(0, ln_top, [&](const Samples& y, double half) {
    Samples integrand;
    for (int i = 0; i < LegendreSeries::order; ++i) integrand[i] = std::exp(y[i]) * rest(std::exp(y[i]));
    integral += half * LegendreSeries::through(integrand).antiderivative()(1);
  });
  const double top = std::exp(ln_top);
  integral += top * rest(top);
  return FarCoefficient{c, 1 - coefficient_expansion(law, 0).first - integral};
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

/// k m0 and the integral I of (R46) for all k up to k0, and the inverse of the function k m0 + I of k.
class SmallMuMotion::Layer {
 public:
  Layer(const Law& law, double ln_k0)
      : ln_k0_(ln_k0), force_slope_(law.force_slope()), rate_low_(coefficient_rate(law, std::exp(min_ln_k))) {
    Values sum = below(min_ln_k);
    if (ln_k0 > min_ln_k) {
      for_each_panel(min_ln_k, ln_k0, [&](const Samples& y, double half) {
        Samples gain, pivoting;
        for (int i = 0; i < LegendreSeries::order; ++i) {
          const Slip slip = slip_of_ratio(std::exp(y[i]));
          const auto [force, moment] = law(slip);
          gain[i] = std::exp(y[i]) * law.moment_deficit(slip) / force;
          pivoting[i] = std::exp(y[i]) * moment / (law.pivoting_moment() * force);
        }
        const auto from = [half](double start, const Samples& rate) {
          LegendreSeries integral = LegendreSeries::through(rate).antiderivative();
          integral *= half;
          return integral += start;
        };
        panels_.push_back(
            {(y[0] + y[LegendreSeries::order - 1]) / 2, half, from(sum.gain, gain), from(sum.pivoting, pivoting)});
        sum = panels_.back().at_end();
      });
    }
    start_ = panels_.empty() ? below(ln_k0) : sum;
    start_coefficient_ = panels_.empty() ? rate_low_ : std::exp(-ln_k0) * sum.gain;
  }

  struct Values {
    double gain;      ///< the product k m0
    double pivoting;  ///< the integral I
    double both() const { return gain + pivoting; }
  };

  const Values& start() const { return start_; }

  double start_coefficient() const { return start_coefficient_; }  ///< m0(k0)

  struct Point {
    double ln_k;
    Values values;
  };

  Point where(double both) const {
    if (both >= start_.both()) return {ln_k0_, start_};
    if (panels_.empty() || both <= below(min_ln_k).both()) {
      const double ln_k = min_ln_k + force_slope_ * both;
      return {ln_k, below(ln_k)};
    }
    const auto panel = std::lower_bound(panels_.begin(), panels_.end(), both,
                                        [](const Panel& each, double value) { return each.at_end().both() < value; });
    const auto excess = [&](double t) { return panel->at(t).both() - both; };
    const double t = root_between(excess, -1, 1);
    return {panel->ln_k(t), panel->at(t)};
  }

 private:
  struct Panel {
    double middle, half;
    LegendreSeries gain, pivoting;
    double ln_k(double t) const { return middle + half * t; }
    Values at(double t) const { return {gain(t), pivoting(t)}; }
    Values at_end() const { return {gain.at_end(), pivoting.at_end()}; }
  };

  /// Returns the values at a k so small that Psi = Psi(0) and Phi is linear.
  Values below(double ln_k) const { return {std::exp(ln_k) * rate_low_, (ln_k - min_ln_k) / force_slope_}; }

  double ln_k0_;
  double force_slope_;
  double rate_low_;  ///< d(k m0)/dk at small k
  std::vector<Panel> panels_;
  Values start_{};
  double start_coefficient_;
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
