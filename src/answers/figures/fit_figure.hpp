#pragma once

#include "contensou/fit/fit.hpp"
#include "contensou/portraits/figure.hpp"

namespace contensou::answers {

/// The data of tracks with the fitted motion, an observable beside the other, the residuals below each, and where
/// friction and patch radius lie: the ellipses of 68 and 95 % confidence. Beside slip, spin and angle, dashed, the
/// textbook's motion from the same start, which has no rolling friction.
/// @param laws  among which the fit's is
/// @param size  requested size of the figure
portraits::Figure fit_figure(const fit::Fit& fit, const std::vector<reduction::Law>& laws,
                             const std::vector<fit::Track>& tracks, const portraits::AskedSize& size);

}  // namespace contensou::answers
