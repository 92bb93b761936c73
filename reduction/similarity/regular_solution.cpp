// Notation (theory.md (R7), (R8), (R25), (R26)): z = +- ln k with the sign by which z grows away from the stop; k =
// v/w, F = Phi - rho, D = F - r k Psi, |D| = +- D:
//   |D| dm/dz + F m               = 1 - Psi/Psi(0)
//   |D| dn/dz + (F + r k Psi) n   = k (1 - Phi)/(1 - rho)
//   |D| do/dz + (F + r k Psi) o   = 1 - Psi/Psi(0)
//   |D| dp/dz + (Phi' - F Psi'/Psi) p           = -Psi'/Psi,   p = ds/dv, ' = d/d ln k
//   |D| dq/dz + r k (Psi Phi'/F - Psi') q       = k Phi'/F,    q = ds/dw
//   |D| db/dz - h b               = -g,  h = (r k Psi + k F)/(1 + k),  g = k (1 + k)/((16 + 15 pi k)(8 + 3 pi k))
// Let j be a function of k. Then y = j m satisfies the equation of m with F - D j'/j in place of F and j times the
// right side. The same holds for n and o.
#include "similarity/regular_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/tangent.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
using Samples = LegendreSeries::Samples;

constexpr double highest_exponent = 700;  ///< exp(700) is still a double

double sign_of(const TerminalChart& chart) { return chart.side() == TerminalChart::Side::above ? 1 : -1; }

/// Returns the z at which panels meet, from the stop outwards: the law's kinks, and multiples of a width. Far from k =
/// 1 the series on panels of this width converge to the last bit.
std::vector<double> edges_of(const Law& law, double r, const TerminalChart& chart, double drive) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("QuadratureCurve: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  constexpr double width = 2;
  constexpr double narrowest = 4 * std::numeric_limits<double>::epsilon();
  const double sign = sign_of(chart);
  const auto [low, high] = std::minmax({sign * lowest_ln_k(law, r, drive), sign * max_ln_k});
  // Towards k = infinity, w is negligible compared with v only if k is also much larger than r.
  const double beyond = sign < 0 ? std::clamp(std::log(r), 0.0, highest_exponent - max_ln_k) : 0;
  const double begin = std::max(sign * chart.log_terminal_ratio(), low - beyond);
  const double end = std::min(sign * chart.log_far_ratio(), high);

  std::vector<double> edges{begin, end};
  for (double edge = width * std::ceil(begin / width); edge < end; edge += width) edges.push_back(edge);
  for (double k : law.kinks()) edges.push_back(sign * std::log(k));
  std::erase_if(edges, [&](double edge) { return edge < begin || edge > std::max(begin, end); });
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end(), [](double a, double b) { return b - a <= narrowest; }),
              edges.end());
  return edges;
}

/// The law's values at one k. D has the sign that makes it positive along the chart.
struct Forces {
  double difference;  ///< |D|
  double force;       ///< F
  double drag;        ///< r k Psi
  double sliding;     ///< Phi
};

class ForcesOnTheWay {
 public:
  ForcesOnTheWay(const Law& law, double r, const TerminalChart& chart, double drive)
      : law_(law), r_(r), drive_(drive), chart_(chart) {}

  Forces operator()(double k) const {
    /// If |D| divided by its larger term is above this number, the sign of D is certain.
    constexpr double certainty = 1e-9;
    const double sign = sign_of(chart_);
    const Balance balance = Balance::of(law_, r_, drive_, k);
    const double force = balance.force, drag = balance.drag, sliding = balance.sliding;
    const double difference = sign * balance.difference(), larger = balance.larger();
    if (difference < -certainty * larger) {
      throw std::domain_error(fmt::format(
          "QuadratureCurve: Phi {} {}r k Psi must hold for every k between the terminal ratio {} and {}, "
          "but law {} has Phi = {}, r k Psi = {} at k = {} for r = {}: "
          "k tends to another ratio; routes regularised and direct answer",
          sign > 0 ? '>' : '<', drive_ > 0 ? fmt::format("{} + ", drive_) : "", std::exp(chart_.log_terminal_ratio()),
          std::exp(chart_.log_far_ratio()), law_.name(), sliding, drag, k, r_));
    }
    against_ = std::max(against_, -difference / larger);
    // On the ray that a drive causes at small k, F = r k Psi. For small r, F is below the rounding of Phi and rho.
    const bool on_ray = drive_ > 0 && k == std::exp(chart_.log_terminal_ratio());
    const double positive = !on_ray && difference > 0 ? difference : 0;  // a negative value is rounding
    const bool beside_a_ray = drive_ > 0 && positive < drag / 2;
    return {positive, beside_a_ray ? drag + sign * positive : force, drag, sliding};
  }

  /// Returns the largest |D| of the wrong sign divided by D's larger term; 0 if rounding of the law can explain it.
  double against() const {
    constexpr double of_the_law = 16 * std::numeric_limits<double>::epsilon();
    return against_ > of_the_law ? against_ : 0;
  }

