// Notation (README (R1) to (R7)): w = mu |u|, k = v/w, D = Phi - r k Psi,
//   h = d ln w/d ln k = r k Psi/D                          (R2)
//   k m w = integral over (0, k) of  w (1 - Psi/Psi(0))/D dk            (R4)
//   n k w^2 = integral over (0, k) of  w^2 k (1 - Phi)/D dk             (R13)
//   b/w   = integral over (k, infinity) of  dk/(w D (16 + 15 pi k)(8 + 3 pi k))   (R7)
// In the variable ln k each integrand gains a factor k.
#include "contensou/reduction/quadrature_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/inertia.hpp"
#include "legendre_series.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
using Samples = LegendreSeries::Samples;

/// Beyond these, one term of each expansion is exact to the last bit: exp(-40) = 4e-18, exp(44) = 1e19.
constexpr int lowest_ln_k = -40;
constexpr int highest_ln_k = 44;

constexpr double panel_tolerance = 1e-15;
constexpr int deepest_split = 40;
constexpr std::size_t most_panels = 50'000;  // a law with more noise than the tolerance would be halved for ever

/// The integrands at one k.
struct Integrands {
  double rim_slope;     ///< h
  double deficit_rate;  ///< (1 - Psi/Psi(0))/D: k (k m)' without the decay of w
  double largest_rate;  ///< 1/D: the same for a deficit of 1
  double slip_rate;     ///< (1 - Phi)/D
  double age_rate;      ///< k/(D (16 + 15 pi k)(8 + 3 pi k))
};

Integrands integrands(const Law& law, double r, double ln_k) {
  const double k = std::exp(ln_k);
  const Slip slip = slip_of_ratio(k);
  const auto [force, moment] = law(slip);
  const double drag = r * (k * moment);
  const double difference = force - drag;
  if (!(difference > 0)) {
    throw std::domain_error(
        fmt::format("QuadratureCurve: Phi > r k Psi must hold for every k, but law {} has Phi = {}, r k Psi = {} at "
                    "k = {}: this r = {} is beyond the regime in which k -> 0",
                    law.name(), force, drag, k, r));
  }
  return {drag / difference, law.moment_deficit(slip) / difference, 1 / difference, (1 - force) / difference,
          k / (difference * (16 + 15 * pi * k) * (8 + 3 * pi * k))};
}

}  // namespace

struct QuadratureCurve::Panel {
  double left;
  double right;
  Samples rim_slope;
  Samples deficit_rate;
  Samples slip_rate;
  Samples age_rate;
  LegendreSeries log_rim;
  LegendreSeries sliding_share;
  LegendreSeries slip_excess;
  LegendreSeries regularised_age;

  double half() const { return (right - left) / 2; }
  double ln_k(double t) const { return left + half() * (1 + t); }
  double t(double ln_k) const { return (ln_k - left) / half() - 1; }
};

QuadratureCurve::~QuadratureCurve() = default;

QuadratureCurve::QuadratureCurve(const Law& law, double r) : SimilarityCurve(r) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("QuadratureCurve: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  const double limit = law.force_slope() / law.pivoting_moment();
  if (!(r < limit)) {
    throw std::domain_error(fmt::format(
        "law {}: the similarity solution is known here for r = gamma mu^2/chi below Phi'(0)/Psi(0) = {:.6g} only "
        "(a ball: mu < {:.6g}), got r = {:.6g}; beyond, v/(mu |u|) does not tend to 0; routes regularised and "
        "direct answer there",
        law.name(), limit, std::sqrt(limit * homogeneous_ball.chi / homogeneous_ball.gamma), r));
  }
  for (int left = lowest_ln_k; left < highest_ln_k; ++left) split(law, left, left + 1, 0);

  const Integrands bottom = integrands(law, r, lowest_ln_k);
  const Integrands top = integrands(law, r, highest_ln_k);
  lower_slope_ = bottom.rim_slope;
  upper_slope_ = top.rim_slope;
  final_age_ = 1 / (128 * r * law.pivoting_moment());
  integrate_forwards();
  integrate_backwards(top.age_rate / (1 + upper_slope_));
}

void QuadratureCurve::split(const Law& law, double left, double right, int depth) {
  Panel panel{};
  panel.left = left;
  panel.right = right;
  double largest_rate = 0;
  for (int i = 0; i < LegendreSeries::order; ++i) {
    const Integrands at = integrands(law, r(), panel.ln_k(LegendreSeries::points()[i]));
    panel.rim_slope[i] = at.rim_slope;
    panel.deficit_rate[i] = at.deficit_rate;
    largest_rate = std::max(largest_rate, at.largest_rate);
    panel.slip_rate[i] = at.slip_rate;
    panel.age_rate[i] = at.age_rate;
  }
  evaluations_ += LegendreSeries::order;

  // What a panel leaves out of the integrals, relative to a panel of full width. 1 - Psi/Psi(0) and 1 - Phi
  // count relative to 1: a law may have them to eps of 1 only, and the time left, P + m S, feels no more.
  const auto left_out = [&](const Samples& samples, double size) {
    return size > 0 ? LegendreSeries::through(samples).tail() / size * (right - left) : 0.0;
  };
  const double worst =
      std::max({left_out(panel.rim_slope, panel.rim_slope.abs().maxCoeff()), left_out(panel.deficit_rate, largest_rate),
                left_out(panel.slip_rate, largest_rate), left_out(panel.age_rate, panel.age_rate.abs().maxCoeff())});
  if (worst <= panel_tolerance || depth == deepest_split || panels_.size() >= most_panels) {
    truncation_ = std::max(truncation_, worst);
    panels_.push_back(std::move(panel));
    return;
  }
  const double middle = (left + right) / 2;
  split(law, left, middle, depth + 1);
  split(law, middle, right, depth + 1);
}

