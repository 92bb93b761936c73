// Notation (README (R18)): tau* = P + m(k) S = (P/|u0|) |u0| + v0 M(k), M = (S/v0) m, k = v0/(mu |u0|)
#include "contensou/reduction/stop_time_table.hpp"

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

#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/pade_sliding_coefficient.hpp"
#include "stop_times/stop_time_loop.hpp"

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;
using Panel = Panels::Panel;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double tolerance = 4 * std::numeric_limits<double>::epsilon();

double sliding_coefficient(const Flow& flow, double k) {
  if (flow.system().law().as<PadeLaw>()) return pade_sliding_coefficient(flow.system().r(), k);
  const double ln_k = std::log(k);
  const auto& curve = flow.solution().through(ln_k);
  return curve->sliding_coefficient(curve->chart().coordinate(ln_k));
}

/// inverse_mu v0/|u0| at a y of the branch of a panel.
double ratio(std::size_t panel, double y) {
  const double up_to_one = (panel & Panels::near_one) != 0 ? (1 - y) / (1 + y) : y / (1 - y);
  return (panel & Panels::above_one) != 0 ? 1 / up_to_one : up_to_one;
}

/// The left edge of a panel in y + lowest, and its width.
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

/// Polynomials on [0, 1], by least squares at Chebyshev's points: twice as many as terms, so that their noise is
/// halved.
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

  /// Coefficients of powers of width x.
  Panel panel(const Values& values, double width) const {
    // The constant apart, so that what is left is small and its rounding smaller.
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
  std::array<Values, Panels::terms> analysis_{};  ///< values -> coefficients of Chebyshev's polynomials
  std::array<std::array<double, Panels::terms>, Panels::terms> powers_{};  ///< of these polynomials
};

bool moderate(double x) { return x > 0x1p-100 && x < 0x1p100; }

/// Threads take whole cache lines.
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
    static const Fit fit;
    const auto [left, width] = span(index);
    Fit::Values values;
    for (std::size_t i = 0; i < Fit::points; ++i) {
      values[i] = sliding * sliding_coefficient(flow, ratio(index, left - Panels::lowest + width * fit.x[i]));
    }
    return fit.panel(values, width);
  }

  /// Compares some starts in each panel, and takes the panels that fail out of use.
  void prove() {
    std::vector<bool> fails(storage.size());
    for (std::size_t i = 0; i < storage.size(); ++i) {
      if (i % Panels::per_branch >= Panels::used) continue;
      const auto [left, width] = span(i);
      for (double x : {0.01, 0.37, 0.85}) {
        const double k = ratio(i, left - Panels::lowest + width * x);
        const State start = k < 1 ? State{1, k / loop.inverse_mu} : State{loop.inverse_mu / k, 1};
        const double wanted = flow.stop_time(start).tau;
        const double error = std::abs(from_panels(loop, start.u, start.v) - wanted) / wanted;
        if (error <= tolerance) {
          worst = std::max(worst, error);
        } else {
          fails[panel_of(loop, start.u, start.v)] = true;  // which is not always this one: k is a double
        }
      }
    }
    for (std::size_t i = 0; i < storage.size(); ++i) {
      if (fails[i]) storage[i] = none();
    }
    refused = static_cast<double>(std::ranges::count(fails, true)) / (Panels::branches * Panels::used);
  }

  /// A start that the table does not answer.
  double otherwise(double u0, double v0) const {
    if (!std::isfinite(u0) || !std::isfinite(v0) || v0 < 0) return not_a_number;
    const double largest = std::max(std::abs(u0), v0);
    if (largest == 0) return 0;
    // Scaled, it may be in the table after all.
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

const ReducedSystem& StopTimeTable::system() const { return stored_->flow.system(); }

bool StopTimeTable::proved() const { return stored_->refused == 0; }

double StopTimeTable::worst_error() const { return stored_->worst; }

double StopTimeTable::refused() const { return stored_->refused; }

double StopTimeTable::operator()(double u0, double v0) const {
  require_state("StopTimeTable", {u0, v0});
  const double tau = from_panels(stored_->loop, u0, v0);
  return std::isnan(tau) ? stored_->otherwise(u0, v0) : tau;
}

void StopTimeTable::evaluate(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                             unsigned threads) const {
  if (u0.size() != v0.size() || u0.size() != tau.size() || threads == 0) {
    throw std::domain_error(
        fmt::format("StopTimeTable::evaluate: arrays of one size and a thread or more are needed, got {} u0, {} v0, {} "
                    "tau, {} threads",
                    u0.size(), v0.size(), tau.size(), threads));
  }
  run_shared(stored_->loop, u0, v0, tau, threads);
}

void StopTimeTable::evaluate_row(std::span<const double> u0, double v0, std::span<double> tau) const {
  if (u0.size() != tau.size()) {
    throw std::domain_error(fmt::format("StopTimeTable::evaluate_row: arrays of one size are needed, got {} u0, {} tau",
                                        u0.size(), tau.size()));
  }
  std::array<double, 512> row;
  row.fill(v0);
  for (std::size_t i = 0; i < tau.size(); i += row.size()) {
    run_fastest()(stored_->loop, &u0[i], row.data(), &tau[i], std::min(row.size(), tau.size() - i));
  }
}

}  // namespace contensou::reduction
