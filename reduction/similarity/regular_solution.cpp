// Notation (README (R19), (R31)): z = +- ln k, growing away from the stop, D = Phi - r k Psi, |D| = +- D
//   |D| dm/dz + Phi m               = 1 - Psi/Psi(0)
//   |D| dn/dz + (Phi + r k Psi) n   = k (1 - Phi)
//   |D| db/dz - h b                 = -g,  h = (r k Psi + k Phi)/(1 + k),  g = k (1 + k)/((16 + 15 pi k)(8 + 3 pi k))
#include "similarity/regular_solution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "numerics/linear_ode.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
using Samples = LegendreSeries::Samples;

constexpr double highest_exponent = 700;  ///< of a double

/// Phi - r k Psi relative to its larger term: beyond this its sign is no rounding.
constexpr double certainty = 1e-9;

/// The law at one k.
struct Coefficients {
  double force;    ///< Phi
  double drag;     ///< r k Psi
  double deficit;  ///< 1 - Psi/Psi(0)
  double excess;   ///< k (1 - Phi)
};

Coefficients coefficients(const Law& law, double r, double k) {
  const Slip slip = slip_of_ratio(k);
  const auto [force, moment] = law(slip);
  return {force, r * (k * moment), law.moment_deficit(slip), k * (1 - force)};
}

}  // namespace

RegularSolution::RegularSolution(const Law& law, double r, const TerminalChart& chart)
    : chart_(chart), sign_(chart.side() == TerminalChart::Side::above ? 1 : -1) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("QuadratureCurve: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  const auto [low, high] = std::minmax({sign_ * min_ln_k, sign_ * max_ln_k});
  // Towards k = infinity, w counts beside v until k is beyond r, too.
  const double beyond = sign_ < 0 ? std::clamp(std::log(r), 0.0, highest_exponent - max_ln_k) : 0;
  const double begin = std::max(sign_ * chart.log_terminal_ratio(), low - beyond);
  const double end = std::min(sign_ * chart.log_far_ratio(), high);

  const auto at_stop = coefficients(law, r, std::exp(sign_ * begin));
  first_ = last_ = {at_stop.deficit / at_stop.force, at_stop.excess / (at_stop.force + at_stop.drag)};
  // Panels meet where z is an integer, and at the law's kinks.
  constexpr double narrowest = 4 * std::numeric_limits<double>::epsilon();
  for (double left = begin; left < end;) {
    double right = std::min(std::floor(left) + 1, end);
    for (double k : law.kinks()) {
      if (const double kink = sign_ * std::log(k); kink > left && kink < right) right = kink;
    }
    if (right - left > narrowest) march(law, r, left, right, 0);
    left = right;
  }
}

void RegularSolution::march(const Law& law, double r, double left, double right, int depth) {
  const double half = (right - left) / 2;
  Samples force, drag, deficit, excess;
  double k = 0;
  double largest_k = 0;
  for (int i = 0; i < LegendreSeries::order; ++i) {
    k = std::exp(sign_ * (left + half * (1 + LegendreSeries::points()[i])));
    largest_k = std::max(k, largest_k);
    const auto at = coefficients(law, r, k);
    force[i] = at.force;
    drag[i] = at.drag;
    deficit[i] = at.deficit;
    excess[i] = at.excess;
    if (sign_ * (at.force - at.drag) < -certainty * std::max(at.force, at.drag)) {
      throw std::domain_error(fmt::format(
          "QuadratureCurve: Phi {} r k Psi must hold for every k between the terminal ratio {} and {}, but law {} has "
          "Phi = {}, r k Psi = {} at k = {} for r = {}: k tends to another ratio; routes regularised and direct answer",
          sign_ > 0 ? '>' : '<', std::exp(chart_.log_terminal_ratio()), std::exp(chart_.log_far_ratio()), law.name(),
          at.force, at.drag, k, r));
    }
  }
  evaluations_ += LegendreSeries::order;

  const Samples difference = (sign_ * (force - drag)).max(0) / half;  // < 0: rounding
  Panel panel{{left, right},
              solve_linear_ode(difference, force, deficit, last_.sliding_coefficient),
              solve_linear_ode(difference, force + drag, excess, last_.slip_length_coefficient)};

  // What the series leave out, relative to a panel of full width. 1 - Psi/Psi(0) and 1 - Phi count relative to 1: a law
  // may have them to eps of 1 only, and neither the time left, P + m S, nor the slip, v (v/2 + n w), feels more.
  const auto tail = [](const Samples& samples) { return LegendreSeries::through(samples).tail(); };
  const double coefficient_size = std::max({1.0, std::abs(panel.sliding_coefficient(1)), 1 / force.maxCoeff()});
  const double excess_size = std::max(largest_k, std::abs(panel.slip_length_coefficient(1)));
  const double of_coefficient = std::max({tail(force) / force.maxCoeff(), tail(drag) / drag.maxCoeff(), tail(deficit),
                                          panel.sliding_coefficient.tail() / coefficient_size}) *
                                (right - left);
  const double of_excess =
      std::max(tail(excess) / largest_k, panel.slip_length_coefficient.tail() / excess_size) * (right - left);
  if (std::max(of_coefficient, of_excess) > panel_tolerance && depth < max_depth && panels_.size() < max_panels) {
    march(law, r, left, left + half, depth + 1);
    march(law, r, left + half, right, depth + 1);
    return;
  }
  truncation_ = std::max(truncation_, of_coefficient);
  last_ = {panel.sliding_coefficient(1), panel.slip_length_coefficient(1)};
  panels_.push_back(std::move(panel));
}