void QuadratureCurve::integrate_forwards() {
  double log_rim = 0;
  // Below the first panel the deficit is k to some power >= 1; the first power makes this exact, others negligible.
  double excess = panels_.front().deficit_rate[0] * std::exp(lowest_ln_k) / (1 + lower_slope_);  // k m
  // There slip_rate is 1/(k (Phi'(0) - r Psi(0))).
  const double first_k = std::exp(panels_.front().ln_k(LegendreSeries::points()[0]));
  double slip = panels_.front().slip_rate[0] * first_k * std::exp(lowest_ln_k) / (1 + 2 * lower_slope_);  // k n
  for (Panel& panel : panels_) {
    panel.log_rim = LegendreSeries::through(panel.rim_slope).antiderivative();
    panel.log_rim *= panel.half();
    const Samples growth = panel.log_rim.samples().exp();
    const Samples k = (panel.left + panel.half() * (1 + LegendreSeries::points())).exp();

    LegendreSeries gain = LegendreSeries::through(growth * k * panel.deficit_rate).antiderivative();
    gain *= panel.half();
    panel.sliding_share = LegendreSeries::through((excess + gain.samples()) / (growth * k));

    LegendreSeries length = LegendreSeries::through((growth * k).square() * panel.slip_rate).antiderivative();
    length *= panel.half();
    panel.slip_excess = LegendreSeries::through((slip + length.samples()) / (growth.square() * k));

    const double whole_growth = std::exp(panel.log_rim(1));
    excess = (excess + gain(1)) / whole_growth;
    slip = (slip + length(1)) / (whole_growth * whole_growth);
    panel.log_rim += log_rim;
    log_rim = panel.log_rim(1);
  }
}

void QuadratureCurve::integrate_backwards(double age_at_top) {
  double age = age_at_top;
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    const double log_rim_at_right = panel->log_rim(1);
    const Samples decay = (panel->log_rim.samples() - log_rim_at_right).exp();  // w relative to the right edge, <= 1
    LegendreSeries loss = LegendreSeries::through(panel->age_rate / decay).antiderivative();
    loss *= panel->half();
    const double whole = loss(1);
    panel->regularised_age = LegendreSeries::through(decay * (age + (whole - loss.samples())));
    age = std::exp(panel->log_rim(-1) - log_rim_at_right) * (age + whole);
  }
}

const QuadratureCurve::Panel* QuadratureCurve::find(double ln_k) const {
  const auto after = std::ranges::upper_bound(panels_, ln_k, {}, &Panel::left);
  return after == panels_.begin() ? &panels_.front() : &*std::prev(after);
}

double QuadratureCurve::log_rim(double ln_k) const {
  if (ln_k < lowest_ln_k) return lower_slope_ * (ln_k - lowest_ln_k);
  const Panel* panel = find(ln_k);
  if (ln_k > highest_ln_k) return panel->log_rim(1) + upper_slope_ * (ln_k - highest_ln_k);
  return panel->log_rim(panel->t(ln_k));
}

double QuadratureCurve::sliding_share(double ln_k) const {
  if (ln_k > highest_ln_k) return 1;
  const Panel* panel = find(ln_k);
  return panel->sliding_share(panel->t(std::max<double>(ln_k, lowest_ln_k)));
}

double QuadratureCurve::slip_excess(double ln_k) const {
  const double inside = std::clamp<double>(ln_k, lowest_ln_k, highest_ln_k);
  const Panel* panel = find(inside);
  return panel->slip_excess(panel->t(inside));
}

double QuadratureCurve::regularised_age(double ln_k) const {
  const Panel* panel = find(ln_k);
  if (ln_k > highest_ln_k) return panel->regularised_age(1) * std::exp(highest_ln_k - ln_k);
  if (ln_k >= lowest_ln_k) return panel->regularised_age(panel->t(ln_k));
  const double decay = std::expm1(lower_slope_ * (ln_k - lowest_ln_k));
  return panel->regularised_age(-1) * (1 + decay) - final_age_ * decay;
}

std::shared_ptr<const SimilarityCurve> similarity_curve(const Law& law, double r) {
  if (auto closed = law.closed_curve(r)) return closed;
  return std::make_shared<QuadratureCurve>(law, r);
}

}  // namespace contensou::reduction
