// theory.md (R11): moving the start along (u, v) scales the motion; moving the start along the field delays the motion.
#include "contensou/reduction/flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contensou/reduction/detail/root.hpp"
#include "motion/stop_time_table.hpp"
#include "numerics/epsilon.hpp"
#include "numerics/later.hpp"
#include "similarity/sliding_derivatives.hpp"

namespace contensou::reduction {

struct Flow::Solved {
  explicit Solved(const ReducedSystem& given, SimilaritySolution found = {})
      : system(given), solution(std::move(found)) {}

  static std::shared_ptr<const Solved> by_quadrature(const ReducedSystem& system) {
    auto solved = std::make_shared<Solved>(system);
    solved->solution = quadrature_solution(system.law(), system.r(), solved->terminal(), system.drive());
    solved->is_by_quadrature = true;
    return solved;
  }

  const TerminalRatios& terminal() const {
    return terminal_.made([this] { return terminal_ratios(system.law(), system.r(), system.drive()); });
  }

  /// Returns the derivatives of the scaled stop time along the curve that contains this k.
  const SlidingDerivatives& derivatives(double ln_k) const {
    const auto& all = derivatives_.made([this] {
      std::vector<SlidingDerivatives> made;
      for (const auto& curve : solution.curves()) {
        made.emplace_back(system.law(), system.r(), curve->chart(), system.drive());
      }
      return made;
    });
    const auto& curves = solution.curves();
    return all[static_cast<std::size_t>(std::ranges::find(curves, solution.through(ln_k)) - curves.begin())];
  }

  ReducedSystem system;
  SimilaritySolution solution;
  bool is_by_quadrature = false;

