#pragma once

#include <optional>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Where motions under a law go, by r = gamma mu^2/chi, in three panels: the invariant rays, k* against r; D = Phi - r k
/// Psi, in units of Phi + r k Psi, with the way that k goes, for one r below r_low, one between and one above r_high; m(k) of the stop time for the
/// same r, between its bounds if the law states them.
///
/// With a drive the rays are where Phi = rho + r k Psi; those without one stand beside them, and m grows as 1/k towards k = 0.
///
/// @param r      that of a body, marked in the first panel and drawn in the others
/// @param drive  rho of ReducedSystem
/// @throws std::domain_error  unless r is positive and finite, and as ReducedSystem for a drive
Figure rays_figure(const reduction::Law& law, std::optional<double> r = {}, const AskedSize& size = {},
                   double drive = 0);

}  // namespace contensou::portraits
