#include "contensou/portraits/phase_portrait_data.hpp"

#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace contensou::portraits {

namespace {

using Json = nlohmann::ordered_json;

std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

Json orbit_json(const PortraitOrbit& orbit) {
  return {{"u", list(orbit.u)}, {"v", list(orbit.v)}, {"tau_left", list(orbit.tau_left)}};
}

void append_rows(std::string& csv, std::string_view kind, std::size_t index, const PortraitOrbit& orbit) {
  for (Eigen::Index i = 0; i < orbit.u.size(); ++i) {
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{}\n", kind, index, orbit.u[i], orbit.v[i], orbit.tau_left[i]);
  }
}

}  // namespace

std::string to_json(const PhasePortrait& portrait) {
  Json json{{"schema", 1},
            {"law", portrait.law},
            {"mu", portrait.mu},
            {"view", name(portrait.view)},
            {"window", {portrait.window.u, portrait.window.v}},
            {"orbits", Json::array()},
            {"isochrones", Json::array()}};
  for (const PortraitOrbit& orbit : portrait.orbits) json["orbits"].push_back(orbit_json(orbit));
  for (const Isochrone& isochrone : portrait.isochrones) {
    json["isochrones"].push_back(
        {{"tau_stop", isochrone.tau_stop}, {"u", list(isochrone.u)}, {"v", list(isochrone.v)}});
  }
  if (portrait.highlight) json["highlight"] = orbit_json(*portrait.highlight);
  return json.dump() + "\n";
}

std::string to_csv(const PhasePortrait& portrait) {
  std::string csv = "kind,index,u,v,tau\n";
  for (std::size_t i = 0; i < portrait.orbits.size(); ++i) append_rows(csv, "orbit", i, portrait.orbits[i]);
  if (portrait.highlight) append_rows(csv, "highlight", 0, *portrait.highlight);
  for (std::size_t i = 0; i < portrait.isochrones.size(); ++i) {
    const Isochrone& isochrone = portrait.isochrones[i];
    for (Eigen::Index j = 0; j < isochrone.u.size(); ++j) {
      fmt::format_to(std::back_inserter(csv), "isochrone,{},{},{},{}\n", i, isochrone.u[j], isochrone.v[j],
                     isochrone.tau_stop);
    }
  }
  return csv;
}

}  // namespace contensou::portraits
