#pragma once

#include <vector>

#include "contensou/portraits/figure.hpp"
#include "views/portrait_panel.hpp"

namespace contensou::portraits {

/// The panels of each view. A new view is a function here, a name in phase_portrait.hpp and a row in
/// phase_portrait_figure.cpp.
std::vector<Panel> plane_view(const Drawing& drawing);       ///< (u, v)
std::vector<Panel> patch_view(const Drawing& drawing);       ///< (mu u, v)
std::vector<Panel> log_view(const Drawing& drawing);         ///< (ln mu u, ln v)
std::vector<Panel> similarity_view(const Drawing& drawing);  ///< (q, p) and (ln k, p)
std::vector<Panel> blowup_view(const Drawing& drawing);      ///< the blown-up origin, and the chart (u, k)
std::vector<Panel> disc_view(const Drawing& drawing);        ///< the Poincare disc
std::vector<Panel> time_view(const Drawing& drawing);        ///< u, v, k against time
std::vector<Panel> pair_view(const Drawing& drawing);        ///< (u, v) beside (u, ln k)

/// Whether ln k passes that value along a whole curve.
bool reaches(const PortraitOrbit& curve, double ln_k);

/// ln k of the invariant rays, by growing k.
std::vector<double> ray_log_ratios(const PhasePortrait& portrait);

/// ln k at which copies of a whole curve are spread: half-way between two rays, `away` from the only one, 0 without.
double spread_log_ratio(const WholeCurve& curve, double away);

/// The state at which a whole curve has that ln k, interpolated between its rows; the last that it reaches otherwise.
Instant at_log_ratio(const PortraitOrbit& curve, double ln_k);

/// Angles atan(k) of the invariant half-lines, from v = 0 to u = 0.
std::vector<double> invariant_angles(const PhasePortrait& portrait);

}  // namespace contensou::portraits
