// Notation (README (R18) to (R20)): n = m - 1, so that tau* = (P + S)(1 + g), g = n S/(P + S); P/S = 1/(r Psi(0) k).
//   Pade, r < 2:  y = A/(A + B k), x = 1 - y, a = r/(2 - r), e = r/(5 - r)
//     x (1 - x) dn/dx + [(1 + a)(1 - x) + (1 + e) x] n = (3/2)(1 + a)(1 - x)
//     S/(P + S) = l x/(l x + y),  l = (A/B) r Psi(0)
#include "contensou/reduction/stop_time_profile.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <Eigen/LU>

#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/quadrature_curve.hpp"
#include "stop_time_kernel.hpp"

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;
using Panel = Panels::Panel;

constexpr long double pi = std::numbers::pi_v<long double>;

/// The interpolation that every panel is made of.
class PanelFit {
 public:
  using Values = Eigen::Matrix<double, Panels::terms, 1>;

  PanelFit() {
    for (int i = 0; i < Panels::terms; ++i) {
      nodes_[i] = std::cos(std::numbers::pi * (2 * i + 1) / (2 * Panels::terms));
    }
    Eigen::Matrix<double, Panels::terms, Panels::terms> powers;
    for (int n = 0; n < Panels::terms; ++n) powers.col(n) = nodes_.array().pow(n);
    solver_.compute(powers);
  }

  /// The panel `index` of a sheet, of a function of y.
  template <class Function>
  Panel operator()(std::size_t index, Function function) const {
    const auto [centre, half] = span(index);
    Values values;
    for (int i = 0; i < Panels::terms; ++i) values[i] = function(centre + half * nodes_[i]);
    const Values coefficients = solver_.solve(values);
    Panel panel{};
    double unit = 1;
    for (int n = 0; n < Panels::terms; ++n, unit *= half) panel.coefficients[n] = coefficients[n] / unit;
    return panel;
  }

  struct Span {
    double centre;
    double half;
  };
  static Span span(std::size_t index) {
    constexpr std::size_t cuts = std::size_t{1} << Panels::cut_bits;
    const double octave = std::ldexp(Panels::lowest, static_cast<int>(index / cuts));
    const double half = octave / (2 * cuts);
    return {octave + half * static_cast<double>(2 * (index % cuts) + 1), half};
  }

 private:
  Values nodes_;
  Eigen::PartialPivLU<Eigen::Matrix<double, Panels::terms, Panels::terms>> solver_;
};

/// n of the Pade curve for r < 2, by Taylor series from y = 1 down.
class PadeMarch {
 public:
  explicit PadeMarch(long double r) : a_(r / (2 - r)), e_(r / (5 - r)) {
    near_[0] = 1.5L;
    for (int j = 1; j < near_terms; ++j) {
      const long double source = j == 1 ? -1.5L * (1 + a_) : 0;
      near_[j] = ((j - 1 + a_ - e_) * near_[j - 1] + source) / (j + 1 + a_);
    }
  }

  /// The next panel's centre; the first time, one at which the series at y = 1 converges.
  void move_to(double centre) {
    const long double value = centre_ == 0 ? near(centre) : series(centre - centre_);
    centre_ = centre;
    // y (1 - y) and (1 + e) + (a - e) y in powers of y - centre.
    const long double c = centre_;
    const long double q1 = a_ - e_;
    const long double q0 = 1 + e_ + q1 * c;
    const long double source = 1.5L * (1 + a_);
    far_[0] = value;
    far_[1] = (q0 * far_[0] - source * c) / (c * (1 - c));
    for (int j = 1; j + 1 < far_terms; ++j) {
      const long double sum = (q0 - (1 - 2 * c) * j) * far_[j] + (q1 + (j - 1)) * far_[j - 1] - (j == 1 ? source : 0);
      far_[j + 1] = sum / (c * (1 - c) * (j + 1));
    }
  }

  long double near(long double y) const { return polynomial(near_, 1 - y); }
  long double series(long double t) const { return polynomial(far_, t); }

 private:
  static constexpr int near_terms = 72;  // x <= 1/2
  static constexpr int far_terms = 20;   // |t| <= y/16

