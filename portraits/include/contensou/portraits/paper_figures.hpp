#pragma once

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// Draws Fig. 1 of Zh98: the contact patch, the centre of velocity C at the distance h = v/omega outside of it, and
/// polar coordinates (r, theta) about C, in which (1.2) integrates the friction of an element.
Figure patch_drawing(const AskedSize& size = {});

/// Draws Fig. 3 of Zh98: the ball on the plane, its axes and its contact patch.
Figure ball_drawing(const AskedSize& size = {});

}  // namespace contensou::portraits
