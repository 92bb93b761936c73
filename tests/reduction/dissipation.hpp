#pragma once

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// The power that friction takes, v Phi + w Psi, per N f: for Slip{k, 1} it is R(k) = k Phi + Psi.
///
/// For Coulomb friction it is also a potential: Phi = dR/dv and Psi = dR/dw, so that Phi = R'(k), Psi = R - k R' and
/// Psi' = -k Phi'. Every law of this library has it, except the Pade law. R is homogeneous of degree 1 in the speeds.
///
/// @throws std::domain_error  as the law
template <FrictionLaw L>
double dissipation(const L& law, Slip slip) {
  const Resistance resistance = law(slip);
  return slip.sliding * resistance.force + slip.pivoting * resistance.moment;
}

}  // namespace contensou::reduction
