// The cost of the wrench of a patch, for each law, through the C interface and through the header alone.
//   benchmark_wrench            prints the table of README.md in Markdown
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "contensou/wrench.h"
#include "contensou/wrench_kernel.h"

namespace {

using Clock = std::chrono::steady_clock;
using namespace contensou;

constexpr contensou_patch patch{0.2, 3e-3, 1e-4};
constexpr double load = 1.7;

/// Returns the time of one call in ns, the least of many rounds.
/// @param k     sliding speed divided by rim speed; 0: each call has another k, log-uniform in 1e-3 .. 1e3
/// @param call  function of vx, vy and omega
template <class T, class Call>
double nanoseconds(double k, const Call& call) {
  constexpr std::size_t calls = 4096;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> ln_k(std::log(1e-3), std::log(1e3)), angle(-3, 3);
  std::vector<std::array<T, 3>> motions;
  for (std::size_t i = 0; i < calls; ++i) {
    const double ratio = k > 0 ? k : std::exp(ln_k(generator)), turn = angle(generator);
    motions.push_back({static_cast<T>(std::cos(turn)), static_cast<T>(std::sin(turn)),
                       static_cast<T>(std::copysign(1 / ratio / patch.radius, turn))});
  }
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 200; ++round) {
    const auto start = Clock::now();
    for (const auto& motion : motions) {
      auto wrench = call(motion);
      benchmark::DoNotOptimize(wrench);
    }
    const std::chrono::duration<double, std::nano> time = Clock::now() - start;
    least = std::min(least, time.count() / calls);
  }
  return least;
}

/// Prints a cell of the table: the time in ns of a call with random k, and with the slowest k.
template <class T, class Call>
void cell(const Call& call) {
  double slowest = 0;
  for (double k : {1e-3, 0.5, 0.99, 1.1, 1.26, 2.0, 7.0, 30.0, 1e3})
    slowest = std::max(slowest, nanoseconds<T>(k, call));
  fmt::print(" {:.0f}, {:.0f} |", nanoseconds<T>(0, call), slowest);
}

/// Prints the cells for the header: force and moment in double and in float, with their derivatives in double, and a
/// step of 1/60 s of a pool ball.
template <class Law>
void kernel_cells() {
  const auto values = [](const auto& at) {
    using T = std::decay_t<decltype(at[0])>;
    return kernel::wrench<Law>(at[0], at[1], at[2], T(patch.friction * load), T(patch.radius), T(patch.creep));
  };
  cell<double>(values);
  cell<float>(values);
  cell<double>([](const auto& at) {
    return kernel::wrench_slopes<Law>(at[0], at[1], at[2], patch.friction * load, patch.radius, patch.creep);
  });
  cell<double>([](const auto& at) {
    constexpr double mass = 0.17, radius = 0.0285;
    return kernel::step<Law>(at[0], at[1], at[2], 3.5 / mass, 2.5 / (mass * radius * radius), patch.friction * load,
                             patch.radius, 1.0 / 60);
  });
}

}  // namespace

int main() {
  fmt::print(
      "| ns of a call | header | header, float | header, slopes | header, step | C interface, slopes |\n"
      "|---|---|---|---|---|---|\n");
  for (const std::string name : {"pade", "elliptic", "exact", "uniform", "punch"}) {
    fmt::print("| {} |", name);
    if (name == "pade") kernel_cells<kernel::Pade>();
    if (name == "elliptic") kernel_cells<kernel::Elliptic>();
    if (name == "exact") kernel_cells<kernel::Exact>();
    if (name == "uniform") kernel_cells<kernel::Uniform>();
    if (name == "punch") fmt::print(" - | - | - | - |");
    const std::unique_ptr<contensou_law, void (*)(contensou_law*)> law(contensou_law_new(name.c_str()),
                                                                       contensou_law_free);
    cell<double>([&](const auto& motion) {
      contensou_wrench wrench;
      contensou_patch_wrench(law.get(), motion.data(), load, &patch, &wrench);
      return wrench;
    });
    fmt::print("\n");
  }
}
