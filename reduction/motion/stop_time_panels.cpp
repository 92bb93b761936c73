#include "motion/stop_time_panels.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace contensou::reduction {

namespace {

using Panels = StopTimePanels;
using Panel = Panels::Panel;

/// Returns inverse_mu v0/|u0| for a y on the branch of a panel.
double ratio(std::size_t panel, double y) {
  const double up_to_one = (panel & Panels::near_one) != 0 ? (1 - y) / (1 + y) : y / (1 - y);
  return (panel & Panels::above_one) != 0 ? 1 / up_to_one : up_to_one;
}

/// The left edge of a panel in y + lowest, and its width.
struct Span {
  double left;
  double width;
};
Span span(std::size_t panel) {
  constexpr std::size_t cuts = std::size_t{1} << Panels::cut_bits;
  const std::size_t index = panel % Panels::per_branch;
  const double octave = std::ldexp(Panels::lowest, static_cast<int>(index / cuts));
  const double width = octave / cuts;
  return {octave + width * static_cast<double>(index % cuts), width};
}

/// Least-squares polynomials on [0, 1] through values at Chebyshev's points. The points are twice as many as the terms,
/// so that the noise of the values is halved.
class Fit {
 public:
  static constexpr std::size_t points = std::size_t{2} * Panels::terms;
  using Values = std::array<double, points>;

  Fit() {
    for (std::size_t i = 0; i < points; ++i) {
      const double angle = std::numbers::pi * static_cast<double>(2 * i + 1) / (2 * points);
      x[i] = (1 - std::cos(angle)) / 2;
      for (std::size_t n = 0; n < Panels::terms; ++n) {
        analysis_[n][i] = (n == 0 ? 1.0 : 2.0) / points * std::cos(static_cast<double>(n) * (std::numbers::pi - angle));
      }
    }
    // T_(n+1) = (4 x - 2) T_n - T_(n-1), T_1 = 2 x - 1.
    powers_[0] = {1};
    powers_[1] = {-1, 2};
    for (std::size_t n = 2; n < Panels::terms; ++n) {
      for (std::size_t i = 0; i <= n; ++i) {
        powers_[n][i] = (i > 0 ? 4 * powers_[n - 1][i - 1] : 0) - 2 * powers_[n - 1][i] - powers_[n - 2][i];
      }
    }
  }

  /// Returns the coefficients of powers of width x.
  Panel panel(const Values& values, double width) const {
    // The other coefficients are small without the constant, and so is their rounding.
    const double constant = values[0];
    Panel fitted{};
    for (std::size_t n = 0; n < Panels::terms; ++n) {
      double coefficient = 0;
      for (std::size_t i = 0; i < points; ++i) coefficient += analysis_[n][i] * (values[i] - constant);
      for (std::size_t i = 0; i <= n; ++i) fitted.c[i] += powers_[n][i] * coefficient;
    }
    fitted.c[0] += constant;
    double unit = 1;
    for (double& c : fitted.c) {
      c /= unit;
      unit *= width;
    }
    return fitted;
  }

  Values x{};

 private:
  std::array<Values, Panels::terms> analysis_{};  ///< maps values to coefficients of Chebyshev's polynomials
  /// Coefficients of powers of x in Chebyshev's polynomials.
  std::array<std::array<double, Panels::terms>, Panels::terms> powers_{};
};

}  // namespace

double sliding_coefficient(const Flow& flow, double k) {
  const double ln_k = std::log(k);
  const auto& curve = flow.solution().through(ln_k);
  return curve->sliding_coefficient(curve->chart().coordinate(ln_k));
}

double ratio_in_panel(std::size_t panel, double x) {
  const auto [left, width] = span(panel);
  return ratio(panel, left - Panels::lowest + width * x);
}

Panel fitted_panel(std::size_t panel, const std::function<double(double k)>& function) {
  static const Fit fit;
  Fit::Values values;
  for (std::size_t i = 0; i < Fit::points; ++i) values[i] = function(ratio_in_panel(panel, fit.x[i]));
  return fit.panel(values, span(panel).width);
}

}  // namespace contensou::reduction
