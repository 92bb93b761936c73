#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/terminal_chart.hpp"
#include "numerics/legendre_series.hpp"

namespace contensou::reduction {

/// Beyond these, one term of each expansion is exact to the last bit: exp(-40) = 4e-18, exp(44) = 1e19.
inline constexpr double min_ln_k = -40;
inline constexpr double max_ln_k = 44;

/// min_ln_k, or with a drive less.
double lowest_ln_k(const Law& law, double r, double drive);

/// When a panel is no longer halved, here and in QuadratureCurve.
inline constexpr double panel_tolerance = 1e-15;
inline constexpr int max_depth = 40;
inline constexpr std::size_t max_panels = 50'000;  // a law with more noise than the tolerance would be halved for ever

/// A quantity y that relaxes along a curve: |D| dy/dz + h y = g, D = Phi - rho - r k Psi, z = +- ln k. h > 0 where the way
/// begins, and the integral of h/|D| is bounded from below.
///
/// The equation is singular where D vanishes, and y is the solution that is regular where its way begins: by
/// collocation, panel after panel. D is not divided by: where all its digits are lost, y has all of its own.
class RegularSolution {
 public:
  struct Terms {
    double difference;  ///< |D|
    double rate;        ///< h
    double source;      ///< g
  };

  /// @param equation   the terms at k, all three times any positive number
  /// @param direction  +1 where z is ln k, -1 where it is -ln k; errors die out as z grows
  /// @param edges      z where panels meet, increasing; y begins as g/h at the first
  /// @param size       errors of g count relative to it, and so do those of a smaller y: a law may have 1 - Psi/Psi(0)
  ///                   and 1 - Phi to eps of 1 only, and no time or slip feels more
  /// @param start      y at the first edge, where D does not vanish there
  /// @param noise      of the terms, relative: nothing smaller is looked for in them
  RegularSolution(const std::function<Terms(double k)>& equation, double direction, const std::vector<double>& edges,
                  double size, std::optional<double> start = {}, double noise = 0);

  /// y; beyond the edges, its value there.
  double operator()(double ln_k) const;

  /// What the last terms of the series leave out of y, relative to max(|y|, size); the noise of the law is in it, and so
  /// is a D of the wrong sign, taken for 0.
  double truncation() const { return truncation_; }

  /// How often the equation was evaluated.
  long evaluations() const { return evaluations_; }

 private:
  friend RegularSolution sliding_equation(const Law& law, double r, const TerminalChart& chart, double drive,
                                          bool to_rest, const std::function<double(double k)>& source);

  struct Panel {
    double left, right;
    LegendreSeries y;
  };

  /// Adds the panels from left to right.
  void march(const std::function<Terms(double k)>& equation, double left, double right, int depth);

  double direction_;
  double size_;
  double tolerance_;  ///< of a panel
  double begin_;
  double first_;  ///< y at the first edge
  double last_;   ///< y at the end of the last panel
  std::vector<Panel> panels_;
  double truncation_ = 0;
  long evaluations_ = 0;
};

/// Whether a curve reaches k = 0 with a drive, where m, n and o grow like 1/k: it has them times what follows here.
bool reaches_rest(const TerminalChart& chart, double drive);

/// The equation of m with any right side: that of m itself, and those of its derivatives by r and rho, README (R58).
/// @param source   that side at k, of the solution times k/(1 + k) if to_rest
/// @param to_rest  whether the solution is m, or its derivative, times k/(1 + k)
RegularSolution sliding_equation(const Law& law, double r, const TerminalChart& chart, double drive, bool to_rest,
                                 const std::function<double(double k)>& source);

/// m of README (R4) between two neighbours of 0, the invariant rays and infinity: regular at the one that k tends to. Times
/// k/(1 + k) if reaches_rest.
///
/// @param chart  on whose way Phi - rho - r k Psi does not change its sign
/// @throws std::domain_error  if it does, or unless r > 0
RegularSolution sliding_solution(const Law& law, double r, const TerminalChart& chart, double drive);

/// ds/dv of README (R57), on the same way.
RegularSolution by_sliding_speed(const Law& law, double r, const TerminalChart& chart, double drive);

/// ds/dw of README (R57), on the part of the way from k to infinity, where Phi > rho.
/// @param chart  one that reaches infinity
/// @param start  its value at k, where the way to infinity begins there; else it is regular where it begins
RegularSolution by_pivoting_speed(const Law& law, double r, const TerminalChart& chart, double drive, double k,
                                  std::optional<double> start);

/// n/(1 + k), n of (R13) and (R50), on the same way. Times k/(1 + k) if reaches_rest.
RegularSolution slip_length_solution(const Law& law, double r, const TerminalChart& chart, double drive);

/// o of (R31), on the same way. Times k/(1 + k) if reaches_rest.
RegularSolution angle_solution(const Law& law, double r, const TerminalChart& chart, double drive);

/// b of (R7), on the same way, from far away towards the stop: there D has the other sign in its equation, and the
/// regular solution is the one that is regular at the far end.
class BetaSolution {
 public:
  BetaSolution(const Law& law, double r, const TerminalChart& chart, double drive);

  double operator()(double ln_k) const;

 private:
  RegularSolution b_;
  double sign_;
  double nearest_;   ///< to the stop, in +- ln k
  double at_stop_;   ///< b in the limit of the stop
  double rate_ = 0;  ///< d ln(b - at_stop)/d(+- ln k) beyond nearest_
};

}  // namespace contensou::reduction
