// What the wrench of a patch costs, by law.
//   benchmark_wrench            prints the table of README.md in Markdown
#include <algorithm>
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

namespace {

using Clock = std::chrono::steady_clock;

/// ns of one call, the least of many rounds.
/// @param k  sliding over rim speed; 0: of each call its own, log-uniform in 1e-3 .. 1e3
double nanoseconds(const char* name, double k) {
  constexpr std::size_t calls = 4096;
  const contensou_patch patch{0.2, 3e-3, 1e-4};
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> ln_k(std::log(1e-3), std::log(1e3)), angle(-3, 3);
  std::vector<double> motions;
  for (std::size_t i = 0; i < calls; ++i) {
    const double ratio = k > 0 ? k : std::exp(ln_k(generator)), turn = angle(generator);
    motions.insert(motions.end(), {std::cos(turn), std::sin(turn), std::copysign(1 / ratio / patch.radius, turn)});
  }
  const std::unique_ptr<contensou_law, void (*)(contensou_law*)> law(contensou_law_new(name), contensou_law_free);
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 200; ++round) {
    const auto start = Clock::now();
    for (std::size_t i = 0; i < calls; ++i) {
      contensou_wrench wrench;
      contensou_patch_wrench(law.get(), &motions[3 * i], 1.7, &patch, &wrench);
      benchmark::DoNotOptimize(wrench);
    }
    const std::chrono::duration<double, std::nano> time = Clock::now() - start;
    least = std::min(least, time.count() / calls);
  }
  return least;
}

}  // namespace

int main() {
  fmt::print("| ns a call, with the Jacobian | k from 1e-3 to 1e3 | the slowest k |\n|---|---|---|\n");
  for (const char* name : {"elliptic", "exact", "uniform", "pade"}) {
    double worst = 0, slowest = 0;
    for (double k : {1e-3, 0.5, 0.99, 1.1, 1.26, 2.0, 7.0, 30.0, 1e3}) {
      const double time = nanoseconds(name, k);
      if (time > worst) slowest = k;
      worst = std::max(worst, time);
    }
    fmt::print("| {} | {:.0f} | {:.0f}, k = {} |\n", name, nanoseconds(name, 0), worst, slowest);
  }
}
