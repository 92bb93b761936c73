#pragma once

#include "contensou/fit/fit.hpp"
#include "contensou/portraits/figure.hpp"

namespace contensou::answers {

/// The data of tracks with the fitted motion, an observable beside the other, the residuals below each, and where
/// friction and patch radius lie: the ellipses of 68 and 95 % confidence.
/// @param size  of the figure, as it is asked for
portraits::Figure fit_figure(const fit::Fit& fit, const std::vector<fit::Track>& tracks,
                             const portraits::AskedSize& size);

}  // namespace contensou::answers
