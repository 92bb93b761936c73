#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/json.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "data/lists.hpp"

namespace contensou::portraits {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::vector<PlanarPortraitOrbit>& orbits) {
  Json json = Json::array();
  for (const auto& [u, v, left] : orbits) json.push_back({{"u", list(u)}, {"v", list(v)}, {"tau_left", list(left)}});
  return json;
}

Json origin_of(const PlanarPortrait& portrait, const PortraitSource& source) {
  Json rays = Json::array();
  for (const auto& ray : portrait.plane.rays()) {
    rays.push_back({{"angle", ray.q}, {"attracts", ray.attracts}, {"to_centre", ray.to_centre}});
  }
  const auto& [low, high] = portrait.window;
  const reduction::PlanarReduction& plane = portrait.plane;
  Json json{{"system", portrait.name},
            {"kind", portrait.plane.kind().empty() ? Json() : Json(portrait.plane.kind())},
            {"centre", plane.scaling() ? Json{plane.centre()[0], plane.centre()[1]} : Json()},
            {"window", {{low[0], high[0]}, {low[1], high[1]}}},
            {"rays", rays}};
  if (!plane.scaling()) {
    json["form"] = plane.form().empty() ? Json() : Json(plane.form());
    json["equilibria"] = equilibria_json<Json>(portrait.equilibria);
  }
  if (!source.version.empty()) json["version"] = source.version;
  return json;
}

}  // namespace

std::string to_json(const PlanarPortrait& portrait, const PortraitSource& source) {
  Json json{{"schema", 1}};
  json.update(origin_of(portrait, source));
  json["orbits"] = json_of(portrait.orbits);
  json["isochrones"] = Json::array();
  for (const auto& [time, u, v] : portrait.isochrones) {
    json["isochrones"].push_back({{"tau_stop", time}, {"u", list(u)}, {"v", list(v)}});
  }
  if (!portrait.highlight.empty()) json["highlight"] = json_of(portrait.highlight);
  if (!portrait.through.empty()) json["through"] = json_of(portrait.through);
  if (!portrait.separatrices.empty()) json["separatrices"] = json_of(portrait.separatrices);
  for (const Polyline& line : portrait.invariant) {
    Json curve{{"u", Json::array()}, {"v", Json::array()}};
    for (const Point& at : line) {
      curve["u"].push_back(at.x);
      curve["v"].push_back(at.y);
    }
    json["invariant"].push_back(std::move(curve));
  }
  return json_document(json);
}

std::string to_csv(const PlanarPortrait& portrait, const PortraitSource& source) {
  std::string csv = csv_remarks(origin_of(portrait, source));
  csv += "kind,index,u,v,tau\n";
  const auto row = [&](std::string_view kind, std::size_t index, double u, double v, double time) {
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{}\n", kind, index, u, v, time);
  };
  const auto orbits = [&](std::string_view kind, const std::vector<PlanarPortraitOrbit>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (Eigen::Index j = 0; j < all[i].u.size(); ++j) row(kind, i, all[i].u[j], all[i].v[j], all[i].tau_left[j]);
    }
  };
  orbits("orbit", portrait.orbits);
  orbits("highlight", portrait.highlight);
  orbits("through", portrait.through);
  orbits("separatrix", portrait.separatrices);
  for (std::size_t i = 0; i < portrait.invariant.size(); ++i) {
    for (const Point& at : portrait.invariant[i]) row("invariant", i, at.x, at.y, infinity);
  }
  for (std::size_t i = 0; i < portrait.isochrones.size(); ++i) {
    const auto& [time, u, v] = portrait.isochrones[i];
    for (Eigen::Index j = 0; j < u.size(); ++j) row("isochrone", i, u[j], v[j], time);
  }
  return csv;
}

}  // namespace contensou::portraits
