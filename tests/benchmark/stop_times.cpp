// The cost of a stop time: this library, other libraries, and the memory bandwidth of the machine, measured in one run.
//   benchmark_stop_times            prints the tables of README.md in Markdown
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "contensou/reduction/detail/stop_times_of_mu.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "motion/stop_time_loop.hpp"
#include "motion/stop_time_table.hpp"
#include "reference_table.hpp"
#include "rivals.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace {

using namespace contensou::reduction;
using contensou::tests::ReferenceRow;

/// The least time of one call in nanoseconds, by name: processor time, or clock time if threads share the work.
class Times : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const bool shared = run.run_name.function_name.ends_with(" cores");
      const double seconds = shared ? run.real_accumulated_time : run.cpu_accumulated_time;
      const double nanoseconds = 1e9 * seconds / static_cast<double>(run.iterations);
      const auto [found, first] = least_.try_emplace(run.run_name.function_name, nanoseconds);
      if (!first) found->second = std::min(found->second, nanoseconds);
    }
  }
  double operator()(const std::string& name) const { return least_.at(name); }

 private:
  std::map<std::string, double> least_;
};

/// Registers a call to be measured.
void measure(const std::string& name, std::function<void()> call, double seconds = 0.03, int repetitions = 5) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [call = std::move(call)](benchmark::State& state) {
                                 for (auto _ : state) call();
                               })
      ->MinTime(seconds)
      ->Repetitions(repetitions)
      ->UseRealTime();
}

/// Registers a call that waits for memory, which other programs use, too. The call is repeated more often.
void measure_in_memory(const std::string& name, std::function<void()> call) {
  measure(name, std::move(call), 0.03, 15);
}

/// A start of tests/reference/stop_pade.csv, with its stop time to 40 digits.
struct Start {
  double mu, u0, v0;
  long double tau;
};

std::vector<Start> starts() {
  std::vector<Start> found;
  for (const ReferenceRow& row : contensou::tests::reference_table("stop_pade")) {
    const double mu = row.input("mu");
    const double u0 = std::abs(row.input("u0"));
    const double v0 = row.input("v0");
    const double k0 = v0 / (mu * u0);
    const bool common = mu >= 0.01 && mu <= 1 && u0 >= 1e-3 && u0 <= 1e3 && k0 >= 1e-3 && k0 <= 1e5;
    if (common) found.push_back({mu, u0, v0, row.result("tau_stop")});
  }
  return found;
}

/// The results of one method, which computes one start after the other: number of evaluations and error.
struct Answers {
  double evaluations = 0;  ///< mean
  double error = 0;        ///< worst, relative
};
using Method = std::function<contensou::rivals::RivalResult(const Start&)>;
Answers answers(const std::vector<Start>& all, const Method& method) {
  Answers sum;
  for (const Start& start : all) {
    const auto [tau, evaluations] = method(start);
    sum.evaluations += static_cast<double>(evaluations) / static_cast<double>(all.size());
    const auto error = static_cast<double>(std::abs(tau / start.tau - 1));
    sum.error = error <= sum.error ? sum.error : std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
  }
  return sum;
}

/// An array with the alignment that the streaming stores of the bandwidth loop need.
class Array {
 public:
  explicit Array(std::size_t size) : data_(new (std::align_val_t{64}) double[size]), size_(size) {}
  double* data() const { return data_.get(); }
  std::span<double> span() const { return {data_.get(), size_}; }

 private:
  struct Free {
    void operator()(double* data) const { operator delete[](data, std::align_val_t{64}); }
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t size_;
};

/// A loop out = u + v with stores that bypass the caches: the cost of reading and writing alone.
using BareLoop = void(const double* u, const double* v, double* out, std::size_t size);

#ifdef __SSE2__
void bare_loop(const double* u, const double* v, double* out, std::size_t size) {
  for (std::size_t i = 0; i < size; i += 2) {
    _mm_stream_pd(out + i, _mm_add_pd(_mm_load_pd(u + i), _mm_load_pd(v + i)));
  }
  _mm_sfence();
}

#else
void bare_loop(const double* u, const double* v, double* out, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) out[i] = u[i] + v[i];
}
#endif

