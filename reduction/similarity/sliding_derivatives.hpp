#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "contensou/reduction/detail/similarity_solution.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "numerics/later.hpp"
#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

/// The derivatives of the scaled stop time s along one chart.
///
/// The derivatives by the speeds are algebraic in m, theory.md (R10). This formula loses its digits next to a ray, and
/// in a fast slide for the derivative by w. In these cases, and under a drive unless the law's slopes are differences,
/// equation (R34) is solved. The derivatives by r and rho need one equation each, (R35).
class SlidingDerivatives {
 public:
  /// @throws std::domain_error  as sliding_solution
  SlidingDerivatives(const Law& law, double r, const TerminalChart& chart, double drive);

  struct Values {
    double by_w, by_v;  ///< ds/dw, ds/dv
    double by_r;        ///< (ds/dr + w/(r^2 Psi(0)))/(w + v)
    double by_drive;    ///< (ds/drho)/(w + v)
  };

  /// A ratio k, and the values of the law at k. Systems with different r share it.
  struct Place {
    double k, ln_k;
    Resistance friction;
    double moment_deficit;  ///< 1 - Psi/Psi(0)

    static Place at(const Law& law, double k);
  };

  /// Returns the derivatives at a place on the chart; k must be finite.
  /// @param m  m of the curve at this k, if the curve has a closed form
  Values at(const Place& place, std::optional<double> m) const;

  /// From this k on, 1/(r Psi(0)) - k m' loses more and more digits of ds/dw.
  static constexpr double fast_slide = 1e3;

  /// Returns true if D = Phi - rho - r k Psi has enough digits for m' = (1 - Psi/Psi(0) - F m)/D.
  /// @param force  Phi
  /// @param drag   r k Psi
  static bool is_clear(double force, double drag, double drive = 0);

  struct BySpeeds {
    double w, v;
  };

  /// Returns ds/dw and ds/dv from m, without a drive, if is_clear.
  /// @param moment  Psi(0)
  static BySpeeds by_m(const Place& place, double r, double moment, double m);

 private:
  /// @param k_m  the product k m, which has a limit at k = 0
  BySpeeds by_speeds(const Place& place, double m, double k_m) const;

  /// Returns true if ds/dv follows from m. Slopes by differences are wrong next to a kink, and (R34) needs slopes.
  bool is_algebraic(const Place& place) const;

  /// Returns m_ divided by m: k/(1 + k), or 1.
  double share(double k) const { return to_rest_ ? k / (1 + k) : 1; }

  /// Returns k m from m_ at this k.
  double k_m(double k, double m) const { return to_rest_ ? m * (1 + k) : k * m; }

  Law law_;
  double r_, drive_;
  TerminalChart chart_;
  bool to_rest_;
  bool by_differences_;  ///< true if slopes of the law are differences
  RegularSolution m_;
  std::unique_ptr<const Later<RegularSolution>> by_v_;  ///< solved at its first use
  RegularSolution by_r_, by_drive_;
  double solved_from_;  ///< from this k on by_w_ is used
  std::optional<RegularSolution> by_w_;
};

/// Returns the gradient of a stop time, theory.md (R10).
/// @param start     a state
/// @param tau       its stop time
/// @param off_axes  returns the derivatives of the scaled stop time at k; called only for starts off the axes
/// @throws std::domain_error  at rest, where there is no gradient
StopTimeGradient stop_time_gradient(const ReducedSystem& system, State start, double tau,
                                    const std::function<SlidingDerivatives::Values(double k)>& off_axes);

}  // namespace contensou::reduction
