#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/terminal_chart.hpp"
#include "numerics/legendre_series.hpp"

namespace contensou::reduction {

/// Beyond these, one term of each expansion is exact to the last bit: exp(-40) = 4e-18, exp(44) = 1e19.
inline constexpr double min_ln_k = -40;
inline constexpr double max_ln_k = 44;

/// When a panel is no longer halved, here and in QuadratureCurve.
inline constexpr double panel_tolerance = 1e-15;
inline constexpr int max_depth = 40;
inline constexpr std::size_t max_panels = 50'000;  // a law with more noise than the tolerance would be halved for ever

/// m of README (R4) and n of (R13) as functions of ln k between two neighbours of 0, the invariant rays and infinity.
///
/// With ' = d/d ln k and D = Phi - r k Psi, (R19) and (R31) are singular where D vanishes, and m and n are regular at
/// the one of the two ratios that k tends to: by collocation, panel after panel away from it. D is not divided by:
/// where all its digits are lost, m has all of its own.
class RegularSolution {
 public:
  /// @param chart     on whose way Phi - r k Psi does not change its sign
  /// @throws std::domain_error  if it does, or unless r > 0
  RegularSolution(const Law& law, double r, const TerminalChart& chart);

  /// Where its panels begin and end, in +- ln k, which grows away from the stop.
  struct Interval {
    double left, right;
    double t(double z) const { return 2 * ((z - left) / (right - left)) - 1; }
  };
  std::vector<Interval> intervals() const;

  double sliding_coefficient(double ln_k) const;      ///< m
  double slip_length_coefficient(double ln_k) const;  ///< n

  /// What the last terms of the series leave out of m, relative to max(m, 1); the noise of the law is in it.
  double truncation() const { return truncation_; }

  /// How often the law was called.
  long evaluations() const { return evaluations_; }

 private:
  struct Values {
    double sliding_coefficient, slip_length_coefficient;
  };
  struct Panel : Interval {
    LegendreSeries sliding_coefficient, slip_length_coefficient;
  };

  /// Adds the panels from left to right.
  void march(const Law& law, double r, double left, double right, int depth);
  /// The panel at z and the t there.
  std::pair<const Panel&, double> place(double ln_k) const;

  TerminalChart chart_;
  double sign_;
  Values first_{};  ///< at the stop
  Values last_{};   ///< at the right end of the last panel
  std::vector<Panel> panels_;
  double truncation_ = 0;
  long evaluations_ = 0;
};

/// b of README (R7) as a function of ln k, on the panels of a RegularSolution, from far away towards the stop: there D
/// has the other sign in its equation (R7), and the regular solution is the one that is regular at the far end.
class BetaSolution {
 public:
  BetaSolution(const Law& law, double r, const TerminalChart& chart, const RegularSolution& grid);

  double operator()(double ln_k) const;

 private:
  struct Panel : RegularSolution::Interval {
    LegendreSeries b;
  };

  double sign_;
  double far_ = 0;      ///< b beyond the last panel
  double at_stop_ = 0;  ///< b in the limit of the stop
  double rate_ = 0;     ///< d ln(b - at_stop)/d z before the first panel
  std::vector<Panel> panels_;
};

}  // namespace contensou::reduction
