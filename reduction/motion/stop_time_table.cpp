// README (R18): tau* = P + m(k) S = (P/|u0|) |u0| + v0 M(k), M = (S/v0) m. P/|u0| and S/v0 are constants of a system.
#include "motion/stop_time_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "motion/stop_time_loop.hpp"
#include "motion/stop_time_panels.hpp"

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;
using Panel = Panels::Panel;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double tolerance = 4 * std::numeric_limits<double>::epsilon();

bool moderate(double x) { return x > 0x1p-100 && x < 0x1p100; }

/// Smallest number of starts for one thread: whole cache lines.
constexpr std::size_t grain = 64;

void run_shared(const Panels& panels, std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                unsigned threads) {
  const std::size_t part_size = (tau.size() / threads / grain + 1) * grain;
  const auto part = [&](std::size_t begin) {
    run_fastest()(panels, &u0[begin], &v0[begin], &tau[begin], std::min(part_size, tau.size() - begin));
  };
#ifdef __cpp_lib_jthread
  std::vector<std::jthread> others;
  for (std::size_t begin = part_size; begin < tau.size(); begin += part_size) others.emplace_back(part, begin);
#else
  for (std::size_t begin = part_size; begin < tau.size(); begin += part_size) part(begin);
#endif
  if (!tau.empty()) part(0);
}

}  // namespace

struct StopTimeTable::Stored {
  explicit Stored(const Flow& given) : flow(given), storage(Panels::branches * Panels::per_branch, none()) {
    const ReducedSystem& system = flow.system();
    loop.inverse_mu = 1 / system.mu();
    loop.pivoting = system.pivoting_limit(1);
    loop.panels = storage.data();
    loop.otherwise = [this](double u0, double v0) { return otherwise(u0, v0); };
    const double sliding = system.sliding_limit(1);
    if (!moderate(loop.inverse_mu) || !moderate(loop.pivoting) || !moderate(sliding)) return;
    for (std::size_t i = 0; i < storage.size(); ++i) {
      if (i % Panels::per_branch < Panels::used) storage[i] = made(i, sliding);
    }
    prove();
  }
  Stored(const Stored&) = delete;
  Stored& operator=(const Stored&) = delete;

  static Panel none() {
    Panel panel;
    std::ranges::fill(panel.c, not_a_number);
    return panel;
  }

  Panel made(std::size_t index, double sliding) const {
    return fitted_panel(index, [&](double k) { return sliding * sliding_coefficient(flow, k); });
  }

  /// Compares some stop times of each panel with those of the flow, and disables the panels that fail.
  void prove() {
    std::vector<bool> fails(storage.size());
    for (std::size_t i = 0; i < storage.size(); ++i) {
      if (i % Panels::per_branch >= Panels::used) continue;
      for (double x : {0.01, 0.37, 0.85}) {
        const double k = ratio_in_panel(i, x);
        const State start = k < 1 ? State{1, k / loop.inverse_mu} : State{loop.inverse_mu / k, 1};
        const double wanted = flow.stop_time(start).tau;
        const double error = std::abs(from_panels(loop, start.u, start.v) - wanted) / wanted;
        if (error <= tolerance) {
          worst = std::max(worst, error);
        } else {
          fails[panel_of(loop, start.u, start.v)] = true;  // k is rounded, so the start may lie in a neighbouring panel
        }
      }
    }
    for (std::size_t i = 0; i < storage.size(); ++i) {
      if (fails[i]) storage[i] = none();
    }
    refused = static_cast<double>(std::ranges::count(fails, true)) / (Panels::branches * Panels::used);
  }

  /// Returns the stop time of a start for which the table has no usable value.
  double otherwise(double u0, double v0) const {
    if (!std::isfinite(u0) || !std::isfinite(v0) || v0 < 0) return not_a_number;
    const double largest = std::max(std::abs(u0), v0);
    if (largest == 0) return 0;
    // A start out of the range of the table may have a multiple in this range.
    const int exponent = std::ilogb(largest);
    const State start{std::ldexp(std::abs(u0), -exponent), std::ldexp(std::abs(v0), -exponent)};
    const double tau = from_panels(loop, start.u, start.v);
    return std::isnan(tau) ? flow.stop_time({u0, std::abs(v0)}).tau : std::ldexp(tau, exponent);
  }

  Flow flow;
  std::vector<Panel> storage;
  Panels loop;
  double worst = 0;
  double refused = 1;
};

StopTimeTable::StopTimeTable(const Flow& flow) : stored_(std::make_shared<const Stored>(flow)) {}

double StopTimeTable::worst_error() const { return stored_->worst; }

double StopTimeTable::refused() const { return stored_->refused; }

double StopTimeTable::operator()(double u0, double v0) const {
  require_state("StopTimeTable", {u0, v0});
  const double tau = from_panels(stored_->loop, u0, v0);
  return std::isnan(tau) ? stored_->otherwise(u0, v0) : tau;
}

void StopTimeTable::evaluate(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                             unsigned threads) const {
  run_shared(stored_->loop, u0, v0, tau, threads);
}

}  // namespace contensou::reduction
