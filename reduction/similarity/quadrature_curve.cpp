// Notation (README (R1) to (R7), (R26)): w = mu |u|, k = v/w, D = Phi - r k Psi, ' = d/dxi, q = (ln k)'/D > 0;
//   (ln w)' = r k Psi q
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
#include "similarity/regular_solution.hpp"

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
constexpr double resolution = 128 * std::numeric_limits<double>::epsilon();
constexpr double certainty = 1e-9;

constexpr double panel_tolerance = 1e-15;
constexpr int deepest_split = 40;
constexpr std::size_t most_panels = 50'000;  // a law with more noise than the tolerance would be halved for ever

/// The coefficients of the equations at one xi.
struct Coefficients {
  double rim_slope;     ///< (ln w)'
  double age;           ///< (1 + k) k q/((16 + 15 pi k)(8 + 3 pi k))
  double age_slope;     ///< (ln(w + v))'
  double time;          ///< c
  double cancellation;  ///< the larger term of D over D
};

}  // namespace

struct QuadratureCurve::Panel {
  double left;
  double right;
  Samples rim_slope, age, age_slope;
  LegendreSeries log_rim, regularised_age, time_rate;

  double half() const { return (right - left) / 2; }
  double xi(double t) const { return left + half() * (1 + t); }
  double t(double xi) const { return (xi - left) / half() - 1; }
};

/// The panels of one curve, made from its law.
class QuadratureCurve::Sampler {
 public:
  Sampler(const Law& law, QuadratureCurve& curve) : law_(law), curve_(curve) {}

  /// Panels of width 1 with an edge at k = 1, as far as D has a digit.
  /// @return  the edge where it has most
  double run() {
    const Approach& approach = curve_.approach();
    const bool from_above = approach.side() == Approach::Side::above;
    const double end = approach.log_terminal_ratio() * (from_above ? 1 : -1);
    const double far = approach.log_far_ratio() * (from_above ? 1 : -1);
    const double low = from_above ? lowest_ln_k : -highest_ln_k;
    const double high = from_above ? highest_ln_k : -lowest_ln_k;
    const double near = std::isfinite(end) ? end + nearest : low;
    const double most = std::isfinite(far) ? far - nearest : std::max(high, high + end);
    const double kink = approach.reaches(0) ? approach.coordinate(0) : near;
    const double edge = kink > near && kink < most ? kink : std::isfinite(end) ? end : std::isfinite(far) ? far : 0;
    double anchor = edge;
    double clearest = 0;
    for (double xi = edge + std::ceil(near - edge); xi < most; xi += 1) {
      const double clear = clearness(xi);
      if (clear <= clearest) continue;
      clearest = clear;
      anchor = xi;
    }
    const auto both_ways = [&] {
      for (double from = anchor; from > near && sample(from, from - 1, 0);) from -= 1;
      for (double from = anchor; from < most && sample(from, from + 1, 0);) from += 1;
    };
    both_ways();
    if (curve_.panels_.empty()) {
      frozen_ = true;
      both_ways();
    }
    std::ranges::sort(curve_.panels_, {}, &Panel::left);
    return anchor;
  }

 private:
  struct Drag {
    double k;
    double rate;        ///< (ln k)'
    double force;       ///< Phi
    double drag;        ///< r k Psi
    double larger;      ///< of the two
    double difference;  ///< D, of the sign of the rate
  };
  Drag drag_at(double xi) const {
    const double k = std::exp(curve_.approach().log_ratio(xi));
    const double rate = curve_.approach().log_ratio_rate(xi);
    const auto [force, moment] = law_(slip_of_ratio(k));
    const double drag = curve_.r() * (k * moment);
    return {k, rate, force, drag, std::max(force, drag), rate > 0 ? force - drag : drag - force};
  }

  double clearness(double xi) const {
    const Drag at = drag_at(xi);
    return at.difference / at.larger;
  }

  /// @return  false where D is all rounding
  bool coefficients(double xi, Coefficients& at) const {
    const auto [k, rate, force, drag, larger, difference] = drag_at(xi);
    if (difference < -certainty * larger) {
      throw std::domain_error(fmt::format(
          "QuadratureCurve: Phi {} r k Psi must hold for every k between the terminal ratio {} and {}, but law {} has "
          "Phi = {}, r k Psi = {} at k = {} for r = {}: k tends to another ratio; routes regularised and direct answer",
          rate > 0 ? '>' : '<', std::exp(curve_.approach().log_terminal_ratio()),
          std::exp(curve_.approach().log_far_ratio()), law_.name(), force, drag, k, curve_.r()));
    }
    if (!frozen_ && !(difference > resolution * larger)) return false;
    // Where D has no digit from end to end, k changes as slowly as D tells.
    const double q = frozen_ ? 1 / (resolution * larger) : std::abs(rate) / difference;
    const double weight = (16 + 15 * pi * k) * (8 + 3 * pi * k);
    at = {.rim_slope = drag * q,
          .age = (1 + k) * k * q / weight,
          .age_slope = (drag + k * force) * q / (1 + k),
          .time = k * q / (1 + k),
          .cancellation = frozen_ ? 1 : larger / difference};
    return true;
  }

