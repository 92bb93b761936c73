#pragma once

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/stop_time_map.hpp"

namespace contensou::portraits {

/// The map as a drawing: stop times as colours, dark for long ones, with a scale; labelled isochrones over them; the
/// ray k = 1, above which the centre of rotation is outside the patch.
Figure draw(const StopTimeMap& map);

}  // namespace contensou::portraits
