#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace contensou::reduction {

/// The type for the computation of tables: long double, or double if long double is 128-bit software (WebAssembly).
#ifdef __wasm__
using Wide = double;
#else
using Wide = long double;
#endif

/// 2F1(a, b; c; x) on 0 <= x <= 1, c > 0 and c - a - b >= 1, as a table of Taylor series.
///
/// Source    the series at 0, up to x = 1/2 or to a smaller x from which its terms begin to grow. Beyond, the
///           hypergeometric equation is continued panel by panel. Up to x = 1/2 each panel is twice as wide as the
///           panel before it; from x = 1/2 to the singular point x = 1, half as wide. Connection formulas have poles at
///           integer c - a - b, the case of the laws of a flat disc and of a ring, and are not used.
/// Accuracy  2 eps if |a| and |b| are of order 1 and Wide has 64 bits; values are rounded to double once.
class GaussFunction {
 public:
  /// Coefficients in powers of (distance from the centre)/(half width).
  using Panel = std::array<double, 40>;

  GaussFunction(Wide a, Wide b, Wide c);

  /// Returns 2F1(a, b; c; x).
  /// @param x  0 to 1
  /// @param y  1 - x, computed by the caller without cancellation
  double operator()(double x, double y) const;

  /// Returns (1 - 2F1)/x without the subtraction, which loses digits at small x.
  double deficit(double x, double y) const;

 private:
  static constexpr int near_terms = 64;
  static constexpr std::size_t far_panels = 72;  ///< the last panel lies below the smallest nonzero 1 - x in double

  int near_exponent_ = 1;                  ///< the series at 0 is used for x <= 2^-near_exponent_
  std::array<double, near_terms> near_{};  ///< coefficients of powers of x
  std::vector<Panel> middle_;              ///< panel j covers 2^-(j+2) <= x <= 2^-(j+1)
  std::vector<Panel> far_;                 ///< panel j covers 2^-(j+2) <= 1 - x <= 2^-(j+1)
};

}  // namespace contensou::reduction
