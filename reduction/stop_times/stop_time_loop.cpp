#include "stop_times/stop_time_loop.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;

constexpr int index_shift = std::numeric_limits<double>::digits - 1 - Panels::cut_bits;
constexpr std::uint64_t left_mask = ~std::uint64_t{0} << index_shift;

/// A stop time is ordinary from 2^-511 to 2^513: the bits of such a double, less this, begin with two zeros.
constexpr std::uint64_t least_ordinary = std::bit_cast<std::uint64_t>(0x1p-511);
constexpr std::uint64_t not_ordinary = std::uint64_t{3} << 62;

/// Only then nothing has overflowed or underflowed, and the start is one.
bool usable(double tau, double v0) {
  return ((std::bit_cast<std::uint64_t>(tau) - least_ordinary) & not_ordinary) == 0 && !std::signbit(v0);
}

/// Where a start lies.
struct Place {
  std::size_t panel;
  double t;
};
Place place(double u, double lv) {
  const double smaller = lv < u ? lv : u;
  const double distance = std::abs(lv - u);
  const double y = (distance < smaller ? distance : smaller) / (u + lv) + Panels::lowest;
  const auto bits = std::bit_cast<std::uint64_t>(y);
  const std::size_t sheet = (distance < smaller ? Panels::near_one : 0) + (lv > u ? Panels::above_one : 0);
  const auto index = static_cast<std::size_t>((bits >> index_shift) % Panels::per_sheet);
  return {sheet + index, y - std::bit_cast<double>(bits & left_mask)};
}

double one(const Panels& table, double u0, double v0) {
  const double u = std::abs(u0);
  const auto [panel, t] = place(u, table.lever * v0);
  const double* c = table.panels[panel].c;
  const double t4 = (t * t) * (t * t);
  const double m = (((c[3] + t4 * c[7]) * t + (c[2] + t4 * c[6])) * t + (c[1] + t4 * c[5])) * t + (c[0] + t4 * c[4]);
  return table.pivoting * u + v0 * m;
}

}  // namespace

std::size_t panel_of(const Panels& table, double u0, double v0) { return place(std::abs(u0), table.lever * v0).panel; }

double from_panels(const Panels& table, double u0, double v0) {
  const double tau = one(table, u0, v0);
  return usable(tau, v0) ? tau : std::numeric_limits<double>::quiet_NaN();
}

void run_plain(const Panels& table, const double* u0, const double* v0, double* tau, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const double found = one(table, u0[i], v0[i]);
    tau[i] = usable(found, v0[i]) ? found : table.otherwise(u0[i], v0[i]);
  }
}

#if defined(__x86_64__) && defined(__GNUC__)

namespace {

/// c[0] to c[3] + t4 (c[4] to c[7]) of a panel.
[[gnu::target("avx2")]] inline __m256d halved(const Panels::Panel& panel, const double* t4) {
  return _mm256_add_pd(_mm256_load_pd(panel.c), _mm256_mul_pd(_mm256_broadcast_sd(t4), _mm256_load_pd(panel.c + 4)));
}

[[gnu::target("avx2")]] inline __m256i bits(__m256d x) { return _mm256_castpd_si256(x); }

}  // namespace

