#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "contensou/reduction/detail/similarity_solution.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "numerics/legendre_series.hpp"

namespace contensou::reduction {

/// Range of ln k. Outside it, one term of each expansion is exact to the last bit: exp(-40) = 4e-18, exp(44) = 1e19.
inline constexpr double min_ln_k = -40;
inline constexpr double max_ln_k = 44;

/// Returns min_ln_k, or a smaller value with a drive.
double lowest_ln_k(const Law& law, double r, double drive);

/// Limits of the halving of panels, here and in QuadratureCurve. They stop the halving for a noisy law.
inline constexpr double panel_tolerance = 1e-15;
inline constexpr int max_depth = 40;
inline constexpr std::size_t max_panels = 50'000;

/// A quantity y that relaxes along a curve: |D| dy/dz + h y = g, where D = Phi - rho - r k Psi and z = +- ln k. At the
/// beginning h > 0, and the integral of h/|D| is bounded from below. The equation is singular at a zero of D. y is the
/// solution that is regular at the beginning, found by collocation, panel after panel. No step divides by D, so y keeps
/// its digits even if D has lost all digits.
class RegularSolution {
 public:
  struct Terms {
    double difference;  ///< |D|
    double rate;        ///< h
    double source;      ///< g
  };

  /// @param equation   the three terms at k; they can be multiplied by a common positive factor
  /// @param direction  +1 if z = ln k, -1 if z = -ln k; errors decay as z grows
  /// @param edges      z at which panels meet, increasing; y = g/h at the first edge, unless start is given
  /// @param size       errors of g and y are relative to max(|y|, size), because a law can compute
  ///                   1 - Psi/Psi(0) and 1 - Phi only to eps of 1. This accuracy is enough for times
  ///                   and lengths
  /// @param start      y at the first edge; to be given if D does not vanish there
  /// @param noise      relative error of the terms; panels are not halved for smaller errors
  RegularSolution(const std::function<Terms(double k)>& equation, double direction, const std::vector<double>& edges,
                  double size, std::optional<double> start = {}, double noise = 0);

  /// Returns y. Beyond the edges, the result is y at the nearest edge.
  double operator()(double ln_k) const;

  /// Returns an estimate of the error, the last terms of the series relative to max(|y|, size). The estimate includes
  /// noise of the law, and any D of the wrong sign, because such a D is replaced by 0.
  double truncation() const { return truncation_; }

  /// Returns the number of evaluations of the equation.
  long evaluations() const { return evaluations_; }

 private:
  friend RegularSolution sliding_equation(const Law& law, double r, const TerminalChart& chart, double drive,
                                          bool to_rest, const std::function<double(double k)>& source);

  struct Panel : SeriesPanel {
    LegendreSeries y;
  };

  /// Adds the panels from left to right. Panels are halved until their series converge.
  void march(const std::function<Terms(double k)>& equation, double left, double right, int depth);

  double direction_;  ///< 1: z = ln k; -1: z = -ln k
  double size_;
  double tolerance_;  ///< allowed error of a panel, relative
  double begin_;
  double first_;  ///< y at the first edge
  double last_;   ///< y at the end of the last panel
  std::vector<Panel> panels_;
  double truncation_ = 0;
  long evaluations_ = 0;
};

/// Returns the charts of all curves of a system.
std::vector<TerminalChart> charts_of(const TerminalRatios& ratios);

/// Returns true if a curve under a drive reaches k = 0, at which m, n and o grow like 1/k. The functions below then
/// return m, n and o times k/(1 + k).
bool reaches_rest(const TerminalChart& chart, double drive);

/// Solves the equation of m with any right side, also that of a derivative of m by r or rho, numerics.md (R35).
/// @param source   right side at k; if to_rest is true, the right side of the product
/// @param to_rest  true to solve for k/(1 + k) times m or times its derivative
RegularSolution sliding_equation(const Law& law, double r, const TerminalChart& chart, double drive, bool to_rest,
                                 const std::function<double(double k)>& source);

/// Returns m of theory.md (R4) between two neighbours among 0, the invariant rays and infinity. m is regular at the
/// limit of k. If reaches_rest is true, the result is m k/(1 + k).
///
/// @param chart  chart along which Phi - rho - r k Psi does not change its sign
/// @throws std::domain_error  if this sign changes, or unless r > 0
RegularSolution sliding_solution(const Law& law, double r, const TerminalChart& chart, double drive);

/// Returns ds/dv of numerics.md (R34) along the same chart; s is the scaled stop time.
RegularSolution by_sliding_speed(const Law& law, double r, const TerminalChart& chart, double drive);

/// Returns ds/dw of numerics.md (R34) along the part of the chart from k to infinity, where Phi > rho.
/// @param chart  chart that reaches infinity
/// @param start  value at k, if the solution begins at k; if empty, the solution is regular at its beginning
RegularSolution by_pivoting_speed(const Law& law, double r, const TerminalChart& chart, double drive, double k,
                                  std::optional<double> start);

/// Returns n/(1 + k) along the same chart, n of (R30) and (R26). If reaches_rest, the result has the factor k/(1 + k).
RegularSolution slip_length_solution(const Law& law, double r, const TerminalChart& chart, double drive);

/// Returns o of (R8) along the same chart. If reaches_rest is true, the result has the factor k/(1 + k).
RegularSolution angle_solution(const Law& law, double r, const TerminalChart& chart, double drive);

/// The function b of (R39) along the same chart. In the equation of b, D has the opposite sign. Therefore b is solved
/// from the far end towards the stop, and b is regular at the far end.
class BetaSolution {
 public:
  BetaSolution(const Law& law, double r, const TerminalChart& chart, double drive);

  double operator()(double ln_k) const;

 private:
  RegularSolution b_;
  double sign_;      ///< 1: z = ln k; -1: z = -ln k
  double nearest_;   ///< edge nearest to the stop, as a value of z = +- ln k
  double at_stop_;   ///< b in the limit of the stop
  double rate_ = 0;  ///< d ln(b - at_stop)/dz beyond nearest_
};

}  // namespace contensou::reduction
