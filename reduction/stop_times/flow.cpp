#include "contensou/reduction/flow.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/stop_time_table.hpp"

namespace contensou::reduction {

struct Flow::Solved {
  ReducedSystem system;
  TerminalRatios terminal = terminal_ratios(system.law(), system.r());
  SimilaritySolution solution = {};
  bool by_quadrature = false;
  bool closed_time = false;  ///< stop times have a closed form of their own

  void solve_by_quadrature() {
    solution = quadrature_solution(system.law(), system.r(), terminal);
    by_quadrature = true;
  }
};

struct Flow::Arrays {
  std::once_flag made;
  std::optional<StopTimeTable> table;
};

namespace {

/// Whether two ln k* are the same to what a ray's accuracy allows.
bool same_ratio(double a, double b) { return a == b || std::abs(a - b) < 1e-6; }

/// A ln k between two ratios, either of which may be 0 or infinity.
double between(double k, double other) {
  const auto [low, high] = std::minmax({std::log(k), std::log(other)});
  if (std::isinf(low)) return std::isinf(high) ? 0 : high - 1;
  return std::isinf(high) ? low + 1 : low + (high - low) / 2;
}

void require_match(const ReducedSystem& system, const SimilaritySolution& solution, const TerminalRatios& terminal) {
  for (const auto& curve : solution.curves()) {
    if (curve->r() == system.r()) continue;
    throw std::domain_error(
        fmt::format("Flow: a solution for r = {} was given with a system of r = {}", curve->r(), system.r()));
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

Flow::Flow(Solved solved)
    : solved_(std::make_shared<const Solved>(std::move(solved))), arrays_(std::make_shared<Arrays>()) {}

Flow::Flow(const ReducedSystem& system)
    : Flow([&] {
        Solved solved{.system = system, .solution = closed_solution(system.law(), system.r())};
        solved.closed_time = closed_stop_time(system, {0, 0}).has_value();
        if (!solved.solution) solved.solve_by_quadrature();
        return solved;
      }()) {}

Flow Flow::by_quadrature(const ReducedSystem& system) {
  Solved solved{.system = system};
  solved.solve_by_quadrature();
  return Flow(std::move(solved));
}

Flow::Flow(const ReducedSystem& system, SimilaritySolution solution)
    : Flow(Solved{.system = system, .solution = std::move(solution)}) {
  require_match(solved_->system, solved_->solution, solved_->terminal);
}

const ReducedSystem& Flow::system() const { return solved_->system; }

const TerminalRatios& Flow::terminal() const { return solved_->terminal; }

const SimilaritySolution& Flow::solution() const { return solved_->solution; }

bool Flow::is_by_quadrature() const { return solved_->by_quadrature; }

Orbit Flow::orbit(State start) const {
  constexpr double max_r = 1e250;
  if (system().r() > max_r) {
    throw std::domain_error(
        fmt::format("Flow::orbit: gamma mu^2/chi = {} is too large: at most {} is allowed; such a body slides as if on "
                    "the axis u = 0",
                    system().r(), max_r));
  }
  return Orbit(solved_->system, start, solved_->solution).begun();
}

StopTime Flow::stop_time(State start) const {
  const Solved& solved = *solved_;
  if (solved.closed_time) return reduction::stop_time(solved.system, start, Route::closed);
  const Orbit motion(solved.system, start, solved.solution);
  const Route route = solved.by_quadrature ? Route::quadrature : Route::closed;
  return {motion.stop_time(), route, motion.accuracy(), motion.evaluations(), solved.system.stop_time_bounds(start)};
}

double Flow::log_first_integral(double u, double ln_v) const {
  const double ln_u = std::log(std::abs(u));
  if (!std::isfinite(ln_u) || !std::isfinite(ln_v)) {
    throw std::domain_error(
        fmt::format("Flow::log_first_integral: it has no value on the axes, got u = {}, ln v = {}", u, ln_v));
  }
  const double ln_k = ln_v - std::log(system().mu()) - ln_u;
  const SimilarityCurve& curve = *solution().through(ln_k);
  return ln_u - curve.ln_w(curve.chart().coordinate(ln_k));
}

const StopTimeTable& Flow::table() const {
  // The table keeps a flow of its own: one that kept this one would never be released.
  std::call_once(arrays_->made, [this] { arrays_->table.emplace(Flow(Solved(*solved_))); });
  return *arrays_->table;
}

void Flow::stop_times(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                      unsigned threads) const {
  table().evaluate(u0, v0, tau, threads);
}

}  // namespace contensou::reduction