  /// @return  false if what lies between reaches into where D is all rounding: the panel there is left out
  bool sample(double from, double to, int depth) {
    Panel panel{};
    panel.left = std::min(from, to);
    panel.right = std::max(from, to);
    Samples time;
    double cancellation = 1;
    for (int i = 0; i < LegendreSeries::order; ++i) {
      Coefficients at{};
      if (!coefficients(panel.xi(LegendreSeries::points()[i]), at)) return false;
      panel.rim_slope[i] = at.rim_slope;
      panel.age[i] = at.age;
      panel.age_slope[i] = at.age_slope;
      time[i] = at.time;
      cancellation = std::max(cancellation, at.cancellation);
    }
    curve_.evaluations_ += LegendreSeries::order;

    // What a panel leaves out, relative to a panel of full width. D has the digits that are left in it.
    const auto left_out = [&](const Samples& samples) {
      return LegendreSeries::through(samples).tail() / (samples.maxCoeff() * cancellation) * (panel.right - panel.left);
    };
    const double worst =
        std::max({left_out(panel.rim_slope), left_out(panel.age_slope), left_out(panel.age), left_out(time)});
    if (worst > panel_tolerance && depth < deepest_split && curve_.panels_.size() < most_panels) {
      const double middle = (from + to) / 2;
      return sample(from, middle, depth + 1) && sample(middle, to, depth + 1);
    }
    panel.time_rate = LegendreSeries::through(time);
    curve_.panels_.push_back(std::move(panel));
    return true;
  }

  const Law& law_;
  QuadratureCurve& curve_;
  bool frozen_ = false;
};

QuadratureCurve::~QuadratureCurve() = default;

QuadratureCurve::QuadratureCurve(const Law& law, double r, const Approach& approach)
    : SimilarityCurve(r, approach, lowest_ln_k), shares_(std::make_unique<RegularSolution>(law, r, approach)) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("QuadratureCurve: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  const double anchor = Sampler(law, *this).run();
  evaluations_ += shares_->evaluations();
  set_limit(panels_.front().left);
  solve(anchor);
}

void QuadratureCurve::solve(double anchor) {
  constexpr int last = LegendreSeries::order - 1;
  lower_slope_ = panels_.front().rim_slope.mean();
  upper_slope_ = panels_.back().rim_slope[last];
  // From where ln w changes least, for at either end it may grow without bound.
  for (Panel& panel : panels_) panel.log_rim = LegendreSeries::through(panel.half() * panel.rim_slope).antiderivative();
  const auto middle = std::ranges::lower_bound(panels_, anchor, {}, &Panel::left);
  double log_rim = 0;
  for (auto panel = middle; panel != panels_.end(); ++panel) {
    panel->log_rim += log_rim;
    log_rim = panel->log_rim(1);
  }
  log_rim = 0;
  for (auto panel = middle; panel != panels_.begin();) {
    --panel;
    panel->log_rim += log_rim - panel->log_rim(1);
    log_rim = panel->log_rim(-1);
  }

  double age = panels_.back().age[last] / panels_.back().age_slope[last];
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    const double half = panel->half();
    panel->regularised_age =
        relax(Samples::Ones(), (half * panel->age_slope).reverse(), (half * panel->age).reverse(), age).mirrored();
    age = panel->regularised_age(-1);
  }
  // w + v is w to the last bit, but next to a small r not its slope.
  const bool to_zero = approach().log_terminal_ratio() == -std::numeric_limits<double>::infinity();
  age_rate_ = to_zero ? lower_slope_ : panels_.front().age_slope[0];
  final_age_ = panels_.front().age[0] / age_rate_;
}

double QuadratureCurve::truncation() const { return shares_->truncation(); }

double QuadratureCurve::accuracy() const { return std::max(1e-13, 10 * truncation()); }

const QuadratureCurve::Panel& QuadratureCurve::find(double xi) const {
  const auto after = std::ranges::upper_bound(panels_, xi, {}, &Panel::left);
  return after == panels_.begin() ? panels_.front() : *std::prev(after);
}

double QuadratureCurve::log_rim(double xi) const {
  const Panel& panel = find(xi);
  if (xi < limit()) return panel.log_rim(-1) + lower_slope_ * (xi - limit());
  if (xi > panel.right) return panel.log_rim(1) + upper_slope_ * (xi - panel.right);
  return panel.log_rim(panel.t(xi));
}

double QuadratureCurve::sliding_share(double xi) const { return shares_->sliding_share(approach().log_ratio(xi)); }

double QuadratureCurve::slip_excess(double xi) const { return shares_->slip_excess(approach().log_ratio(xi)); }

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
