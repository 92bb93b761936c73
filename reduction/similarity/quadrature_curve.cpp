// Notation (theory.md and numerics.md (R1) to (R4), (R32), (R39), (R53)): w = mu |u|, k = v/w, D = Phi - rho - r k Psi,
// ' = d/dxi, q = (ln k)'/D > 0;
//   (ln w)' = r k Psi q
//   c = k q/(1 + k)
#include "similarity/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"
#include "numerics/later.hpp"
#include "numerics/legendre_series.hpp"
#include "similarity/regular_solution.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

namespace {

using Samples = LegendreSeries::Samples;

/// The value of xi - ln k* below which k and k* are the same double.
constexpr double nearest = -37;

/// If |D| divided by its larger term is below this number, D is only rounding.
constexpr double resolution = 128 * std::numeric_limits<double>::epsilon();

/// The coefficients of the equations at one xi.
struct CurveCoefficients {
  double clearness;   ///< D divided by its larger term, with the sign that makes it positive along the chart
  double ln_w_slope;  ///< (ln w)'
  double time;        ///< c
};

}  // namespace

/// The functions ln w and c of one curve.
class QuadratureCurve::Panels {
 public:
  Panels(const Law& law, const QuadratureCurve& curve)
      : law_(law), r_(curve.r()), drive_(curve.drive()), chart_(curve.chart()) {
    solve(sample());
  }

  double limit() const { return panels_.front().left; }

  double ln_w(double xi) const {
    const Panel& panel = panel_at(panels_, xi);
    const double inside = std::clamp(xi, panel.left, panel.right);
    return panel.ln_w(panel.t(inside)) + (xi < inside ? lower_slope_ : upper_slope_) * (xi - inside);
  }

  double time_rate(double xi) const {
    const Panel& panel = panel_at(panels_, xi);
    return panel.time_rate(panel.t(std::clamp(xi, panel.left, panel.right)));
  }

 private:
  struct Panel : SeriesPanel {
    Samples ln_w_slope;
    LegendreSeries ln_w, time_rate;
  };

  /// Makes panels of width 1 over the range in which D has a correct digit, with edges at k = 1 and at the law's kinks.
  /// @return the edge at which D has the most digits
  double sample() {
    const bool from_above = chart_.side() == TerminalChart::Side::above;
    const double end = chart_.log_terminal_ratio() * (from_above ? 1 : -1);
    const double far = chart_.log_far_ratio() * (from_above ? 1 : -1);
    const double lowest = lowest_ln_k(law_, r_, drive_);
    const double low = from_above ? lowest : -max_ln_k;
    const double high = from_above ? max_ln_k : -lowest;
    const double near = std::isfinite(end) ? end + nearest : low;
    const double most = std::isfinite(far) ? far - nearest : std::max(high, high + end);
    const double kink = chart_.reaches(0) ? chart_.coordinate(0) : near;
    const double edge = kink > near && kink < most ? kink : std::isfinite(end) ? end : std::isfinite(far) ? far : 0;
    double anchor = edge;
    double clearest = 0;
    for (double xi = edge + std::ceil(near - edge); xi < most; xi += 1) {
      const double clear = coefficients(xi).clearness;
      if (clear <= clearest) continue;
      clearest = clear;
      anchor = xi;
    }
    for (double k : law_.kinks()) {
      const double ln_k = std::log(k);
      if (!chart_.reaches(ln_k)) continue;
      if (const double xi = chart_.coordinate(ln_k); xi > near && xi < most) kinks_.push_back(xi);
    }
    const auto both_ways = [&] {
      for (double from = anchor; from > near && sample(from, from - 1, 0);) from -= 1;
      for (double from = anchor; from < most && sample(from, from + 1, 0);) from += 1;
    };
    both_ways();
    if (panels_.empty()) {
      frozen_ = true;
      both_ways();
    }
    std::ranges::sort(panels_, {}, &Panel::left);
    return anchor;
  }

  CurveCoefficients coefficients(double xi) const {
    const double k = std::exp(chart_.log_ratio(xi));
    const double rate = chart_.log_ratio_rate(xi);  // (ln k)'
    const Balance balance = Balance::of(law_, r_, drive_, k);
    const double larger = balance.larger(), difference = rate > 0 ? balance.difference() : -balance.difference();
    // If D has no correct digit on the whole curve, use the rounding of D in place of D: it bounds the rate of k.
    const double q = frozen_ ? 1 / (resolution * larger) : std::abs(rate) / difference;
    return {.clearness = frozen_ ? 1 : difference / larger, .ln_w_slope = balance.drag * q, .time = k * q / (1 + k)};
  }

