#pragma once

#include <string>

#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// The portrait as JSON: schema, law, mu, body {chi, gamma}, view, window [U, V], orbits [{u, v, tau_left}], isochrones
/// [{tau_stop, u, v}]; where asked for also highlight (an orbit), through (orbits), against {law, orbits, isochrones}.
/// Numbers read back to the same doubles.
std::string to_json(const PhasePortrait& portrait);

/// The portrait as CSV with the columns kind,index,u,v,tau: kind is orbit, highlight, through or isochrone (of another
/// law, against_orbit or against_isochrone), tau the time left.
std::string to_csv(const PhasePortrait& portrait);

}  // namespace contensou::portraits
