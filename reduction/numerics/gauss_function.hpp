#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace contensou::reduction {

/// What tables are computed in: long double, but where that is software of 128 bits, as in WebAssembly, a double.
#ifdef __wasm__
using Wide = double;
#else
using Wide = long double;
#endif

/// 2F1(a, b; c; x) on 0 <= x <= 1, c > 0 and c - a - b >= 1, as a table of Taylor series.
///
/// Source    the series at 0, up to x = 1/2 or where its terms begin to grow; beyond, the hypergeometric equation
///           continued panel by panel, each twice as wide as the one before up to x = 1/2 and half as wide from there
///           to the singular point x = 1. No connection formula: it has poles where c - a - b is an integer, and the
///           laws of a flat disc and of a ring are such cases.
/// Accuracy  continued in Wide and rounded to double once: 2 eps while |a|, |b| are of order 1 and Wide has 64 bits.
class GaussFunction {
 public:
  /// Coefficients in powers of (distance from the centre)/(half width).
  using Panel = std::array<double, 40>;

  GaussFunction(Wide a, Wide b, Wide c);

  /// @param x  0 to 1
  /// @param y  1 - x, known to the caller without the subtraction
  double operator()(double x, double y) const;

  /// (1 - 2F1)/x, without the subtraction for small x.
  double deficit(double x, double y) const;

 private:
  static constexpr int near_terms = 64;
  static constexpr std::size_t far_panels = 72;  ///< the last lies below the smallest 1 - x of doubles

  int near_exponent_ = 1;                  ///< the series at 0 serves x <= 2^-near_exponent
  std::array<double, near_terms> near_{};  ///< in powers of x
  std::vector<Panel> middle_;              ///< 2^-(j+2) < x <= 2^-(j+1), panel j is 2^-(j+2) <= x <= 2^-(j+1)
  std::vector<Panel> far_;                 ///< the same in y
};

}  // namespace contensou::reduction