  /// Adds the panels between two values of xi.
  /// @return false if D is only rounding in a part of the interval; the panel of this part is left out
  bool sample(double from, double to, int depth) {
    constexpr double narrowest = 1e-12;
    for (double kink : kinks_) {
      const double beyond = (kink - from) / (to - from);
      if (std::min(beyond, 1 - beyond) * std::abs(to - from) > narrowest) {
        return sample(from, kink, depth) && sample(kink, to, depth);
      }
    }
    Panel panel{};
    panel.left = std::min(from, to);
    panel.right = std::max(from, to);
    Samples time;
    double clearness = 1;
    for (int i = 0; i < LegendreSeries::order; ++i) {
      const CurveCoefficients at = coefficients(panel.x(LegendreSeries::points()[i]));
      if (!(at.clearness > resolution)) return false;
      panel.ln_w_slope[i] = at.ln_w_slope;
      time[i] = at.time;
      clearness = std::min(clearness, at.clearness);
    }

    // The error of a panel's series, relative to that of a panel of width 1. Cancellation in D limits the accuracy.
    const auto left_out = [&](const Samples& samples) {
      return LegendreSeries::tail(samples) / samples.maxCoeff() * clearness * (panel.right - panel.left);
    };
    const double worst = std::max(left_out(panel.ln_w_slope), left_out(time));
    if (worst > panel_tolerance && depth < max_depth && panels_.size() < max_panels) {
      const double middle = (from + to) / 2;
      return sample(from, middle, depth + 1) && sample(middle, to, depth + 1);
    }
    panel.time_rate = LegendreSeries::through(time);
    panels_.push_back(std::move(panel));
    return true;
  }

  void solve(double anchor) {
    constexpr int last = LegendreSeries::order - 1;
    lower_slope_ = panels_.front().ln_w_slope.mean();
    upper_slope_ = panels_.back().ln_w_slope[last];
    // The sum starts where ln w changes least, because ln w can grow without bound at either end.
    for (Panel& panel : panels_) panel.ln_w = LegendreSeries::through(panel.half() * panel.ln_w_slope).antiderivative();
    join(panels_, &Panel::ln_w, anchor);
  }

  const Law& law_;
  double r_, drive_;
  TerminalChart chart_;
  std::vector<double> kinks_;  ///< values of xi at kinks of the law
  bool frozen_ = false;
  std::vector<Panel> panels_;
  double lower_slope_ = 0;  ///< d ln_w/d xi as xi -> -infinity
  double upper_slope_ = 0;  ///< d ln_w/d xi as xi -> infinity
};

struct QuadratureCurve::Parts {
  Law law;
  RegularSolution m;
  Later<RegularSolution> n, o;
  Later<BetaSolution> b;
  Later<Panels> panels;

  const Panels& panels_of(const QuadratureCurve& curve) const {
    return panels.made([&] { return Panels(law, curve); });
  }
};

QuadratureCurve::QuadratureCurve(const Law& law, double r, const TerminalChart& chart, double drive)
    : SimilarityCurve(r, chart, drive),
      parts_(new Parts{law, sliding_solution(law, r, chart, drive), {}, {}, {}, {}}) {}

QuadratureCurve::~QuadratureCurve() = default;

double QuadratureCurve::linear_below() const { return parts_->panels_of(*this).limit(); }

double QuadratureCurve::truncation() const { return parts_->m.truncation(); }

double QuadratureCurve::accuracy() const { return (rounding_of_stop_time(r()) + truncation()) / (1 - drive()); }

long QuadratureCurve::evaluations() const { return parts_->m.evaluations(); }

double QuadratureCurve::rest_factor(double ln_k) const {
  return reaches_rest(chart(), drive()) ? 1 + std::exp(-ln_k) : 1;
}

double QuadratureCurve::sliding_coefficient(double xi) const {
  const double ln_k = chart().log_ratio(xi);
  if (ln_k > max_ln_k) return 1 / (1 - drive());
  return parts_->m(ln_k) * rest_factor(ln_k);
}

double QuadratureCurve::slip_length_coefficient(double xi) const {
  const RegularSolution& n =
      parts_->n.made([this] { return slip_length_solution(parts_->law, r(), chart(), drive()); });
  const double ln_k = chart().log_ratio(xi);
  return n(ln_k) * (1 + std::exp(std::min(ln_k, max_ln_k))) * rest_factor(ln_k);
}

double QuadratureCurve::angle_coefficient(double xi) const {
  const double ln_k = chart().log_ratio(xi);
  const RegularSolution& o = parts_->o.made([this] { return angle_solution(parts_->law, r(), chart(), drive()); });
  return o(ln_k) * rest_factor(ln_k);
}

double QuadratureCurve::ln_w(double xi) const { return parts_->panels_of(*this).ln_w(xi); }

double QuadratureCurve::beta_coefficient(double xi) const {
  const BetaSolution& b = parts_->b.made([this] { return BetaSolution(parts_->law, r(), chart(), drive()); });
  return b(chart().log_ratio(xi));
}

double QuadratureCurve::time_rate(double xi) const { return parts_->panels_of(*this).time_rate(xi); }

}  // namespace contensou::reduction
