#pragma once

#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Draws friction force Phi and moment Psi against k from 0 to 4, a line style per law (V. F. Zhuravlev, 1998, Fig. 2).
Figure law_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

/// Draws the limit surfaces of laws (force and moment at which a patch slips), and the ellipse (F/F0)^2 + (M/M0)^2 = 1.
Figure limit_surface_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

}  // namespace contensou::portraits
