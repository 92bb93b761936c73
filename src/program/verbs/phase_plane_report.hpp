#pragma once

#include <string>
#include <string_view>

#include "contensou/reduction/phase_plane.hpp"
#include "output/json.hpp"

namespace contensou::program {

/// "zero", "ray" or "infinity".
std::string_view limit_name(reduction::TerminalRegime regime);

/// Relative error of the k of an end; 0 for k = 0 and infinity.
double accuracy_of(const reduction::TerminalRatio& end, const reduction::TerminalRatios& ratios);

/// Adds r_low, r_high, rays and ends; of each end limit, k_star, k_star_accuracy, k_from and k_to. These five are added
/// to the document itself, too, of the end that takes the largest sector of starts.
void add_terminal_ratios(JsonObject& document, const reduction::TerminalRatios& ratios);

/// What `portrait --facts` prints: regime, singular points with eigenvalues and kind, how orbits enter the origin.
std::string phase_plane_as_text(const reduction::ReducedSystem& system, const reduction::PhasePlane& plane, int digits);

/// A row for each singular point: half_line,place,k,q,radial,angular,kind,separatrix.
std::string phase_plane_as_csv(const reduction::PhasePlane& plane);

std::string phase_plane_as_json(const reduction::ReducedSystem& system, const reduction::PhasePlane& plane);

}  // namespace contensou::program
