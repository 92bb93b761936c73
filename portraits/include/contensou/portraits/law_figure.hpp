#pragma once

#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Draws Fig. 2 of Zh98: friction force Phi and friction moment Psi against k from 0 to 4, with one line style per law.
Figure law_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

/// Draws the limit surfaces of laws, that is force against moment at which a patch slips, and the ellipse.
Figure limit_surface_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

}  // namespace contensou::portraits
