#pragma once

#include <optional>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Draws, for a law (force Phi, moment Psi) and all r = gamma mu^2/chi, the limits of k = v/(mu |u|) in three panels:
///
///   - the invariant rays: k of each ray, k*, against r;
///   - D = Phi - r k Psi divided by Phi + r k Psi, with the direction of motion of k, for one r below r_low, one
///     between r_low and r_high, and one above r_high (TerminalRatios::low and high);
///   - the coefficient m(k) of the stop time for the same r, between its bounds if the law states them.
///
/// A drive rho moves the rays to Phi = rho + r k Psi. The rays without the drive are drawn beside them. Under a drive m
/// grows as 1/k towards k = 0.
///
/// @param r      r of a body, marked in the first panel and drawn in the other panels
/// @param drive  rho of ReducedSystem
/// @throws std::domain_error  unless r is positive and finite; for a drive as ReducedSystem
Figure rays_figure(const reduction::Law& law, std::optional<double> r = {}, const AskedSize& size = {},
                   double drive = 0);

}  // namespace contensou::portraits