 private:
  const Law& law_;
  double r_, drive_;
  const TerminalChart& chart_;
  mutable double against_ = 0;
};

}  // namespace

double lowest_ln_k(const Law& law, double r, double drive) {
  return drive > 0 ? std::min(min_ln_k, least_log_ratio(law, r, drive)) : min_ln_k;
}

std::vector<TerminalChart> charts_of(const TerminalRatios& ratios) {
  std::vector<TerminalChart> charts;
  for (const TerminalRatio& end : ratios.ends) {
    for (double far : {end.from, end.to}) {
      if (far != end.k) charts.push_back(TerminalChart::between(std::log(end.k), std::log(far)));
    }
  }
  return charts;
}

bool reaches_rest(const TerminalChart& chart, double drive) { return drive > 0 && chart.log_far_ratio() == -infinity; }

RegularSolution::RegularSolution(const std::function<Terms(double)>& equation, double direction,
                                 const std::vector<double>& edges, double size, std::optional<double> start,
                                 double noise)
    : direction_(direction), size_(size), tolerance_(std::max(panel_tolerance, noise)), begin_(edges.front()) {
  const Terms at_begin = equation(std::exp(direction_ * begin_));
  first_ = last_ = start ? *start : at_begin.source / at_begin.rate;
  for (std::size_t i = 1; i < edges.size(); ++i) march(equation, edges[i - 1], edges[i], 0);
}

void RegularSolution::march(const std::function<Terms(double)>& equation, double left, double right, int depth) {
  const double half = (right - left) / 2;
  Samples difference, rate, source;
  for (int i = 0; i < LegendreSeries::order; ++i) {
    const Terms at = equation(std::exp(direction_ * (left + half * (1 + LegendreSeries::points()[i]))));
    difference[i] = at.difference;
    rate[i] = at.rate;
    source[i] = at.source;
  }
  evaluations_ += LegendreSeries::order;
  LegendreSeries y = solve_linear_ode(difference / half, rate, source, last_);
  const double y_end = y.at_end();

  // The error of the series, relative to that on a panel of width 1; in a narrower panel an error has less effect.
  const double largest = std::max(rate.maxCoeff(), difference.maxCoeff());
  const double y_size = std::max({std::abs(y_end), size_, size_ / largest});
  const double of_terms =
      std::max({LegendreSeries::tail(difference), LegendreSeries::tail(rate), LegendreSeries::tail(source) / y_size}) /
      largest;
  const double left_out = std::max(of_terms, y.tail() / y_size) * std::min(right - left, 1.0);
  if (left_out > tolerance_ && depth < max_depth && panels_.size() < max_panels) {
    march(equation, left, left + half, depth + 1);
    march(equation, left + half, right, depth + 1);
    return;
  }
  truncation_ = std::max(truncation_, left_out);
  last_ = y_end;
  panels_.push_back({{left, right}, std::move(y)});
}

double RegularSolution::operator()(double ln_k) const {
  const double z = direction_ * ln_k;
  if (panels_.empty() || z <= begin_) return first_;
  const Panel& panel = panel_at(panels_, z);
  return panel.y(std::min(panel.t(z), 1.0));
}

RegularSolution sliding_equation(const Law& law, double r, const TerminalChart& chart, double drive, bool to_rest,
                                 const std::function<double(double k)>& source) {
  const ForcesOnTheWay forces(law, r, chart, drive);
  const auto equation = [&](double k) -> RegularSolution::Terms {
    const auto [difference, force, drag, sliding] = forces(k);
    return {difference, to_rest ? (k * force + drag) / (1 + k) : force, source(k)};
  };
  RegularSolution solution(equation, sign_of(chart), edges_of(law, r, chart, drive), 1);
  solution.truncation_ = std::max(solution.truncation_, forces.against());
  return solution;
}

RegularSolution sliding_solution(const Law& law, double r, const TerminalChart& chart, double drive) {
  const bool to_rest = reaches_rest(chart, drive);
  return sliding_equation(law, r, chart, drive, to_rest, [&](double k) {
    const double deficit = law.moment_deficit(slip_of_ratio(k));
    return to_rest ? k / (1 + k) * deficit : deficit;
  });
}

RegularSolution by_sliding_speed(const Law& law, double r, const TerminalChart& chart, double drive) {
  const ForcesOnTheWay forces(law, r, chart, drive);
  const auto equation = [&, tangent = tangent_of(law)](double k) -> RegularSolution::Terms {
    const auto [difference, force, drag, sliding] = forces(k);
    const auto [force_by_p, moment_by_r, force_slope, moment_slope] = tangent(slip_of_ratio(k));
    // All terms are multiplied by max(k, 1/k). Slopes of `tangent` are derivatives by k for k <= 1, by 1/k for k > 1.
    const double larger = std::max(k, 1 / k);
    const double moment_falls = moment_slope / (moment_by_r * std::min(1.0, 1 / k));
    return {larger * difference, force_slope + force * moment_falls, moment_falls};
  };
  return {equation, sign_of(chart), edges_of(law, r, chart, drive), 1, {}, tangent_error(law)};
}

