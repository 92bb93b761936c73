#pragma once

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// Draws Fig. 1 of V. F. Zhuravlev, 1998 (Zh98): the contact patch, the centre of velocity C outside it at the distance
/// h = v/omega, and the polar coordinates (r, theta) about C of the paper's friction integral (1.2).
Figure patch_drawing(const AskedSize& size = {});

/// Draws Fig. 3 of the same paper: the ball on the plane, its axes and its contact patch.
Figure ball_drawing(const AskedSize& size = {});

}  // namespace contensou::portraits
