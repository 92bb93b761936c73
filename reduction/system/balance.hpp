#pragma once

#include <algorithm>
#include <numbers>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Returns dtau/dbeta, the weight of the regularised equations (2.7) and (2.8), at scaled speeds w = mu |u| and v.
inline double regularising_weight(double w, double v) {
  using std::numbers::pi;
  return (16 * w + 15 * pi * v) * (8 * w + 3 * pi * v);
}

/// Returns true if friction minus drive is to be computed from 1 - Phi. For rho >= 1/2 the difference 1 - rho is exact.
inline bool by_deficit(const Law& law, double drive) { return drive >= 0.5 && law.states_force_deficit(); }

/// Returns F = Phi - rho, the net force.
/// @param sliding  Phi at this slip
inline double net_force(const Law& law, Slip slip, double sliding, double drive) {
  return by_deficit(law, drive) ? (1 - drive) - law.force_deficit(slip) : sliding - drive;
}

/// D = Phi - rho - r k Psi of theory.md (R2) and (R25), as a difference of two accurate numbers. If D > 0, k falls.
struct Balance {
  double slows;            ///< first number: Phi, or 1 - rho if by_deficit
  double speeds;           ///< second number: rho + r k Psi, or (1 - Phi) + r k Psi if by_deficit
  double force;            ///< F = Phi - rho
  double drag;             ///< r k Psi
  double sliding, moment;  ///< Phi, Psi

  double difference() const { return slows - speeds; }
  double larger() const { return std::max(slows, speeds); }

  static Balance of(const Law& law, double r, double drive, double k) {
    const Slip slip = slip_of_ratio(k);
    const auto [sliding, moment] = law(slip);
    const double drag = r * (k * moment);
    if (!by_deficit(law, drive)) return {sliding, drive + drag, sliding - drive, drag, sliding, moment};
    const double deficit = law.force_deficit(slip);
    return {1 - drive, deficit + drag, (1 - drive) - deficit, drag, sliding, moment};
  }
};

}  // namespace contensou::reduction
