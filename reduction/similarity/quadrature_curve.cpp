// Notation (README (R1) to (R7), (R26)): w = mu |u|, k = v/w, D = Phi - r k Psi, ' = d/dxi, q = (ln k)'/D > 0;
//   (ln w)' = r k Psi q,   (ln v)' = Phi q
//   m' + (ln v)' m = (1 - Psi/Psi(0)) q
//   n' + (ln v w)' n = k (1 - Phi) q
//   b' - (ln(w + v))' b = -(1 + k) k q/((16 + 15 pi k)(8 + 3 pi k))
//   c = k q/(1 + k)
#include "contensou/reduction/quadrature_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "numerics/legendre_series.hpp"
#include "numerics/relaxation.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
using Samples = LegendreSeries::Samples;

/// Beyond these, one term of each expansion is exact to the last bit: exp(-40) = 4e-18, exp(44) = 1e19.
constexpr double lowest_ln_k = -40;
constexpr double highest_ln_k = 44;

/// So near a ray, relative to k*, a double k is k* itself.
constexpr double nearest = -37;

/// Phi - r k Psi relative to its larger term: below the one it is rounding, and beyond the other a sign.
constexpr double resolution = 256 * std::numeric_limits<double>::epsilon();
constexpr double certainty = 1e-9;

constexpr double panel_tolerance = 1e-15;
constexpr int deepest_split = 40;
constexpr std::size_t most_panels = 50'000;  // a law with more noise than the tolerance would be halved for ever

/// The coefficients of the equations at one xi.
struct Coefficients {
  double rim_slope;      ///< (ln w)'
  double sliding_slope;  ///< (ln v)'
  double deficit;        ///< (1 - Psi/Psi(0)) q
  double largest;        ///< q: the same for a deficit of 1
  double excess;         ///< k (1 - Phi) q
  double age;            ///< (1 + k) k q/((16 + 15 pi k)(8 + 3 pi k))
  double age_slope;      ///< (ln(w + v))'
  double time;           ///< c
  double k;
  double cancellation;  ///< the larger term of D over D
};

/// @return  false where D is all rounding
bool coefficients(const Law& law, double r, const Approach& approach, double xi, Coefficients& at) {
  const double k = std::exp(approach.log_ratio(xi));
  const Slip slip = slip_of_ratio(k);
  const auto [force, moment] = law(slip);
  const double drag = r * (k * moment);
  const double rate = approach.log_ratio_rate(xi);
  const double difference = rate > 0 ? force - drag : drag - force;
  const double larger = std::max(force, drag);
  if (difference < -certainty * larger) {
    throw std::domain_error(
        fmt::format("QuadratureCurve: Phi {} r k Psi must hold for every k {} the terminal ratio {}, but law {} has "
                    "Phi = {}, r k Psi = {} at k = {} for r = {}: k tends to another ratio; routes regularised and "
                    "direct answer",
                    rate > 0 ? '>' : '<', rate > 0 ? "above" : "below", std::exp(approach.log_terminal_ratio()),
                    law.name(), force, drag, k, r));
  }
  if (!(difference > resolution * larger)) return false;
  const double q = std::abs(rate) / difference;
  const double weight = (16 + 15 * pi * k) * (8 + 3 * pi * k);
  at = {.rim_slope = drag * q,
        .sliding_slope = force * q,
        .deficit = law.moment_deficit(slip) * q,
        .largest = q,
        .excess = k * (1 - force) * q,
        .age = (1 + k) * k * q / weight,
        .age_slope = (drag + k * force) * q / (1 + k),
        .time = k * q / (1 + k),
        .k = k,
        .cancellation = larger / difference};
  return true;
}

}  // namespace

struct QuadratureCurve::Panel {
  double left;
  double right;
  Samples rim_slope, sliding_slope, deficit, excess, age, age_slope;
  LegendreSeries log_rim, sliding_share, slip_excess, regularised_age, time_rate;

