#pragma once

#include <optional>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/terminal_chart.hpp"
#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

/// The derivatives of the scaled stop time s along one chart.
///
/// The derivatives by the speeds are algebraic in m, README (R10). This formula loses its digits next to a ray, with a
/// drive, and, for the derivative by w, in a fast slide. In these cases equation (R57) is solved. The derivatives by r
/// and rho need one equation each, (R58).
class SlidingDerivatives {
 public:
  /// @throws std::domain_error  as sliding_solution
  SlidingDerivatives(const Law& law, double r, const TerminalChart& chart, double drive);

  struct Values {
    double by_w, by_v;  ///< ds/dw, ds/dv
    double by_r;        ///< (ds/dr + w/(r^2 Psi(0)))/(w + v)
    double by_drive;    ///< (ds/drho)/(w + v)
  };

  /// Returns the derivatives at k.
  /// @param k  v/w on the chart, finite
  /// @param m  m at this k in closed form, if the curve has one
  Values at(double k, std::optional<double> m) const;

 private:
  struct BySpeeds {
    double w, v;
  };
  BySpeeds by_speeds(double k, double m) const;

  /// Returns m_ divided by m: k/(1 + k), or 1.
  double share(double k) const { return to_rest_ ? k / (1 + k) : 1; }

  Law law_;
  double r_, drive_;
  bool to_rest_;
  RegularSolution m_, by_v_, by_r_, by_drive_;
  double solved_from_;  ///< by_w_ is used for this k and larger ones
  std::optional<RegularSolution> by_w_;
};

}  // namespace contensou::reduction
