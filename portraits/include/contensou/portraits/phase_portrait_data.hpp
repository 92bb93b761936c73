#pragma once

#include <string>

#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// The portrait as JSON: schema, law, mu, view, window [U, V], orbits [{u, v, tau_left}], isochrones [{tau_stop, u,
/// v}], and highlight like an orbit if there is one. Numbers read back to the same doubles.
std::string to_json(const PhasePortrait& portrait);

/// The portrait as CSV with the columns kind,index,u,v,tau: kind is orbit, highlight or isochrone, tau the time left.
std::string to_csv(const PhasePortrait& portrait);

}  // namespace contensou::portraits