 private:
  Later<TerminalRatios> terminal_;
  Later<std::vector<SlidingDerivatives>> derivatives_;
};

struct Flow::Arrays {
  Later<StopTimeTable> table;
};

namespace {

/// Returns true if two values of ln k* are equal within the accuracy of a ray.
bool same_ratio(double a, double b) { return a == b || std::abs(a - b) < 1e-6; }

/// Returns some ln k between two ratios k, each of which can be 0 or infinity.
double between(double k, double other) {
  const auto [low, high] = std::minmax({std::log(k), std::log(other)});
  if (std::isinf(low)) return std::isinf(high) ? 0 : high - 1;
  return std::isinf(high) ? low + 1 : low + (high - low) / 2;
}

void require_match(const ReducedSystem& system, const SimilaritySolution& solution, const TerminalRatios& terminal) {
  for (const auto& curve : solution.curves()) {
    if (curve->r() == system.r() && curve->drive() == system.drive()) continue;
    throw std::domain_error(
        fmt::format("Flow: a solution for r = {} and a drive of {} was given with a system of r = {} and a drive of {}",
                    curve->r(), curve->drive(), system.r(), system.drive()));
  }
  for (const TerminalRatio& end : terminal.ends) {
    for (double far : {end.from, end.to}) {
      if (far == end.k) continue;
      const double ln_k = solution.through(between(end.k, far))->chart().log_terminal_ratio();
      if (same_ratio(ln_k, std::log(end.k))) continue;
      throw std::domain_error(fmt::format("Flow: the solution tends to k = {} where law {} with r = {} tends to k = {}",
                                          std::exp(ln_k), system.law().name(), system.r(), end.k));
    }
  }
}

}  // namespace

Flow::Flow(std::shared_ptr<const Solved> solved)
    : solved_(std::move(solved)), arrays_(std::make_shared<const Arrays>()) {}

Flow::Flow(const ReducedSystem& system)
    : Flow([&]() -> std::shared_ptr<const Solved> {
        SimilaritySolution closed = closed_solution(system.law(), system.r(), system.drive());
        if (!closed) return Solved::by_quadrature(system);
        return std::make_shared<const Solved>(system, std::move(closed));
      }()) {}

Flow Flow::by_quadrature(const ReducedSystem& system) { return Flow(Solved::by_quadrature(system)); }

Flow::Flow(const ReducedSystem& system, SimilaritySolution solution)
    : Flow(std::make_shared<const Solved>(system, std::move(solution))) {
  require_match(solved_->system, solved_->solution, solved_->terminal());
}

const ReducedSystem& Flow::system() const { return solved_->system; }

const TerminalRatios& Flow::terminal() const { return solved_->terminal(); }

const SimilaritySolution& Flow::solution() const { return solved_->solution; }

bool Flow::is_by_quadrature() const { return solved_->is_by_quadrature; }

Orbit Flow::orbit(State start) const {
  constexpr double min_r = 1e-300, max_r = 1e250;
  if (!(system().r() >= min_r && system().r() <= max_r)) {
    throw std::domain_error(fmt::format(
        "Flow::orbit: gamma mu^2/chi = {:.3g}, of mu = {:.3g}: {} to {} is allowed; a body with less spins as if "
        "v did not change u, and one with more slides as if on the axis u = 0",
        system().r(), system().mu(), min_r, max_r));
  }
  return {solved_->system, start, solved_->solution};
}

StopTime Flow::stop_time(State start) const {
  const Orbit motion(system(), start, solution());
  return {motion.stop_time(), motion.accuracy(), motion.evaluations(), system().stop_time_bounds(start)};
}

StopTimeGradient Flow::stop_time_gradient(State start) const {
  require_state("Flow::stop_time_gradient", start);
  return reduction::stop_time_gradient(system(), start, stop_time(start).tau, [this](double k) {
    const double ln_k = std::log(k);
    const auto& curve = *solution().through(ln_k);
    std::optional<double> closed;
    if (!is_by_quadrature()) closed = curve.sliding_coefficient(curve.chart().coordinate(ln_k));
    return solved_->derivatives(ln_k).at(SlidingDerivatives::Place::at(system().law(), k), closed);
  });
}

double Flow::log_first_integral(double u, double ln_v) const {
  const double ln_u = std::log(std::abs(u));
  if (!std::isfinite(ln_u) || !std::isfinite(ln_v)) {
    throw std::domain_error(
        fmt::format("Flow::log_first_integral: it has no value on the axes, got u = {}, ln v = {}", u, ln_v));
  }
  const double ln_k = ln_v - std::log(system().mu()) - ln_u;
  // The curves on both sides of a ray differ, and none of them contains the ray.
  const double k = std::exp(ln_k);
  for (const InvariantRay& ray : terminal().rays) {
    if (std::abs(k / ray.k - 1) > 4 * eps) continue;
    throw std::domain_error(
        fmt::format("Flow::log_first_integral: it has no value on the invariant ray k = {}, got u = {}, ln v = {}",
                    ray.k, u, ln_v));
  }
  const SimilarityCurve& curve = *solution().through(ln_k);
  return ln_u - curve.ln_w(curve.chart().coordinate(ln_k));
}

void Flow::stop_times(std::span<const double> u0, std::span<const double> v0, std::span<double> tau, unsigned threads,
                      std::size_t whole) const {
  if (u0.size() != v0.size() || u0.size() != tau.size() || threads == 0) {
    throw std::domain_error(fmt::format(
        "Flow::stop_times: arrays of one size and a thread or more are needed, got {} u0, {} v0, {} tau, {} threads",
        u0.size(), v0.size(), tau.size(), threads));
  }
  if (by_table(std::max(whole, tau.size()))) return table().evaluate(u0, v0, tau, threads);
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const State start{u0[i], v0[i]};
    tau[i] = is_state(start) ? stop_time(start).tau : std::numeric_limits<double>::quiet_NaN();
  }
}

double Flow::refused(std::size_t whole) const { return by_table(whole) ? table().refused() : 0; }

// The table stores m, which grows without bound under a drive.
bool Flow::by_table(std::size_t starts) const { return starts >= many_starts && system().drive() == 0; }

const StopTimeTable& Flow::table() const {
  // The table contains a copy of the flow. If it shared this flow, the two would keep each other alive for ever.
  return arrays_->table.made([this] { return StopTimeTable(Flow(solved_)); });
}

