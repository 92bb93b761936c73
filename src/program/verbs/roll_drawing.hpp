#pragma once

#include <optional>

#include "contensou/portraits/roll_figure.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/shot.hpp"
#include "options/roll_route.hpp"

namespace contensou::program {

/// The picture of a shot, beside the textbook's.
///
/// @param until  s; empty: a little past the stop
portraits::RollPicture roll_drawing(const si::Shot& shot, const reduction::Law& law, RollRoute route,
                                    std::optional<double> until);

}  // namespace contensou::program
