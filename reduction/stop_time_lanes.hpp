// The loop of StopTimeProfile, once for all instruction sets: a translation unit that includes this has defined, in
// namespace contensou::reduction and there without a name,
//   width                         doubles in a vector
//   Vector, Bits                  of so many doubles and unsigned 64-bit integers
//   Vector magnitude(x)           its absolute value
//   Vector fused(a, b, c)         a b + c
//   bool any_negative(Bits)       whether the first bit of any lane is set
//   Pairs pairs(panels, t)        the polynomial of each lane in two halves, in whatever order they come about
//   Halves halves(Pairs)          in that of the lanes: low, the sum of c_n t^n over n = 0..3, and high, of c_(n+4) t^n
//   void stream(double*, Vector)  to an aligned address, past the caches; void streamed() ends a run of them
// Nothing from the standard library is called: an inline function compiled here for a larger instruction set could be
// the one that the linker keeps for everybody.
#pragma once

#include <cstddef>
#include <cstdint>

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
inline Bits bits(Vector x) { return reinterpret_cast<Bits>(x); }

struct Scales {
  Vector pivoting, sliding, lever, lowest;
  Bits sheets[4];  ///< the addresses of their first panels, less the panel bits of lowest
  static constexpr int panel_shift = StopTimePanels::mantissa_bits - 6;  ///< panels have 2^6 bytes
  static constexpr std::size_t sheet_size = StopTimePanels::per_sheet * sizeof(StopTimePanels::Panel);

  explicit Scales(const StopTimeTable& table)
      : pivoting(every(table.pivoting)),
        sliding(every(table.sliding)),
        lever(every(table.lever)),
        lowest(every(StopTimePanels::lowest)) {
    const auto lowest_panel = bits(lowest) >> panel_shift;
    for (std::size_t i = 0; i < 4; ++i) {
      sheets[i] = Bits{} + (reinterpret_cast<std::uintptr_t>(table.panels) + i * sheet_size) - lowest_panel;
    }
  }
};

/// Where starts lie: y, and on which sheet.
struct Fractions {
  Vector y;
  Bits sheet;
};

/// Starts on the way to their stop times: four steps, because the way through a division and a polynomial is long and a
/// processor looks ahead by a few vectors only.
class Block {
 public:
  static constexpr std::size_t size = 128;

  /// @param odd  becomes negative in the lanes that need care: v0 is, or P + S is not ordinary
  template <bool one_sheet>
  Fractions divide(const Scales& scales, Vector u0, Vector v, std::size_t i, Bits& odd) {
    const Vector u = magnitude(u0);
    // Not fused, so that it is the same everywhere.
    const Vector sum = scales.pivoting * u + scales.sliding * v;
    store(sum_ + i, sum);
    odd |= (last_ordinary - (bits(sum) << 1)) | bits(v);
    if constexpr (one_sheet) {
      return {u / fused(scales.lever, v, u), scales.sheets[0]};
    } else {
      const Vector levered = scales.lever * v;
      const Vector smaller = levered < u ? levered : u;
      const Vector distance = magnitude(levered - u);
      const auto near = distance < smaller;
      const auto above = levered > u;
      const Bits beside_one = above ? scales.sheets[Panels::above_one] : scales.sheets[Panels::below_one];
      const Bits beyond = above ? scales.sheets[Panels::fast] : scales.sheets[Panels::slow];
      return {(near ? distance : smaller) / (levered + u), near ? beside_one : beyond};
    }
  }

  /// y must not be beyond [0, 1]: it tells an address.
  void place(const Scales& scales, const Fractions& at, std::size_t i) {
    const Vector y = at.y + scales.lowest;
    const Bits left = bits(y) & ~0ULL << Panels::mantissa_bits;
    const Vector t = y - reinterpret_cast<Vector>(left);
    const Bits panel = (left >> Scales::panel_shift) + at.sheet;
    store(t_ + i, t);
    __builtin_memcpy(panel_ + i, &panel, sizeof panel);
  }

  Pairs polynomials(std::size_t i) const {
    const double* panels[width];
    for (int lane = 0; lane < width; ++lane) panels[lane] = reinterpret_cast<const double*>(panel_[i + lane]);
    return pairs(panels, t_ + i);
  }

  Vector finish(const Pairs& polynomials, std::size_t i) const {
    const Vector sum = load(sum_ + i), t = load(t_ + i);
    const Halves g = halves(polynomials);
    return fused(sum, fused(g.high, (t * t) * (t * t), g.low), sum);
  }

 private:
  using Panels = StopTimePanels;
  /// Without a sign, which v has already told: what is larger, and what is less by half of all exponents, is off.
  static constexpr auto last_ordinary = (__builtin_bit_cast(unsigned long long, StopTimeTable::ordinary_below) - 1)
                                        << 1;
  static_assert(sizeof(Panels::Panel) == 64);

  alignas(64) double sum_[size];
  alignas(64) double t_[size];             ///< y - left edge of the panel
  alignas(64) std::uint64_t panel_[size];  ///< its address
};

