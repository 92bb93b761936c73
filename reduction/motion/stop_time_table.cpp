// theory.md (R5): tau* = P + m(k) S = (P/|u0|) |u0| + v0 M(k), M = (S/v0) m. P/|u0| and S/v0 are constants of a system.
#include "motion/stop_time_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <thread>
#include <vector>

#include "motion/stop_time_loop.hpp"

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;
using Panel = Panels::Panel;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double tolerance = 4 * std::numeric_limits<double>::epsilon();

bool moderate(double x) { return x > 0x1p-100 && x < 0x1p100; }

/// Returns k0 = inverse_mu v0/|u0| for the coordinate y of StopTimePanels on the branch of a panel.
double ratio(std::size_t panel, double y) {
  const double up_to_one = (panel & Panels::near_one) != 0 ? (1 - y) / (1 + y) : y / (1 - y);
  return (panel & Panels::above_one) != 0 ? 1 / up_to_one : up_to_one;
}

/// The left edge of a panel in y + lowest, and the width of the panel.
struct Span {
  double left;
  double width;
};
Span span(std::size_t panel) {
  constexpr std::size_t cuts = std::size_t{1} << Panels::cut_bits;
  const std::size_t index = panel % Panels::per_branch;
  const double octave = std::ldexp(Panels::lowest, static_cast<int>(index / cuts));
  const double width = octave / cuts;
  return {octave + width * static_cast<double>(index % cuts), width};
}

/// Least-squares polynomials on [0, 1] through values at Chebyshev points. There are twice as many points as terms, so
/// that the noise of the values is halved.
class Fit {
 public:
  static constexpr std::size_t points = std::size_t{2} * Panels::terms;
  using Values = std::array<double, points>;

  Fit() {
    for (std::size_t i = 0; i < points; ++i) {
      const double angle = std::numbers::pi * static_cast<double>(2 * i + 1) / (2 * points);
      x[i] = (1 - std::cos(angle)) / 2;
      for (std::size_t n = 0; n < Panels::terms; ++n) {
        analysis_[n][i] = (n == 0 ? 1.0 : 2.0) / points * std::cos(static_cast<double>(n) * (std::numbers::pi - angle));
      }
    }
    // T_(n+1) = (4 x - 2) T_n - T_(n-1), T_1 = 2 x - 1.
    powers_[0] = {1};
    powers_[1] = {-1, 2};
    for (std::size_t n = 2; n < Panels::terms; ++n) {
      for (std::size_t i = 0; i <= n; ++i) {
        powers_[n][i] = (i > 0 ? 4 * powers_[n - 1][i - 1] : 0) - 2 * powers_[n - 1][i] - powers_[n - 2][i];
      }
    }
  }

  /// Returns the coefficients of powers of the distance width x from the left edge, 0 <= x <= 1.
  Panel panel(const Values& values, double width) const {
    // Subtract the constant first: then the other coefficients are small, and so is their rounding.
    const double constant = values[0];
    Panel fitted{};
    for (std::size_t n = 0; n < Panels::terms; ++n) {
      double coefficient = 0;
      for (std::size_t i = 0; i < points; ++i) coefficient += analysis_[n][i] * (values[i] - constant);
      for (std::size_t i = 0; i <= n; ++i) fitted.c[i] += powers_[n][i] * coefficient;
    }
    fitted.c[0] += constant;
    double unit = 1;
    for (double& c : fitted.c) {
      c /= unit;
      unit *= width;
    }
    return fitted;
  }

  Values x{};

 private:
  std::array<Values, Panels::terms> analysis_{};  ///< matrix from values to coefficients of Chebyshev polynomials
  /// Coefficients of powers of x in the Chebyshev polynomials.
  std::array<std::array<double, Panels::terms>, Panels::terms> powers_{};
};

/// Returns m of theory.md (R4) at k.
double sliding_coefficient(const Flow& flow, double k) {
  const double ln_k = std::log(k);
  const auto& curve = flow.solution().through(ln_k);
  return curve->sliding_coefficient(curve->chart().coordinate(ln_k));
}

/// Returns k at the fraction x in [0, 1] of the width of a panel.
double ratio_in_panel(std::size_t panel, double x) {
  const auto [left, width] = span(panel);
  return ratio(panel, left - Panels::lowest + width * x);
}

/// Returns the least-squares polynomial of a function of k on a panel.
Panel fitted_panel(std::size_t panel, const std::function<double(double k)>& function) {
  static const Fit fit;
  Fit::Values values;
  for (std::size_t i = 0; i < Fit::points; ++i) values[i] = function(ratio_in_panel(panel, fit.x[i]));
  return fit.panel(values, span(panel).width);
}

/// A thread takes at least this number of starts: whole cache lines.
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

  /// Compares some stop times of each panel with those of the flow, and disables the panels with too large errors.
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
          fails[panel_of(loop, start.u, start.v)] = true;  // k is rounded, so the start can lie in a neighbouring panel
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
    // A start outside the table's range of speeds can have a multiple inside this range.
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