  template <std::size_t terms>
  static long double polynomial(const std::array<long double, terms>& coefficients, long double t) {
    long double sum = 0;
    for (std::size_t n = terms; n-- > 0;) sum = sum * t + coefficients[n];
    return sum;
  }

  long double a_, e_;
  long double centre_ = 0;
  std::array<long double, near_terms> near_{};
  std::array<long double, far_terms> far_{};
};

std::vector<Panel> pade_panels(long double r, long double pivoting_moment) {
  const PanelFit fit;
  PadeMarch march(r);
  const long double l = 8 * (2 - r) / (3 * pi * (5 - r)) * r * pivoting_moment;
  std::vector<Panel> panels(Panels::per_sheet);
  for (std::size_t i = panels.size(); i-- > 0;) {
    const double centre = PanelFit::span(i).centre;
    const bool near = centre > 0.5;
    if (!near) march.move_to(centre);
    panels[i] = fit(i, [&](long double y) {
      const long double n = near ? march.near(y) : march.series(y - centre);
      return static_cast<double>(n * l * (1 - y) / (l * (1 - y) + y));
    });
  }
  return panels;
}

/// k of a fraction y on a sheet, as its logarithm.
double log_ratio(Panels::Sheet sheet, double y) {
  switch (sheet) {
    case Panels::slow:
      return std::log(y) - std::log1p(-y);
    case Panels::below_one:
      return -2 * std::atanh(y);
    case Panels::above_one:
      return 2 * std::atanh(y);
    case Panels::fast:
      break;
  }
  return std::log1p(-y) - std::log(y);
}

std::vector<Panel> sampled_panels(const Law& law, double r) {
  const PanelFit fit;
  const auto curve = similarity_curve(law, r);
  const double rate = r * law.pivoting_moment();
  std::vector<Panel> panels(4 * Panels::per_sheet);
  for (Panels::Sheet sheet : {Panels::slow, Panels::below_one, Panels::above_one, Panels::fast}) {
    for (std::size_t i = 0; i < Panels::per_sheet; ++i) {
      if (PanelFit::span(i).centre > 0.5) break;  // no y is above 1/3
      panels[sheet * Panels::per_sheet + i] = fit(i, [&](double y) {
        const double ln_k = log_ratio(sheet, y);
        return (curve->sliding_share(ln_k) - 1) / (1 + std::exp(-ln_k) / rate);
      });
    }
  }
  return panels;
}

bool moderate(double x) { return x > 0x1p-100 && x < 0x1p100; }

/// A table that owns its panels.
struct StoredTable : StopTimeTable {
  explicit StoredTable(const ReducedSystem& system) : StopTimeTable{} {
    const Law& law = system.law();
    const long double r = system.r();
    const long double mu = system.mu();
    one_sheet = law.as<PadeLaw>() && r < 2;
    storage = one_sheet ? pade_panels(r, law.pivoting_moment()) : sampled_panels(law, system.r());
    panels = storage.data();
    wide_pivoting = 3 * pi / 2 / system.inertia().gamma / law.pivoting_moment() / mu;
    wide_sliding = 3 * pi / 2 / system.inertia().chi;
    wide_rim = one_sheet ? mu * (8 * (2 - r) / (3 * pi * (5 - r))) : mu;
    pivoting = static_cast<double>(wide_pivoting);
    sliding = static_cast<double>(wide_sliding);
    rim = static_cast<double>(wide_rim);
    ordinary = moderate(pivoting) && moderate(sliding) && moderate(rim);
  }

  std::vector<Panel> storage;
};

}  // namespace