  double half() const { return (right - left) / 2; }
  double xi(double t) const { return left + half() * (1 + t); }
  double t(double xi) const { return (xi - left) / half() - 1; }
};

QuadratureCurve::~QuadratureCurve() = default;

QuadratureCurve::QuadratureCurve(const Law& law, double r, const Approach& approach)
    : SimilarityCurve(r, approach, lowest_ln_k) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("QuadratureCurve: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  // Panels of width 1 from far away to the stop, with an edge at k = 1.
  const bool from_above = approach.side() == Approach::Side::above;
  const double end = approach.log_terminal_ratio();
  const double far = from_above ? std::max(highest_ln_k, end + highest_ln_k) : std::min(lowest_ln_k, end + lowest_ln_k);
  const double near = std::isfinite(end) ? (from_above ? end : -end) + nearest
                      : from_above       ? lowest_ln_k
                                         : -highest_ln_k;
  const double kink = approach.coordinate(0);
  const double anchor = approach.reaches(0) && kink > near ? kink : 0;
  double right = anchor + std::ceil(approach.coordinate(far) - anchor);
  while (right > near && sample(law, right - 1, right, 0)) right -= 1;
  if (panels_.empty()) {
    throw std::domain_error(fmt::format("QuadratureCurve: for r = {}, law {} does not tell Phi from r k Psi {} k* = {}",
                                        r, law.name(), from_above ? "above" : "below", std::exp(end)));
  }
  std::ranges::sort(panels_, {}, &Panel::left);
  set_limit(panels_.front().left);
  solve_from_the_stop();
  solve_towards_the_stop();
}

/// @return  false if the panel reaches into where D is all rounding: it is left out
bool QuadratureCurve::sample(const Law& law, double left, double right, int depth) {
  Panel panel{};
  panel.left = left;
  panel.right = right;
  Samples time;
  double largest = 0;
  double largest_excess = 0;
  double cancellation = 1;
  for (int i = 0; i < LegendreSeries::order; ++i) {
    Coefficients at{};
    if (!coefficients(law, r(), approach(), panel.xi(LegendreSeries::points()[i]), at)) return false;
    panel.rim_slope[i] = at.rim_slope;
    panel.sliding_slope[i] = at.sliding_slope;
    panel.deficit[i] = at.deficit;
    panel.excess[i] = at.excess;
    panel.age[i] = at.age;
    panel.age_slope[i] = at.age_slope;
    time[i] = at.time;
    largest = std::max(largest, at.largest);
    largest_excess = std::max(largest_excess, at.k * at.largest);
    cancellation = std::max(cancellation, at.cancellation);
  }
  evaluations_ += LegendreSeries::order;

  // What a panel leaves out, relative to a panel of full width. 1 - Psi/Psi(0) and 1 - Phi count relative to 1: a law
  // may have them to eps of 1 only, and the time left, P + m S, feels no more. D has the digits that are left in it,
  // and m no less for that: it is known where D vanishes.
  const auto left_out = [&](const Samples& samples, double size) {
    return size > 0 ? LegendreSeries::through(samples).tail() / (size * cancellation) * (right - left) : 0.0;
  };
  const double worst =
      std::max({left_out(panel.rim_slope, panel.rim_slope.maxCoeff()),
                left_out(panel.sliding_slope, panel.sliding_slope.maxCoeff()), left_out(panel.deficit, largest),
                left_out(panel.excess, largest_excess), left_out(panel.age, panel.age.maxCoeff())});
  if (worst > panel_tolerance && depth < deepest_split && panels_.size() < most_panels) {
    const double middle = (left + right) / 2;
    return sample(law, middle, right, depth + 1) && sample(law, left, middle, depth + 1);
  }
  truncation_ = std::max(truncation_, worst);
  panel.time_rate = LegendreSeries::through(time);
  panels_.push_back(std::move(panel));
  return true;
}

