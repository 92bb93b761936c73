#pragma once

#include <string>

#include "contensou/reduction/phase_plane.hpp"

namespace contensou::program {

/// What `portrait --facts` prints: regime, singular points with eigenvalues and kind, how orbits enter the origin.
std::string phase_plane_as_text(const reduction::ReducedSystem& system, const reduction::PhasePlane& plane, int digits);

/// A row for each singular point: half_line,place,k,q,radial,angular,kind,separatrix.
std::string phase_plane_as_csv(const reduction::PhasePlane& plane);

std::string phase_plane_as_json(const reduction::ReducedSystem& system, const reduction::PhasePlane& plane);

}  // namespace contensou::program
