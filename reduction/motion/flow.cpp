#include "contensou/reduction/flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

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

}  // namespace contensou::reduction