RegularSolution by_pivoting_speed(const Law& law, double r, const TerminalChart& chart, double drive, double k,
                                  std::optional<double> start) {
  const ForcesOnTheWay forces(law, r, chart, drive);
  const auto equation = [&, tangent = tangent_of(law)](double at) -> RegularSolution::Terms {
    const auto [difference, force, drag, sliding] = forces(at);
    const auto [force_by_p, moment_by_r, force_slope, moment_slope] = tangent(slip_of_ratio(at));
    // Slopes of `tangent` are derivatives by k for k <= 1, and by 1/k for k > 1.
    const double times = at < 1 ? at * at : 1;
    const double slides = times * force_slope / force;
    return {difference, r * (times * moment_slope + moment_by_r * std::min(1.0, 1 / at) * slides), slides};
  };
  const double sign = sign_of(chart);
  std::vector<double> edges = edges_of(law, r, chart, drive);
  std::erase_if(edges, [&](double edge) { return sign * edge <= std::log(k); });
  edges.insert(sign > 0 ? edges.begin() : edges.end(), sign * std::log(k));
  // The solution falls like 1/k, but the noise of slopes by differences does not.
  const double noise = tangent_error(law);
  return {equation, sign, edges, noise > 0 ? 1.0 : 0.0, start, noise};
}

RegularSolution slip_length_solution(const Law& law, double r, const TerminalChart& chart, double drive) {
  // Solve for y = n/(1 + k): the slip length v (v/2 + n w) needs n only to an error relative to max(n, k).
  const ForcesOnTheWay forces(law, r, chart, drive);
  const auto equation = [&, to_rest = reaches_rest(chart, drive)](double k) -> RegularSolution::Terms {
    const auto [difference, force, drag, sliding] = forces(k);
    const double source = law.force_deficit(slip_of_ratio(k)) / (1 - drive);
    if (to_rest) return {difference, 2 * (k * force + drag) / (1 + k), k / (1 + k) * (k / (1 + k)) * source};
    return {difference * (1 + k) / k, (force * (1 + 2 * k) + drag) / k, source};
  };
  return {equation, sign_of(chart), edges_of(law, r, chart, drive), 1};
}

RegularSolution angle_solution(const Law& law, double r, const TerminalChart& chart, double drive) {
  const ForcesOnTheWay forces(law, r, chart, drive);
  const auto equation = [&, to_rest = reaches_rest(chart, drive)](double k) -> RegularSolution::Terms {
    const auto [difference, force, drag, sliding] = forces(k);
    const double deficit = law.moment_deficit(slip_of_ratio(k));
    if (to_rest) return {difference, (k * force + (2 + k) * drag) / (1 + k), k / (1 + k) * deficit};
    return {difference, force + drag, deficit};
  };
  return {equation, sign_of(chart), edges_of(law, r, chart, drive), 1};
}

namespace {

RegularSolution::Terms beta_terms(const ForcesOnTheWay& forces, double k) {
  const auto [difference, force, drag, sliding] = forces(k);
  return {difference, (drag + k * force) / (1 + k), k * ((1 + k) / ((16 + 15 * pi * k) * (8 + 3 * pi * k)))};
}

RegularSolution beta_solution(const Law& law, double r, const TerminalChart& chart, double drive) {
  const ForcesOnTheWay forces(law, r, chart, drive);
  auto edges = edges_of(law, r, chart, drive);
  std::ranges::reverse(edges);
  for (double& edge : edges) edge = -edge;
  const auto at_rest = reaches_rest(chart, drive) ? std::optional(0.0) : std::nullopt;
  return {[&](double k) { return beta_terms(forces, k); }, -sign_of(chart), edges, 0, at_rest};
}

}  // namespace

BetaSolution::BetaSolution(const Law& law, double r, const TerminalChart& chart, double drive)
    : b_(beta_solution(law, r, chart, drive)), sign_(sign_of(chart)), nearest_(edges_of(law, r, chart, drive).front()) {
  // If h is small compared with D, b reaches its limit long after all other functions have reached theirs. Beyond
  // nearest_, v is negligible in w + v for k -> 0, however small r is, and w is negligible for k -> infinity.
  const double k = std::exp(sign_ * nearest_);
  const ForcesOnTheWay forces(law, r, chart, drive);
  const auto [difference, force, drag, sliding] = forces(k);
  auto terms = beta_terms(forces, k);
  if (std::isinf(chart.log_terminal_ratio())) terms.rate = sign_ > 0 ? drag : force;
  at_stop_ = terms.source / terms.rate;
  rate_ = terms.rate / difference;
}

double BetaSolution::operator()(double ln_k) const {
  const double z = sign_ * ln_k;
  const double b = b_(ln_k);
  if (z >= nearest_) return b;
  const double change = std::expm1(rate_ * (z - nearest_));
  return b * (1 + change) - at_stop_ * change;
}

}  // namespace contensou::reduction
