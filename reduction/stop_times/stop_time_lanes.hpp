// The loop of StopTimeProfile, once for all instruction sets: a translation unit that includes this has defined, in
// namespace contensou::reduction and there without a name,
//   width                         doubles in a vector
//   Vector, Bits                  of so many doubles and unsigned 64-bit integers
//   Vector magnitude(x)           its absolute value
//   Vector fused(a, b, c)         a b + c, rounded once, so that bits are the same everywhere
//   bool any_negative(Bits)       whether the first bit of any lane is set
//   Pairs pairs(panels, t)        the polynomial of each lane in two halves, in whatever order they come about
//   Halves halves(Pairs)          in that of the lanes: low, the sum of c_n t^n over n = 0..3, and high, of c_(n+4) t^n
//   void stream(double*, Vector)  to an aligned address, past the caches; void streamed() ends a run of them
// Nothing from the standard library is called: an inline function compiled here for a larger instruction set could be
// the one that the linker keeps for everybody.
#pragma once

#include <cstddef>
#include <cstdint>

#include "stop_times/stop_time_kernel.hpp"

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
  Vector lever, lowest;
  Bits sheets[4];  ///< the addresses of their first panels, less the panel bits of lowest
  static constexpr int panel_shift = StopTimePanels::mantissa_bits - 6;  ///< panels have 2^6 bytes
  static constexpr std::size_t sheet_size = StopTimePanels::per_sheet * sizeof(StopTimePanels::Panel);

  explicit Scales(const StopTimeTable& table) : lever(every(table.lever)), lowest(every(StopTimePanels::lowest)) {
    const auto lowest_panel = bits(lowest) >> panel_shift;
    for (std::size_t i = 0; i < 4; ++i) {
      sheets[i] = Bits{} + (reinterpret_cast<std::uintptr_t>(table.panels) + i * sheet_size) - lowest_panel;
    }
  }
};

/// Of some starts, which need care: those whose v0 is negative, or whose D is not ordinary.
class Care {
 public:
  void look_at(Vector v, Vector total) {
    signs_ |= bits(v);
    ordinary_ &= bits(total) + raise;
  }

  /// The first bit of each lane.
  Bits needed() const { return signs_ | ~ordinary_ << 1; }

 private:
  /// Half of all exponents are ordinary: raised by this, they have the bit after the sign and the others have not.
  static constexpr std::uint64_t raise =
      (std::uint64_t{1} << 63) - __builtin_bit_cast(std::uint64_t, StopTimeTable::ordinary_below);

  Bits signs_{};
  Bits ordinary_ = ~Bits{};
};

/// Where starts lie: y, and on which sheet.
struct Fractions {
  Vector y;
  Bits sheet;
};

constexpr std::size_t cache_line = 8;  ///< in doubles

/// Starts on the way to their stop times, a cache line of each array. There are four steps, because the way through a
/// division and a polynomial is long and a processor looks ahead by a few vectors only.
class Line {
 public:
  template <bool one_sheet>
  Fractions divide(const Scales& scales, Vector u0, Vector v, std::size_t i, Care& care) {
    const Vector u = magnitude(u0);
    const Vector total = fused(scales.lever, v, u);
    store(total_ + i, total);
    care.look_at(v, total);
    if constexpr (one_sheet) {
      return {u / total, scales.sheets[0]};
    } else {
      const Vector levered = scales.lever * v;
      const Vector smaller = levered < u ? levered : u;
      const Vector distance = magnitude(fused(scales.lever, v, -u));
      const auto near = distance < smaller;
      const auto above = levered > u;
      const Bits beside_one = above ? scales.sheets[Panels::above_one] : scales.sheets[Panels::below_one];
      const Bits beyond = above ? scales.sheets[Panels::fast] : scales.sheets[Panels::slow];
      return {(near ? distance : smaller) / total, near ? beside_one : beyond};
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
    for (std::size_t lane = 0; lane < width; ++lane) panels[lane] = reinterpret_cast<const double*>(panel_[i + lane]);
    return pairs(panels, t_ + i);
  }

  Vector finish(const Pairs& polynomials, std::size_t i) const {
    const Vector t = load(t_ + i);
    const Halves g = halves(polynomials);
    return load(total_ + i) * fused(g.high, (t * t) * (t * t), g.low);
  }

 private:
  using Panels = StopTimePanels;
  static_assert(sizeof(Panels::Panel) == 64);

  alignas(64) double total_[cache_line];  ///< D
  double t_[cache_line];                  ///< y - left edge of the panel
  std::uint64_t panel_[cache_line];       ///< its address
};

/// A few starts, or some that need care.
template <bool one_sheet>
[[gnu::noinline]] void run_few(const StopTimeTable& table, const double* u0, const double* v0, std::size_t v0_step,
                               double* tau, std::size_t count) {
  Line line;
  const Scales scales(table);
  for (std::size_t i = 0; i < count; i += width) {
    const std::size_t lanes = count - i < width ? count - i : width;
    Vector some_u0 = every(u0[i]), some_v0 = every(v0[i * v0_step]);
    for (std::size_t lane = 1; lane < lanes; ++lane) {
      some_u0[lane] = u0[i + lane];
      some_v0[lane] = v0[(i + lane) * v0_step];
    }
    Care care;
    Fractions fractions = line.divide<one_sheet>(scales, some_u0, some_v0, 0, care);
    const Bits odd = care.needed();
    if (any_negative(odd)) {
      for (int lane = 0; lane < width; ++lane) {
        if (odd[lane] >> 63 != 0) fractions.y[lane] = 1;  // any y that there is a panel for
      }
    }
    line.place(scales, fractions, 0);
    const Vector some_tau = line.finish(line.polynomials(0), 0);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      tau[i + lane] = odd[lane] >> 63 == 0 ? some_tau[lane] : table.careful(some_u0[lane], some_v0[lane]);
    }
  }
}

