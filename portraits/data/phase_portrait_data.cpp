#include "contensou/portraits/phase_portrait_data.hpp"

#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/json.hpp"

namespace contensou::portraits {

namespace {

using Json = nlohmann::ordered_json;

std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

Json orbit_json(const PortraitOrbit& orbit) {
  return {{"u", list(orbit.u)}, {"v", list(orbit.v)}, {"tau_left", list(orbit.tau_left)}};
}

Json orbits_json(const std::vector<PortraitOrbit>& orbits) {
  Json json = Json::array();
  for (const PortraitOrbit& orbit : orbits) json.push_back(orbit_json(orbit));
  return json;
}

Json isochrones_json(const std::vector<Isochrone>& isochrones) {
  Json json = Json::array();
  for (const Isochrone& isochrone : isochrones) {
    json.push_back({{"tau_stop", isochrone.tau_stop}, {"u", list(isochrone.u)}, {"v", list(isochrone.v)}});
  }
  return json;
}

void append_orbits(std::string& csv, std::string_view kind, const std::vector<PortraitOrbit>& orbits) {
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    const PortraitOrbit& orbit = orbits[i];
    for (Eigen::Index j = 0; j < orbit.rows(); ++j) {
      fmt::format_to(std::back_inserter(csv), "{},{},{},{},{}\n", kind, i, orbit.u[j], orbit.v[j], orbit.tau_left[j]);
    }
  }
}

void append_isochrones(std::string& csv, std::string_view kind, const std::vector<Isochrone>& isochrones) {
  for (std::size_t i = 0; i < isochrones.size(); ++i) {
    const Isochrone& isochrone = isochrones[i];
    for (Eigen::Index j = 0; j < isochrone.u.size(); ++j) {
      fmt::format_to(std::back_inserter(csv), "{},{},{},{},{}\n", kind, i, isochrone.u[j], isochrone.v[j],
                     isochrone.tau_stop);
    }
  }
}

}  // namespace

std::string to_json(const PhasePortrait& portrait) {
  const reduction::ReducedSystem& system = portrait.system;
  Json json{{"schema", 1},
            {"law", system.law().name()},
            {"mu", system.mu()},
            {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
            {"view", name(portrait.view)},
            {"window", {portrait.window.u, portrait.window.v}},
            {"orbits", orbits_json(portrait.orbits)},
            {"isochrones", isochrones_json(portrait.isochrones)}};
  if (portrait.highlight) json["highlight"] = orbit_json(*portrait.highlight);
  if (!portrait.through.empty()) json["through"] = orbits_json(portrait.through);
  for (const PhasePortrait& rival : portrait.against) {
    json["against"] = {{"law", rival.system.law().name()},
                       {"orbits", orbits_json(rival.orbits)},
                       {"isochrones", isochrones_json(rival.isochrones)}};
  }
  return json_document(json);
}

std::string to_csv(const PhasePortrait& portrait) {
  std::string csv = "kind,index,u,v,tau\n";
  append_orbits(csv, "orbit", portrait.orbits);
  if (portrait.highlight) append_orbits(csv, "highlight", {*portrait.highlight});
  append_orbits(csv, "through", portrait.through);
  append_isochrones(csv, "isochrone", portrait.isochrones);
  for (const PhasePortrait& rival : portrait.against) {
    append_orbits(csv, "against_orbit", rival.orbits);
    append_isochrones(csv, "against_isochrone", rival.isochrones);
  }
  return csv;
}

}  // namespace contensou::portraits
