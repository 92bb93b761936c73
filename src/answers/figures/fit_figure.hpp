#pragma once

#include "contensou/fit/fit.hpp"
#include "contensou/portraits/figure.hpp"

namespace contensou::answers {

/// Draws the data of tracks with the fitted motion, one observable beside the other, with the residuals below each. A
/// further panel shows the ellipses of 68 and 95 % confidence for friction and patch radius. For slip, spin and angle a
/// dashed line shows the motion of the uncoupled model from the same start, without rolling friction.
/// @param laws  laws that were compared; the law of the fit is one of them
/// @param size  requested size of the figure
portraits::Figure fit_figure(const fit::Fit& fit, const std::vector<reduction::Law>& laws,
                             const std::vector<fit::Track>& tracks, const portraits::AskedSize& size);

}  // namespace contensou::answers