/// Starts that are looked at together: if one needs care, they all take the slow way.
struct Block {
  static constexpr std::size_t lines = 16;
  static constexpr std::size_t size = lines * cache_line;
  Line line[lines];
};

constexpr std::size_t page = 512;  ///< in doubles

template <bool one_sheet, bool row, bool streaming>
void run_blocks(const StopTimeTable& table, const StopTimeJob& job) {
  const Scales scales(table);
  const double* const u0 = job.u0;
  const double* const v0 = job.v0;
  double* const tau = job.tau;
  const Vector row_v0 = every(*v0);
  const auto few = [&](std::size_t begin, std::size_t count) {
    run_few<one_sheet>(table, u0 + begin, v0 + begin * job.v0_step, job.v0_step, tau + begin, count);
  };

  std::size_t begin = 0;
  if (streaming) {
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(job.tau) % sizeof(Vector) / sizeof(double);
    if (beyond != 0) begin = width - beyond < job.size ? width - beyond : job.size;
    few(0, begin);
  }

  // What lies between two steps is in registers.
  constexpr std::size_t vectors = cache_line / width;
  struct Divided {
    Fractions of[vectors];
  };
  struct Evaluated {
    Pairs of[vectors];
  };
  Care care;
  const auto divide = [&](Line& line, std::size_t at) {
    Divided divided;
    for (std::size_t n = 0, i = 0; n < vectors; ++n, i += width) {
      divided.of[n] = line.divide<one_sheet>(scales, load(u0 + at + i), row ? row_v0 : load(v0 + at + i), i, care);
    }
    return divided;
  };
  const auto place = [&](Line& line, const Divided& divided) {
    for (std::size_t n = 0; n < vectors; ++n) line.place(scales, divided.of[n], n * width);
  };
  const auto evaluate = [](const Line& line) {
    Evaluated evaluated;
    for (std::size_t n = 0; n < vectors; ++n) evaluated.of[n] = line.polynomials(n * width);
    return evaluated;
  };
  const auto finish = [=](const Line& line, const Evaluated& evaluated, std::size_t at) {
    for (std::size_t n = 0, i = 0; n < vectors; ++n, i += width) {
      const Vector result = line.finish(evaluated.of[n], i);
      streaming ? stream(tau + at + i, result) : store(tau + at + i, result);
    }
  };

  Block blocks[2];
  bool ahead = false;  // the block that begins here is placed
  for (int turn = 0; begin + Block::size <= job.size; begin += Block::size, turn = 1 - turn) {
    Line* line = blocks[turn].line;
    if (!ahead) {
      care = Care{};
      for (std::size_t i = 0; i < Block::lines; ++i) place(line[i], divide(line[i], begin + i * cache_line));
    }
    if (any_negative(care.needed())) {
      few(begin, Block::size);
      ahead = false;
      continue;
    }
    const std::size_t next = begin + Block::size;
    ahead = next + Block::size <= job.size;
    if (!ahead) {
      for (std::size_t i = 0; i < Block::lines; ++i) finish(line[i], evaluate(line[i]), begin + i * cache_line);
      continue;
    }

    if (streaming && begin % page < Block::size && begin + 2 * page <= job.size) {
      // To find a page of memory takes long: it is asked for while the page before is in use, and for what is written
      // at another place in it than for what is read, because like places get into each other's way.
      const std::size_t next_page = begin + page + page / 2;
      __builtin_prefetch(u0 + next_page + Block::size);
      if (!row) __builtin_prefetch(v0 + next_page + Block::size);
      __builtin_prefetch(tau + next_page, 1);
    }
    const std::size_t coming = next + 3 * Block::size <= job.size ? 2 * Block::size : 0;

    // This block goes through its last two steps and the next one through its first two, every second step a line
    // behind the first.
    Line* other = blocks[1 - turn].line;
    care = Care{};
    std::size_t at = begin;
    Divided divided = divide(*other, at + Block::size);
    Evaluated evaluated = evaluate(*line);
    for (std::size_t i = 1; i < Block::lines; ++i) {
      if (streaming) {
        __builtin_prefetch(u0 + at + Block::size + coming);
        if (!row) __builtin_prefetch(v0 + at + Block::size + coming);
      }
      place(*other, divided);
      finish(*line, evaluated, at);
      at += cache_line;
      divided = divide(*++other, at + Block::size);
      evaluated = evaluate(*++line);
    }
    place(*other, divided);
    finish(*line, evaluated, at);
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
  if (job.size < Block::size) {
    (table.one_sheet ? run_few<true> : run_few<false>)(table, job.u0, job.v0, job.v0_step, job.tau, job.size);
  } else {
    table.one_sheet ? run_sheets<true>(table, job) : run_sheets<false>(table, job);
  }
}

}  // namespace
}  // namespace contensou::reduction
