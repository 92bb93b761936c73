#pragma once

#include <map>
#include <string>

#include "contensou/reduction/planar_symmetry.hpp"

namespace contensou::answers {

/// The field of "u' = F; v' = G", formulas in u, v and parameters as answers/formulas.hpp has them. Its copies share their
/// variables: one thread.
///
/// @throws BadInput  as Formulas
reduction::PlanarField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters);

}  // namespace contensou::answers
