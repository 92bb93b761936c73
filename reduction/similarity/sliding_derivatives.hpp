#pragma once

#include <optional>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/terminal_chart.hpp"
#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

/// How the scaled stop time s changes, on the way of one chart.
///
/// By the speeds it is algebraic in m, README (R10), but next to a ray, with a drive, and, by w, beside a fast slide:
/// there nothing is left of a difference, and (R57) is solved. By r and rho it is one linear equation each, (R58).
class SlidingDerivatives {
 public:
  /// @throws std::domain_error  as sliding_solution
  SlidingDerivatives(const Law& law, double r, const TerminalChart& chart, double drive);

  struct Values {
    double by_w, by_v;  ///< ds/dw, ds/dv
    double by_r;        ///< (ds/dr + w/(r^2 Psi(0)))/(w + v)
    double by_drive;    ///< (ds/drho)/(w + v)
  };

  /// @param k  v/w on the way, finite
  /// @param m  the curve's own at this k, if it has one in closed form
  Values at(double k, std::optional<double> m) const;

 private:
  struct BySpeeds {
    double w, v;
  };
  BySpeeds by_speeds(double k, double m) const;

  /// So much of m is m_: k/(1 + k), or all.
  double share(double k) const { return to_rest_ ? k / (1 + k) : 1; }

  Law law_;
  double r_, drive_;
  bool to_rest_;
  RegularSolution m_, by_v_, by_r_, by_drive_;
  double solved_from_;  ///< from this k on by_w_ is solved for
  std::optional<RegularSolution> by_w_;
};

}  // namespace contensou::reduction
