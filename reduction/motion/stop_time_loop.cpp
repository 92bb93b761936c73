#include "motion/stop_time_loop.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;

constexpr int index_shift = std::numeric_limits<double>::digits - 1 - Panels::cut_bits;
constexpr std::uint64_t left_mask = ~std::uint64_t{0} << index_shift;

/// Usable stop times lie from 2^-511 to 2^513. The bits of such a double minus min_ordinary begin with two zeros.
constexpr std::uint64_t min_ordinary = std::bit_cast<std::uint64_t>(0x1p-511);
constexpr std::uint64_t not_ordinary = std::uint64_t{3} << 62;

/// Returns true if nothing overflowed or underflowed and v0 >= 0.
bool usable(double tau, double v0) {
  return ((std::bit_cast<std::uint64_t>(tau) - min_ordinary) & not_ordinary) == 0 && !std::signbit(v0);
}

/// The panel of a start, and the distance of the start from the left edge of the panel, in y + lowest.
struct PlaceInPanels {
  std::size_t panel;
  double t;
};

PlaceInPanels place(double u, double v_mu) {
  const double smaller = v_mu < u ? v_mu : u;
  const double distance = std::abs(v_mu - u);
  const double y = (distance < smaller ? distance : smaller) / (u + v_mu) + Panels::lowest;
  const auto bits = std::bit_cast<std::uint64_t>(y);
  const std::size_t branch = (distance < smaller ? Panels::near_one : 0) + (v_mu > u ? Panels::above_one : 0);
  const auto index = static_cast<std::size_t>((bits >> index_shift) % Panels::per_branch);
  return {branch + index, y - std::bit_cast<double>(bits & left_mask)};
}

double one(const Panels& table, double u0, double v0) {
  const double u = std::abs(u0);
  const auto [panel, t] = place(u, table.inverse_mu * v0);
  const double* c = table.panels[panel].c;
  const double t4 = (t * t) * (t * t);
  const double m = (((c[3] + t4 * c[7]) * t + (c[2] + t4 * c[6])) * t + (c[1] + t4 * c[5])) * t + (c[0] + t4 * c[4]);
  return table.pivoting * u + v0 * m;
}

}  // namespace

std::size_t panel_of(const Panels& table, double u0, double v0) {
  return place(std::abs(u0), table.inverse_mu * v0).panel;
}

double from_panels(const Panels& table, double u0, double v0) {
  const double tau = one(table, u0, v0);
  return usable(tau, v0) ? tau : std::numeric_limits<double>::quiet_NaN();
}

namespace {

constexpr std::size_t width = 4;
using Numbers [[gnu::vector_size(width * sizeof(double))]] = double;
using Bits [[gnu::vector_size(width * sizeof(double))]] = std::uint64_t;

// Types of vectors that are stored in an array at any address.
using StoredNumbers [[gnu::vector_size(width * sizeof(double)), gnu::may_alias, gnu::aligned(8)]] = double;
using StoredBits [[gnu::vector_size(width * sizeof(double)), gnu::may_alias, gnu::aligned(8)]] = std::uint64_t;
const StoredNumbers* at(const double* first) { return reinterpret_cast<const StoredNumbers*>(first); }
StoredNumbers* at(double* first) { return reinterpret_cast<StoredNumbers*>(first); }
StoredBits* at(std::uint64_t* first) { return reinterpret_cast<StoredBits*>(first); }

/// The loop for every instruction set. It is inlined into functions that are each compiled for one set. It handles
/// several vectors at a time in two steps: a division and a polynomial are a long chain of operations, and a processor
/// looks ahead by few vectors only.
[[gnu::always_inline]] inline void run(const Panels& table, const double* u0, const double* v0, double* tau,
                                       std::size_t size) {
  constexpr std::size_t vectors = 8, starts = width * vectors;
  constexpr std::size_t ahead = 256;  // memory is fetched this number of starts in advance
  constexpr std::uint64_t magnitude = ~std::uint64_t{0} >> 1;
  std::array<Numbers, vectors> u, v, t;
  std::array<double, starts> t4, found;
  std::array<std::uint64_t, starts> index;
  std::size_t begin = 0;
  for (; begin + starts <= size; begin += starts) {
    for (std::size_t n = 0, i = 0; n < vectors; ++n, i += width) {
      u[n] = Numbers(Bits(*at(&u0[begin + i])) & magnitude);
      v[n] = *at(&v0[begin + i]);
      const Numbers v_mu = table.inverse_mu * v[n];
      const Numbers smaller = v_mu < u[n] ? v_mu : u[n], distance = Numbers(Bits(v_mu - u[n]) & magnitude);
      const Numbers y = (distance < smaller ? distance : smaller) / (u[n] + v_mu) + Panels::lowest;
      const Bits branch = (Bits(distance < smaller) & Panels::near_one) + (Bits(v_mu > u[n]) & Panels::above_one);
      *at(&index[i]) = branch + ((Bits(y) >> index_shift) & (Panels::per_branch - 1));
      t[n] = y - Numbers(Bits(y) & left_mask);
      *at(&t4[i]) = (t[n] * t[n]) * (t[n] * t[n]);
    }
    Bits unusable{};
    for (std::size_t n = 0, i = 0; n < vectors; ++n, i += width) {
      Numbers row[width];  // c[0] to c[3] + t^4 (c[4] to c[7]) of each start
      for (std::size_t j = 0; j < width; ++j) {
        const double* c = table.panels[index[i + j]].c;
        row[j] = *at(&c[0]) + t4[i + j] * *at(&c[width]);
      }
      const Numbers even01 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
      const Numbers even23 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
      const Numbers odd01 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
      const Numbers odd23 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
      Numbers m = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
      m = m * t[n] + __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
      m = m * t[n] + __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
      m = m * t[n] + __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
      const Numbers result = table.pivoting * u[n] + v[n] * m;
      unusable |= ((Bits(result) - min_ordinary) & not_ordinary) | (Bits(v[n]) & ~magnitude);
      *at(&found[i]) = result;
    }
    if ((unusable[0] | unusable[1] | unusable[2] | unusable[3]) == 0) {
      for (std::size_t i = 0; i < starts; i += width) *at(&tau[begin + i]) = *at(&found[i]);
    } else {
      for (std::size_t i = 0; i < starts; ++i) {
        const double v_i = v0[begin + i];
        tau[begin + i] = usable(found[i], v_i) ? found[i] : table.otherwise(u0[begin + i], v_i);
      }
    }
    for (std::size_t i = ahead; i < ahead + starts; i += 8) {
      __builtin_prefetch(&u0[begin + i]);
      __builtin_prefetch(&v0[begin + i]);
      __builtin_prefetch(&tau[begin + i], 1);
    }
  }
  for (; begin < size; ++begin) {
    const double result = one(table, u0[begin], v0[begin]);
    tau[begin] = usable(result, v0[begin]) ? result : table.otherwise(u0[begin], v0[begin]);
  }
}

}  // namespace

void run_plain(const Panels& table, const double* u0, const double* v0, double* tau, std::size_t size) {
  run(table, u0, v0, tau, size);
}

#ifdef __x86_64__

[[gnu::target("avx2")]] void run_avx2(const Panels& table, const double* u0, const double* v0, double* tau,
                                      std::size_t size) {
  run(table, u0, v0, tau, size);
}

StopTimeLoop& run_fastest() { return __builtin_cpu_supports("avx2") ? run_avx2 : run_plain; }

#else

StopTimeLoop& run_fastest() { return run_plain; }

#endif

}  // namespace contensou::reduction
