#pragma once

#include <optional>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Draws Fig. 1 of V. F. Zhuravlev, 1998 (Zh98): the contact patch, the centre of velocity C outside it at the distance
/// h = v/omega, and the polar coordinates (r, theta) about C of the paper's friction integral (1.2).
Figure patch_drawing(const AskedSize& size = {});

/// Draws Fig. 3 of the same paper: the ball on the plane, its axes and its contact patch.
Figure ball_drawing(const AskedSize& size = {});

/// Draws friction force Phi and moment Psi against k from 0 to 4. The two laws of V. F. Zhuravlev, 1998, are his
/// Fig. 2.
Figure law_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

/// Draws the limit surfaces of laws (force and moment at which a patch slips), and the ellipse (F/F0)^2 + (M/M0)^2 = 1.
Figure limit_surface_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

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