double StopTimeTable::careful(double u0, double v0) const {
  if (!std::isfinite(u0) || !std::isfinite(v0) || v0 < 0) return std::numeric_limits<double>::quiet_NaN();
  const long double u = std::abs(u0);
  const long double v = v0;
  if (u == 0 && v == 0) return 0;
  const long double w = wide_rim * u;
  long double numerator = w;
  std::size_t sheet = 0;
  if (!one_sheet) {
    const long double smaller = std::min(v, w);
    const long double distance = std::abs(v - w);
    const bool near = distance < smaller;
    numerator = near ? distance : smaller;
    sheet = near ? (v > w ? Panels::above_one : Panels::below_one) : (v > w ? Panels::fast : Panels::slow);
  }
  const double y = std::max(static_cast<double>(numerator / (v + w)), Panels::lowest);
  constexpr auto first = std::bit_cast<std::uint64_t>(Panels::lowest);
  const auto index = (std::bit_cast<std::uint64_t>(y) - first) >> Panels::mantissa_bits;
  const double t = y - PanelFit::span(index).centre;
  double g = 0;
  const Panel& panel = panels[sheet * Panels::per_sheet + index];
  for (int n = Panels::terms; n-- > 0;) g = g * t + panel.coefficients[n];
  const long double sum = wide_pivoting * u + wide_sliding * v;
  return static_cast<double>(sum + sum * g);
}

std::span<const StopTimeKernel> stop_time_kernels() {
  static const std::vector<StopTimeKernel> kernels = [] {
    std::vector<StopTimeKernel> found{{"baseline", run_baseline}};
#ifdef CONTENSOU_X86_64
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back({"AVX2", run_avx2});
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
      found.push_back({"AVX-512", run_avx512});
    }
#endif
    return found;
  }();
  return kernels;
}

namespace {

/// Arrays larger than this leave the caches by themselves: their results are stored past them.
constexpr std::size_t streaming_size = std::size_t{1} << 18;

/// Threads take whole cache lines.
constexpr std::size_t grain = 64;

void run_alone(const StopTimeTable& table, const StopTimeJob& job) {
  if (table.ordinary) {
    stop_time_kernels().back().run(table, job);
    return;
  }
  for (std::size_t i = 0; i < job.size; ++i) job.tau[i] = table.careful(job.u0[i], job.v0[i * job.v0_step]);
}

void run_shared(const StopTimeTable& table, const StopTimeJob& job, unsigned threads) {
  const std::size_t share = (job.size / threads / grain + 1) * grain;
  const auto part = [&](std::size_t begin) {
    StopTimeJob mine = job;
    mine.u0 += begin;
    mine.v0 += begin * job.v0_step;
    mine.tau += begin;
    mine.size = std::min(share, job.size - begin);
    run_alone(table, mine);
  };
#ifdef __cpp_lib_jthread
  std::vector<std::jthread> others;
  for (std::size_t begin = share; begin < job.size; begin += share) others.emplace_back(part, begin);
#else
  for (std::size_t begin = share; begin < job.size; begin += share) part(begin);
#endif
  if (job.size > 0) part(0);
}

}  // namespace

StopTimeProfile::StopTimeProfile(const ReducedSystem& system)
    : system_(system), table_(std::make_shared<const StoredTable>(system)) {}

double StopTimeProfile::operator()(double u0, double v0) const {
  require_state("StopTimeProfile", {u0, v0});
  double tau = 0;
  run_alone(*table_, {&u0, &v0, 1, &tau, 1, false});
  return tau;
}

void StopTimeProfile::evaluate(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                               unsigned threads) const {
  if (u0.size() != v0.size() || u0.size() != tau.size() || threads == 0) {
    throw std::domain_error(
        fmt::format("StopTimeProfile::evaluate: arrays of one size and a thread or more are needed, got {} u0, {} v0, "
                    "{} tau, {} threads",
                    u0.size(), v0.size(), tau.size(), threads));
  }
  run_shared(*table_, {u0.data(), v0.data(), 1, tau.data(), tau.size(), tau.size() > streaming_size}, threads);
}

void StopTimeProfile::evaluate_row(std::span<const double> u0, double v0, std::span<double> tau,
                                   unsigned threads) const {
  if (u0.size() != tau.size() || threads == 0) {
    throw std::domain_error(
        fmt::format("StopTimeProfile::evaluate_row: arrays of one size and a thread or more are needed, got {} u0, {} "
                    "tau, {} threads",
                    u0.size(), tau.size(), threads));
  }
  run_shared(*table_, {u0.data(), &v0, 0, tau.data(), tau.size(), tau.size() > streaming_size}, threads);
}

std::string_view StopTimeProfile::instruction_set() { return stop_time_kernels().back().name; }

}  // namespace contensou::reduction