void QuadratureCurve::solve_from_the_stop() {
  // At the stop ' vanishes from the equations of m and n, or their sources do.
  const Panel& first = panels_.front();
  const auto at_left = [](const Samples& samples) { return LegendreSeries::through(samples)(-1); };
  limit_slope_ = at_left(first.rim_slope);
  double share = at_left(first.deficit / first.sliding_slope);
  double excess = at_left(first.excess / (first.sliding_slope + first.rim_slope));
  for (Panel& panel : panels_) {
    const double half = panel.half();
    panel.sliding_share = relax(half * panel.sliding_slope, half * panel.deficit, share);
    share = panel.sliding_share(1);

    panel.slip_excess = relax(half * (panel.sliding_slope + panel.rim_slope), half * panel.excess, excess);
    excess = panel.slip_excess(1);
  }
  upper_slope_ = panels_.back().rim_slope[LegendreSeries::order - 1];
}

void QuadratureCurve::solve_towards_the_stop() {
  constexpr int last = LegendreSeries::order - 1;
  double age = panels_.back().age[last] / panels_.back().age_slope[last];
  double log_rim = 0;  // here: it may fall by much, and what starts far from the stop must not lose digits to that
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    const double half = panel->half();
    panel->log_rim = LegendreSeries::through(half * panel->rim_slope).antiderivative();
    panel->log_rim += log_rim - panel->log_rim(1);
    log_rim = panel->log_rim(-1);

    panel->regularised_age = relax((half * panel->age_slope).reverse(), (half * panel->age).reverse(), age).mirrored();
    age = panel->regularised_age(-1);
  }
  // w + v is w to the last bit, but next to a small r not its slope.
  const bool to_zero = approach().log_terminal_ratio() == -std::numeric_limits<double>::infinity();
  age_rate_ = to_zero ? limit_slope_ : panels_.front().age_slope[0];
  final_age_ = panels_.front().age[0] / age_rate_;
}

double QuadratureCurve::accuracy() const { return std::max(1e-13, 10 * truncation_); }

const QuadratureCurve::Panel& QuadratureCurve::find(double xi) const {
  const auto after = std::ranges::upper_bound(panels_, xi, {}, &Panel::left);
  return after == panels_.begin() ? panels_.front() : *std::prev(after);
}

double QuadratureCurve::log_rim(double xi) const {
  const Panel& panel = find(xi);
  if (xi < limit()) return panel.log_rim(-1) + limit_slope_ * (xi - limit());
  if (xi > panel.right) return panel.log_rim(1) + upper_slope_ * (xi - panel.right);
  return panel.log_rim(panel.t(xi));
}

double QuadratureCurve::sliding_share(double xi) const {
  const Panel& panel = find(xi);
  const bool from_above = approach().side() == Approach::Side::above;
  if (xi > panel.right && from_above) return 1;
  if (xi >= limit()) return panel.sliding_share(panel.t(std::min(xi, panel.right)));
  const double at_limit = panel.sliding_share(-1);
  // To infinity, where all time is sliding's, 1 - m falls like 1/k.
  return from_above || std::isfinite(approach().log_terminal_ratio()) ? at_limit
                                                                      : 1 - (1 - at_limit) * std::exp(xi - limit());
}

double QuadratureCurve::slip_excess(double xi) const {
  const Panel& panel = find(xi);
  return panel.slip_excess(panel.t(std::clamp(xi, panel.left, panel.right)));
}

double QuadratureCurve::regularised_age(double xi) const {
  const Panel& panel = find(xi);
  if (xi >= limit()) return panel.regularised_age(panel.t(std::min(xi, panel.right)));
  // Where the slope of ln(w + v) is small, b is far from its limit long after all else is at its own.
  const double decay = std::expm1(age_rate_ * (xi - limit()));
  return panel.regularised_age(-1) * (1 + decay) - final_age_ * decay;
}

double QuadratureCurve::time_rate(double xi) const {
  const Panel& panel = find(xi);
  return panel.time_rate(panel.t(std::clamp(xi, panel.left, panel.right)));
}

}  // namespace contensou::reduction
