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

#include "contensou/reduction/pade_law.hpp"
#include "stop_times/stop_time_kernel.hpp"
#include "stop_times/stop_time_panels.hpp"

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;
using Panel = Panels::Panel;

constexpr long double pi = std::numbers::pi_v<long double>;

bool moderate(long double x) { return x > 0x1p-100 && x < 0x1p100; }

/// A table that owns its panels.
struct StoredTable : StopTimeTable {
  explicit StoredTable(const ReducedSystem& system) : StopTimeTable{} {
    const Law& law = system.law();
    const long double r = system.r();
    const long double mu = system.mu();
    one_sheet = law.as<PadeLaw>() && system.r() <= largest_pade_r;
    wide_pivoting = 3 * pi / 2 / system.inertia().gamma / law.pivoting_moment() / mu;
    wide_sliding = 3 * pi / 2 / system.inertia().chi;
    lever = static_cast<double>(1 / (one_sheet ? mu * pade_fold(r) : mu));
    const long double sliding_share = wide_sliding / wide_pivoting / lever;
    flat = sliding_share < flat_below;
    if (flat) return;
    ordinary = moderate(wide_pivoting) && moderate(wide_sliding) && moderate(lever);
    unit = ordinary ? 1 : wide_pivoting;
    const PanelScales scales{sliding_share, unit / wide_pivoting};
    storage = one_sheet ? pade_panels(r, 1 / (mu * lever), scales) : law_panels(law, system.r(), scales);
    panels = storage.data();
  }

  /// The stop time is P + S then but for less than the last bit, and `lowest` would not be below it.
  static constexpr long double flat_below = 0x1p-61L;

  std::vector<Panel> storage;
};

}  // namespace

Panels::Span Panels::span(std::size_t index) {
  constexpr std::size_t cuts = std::size_t{1} << cut_bits;
  const double octave = std::ldexp(lowest, static_cast<int>(index / cuts));
  const double width = octave / cuts;
  return {octave + width * static_cast<double>(index % cuts), width};
}

double StopTimeTable::careful(double u0, double v0) const {
  if (!std::isfinite(u0) || !std::isfinite(v0) || v0 < 0) return std::numeric_limits<double>::quiet_NaN();
  const long double u = std::abs(u0);
  const long double v = v0;
  if (flat || (u == 0 && v == 0)) return static_cast<double>(wide_pivoting * u + wide_sliding * v);
  const long double levered = lever * v;
  const long double total = levered + u;
  long double numerator = u;
  std::size_t sheet = 0;
  if (!one_sheet) {
    const long double smaller = std::min(levered, u);
    const long double distance = std::abs(levered - u);
    const bool near = distance < smaller;
    const bool above = levered > u;
    numerator = near ? distance : smaller;
    sheet = near ? (above ? Panels::above_one : Panels::below_one) : (above ? Panels::fast : Panels::slow);
  }
  const double y = static_cast<double>(numerator / total) + Panels::lowest;
  const std::size_t index = Panels::index(std::bit_cast<std::uint64_t>(y));
  const long double t = y - Panels::span(index).left;
  long double sum = 0;
  const Panel& panel = panels[sheet * Panels::per_sheet + index];
  for (int n = Panels::terms; n-- > 0;) sum = sum * t + panel.of_power(n);
  return static_cast<double>(total * sum * unit);
}

std::span<const StopTimeKernel> stop_time_kernels() {
  static const std::vector<StopTimeKernel> kernels = [] {
    std::vector<StopTimeKernel> found{{"baseline", run_baseline}};
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back({"AVX2", run_avx2});
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
