#pragma once

#include <string>
#include <string_view>

#include "contensou/reduction/phase_plane.hpp"
#include "output/json.hpp"

namespace contensou::program {

/// "zero", "ray" or "infinity".
std::string_view limit_name(reduction::TerminalRegime regime);

/// Adds r_low, r_high, limit and k_star ("several" and null if it depends on the start), rays and ends.
void add_terminal_ratios(JsonObject& document, const reduction::TerminalRatios& ratios);

/// What `portrait --facts` prints: regime, singular points with eigenvalues and kind, how orbits enter the origin.
std::string phase_plane_as_text(const reduction::ReducedSystem& system, const reduction::PhasePlane& plane, int digits);

/// A row for each singular point: half_line,place,k,q,radial,angular,kind,separatrix.
std::string phase_plane_as_csv(const reduction::PhasePlane& plane);

std::string phase_plane_as_json(const reduction::ReducedSystem& system, const reduction::PhasePlane& plane);

}  // namespace contensou::program
