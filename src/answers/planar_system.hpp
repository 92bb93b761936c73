#pragma once

#include <map>
#include <string>

#include "contensou/reduction/planar_symmetry.hpp"

namespace contensou::answers {

/// The field of "u' = F; v' = G", with formulas in u, v and parameters: + - * / ^ ( ) < > ? :, |...|, pi, and the
/// functions of muParser and hypot, with sign(0) = 0 and log = ln. Its copies share their variables: one thread.
///
/// @throws BadInput  quoting what is wrong and saying at which character; for a parameter that is a name of another kind
///                   or that no formula has
reduction::PlanarField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters);

}  // namespace contensou::answers