std::vector<RegularSolution::Interval> RegularSolution::intervals() const { return {panels_.begin(), panels_.end()}; }

std::pair<const RegularSolution::Panel&, double> RegularSolution::place(double ln_k) const {
  const double z = sign_ * ln_k;
  const auto after = std::ranges::upper_bound(panels_, z, {}, &Panel::left);
  const Panel& panel = after == panels_.begin() ? *after : *std::prev(after);
  return {panel, std::clamp(panel.t(z), -1.0, 1.0)};
}

double RegularSolution::sliding_coefficient(double ln_k) const {
  if (ln_k > max_ln_k) return 1;
  if (panels_.empty() || sign_ * ln_k <= panels_.front().left) return first_.sliding_coefficient;
  const auto [panel, t] = place(ln_k);
  return panel.sliding_coefficient(t);
}

double RegularSolution::slip_length_coefficient(double ln_k) const {
  if (panels_.empty() || sign_ * ln_k <= panels_.front().left) return first_.slip_length_coefficient;
  const auto [panel, t] = place(ln_k);
  return panel.slip_length_coefficient(t);
}

BetaSolution::BetaSolution(const Law& law, double r, const TerminalChart& chart, const RegularSolution& grid)
    : sign_(chart.side() == TerminalChart::Side::above ? 1 : -1) {
  struct Terms {
    double difference, growth, source;  // |D|, h, g
  };
  const auto terms = [&](double z) -> Terms {
    const double k = std::exp(sign_ * z);
    const auto [force, moment] = law(slip_of_ratio(k));
    const double drag = r * (k * moment);
    return {std::max(sign_ * (force - drag), 0.0), (drag + k * force) / (1 + k),
            k * ((1 + k) / ((16 + 15 * pi * k) * (8 + 3 * pi * k)))};
  };
  const auto intervals = grid.intervals();
  if (intervals.empty()) {
    const auto [difference, growth, source] = terms(sign_ * chart.log_terminal_ratio());
    far_ = at_stop_ = source / growth;
    return;
  }
  const Terms far = terms(intervals.back().right);
  double b = far_ = far.source / far.growth;
  const auto march = [&](auto&& self, RegularSolution::Interval interval, int depth) -> void {
    const double half = (interval.right - interval.left) / 2;
    Samples difference, growth, source;
    for (int i = 0; i < LegendreSeries::order; ++i) {
      // Backwards: in -z the equation forgets its start.
      const Terms at = terms(interval.right - half * (1 + LegendreSeries::points()[i]));
      difference[i] = at.difference / half;
      growth[i] = at.growth;
      source[i] = at.source;
    }
    const LegendreSeries series = solve_linear_ode(difference, growth, source, b);
    const double left_out = series.tail() / std::max(std::abs(b), std::abs(series(1))) * 2 * half;
    if (left_out > panel_tolerance && depth < max_depth && panels_.size() < max_panels) {
      self(self, {interval.right - half, interval.right}, depth + 1);
      self(self, {interval.left, interval.right - half}, depth + 1);
      return;
    }
    b = series(1);
    panels_.push_back({interval, series.mirrored()});
  };
  for (auto interval = intervals.rbegin(); interval != intervals.rend(); ++interval) march(march, *interval, 0);
  std::ranges::reverse(panels_);
  // Where h is small beside D, b is far from its limit long after all else is at its own. v no longer counts in w + v
  // where k -> 0, however small r is; nor does w where k -> infinity.
  const double z = panels_.front().left;
  auto [difference, growth, source] = terms(z);
  if (std::isinf(chart.log_terminal_ratio())) {
    const auto at = coefficients(law, r, std::exp(sign_ * z));
    growth = sign_ > 0 ? at.drag : at.force;
  }
  at_stop_ = source / growth;
  rate_ = growth / difference;
}

double BetaSolution::operator()(double ln_k) const {
  const double z = sign_ * ln_k;
  if (panels_.empty() || z >= panels_.back().right) return far_;
  const Panel& first = panels_.front();
  if (z <= first.left) {
    const double change = z < first.left ? std::expm1(rate_ * (z - first.left)) : 0;
    return first.b(-1) * (1 + change) - at_stop_ * change;
  }
  const auto after = std::ranges::upper_bound(panels_, z, {}, &Panel::left);
  return std::prev(after)->b(std::prev(after)->t(z));
}

}  // namespace contensou::reduction
