#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/json.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "data/lists.hpp"

namespace contensou::portraits {

namespace {

using Json = nlohmann::ordered_json;

/// v/(mu |u|), by its logarithm, which does not underflow. Not by Eigen's exp, which is never below 5.6e-309.
std::vector<double> ratios(const PortraitOrbit& orbit) {
  return list(orbit.ln_k.unaryExpr([](double ln_k) { return std::exp(ln_k); }));
}

Json json_of(const PortraitOrbit& orbit) {
  return {{"u", list(orbit.u)},
          {"v", list(orbit.v)},
          {"ln_v", list(orbit.ln_v)},
          {"k", ratios(orbit)},
          {"tau_left", list(orbit.tau_left)}};
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

Json origin_of(const PhasePortrait& portrait, const PortraitSource& source) {
  const reduction::ReducedSystem& system = portrait.system();
  Json json{{"law", system.law().name()},
            {"mu", system.mu()},
            {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
            {"view", name(portrait.view)},
            {"window", {portrait.window.u, portrait.window.v}}};
  if (system.drive() > 0) json["drive"] = system.drive();
  if (!source.version.empty()) json["version"] = source.version;
  if (!source.ball.empty()) json.update({{"ball", source.ball}, {"seconds_per_tau", source.seconds_per_tau}});
  return json;
}

}  // namespace

std::string to_json(const PhasePortrait& portrait, const PortraitSource& source) {
  Json json{{"schema", 1}};
  json.update(origin_of(portrait, source));
  json.update({{"orbits", json_of(portrait.orbits)}, {"isochrones", json_of(portrait.isochrones)}});
  if (portrait.highlight) json["highlight"] = json_of(*portrait.highlight);
  if (!portrait.through.empty()) json["through"] = json_of(portrait.through);
  for (const PhasePortrait& other : portrait.comparisons) {
    json["against"] = {{"law", other.system().law().name()},
                       {"orbits", json_of(other.orbits)},
                       {"isochrones", json_of(other.isochrones)}};
  }
  return json_document(json);
}

std::string to_csv(const PhasePortrait& portrait, const PortraitSource& source) {
  std::string csv = csv_remarks(origin_of(portrait, source));
  const bool timed = source.seconds_per_tau > 0;
  csv += fmt::format("kind,index,u,v,tau,ln_v,k{}\n", timed ? ",t" : "");
  const auto row = [&](std::string_view kind, std::size_t index, const PortraitOrbit::Instant& at) {
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{}", kind, index, at.u, at.v, at.tau_left, at.ln_v,
                   std::exp(at.ln_k));
    csv += timed ? fmt::format(",{}\n", source.seconds_per_tau * at.tau_left) : "\n";
  };
  const auto orbits = [&](std::string_view kind, const std::vector<PortraitOrbit>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (Eigen::Index j = 0; j < all[i].rows(); ++j) row(kind, i, all[i].at(j));
    }
  };
  const auto isochrones = [&](std::string_view kind, const PhasePortrait& of) {
    for (std::size_t i = 0; i < of.isochrones.size(); ++i) {
      const auto& [tau, u, v] = of.isochrones[i];
      for (Eigen::Index j = 0; j < u.size(); ++j) {
        row(kind, i, {u[j], v[j], std::log(v[j]), std::log(v[j] / (of.system().mu() * std::abs(u[j]))), tau});
      }
    }
  };
  orbits("orbit", portrait.orbits);
  if (portrait.highlight) orbits("highlight", {*portrait.highlight});
  orbits("through", portrait.through);
  isochrones("isochrone", portrait);
  for (const PhasePortrait& other : portrait.comparisons) {
    orbits("against_orbit", other.orbits);
    isochrones("against_isochrone", other);
  }
  return csv;
}

}  // namespace contensou::portraits
