#pragma once

#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"

namespace contensou::portraits {

/// Fig. 2 of Zh98: the friction force Phi and the friction moment Psi against k, one line style for each law.
Figure law_figure(const std::vector<reduction::Law>& laws);

}  // namespace contensou::portraits
