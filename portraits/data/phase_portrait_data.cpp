#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/json.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

namespace {

using Json = nlohmann::ordered_json;

std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

Json json_of(const PortraitOrbit& orbit) {
  return {{"u", list(orbit.u)}, {"v", list(orbit.v)}, {"ln_v", list(orbit.ln_v)}, {"tau_left", list(orbit.tau_left)}};
}

Json json_of(const Isochrone& isochrone) {
  return {{"tau_stop", isochrone.tau_stop}, {"u", list(isochrone.u)}, {"v", list(isochrone.v)}};
}

template <class Curve>
Json json_of(const std::vector<Curve>& curves) {
  Json json = Json::array();
  for (const Curve& curve : curves) json.push_back(json_of(curve));
  return json;
}

double tau_at(const PortraitOrbit& orbit, Eigen::Index row) { return orbit.tau_left[row]; }
double tau_at(const Isochrone& isochrone, Eigen::Index) { return isochrone.tau_stop; }

template <class Curve>
void append(std::string& csv, std::string_view kind, const std::vector<Curve>& curves) {
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (Eigen::Index j = 0; j < curves[i].u.size(); ++j) {
      fmt::format_to(std::back_inserter(csv), "{},{},{},{},{}\n", kind, i, curves[i].u[j], curves[i].v[j],
                     tau_at(curves[i], j));
    }
  }
}

}  // namespace

std::string to_json(const PhasePortrait& portrait) {
  const reduction::ReducedSystem& system = portrait.system();
  Json json{{"schema", 1},
            {"law", system.law().name()},
            {"mu", system.mu()},
            {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
            {"view", name(portrait.view)},
            {"window", {portrait.window.u, portrait.window.v}},
            {"orbits", json_of(portrait.orbits)},
            {"isochrones", json_of(portrait.isochrones)}};
  if (portrait.highlight) json["highlight"] = json_of(*portrait.highlight);
  if (!portrait.through.empty()) json["through"] = json_of(portrait.through);
  for (const PhasePortrait& other : portrait.comparisons) {
    json["against"] = {{"law", other.system().law().name()},
                       {"orbits", json_of(other.orbits)},
                       {"isochrones", json_of(other.isochrones)}};
  }
  return json_document(json);
}

std::string to_csv(const PhasePortrait& portrait) {
  std::string csv = "kind,index,u,v,tau\n";
  append(csv, "orbit", portrait.orbits);
  if (portrait.highlight) append(csv, "highlight", std::vector{*portrait.highlight});
  append(csv, "through", portrait.through);
  append(csv, "isochrone", portrait.isochrones);
  for (const PhasePortrait& other : portrait.comparisons) {
    append(csv, "against_orbit", other.orbits);
    append(csv, "against_isochrone", other.isochrones);
  }
  return csv;
}

}  // namespace contensou::portraits
