#pragma once

#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Fig. 1 of Zh98: the contact patch, the centre of velocity C at the distance h = v/omega outside of it, and the polar
/// coordinates (r, theta) about C in which the friction of an element is integrated (1.2).
Figure patch_drawing(const AskedSize& size = {});

/// Fig. 2: the friction force Phi and the friction moment Psi against k from 0 to 4, one line style for each law.
Figure law_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

/// The limit surfaces of laws, the curves of force against moment at which a patch slips, and the ellipse.
Figure limit_surface_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

/// Fig. 3: the ball on the plane, its axes and the spot on which it touches.
Figure ball_drawing(const AskedSize& size = {});

}  // namespace contensou::portraits
