#pragma once

#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Fig. 2 of Zh98: the friction force Phi and the friction moment Psi against k from 0 to 4, one line style for each law.
Figure law_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

/// The limit surfaces of laws, the curves of force against moment at which a patch slips, and the ellipse.
Figure limit_surface_figure(const std::vector<reduction::Law>& laws, const AskedSize& size = {});

}  // namespace contensou::portraits
