#pragma once

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// Fig. 1 of Zh98: the contact patch, the centre of velocity C at the distance h = v/omega outside of it, and the polar
/// coordinates (r, theta) about C in which the friction of an element is integrated (1.2).
Figure patch_drawing(const AskedSize& size = {});

/// Fig. 3: the ball on the plane, its axes and the spot on which it touches.
Figure ball_drawing(const AskedSize& size = {});

}  // namespace contensou::portraits