void run_shared(BareLoop* loop, std::span<const double> u, std::span<const double> v, std::span<double> out,
                unsigned threads) {
  const std::size_t share = out.size() / threads / 64 * 64;
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < threads; ++i) {
    const std::size_t begin = i * share, end = i + 1 == threads ? out.size() : begin + share;
    others.emplace_back(loop, &u[begin], &v[begin], &out[begin], end - begin);
  }
  loop(u.data(), v.data(), out.data(), threads == 1 ? out.size() : share);
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string duration(double nanoseconds) {
  if (nanoseconds < 1e3) return fmt::format("{:.3g} ns", nanoseconds);
  return nanoseconds < 1e6 ? fmt::format("{:.3g} us", nanoseconds / 1e3) : fmt::format("{:.3g} ms", nanoseconds / 1e6);
}

}  // namespace

int main() {
  constexpr std::size_t points = std::size_t{1} << 23;  // 3 arrays of 64 MiB
  const unsigned cores = std::min(2U, std::thread::hardware_concurrency());
  const std::vector<Start> table = starts();

  // Measurements with one start at a time.
  std::vector<std::pair<std::string, Method>> methods;
  std::map<double, StopTimeTable> tables;
  for (const Start& start : table) tables.try_emplace(start.mu, ReducedSystem(PadeLaw{}, start.mu));
  methods.emplace_back("table of the system, one start", [&](const Start& s) {
    return contensou::rivals::RivalResult{tables.at(s.mu)(s.u0, s.v0), 0};
  });
  const Law pade_law{PadeLaw{}};
  const auto by_route = [&pade_law](Route route) {
    return [&pade_law, route](const Start& s) {
      const StopTime stop = stop_time(ReducedSystem(pade_law, s.mu), {s.u0, s.v0}, route);
      return contensou::rivals::RivalResult{stop.tau, stop.evaluations};
    };
  };
  methods.emplace_back("closed form", by_route(Route::closed));
  methods.emplace_back("quadrature", by_route(Route::quadrature));
  methods.emplace_back("Odeint on (2.7) in ln u, ln v", by_route(Route::regularised));
  for (const auto& rival : contensou::rivals::all()) {
    methods.emplace_back(rival.name, [rival](const Start& s) { return rival.stop_time(s.mu, s.u0, s.v0); });
  }
  for (const auto& [name, method] : methods) {
    const bool slow = name.find("(2.6)") != std::string::npos;
    measure(
        name,
        [&table, method = method] {
          for (const Start& start : table) benchmark::DoNotOptimize(method(start));
        },
        slow ? 0.001 : 0.05, slow ? 2 : 7);
  }

  // Measurements with arrays.
  const Array u(points), v(points), tau(points);
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> ln(-3, 3);
  for (double& x : u.span()) x = std::exp(ln(generator));
  for (double& x : v.span()) x = std::exp(ln(generator));
  std::ranges::fill(tau.span(), 0);
  const StopTimeTable pade(ReducedSystem(PadeLaw{}, 0.1)), hertz(ReducedSystem(HertzLaw{}, 0.1));
  for (unsigned threads = 1; threads <= cores; ++threads) {
    const std::string on = threads == 1 ? "" : fmt::format(" on {} cores", threads);
    measure_in_memory("loop" + on, [&, threads] { run_shared(bare_loop, u.span(), v.span(), tau.span(), threads); });
    measure_in_memory("pade" + on, [&, threads] { pade.evaluate(u.span(), v.span(), tau.span(), threads); });
    measure_in_memory("hertz" + on, [&, threads] { hertz.evaluate(u.span(), v.span(), tau.span(), threads); });
  }
  // The loop alone, on panels that all contain the same polynomial.
  const std::vector<StopTimePanels::Panel> panels(StopTimePanels::branches * StopTimePanels::per_branch,
                                                  {{1, 0.5, 0.25}});
  const StopTimePanels plain{10, 32, panels.data(), {}};
  measure_in_memory("plain", [&] { run_plain(plain, u.data(), v.data(), tau.data(), points); });
  measure("build pade", [] { benchmark::DoNotOptimize(StopTimeTable(ReducedSystem(PadeLaw{}, 0.1))); });
  measure("build hertz", [] { benchmark::DoNotOptimize(StopTimeTable(ReducedSystem(HertzLaw{}, 0.1))); });

  // Each start has its own mu. The measured time includes the solution that serves all these mu.
  constexpr std::size_t own = 10'000;
  std::uniform_real_distribution<double> some_mu(0.05, 0.3), some_speed(0.1, 2);
  std::vector<std::pair<double, State>> own_starts;
  for (std::size_t i = 0; i < own; ++i)
    own_starts.push_back({some_mu(generator), {some_speed(generator), some_speed(generator)}});
  std::vector<std::string> own_rows;
  const auto measure_own = [&](const Law& law, double drive, bool gradient) {
    const std::string name =
        fmt::format("{} law{}{}", law.name(), drive > 0 ? ", drive 0.1" : "", gradient ? ", gradient" : "");
    own_rows.push_back(name);
    measure(
        name,
        [&own_starts, law, drive, gradient] {
          const StopTimesOfMu stop_time(law, homogeneous_ball, drive);
          for (const auto& [mu, start] : own_starts) {
            benchmark::DoNotOptimize(gradient ? stop_time.gradient(mu, start).by_mu : stop_time(mu, start));
          }
        },
        0.01, 3);
    measure(
        name + " alone",
        [law, drive, gradient] {
          const Flow flow({law, 0.1, homogeneous_ball, drive});
          benchmark::DoNotOptimize(gradient ? flow.stop_time_gradient({1, 1}).by_mu : flow.stop_time({1, 1}).tau);
        },
        0.01, 3);
  };
  for (const char* name : {"exact", "pade", "uniform", "ring"}) measure_own(*find_law(name), 0, false);
  for (const char* name : {"exact", "ring"}) measure_own(*find_law(name), 0.1, false);
  for (const char* name : {"exact", "ring"}) measure_own(*find_law(name), 0, true);

  // Measure compared calls alternately, so that a slow minute of the machine affects all of them.
  std::array<std::string, 2> options{"benchmark_stop_times", "--benchmark_enable_random_interleaving=true"};
  std::array<char*, 2> arguments{options[0].data(), options[1].data()};
  int count = arguments.size();
  benchmark::Initialize(&count, arguments.data());
  Times times;
  benchmark::RunSpecifiedBenchmarks(&times);

  fmt::print("{}, {} cores used, {}; GCC {}, {}.\n", processor(), cores,
             &run_fastest() == &run_plain ? "no AVX2" : "AVX2", __VERSION__, contensou::rivals::versions());

  fmt::print("\n{} starts of tests/reference/stop_pade.csv, one after the other, steppers at 1e-12:\n\n", table.size());
  fmt::print(
      "| Pade ball, 0.01 <= mu <= 1 | time | against the closed form | evaluations | worst error "
      "|\n|---|---|---|---|---|\n");
  const double closed = times("closed form");
  for (const auto& [name, method] : methods) {
    const auto [evaluations, error] = answers(table, method);
    fmt::print("| {} | {} | {:.3g} | {:.0f} | {:.1e} |\n", name,
               duration(times(name) / static_cast<double>(table.size())), times(name) / closed, evaluations, error);
  }

  const auto each = [&](const std::string& name) { return times(name) / static_cast<double>(points); };
  fmt::print("\n{} starts in arrays, mu = 0.1:\n\n", points);
  fmt::print("| a point | 1 core | of the loop | {} cores | of the loop |\n|---|---|---|---|---|\n", cores);
  for (const auto& [name, title] :
       {std::pair{"loop", "out = u + v, streaming stores"}, {"pade", "table, Pade"}, {"hertz", "table, exact law"}}) {
    const auto on = [&](const char* what, unsigned n) {
      return each(n == 1 ? what : fmt::format("{} on {} cores", what, n));
    };
    fmt::print("| {} | {:.2f} ns | {:.0f} % | {:.2f} ns | {:.0f} % |\n", title, on(name, 1),
               100 * on("loop", 1) / on(name, 1), on(name, cores), 100 * on("loop", cores) / on(name, cores));
  }
  fmt::print("| table, as where there is no AVX2 | {:.2f} ns | {:.0f} % | | |\n", each("plain"),
             100 * each("loop") / each("plain"));
  fmt::print("\nA table is built and proved in {} (Pade), {} (exact law).\n", duration(times("build pade")),
             duration(times("build hertz")));

  fmt::print("\n{} starts with a mu of their own, 0.05 to 0.3:\n\n", own);
  fmt::print("| law | a start, of all | solved alone | ratio |\n|---|---|---|---|\n");
  for (const std::string& name : own_rows) {
    const double together = times(name) / static_cast<double>(own), alone = times(name + " alone");
    fmt::print("| {} | {} | {} | {:.2g} |\n", name, duration(together), duration(alone), alone / together);
  }
}
