#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace contensou::reduction {

/// What StopTimeProfile has in common with its kernels, one translation unit for each instruction set.
///
/// A fraction y in [0, 1] says where a start lies; the exponent of y and `cut_bits` bits of its mantissa say which
/// panel holds G = tau*/D there, D = |u0| + lever v0. Two maps from k to y:
///   - one sheet:    y = |u0|/D, for a curve that is singular at k = infinity alone;
///   - four sheets:  y = min(|u0|, lever v0, their distance)/D, for one that may be singular at k = 0, 1 and infinity;
///                   lever v0/|u0| is k there.
/// Panels become narrow where y -> 0, on every sheet.
struct StopTimePanels {
  static constexpr int cut_bits = 4;
  static constexpr int terms = 8;
  static constexpr int octaves = 64;
  static constexpr double lowest = 0x1p-63;  ///< it is added to y, so that there is no y without a panel
  static constexpr int mantissa_bits = 52 - cut_bits;
  static constexpr std::size_t per_sheet = std::size_t{octaves} << cut_bits;
  static constexpr std::size_t at_one = per_sheet - (std::size_t{1} << cut_bits);  ///< the last panel that has a y

  /// The exponents of lowest to 1 are the numbers 0 to 63 modulo 64.
  static constexpr std::size_t index(std::uint64_t bits_of_y) { return bits_of_y >> mantissa_bits & (per_sheet - 1); }

  /// A polynomial in t = y - left. Its coefficients lie so that both halves of a panel, with those of another panel
  /// between them, make Horner's rule for two starts and for the powers 0 to 3 and 4 to 7 at once.
  struct alignas(64) Panel {
    double coefficients[terms];

    double& of_power(int n) { return coefficients[places[n]]; }
    double of_power(int n) const { return coefficients[places[n]]; }

   private:
    static constexpr int places[terms] = {0, 1, 4, 5, 2, 3, 6, 7};
  };

  /// Where a panel lies on its sheet.
  struct Span {
    double left;
    double width;
  };
  static Span span(std::size_t index);

  /// In four sheets: k <= 1/2, 1/2 to 1, 1 to 2, from 2.
  enum Sheet { slow, below_one, above_one, fast };
};

/// A profile as its kernels read it.
struct StopTimeTable {
  double lever;    ///< of D
  bool one_sheet;  ///< and not four
  bool ordinary;   ///< what it holds is so far from the ends of the double range that only u0 and v0 can lead there
  bool flat;       ///< tau* is P + S to the last bit: there are no panels
  const StopTimePanels::Panel* panels;            ///< of G/unit; the unit is 1 if the table is ordinary
  long double wide_pivoting, wide_sliding, unit;  ///< P/|u0|, S/v0 and that unit, for careful()

  /// D needs no care from 2^-511 to here: half of all exponents, which one addition tells.
  static constexpr double ordinary_below = 0x1p513;

  /// One stop time without overflow or underflow on the way; NaN for a start that is none.
  double careful(double u0, double v0) const;
};

/// Starts in, stop times out; v0 counts for all if v0_step is 0.
struct StopTimeJob {
  const double* u0;
  const double* v0;
  std::size_t v0_step;
  double* tau;
  std::size_t size;
  bool streaming;  ///< stores that bypass the caches
};

/// The loop, compiled for one instruction set.
using StopTimeLoop = void(const StopTimeTable&, const StopTimeJob&);
StopTimeLoop run_baseline, run_avx2;

struct StopTimeKernel {
  std::string_view name;
  StopTimeLoop* run;
};

/// Those that this processor can run, the fastest last.
std::span<const StopTimeKernel> stop_time_kernels();

}  // namespace contensou::reduction