InstantGradient instant_gradient(const Flow& flow, State start, double tau) {
  const ReducedSystem& system = flow.system();
  require_state("instant_gradient", start);
  if (start.u == 0 || start.v == 0) {
    throw std::domain_error(fmt::format(
        "instant_gradient: a start with u not 0 and v > 0 is needed, got u = {}, v = {}", start.u, start.v));
  }
  const Orbit motion = flow.orbit(start);
  const Orbit::Instant at = motion.instant(tau);
  const Rate first = system.field(start);
  const Rate last = at.v > 0 || at.u != 0 ? system.field({at.u, at.v}) : Rate{0, 0};
  const double D = start.u * first.v - start.v * first.u;
  constexpr double clear = 1e-5;
  if (!(std::abs(D) > clear * std::max(std::abs(start.u * first.v), std::abs(start.v * first.u)))) {
    // Across a ray the state is as smooth as the law, so the gradient is the mean of two gradients beside the ray.
    for (double aside = 3 * clear; aside < 0.01; aside *= 3) {
      const State below{start.u, start.v * (1 - aside)}, above{start.u, start.v * (1 + aside)};
      const auto is_clear = [&](State beside) {
        const Rate rate = system.field(beside);
        return std::abs(beside.u * rate.v - beside.v * rate.u) > clear * std::abs(beside.v * rate.u);
      };
      if (!is_clear(below) || !is_clear(above)) continue;
      InstantGradient one = instant_gradient(flow, below, tau), other = instant_gradient(flow, above, tau);
      const auto mean = [](const InstantGradient::Part& a, const InstantGradient::Part& b, double value, double rate) {
        return InstantGradient::Part{value, (a.by_u + b.by_u) / 2, (a.by_v + b.by_v) / 2, rate};
      };
      return {mean(one.u, other.u, at.u, last.u), mean(one.v, other.v, at.v, last.v),
              mean(one.slip_length, other.slip_length, at.slip_length, at.v),
              mean(one.turned, other.turned, at.turned, at.u)};
    }
    throw std::domain_error(fmt::format(
        "instant_gradient: under law {} every k near that of u = {}, v = {} keeps what it is: no gradient by k",
        system.law().name(), start.u, start.v));
  }
  // Two derivatives by the start are known: along (u, v), a scaling, and along the field, a delay.
  const auto part = [&](double value, int degree, double rate, double later) {
    const double scaled = degree * value - tau * rate;
    return InstantGradient::Part{value, (scaled * first.v - start.v * later) / D,
                                 (start.u * later - first.u * scaled) / D, rate};
  };
  return {part(at.u, 1, last.u, last.u), part(at.v, 1, last.v, last.v), part(at.slip_length, 2, at.v, at.v - start.v),
          part(at.turned, 2, at.u, at.u - start.u)};
}

namespace {

using std::numbers::pi;

OrbitPoint at_beta(const Orbit& orbit, double mu, State start, double beta) {
  if (!(beta >= 0)) throw std::domain_error(fmt::format("at_beta: beta must be >= 0, got {}", beta));
  const double stop = orbit.stop_time();
  if (beta == 0) return orbit.at_time(0);
  OrbitPoint found = orbit.at_time_left(0);
  if (std::isinf(beta) || stop == 0) return found;
  if (orbit.on_axis()) {
    // The speed that is not 0 falls linearly. In dtau = weight dbeta the weight is proportional to the square of this
    // speed. If the share f of the time is left, beta is (1 - f)/f times its value at f = 1/2.
    const double spent = beta / orbit.at_time_left(stop / 2).beta;
    if (std::isfinite(spent)) found = orbit.at_time_left(stop / (1 + spent));
  } else {
    // Towards the stop beta grows like 1/(time left), so ln beta is nearly linear in ln (time left).
    const double unit = 1 / (16 * mu * std::abs(start.u) + 15 * pi * start.v);
    const auto at = [&](double ln_share) { return orbit.at_time_left(std::min(stop * std::exp(ln_share), stop)); };
    const auto missing = [&](double ln_share) { return std::log(beta + unit) - std::log(at(ln_share).beta + unit); };
    constexpr double last = -500;  // from there on beta is proportional to 1/(time left), within rounding
    double low = -1;
    while (low > last && missing(low) > 0) low = std::max(2 * low, last);
    found = missing(low) > 0 ? orbit.at_time_left(stop * std::exp(low) * std::exp(-missing(low)))
                             : at(root_between(missing, low, 0, missing(low), std::log(beta + unit) - std::log(unit)));
  }
  found.beta = beta;
  return found;
}

}  // namespace

OrbitPoint at_beta(const Flow& flow, State start, double beta) {
  return at_beta(flow.orbit(start), flow.system().mu(), start, beta);
}

OrbitColumns at_betas(const Flow& flow, State start, const Eigen::ArrayXd& betas) {
  const Orbit orbit = flow.orbit(start);
  OrbitColumns columns(betas.size());
  for (Eigen::Index i = 0; i < betas.size(); ++i) {
    columns.set(i, at_beta(orbit, flow.system().mu(), start, betas[i]));
  }
  return columns;
}

}  // namespace contensou::reduction