/// A few starts, or some that need care.
template <bool one_sheet>
[[gnu::noinline]] void run_few(const StopTimeTable& table, const double* u0, const double* v0, std::size_t v0_step,
                               double* tau, std::size_t count) {
  Block block;
  const Scales scales(table);
  for (std::size_t i = 0; i < count; i += width) {
    Vector some_u0 = every(1), some_v0 = every(1);
    const std::size_t lanes = count - i < width ? count - i : width;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      some_u0[lane] = u0[i + lane];
      some_v0[lane] = v0[(i + lane) * v0_step];
    }
    Bits odd{};
    Fractions fractions = block.divide<one_sheet>(scales, some_u0, some_v0, 0, odd);
    for (int lane = 0; lane < width; ++lane) {
      if (odd[lane] >> 63 != 0) fractions.y[lane] = 1;  // any y that there is a panel for
    }
    block.place(scales, fractions, 0);
    const Vector some_tau = block.finish(block.polynomials(0), 0);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      tau[i + lane] = odd[lane] >> 63 == 0 ? some_tau[lane] : table.careful(some_u0[lane], some_v0[lane]);
    }
  }
}

/// In doubles.
constexpr std::size_t cache_line = 8;
constexpr std::size_t page = 512;

template <bool one_sheet, bool row, bool streaming>
void run_blocks(const StopTimeTable& table, const StopTimeJob& job) {
  const Scales scales(table);
  const double* const u0 = job.u0;
  const double* const v0 = job.v0;
  double* const tau = job.tau;
  const Vector row_v0 = every(*v0);
  const auto divide = [=](Block& block, std::size_t begin, std::size_t i, Bits& odd) {
    return block.divide<one_sheet>(scales, load(u0 + begin + i), row ? row_v0 : load(v0 + begin + i), i, odd);
  };
  const auto finish = [=](const Block& block, const Pairs& polynomials, std::size_t begin, std::size_t i) {
    const Vector result = block.finish(polynomials, i);
    streaming ? stream(tau + begin + i, result) : store(tau + begin + i, result);
  };
  const auto few = [&](std::size_t begin, std::size_t count) {
    run_few<one_sheet>(table, u0 + begin, v0 + begin * job.v0_step, job.v0_step, tau + begin, count);
  };

  std::size_t begin = 0;
  if (streaming) {
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(job.tau) % sizeof(Vector) / sizeof(double);
    if (beyond != 0) begin = width - beyond < job.size ? width - beyond : job.size;
    few(0, begin);
  }
  Block blocks[2];
  Bits odd{};
  bool ahead = false;  // the block that begins here is placed
  for (int turn = 0; begin + Block::size <= job.size; begin += Block::size, turn = 1 - turn) {
    Block& block = blocks[turn];
    if (!ahead) {
      odd = Bits{};
      for (std::size_t i = 0; i < Block::size; i += width) {
        block.place(scales, divide(block, begin, i, odd), i);
      }
    }
    if (any_negative(odd)) {
      few(begin, Block::size);
      ahead = false;
      continue;
    }
    const std::size_t next = begin + Block::size;
    ahead = next + Block::size <= job.size;
    if (!ahead) {
      for (std::size_t i = 0; i < Block::size; i += width) finish(block, block.polynomials(i), begin, i);
      continue;
    }

    if (streaming && begin % page < Block::size && begin + 2 * page <= job.size) {
      // To find a page of memory takes long: it is asked for while the page before is in use.
      const std::size_t next_page = begin + page + page / 2;
      __builtin_prefetch(u0 + next_page);
      if (!row) __builtin_prefetch(v0 + next_page);
      __builtin_prefetch(tau + next_page, 1);
    }
    const std::size_t coming = next + 2 * Block::size <= job.size ? next + Block::size : next;

    // This block goes through its last two steps and the next one through its first two, every second step a cache line
    // behind the first; what lies between is in registers.
    Block& other = blocks[1 - turn];
    constexpr std::size_t vectors = cache_line / width;
    Fractions fractions[vectors];
    Pairs polynomials[vectors];
    odd = Bits{};
    for (std::size_t n = 0; n < vectors; ++n) {
      polynomials[n] = block.polynomials(n * width);
      fractions[n] = divide(other, next, n * width, odd);
    }
    std::size_t line = 0;
    for (; line + cache_line < Block::size; line += cache_line) {
      if (streaming) {
        __builtin_prefetch(u0 + coming + line);
        if (!row) __builtin_prefetch(v0 + coming + line);
      }
      for (std::size_t n = 0; n < vectors; ++n) {
        const std::size_t i = line + n * width;
        finish(block, polynomials[n], begin, i);
        polynomials[n] = block.polynomials(i + cache_line);
        other.place(scales, fractions[n], i);
        fractions[n] = divide(other, next, i + cache_line, odd);
      }
    }
    for (std::size_t n = 0; n < vectors; ++n) {
      finish(block, polynomials[n], begin, line + n * width);
      other.place(scales, fractions[n], line + n * width);
    }
  }
  few(begin, job.size - begin);
  if (streaming) streamed();
}

template <bool one_sheet>
void run_sheets(const StopTimeTable& table, const StopTimeJob& job) {
  if (job.v0_step == 0) {
    job.streaming ? run_blocks<one_sheet, true, true>(table, job) : run_blocks<one_sheet, true, false>(table, job);
  } else {
    job.streaming ? run_blocks<one_sheet, false, true>(table, job) : run_blocks<one_sheet, false, false>(table, job);
  }
}

inline void run(const StopTimeTable& table, const StopTimeJob& job) {
  if (job.size == 0) return;
  table.one_sheet ? run_sheets<true>(table, job) : run_sheets<false>(table, job);
}

}  // namespace
}  // namespace contensou::reduction
