// The loop of StopTimeProfile, once for all instruction sets: a translation unit that includes this has defined, in
// namespace contensou::reduction and there without a name,
//   width             doubles in a vector
//   Vector, Integers  of so many doubles and 64-bit integers
//   Columns transposed(const Pair (&)[width])  the first and the second number of each pair, lane by lane
//   Vector fused(a, b, c)         a b + c
//   bool all(Integers mask)       for masks of 0 and -1
//   void stream(double*, Vector)  to an aligned address, past the caches; void streamed() ends a run of them
// Nothing from the standard library is called: an inline function compiled here for a larger instruction set could be
// the one that the linker keeps for everybody.
#pragma once

#include <cstddef>

#include "stop_time_kernel.hpp"

namespace contensou::reduction {
namespace {

inline Vector load(const double* from) {
  Vector vector;
  __builtin_memcpy(&vector, from, sizeof vector);
  return vector;
}

inline void store(double* to, Vector vector) { __builtin_memcpy(to, &vector, sizeof vector); }

inline Vector every(double value) { return value - Vector{}; }
inline Vector magnitude(Vector x) {
  constexpr long long all_but_sign = 0x7fffffffffffffff;
  return reinterpret_cast<Vector>(reinterpret_cast<Integers>(x) & all_but_sign);
}

template <bool one_sheet>
inline Vector stop_times(const StopTimeTable& table, Vector u0, Vector v0) {
  using Panels = StopTimePanels;
  const Vector u = magnitude(u0);
  const Vector v = magnitude(v0);
  // Products and sums that would move the argument or the sum by a bit are not fused: they are the same everywhere.
  const Vector sum = table.pivoting * u + table.sliding * v;
  const Vector w = table.rim * u;

  Vector numerator = w;
  Integers sheet{};
  if constexpr (!one_sheet) {
    const Vector smaller = v < w ? v : w;
    const Vector distance = magnitude(v - w);
    const Integers near = distance < smaller;
    numerator = near ? distance : smaller;
    const Integers above = v > w;
    const auto start = [](Panels::Sheet s) { return Integers{} + s * Panels::per_sheet * sizeof(Panels::Panel); };
    sheet = near ? (above ? start(Panels::above_one) : start(Panels::below_one))
                 : (above ? start(Panels::fast) : start(Panels::slow));
  }
  Vector y = numerator / (v + w);
  y = y > Panels::lowest ? y : every(Panels::lowest);  // and so for NaN

  constexpr long long half_panel = 1LL << (Panels::mantissa_bits - 1);
  constexpr long long first = static_cast<long long>(__builtin_bit_cast(unsigned long long, Panels::lowest));
  const Integers bits = reinterpret_cast<Integers>(y);
  const Integers offsets =
      ((bits - first) >> Panels::mantissa_bits) * static_cast<long long>(sizeof(Panels::Panel)) + sheet;
  const Vector t = y - reinterpret_cast<Vector>((bits & -(2 * half_panel)) | half_panel);

  const char* panels = reinterpret_cast<const char*>(table.panels);
  Vector g = every(0);
  for (int n = Panels::terms; (n -= 2) >= 0;) {
    Pair pairs[width];
    for (int lane = 0; lane < width; ++lane) {
      pairs[lane] = *reinterpret_cast<const Pair*>(panels + offsets[lane] + n * static_cast<int>(sizeof(double)));
    }
    const auto [even, odd] = transposed(pairs);
    g = fused(fused(g, t, odd), t, even);
  }
  Vector tau = fused(sum, g, sum);

  const Integers ordinary = (sum > table.least_ordinary) & (sum < table.most_ordinary) & (v0 >= 0);
  if (!all(ordinary)) {
    for (int lane = 0; lane < width; ++lane) {
      if (!ordinary[lane]) tau[lane] = table.careful(u0[lane], v0[lane]);
    }
  }
  return tau;
}

template <bool one_sheet, bool row>
void run_lanes(const StopTimeTable& table, const StopTimeJob& job) {
  const Vector row_v0 = every(*job.v0);
  const auto at = [&](std::size_t i) {
    return stop_times<one_sheet>(table, load(job.u0 + i), row ? row_v0 : load(job.v0 + i));
  };
  const auto fewer_at = [&](std::size_t i, std::size_t count) {
    Vector u0 = every(1);
    Vector v0 = row ? row_v0 : every(1);
    for (std::size_t lane = 0; lane < count; ++lane) {
      u0[lane] = job.u0[i + lane];
      if (!row) v0[lane] = job.v0[i + lane];
    }
    const Vector tau = stop_times<one_sheet>(table, u0, v0);
    for (std::size_t lane = 0; lane < count; ++lane) job.tau[i + lane] = tau[lane];
  };

  std::size_t i = 0;
  if (job.streaming) {
    constexpr std::size_t alignment = sizeof(Vector);
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(job.tau) % alignment / sizeof(double);
    const std::size_t head = beyond == 0 ? 0 : width - beyond;
    if (head > 0 && head < job.size) {
      fewer_at(0, head);
      i = head;
    }
    for (; i + width <= job.size; i += width) stream(job.tau + i, at(i));
    streamed();
  } else {
    for (; i + width <= job.size; i += width) store(job.tau + i, at(i));
  }
  if (i < job.size) fewer_at(i, job.size - i);
}

inline void run(const StopTimeTable& table, const StopTimeJob& job) {
  if (job.size == 0) return;
  if (table.one_sheet) {
    job.v0_step == 0 ? run_lanes<true, true>(table, job) : run_lanes<true, false>(table, job);
  } else {
    job.v0_step == 0 ? run_lanes<false, true>(table, job) : run_lanes<false, false>(table, job);
  }
}

}  // namespace
}  // namespace contensou::reduction