/// Two steps for some vectors of starts at a time, because the way through a division and a polynomial is long and a
/// processor looks ahead by a few vectors only.
[[gnu::target("avx2")]] void run_avx2(const Panels& table, const double* u0, const double* v0, double* tau,
                                      std::size_t size) {
  constexpr std::size_t width = 4, vectors = 8, starts = width * vectors;
  constexpr std::size_t ahead = 256;  // what is asked of memory now is used so many starts later
  const __m256d lever = _mm256_set1_pd(table.lever), pivoting = _mm256_set1_pd(table.pivoting);
  const __m256d lowest = _mm256_set1_pd(Panels::lowest), sign = _mm256_set1_pd(-0.0);
  const __m256i within_sheet = _mm256_set1_epi64x(Panels::per_sheet - 1);
  const __m256i near_one = _mm256_set1_epi64x(Panels::near_one), above_one = _mm256_set1_epi64x(Panels::above_one);
  const __m256i left = _mm256_set1_epi64x(static_cast<long long>(left_mask));
  const __m256i least = _mm256_set1_epi64x(static_cast<long long>(least_ordinary));
  const __m256i excess = _mm256_set1_epi64x(static_cast<long long>(not_ordinary));
  alignas(32) std::uint64_t index[starts];
  alignas(32) double t4[starts], found[starts];
  __m256d u[vectors], v[vectors], t[vectors];
  std::size_t begin = 0;
  for (; begin + starts <= size; begin += starts) {
    for (std::size_t n = 0; n < vectors; ++n) {
      u[n] = _mm256_andnot_pd(sign, _mm256_loadu_pd(u0 + begin + n * width));
      v[n] = _mm256_loadu_pd(v0 + begin + n * width);
      const __m256d lv = _mm256_mul_pd(lever, v[n]);
      const __m256d smaller = _mm256_min_pd(lv, u[n]), distance = _mm256_andnot_pd(sign, _mm256_sub_pd(lv, u[n]));
      const __m256d numerator = _mm256_min_pd(distance, smaller);
      const __m256d y = _mm256_add_pd(_mm256_div_pd(numerator, _mm256_add_pd(u[n], lv)), lowest);
      const __m256i sheet =
          _mm256_add_epi64(_mm256_and_si256(bits(_mm256_cmp_pd(distance, smaller, _CMP_LT_OQ)), near_one),
                           _mm256_and_si256(bits(_mm256_cmp_pd(lv, u[n], _CMP_GT_OQ)), above_one));
      const __m256i of_sheet = _mm256_and_si256(_mm256_srli_epi64(bits(y), index_shift), within_sheet);
      _mm256_store_si256(reinterpret_cast<__m256i*>(index + n * width), _mm256_add_epi64(sheet, of_sheet));
      t[n] = _mm256_sub_pd(y, _mm256_castsi256_pd(_mm256_and_si256(bits(y), left)));
      const __m256d t2 = _mm256_mul_pd(t[n], t[n]);
      _mm256_store_pd(t4 + n * width, _mm256_mul_pd(t2, t2));
    }
    __m256i beyond = _mm256_setzero_si256();
    __m256d signs = _mm256_setzero_pd();
    for (std::size_t n = 0, i = 0; n < vectors; ++n, i += width) {
      const __m256d a = halved(table.panels[index[i]], t4 + i), b = halved(table.panels[index[i + 1]], t4 + i + 1);
      const __m256d c = halved(table.panels[index[i + 2]], t4 + i + 2);
      const __m256d d = halved(table.panels[index[i + 3]], t4 + i + 3);
      const __m256d ab_even = _mm256_unpacklo_pd(a, b), ab_odd = _mm256_unpackhi_pd(a, b);
      const __m256d cd_even = _mm256_unpacklo_pd(c, d), cd_odd = _mm256_unpackhi_pd(c, d);
      __m256d m = _mm256_permute2f128_pd(ab_odd, cd_odd, 0x31);
      m = _mm256_add_pd(_mm256_mul_pd(m, t[n]), _mm256_permute2f128_pd(ab_even, cd_even, 0x31));
      m = _mm256_add_pd(_mm256_mul_pd(m, t[n]), _mm256_permute2f128_pd(ab_odd, cd_odd, 0x20));
      m = _mm256_add_pd(_mm256_mul_pd(m, t[n]), _mm256_permute2f128_pd(ab_even, cd_even, 0x20));
      const __m256d result = _mm256_add_pd(_mm256_mul_pd(pivoting, u[n]), _mm256_mul_pd(v[n], m));
      beyond = _mm256_or_si256(beyond, _mm256_sub_epi64(bits(result), least));
      signs = _mm256_or_pd(signs, v[n]);
      _mm256_store_pd(found + i, result);
    }
    if (_mm256_testz_si256(beyond, excess) != 0 && _mm256_movemask_pd(signs) == 0) {
      for (std::size_t i = 0; i < starts; i += width) _mm256_storeu_pd(tau + begin + i, _mm256_load_pd(found + i));
    } else {
      for (std::size_t i = 0; i < starts; ++i) {
        const double v_i = v0[begin + i];
        tau[begin + i] = usable(found[i], v_i) ? found[i] : table.otherwise(u0[begin + i], v_i);
      }
    }
    for (std::size_t i = ahead; i < ahead + starts; i += 8) {
      __builtin_prefetch(u0 + begin + i);
      __builtin_prefetch(v0 + begin + i);
      __builtin_prefetch(tau + begin + i, 1);
    }
  }
  run_plain(table, u0 + begin, v0 + begin, tau + begin, size - begin);
}

StopTimeLoop& run_fastest() { return __builtin_cpu_supports("avx2") ? run_avx2 : run_plain; }

#else

StopTimeLoop& run_fastest() { return run_plain; }

#endif

}  // namespace contensou::reduction
