#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/json.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "data/lists.hpp"
#include "data/regularised_time.hpp"

namespace contensou::portraits {

namespace {

using Json = nlohmann::ordered_json;

/// Returns v/(mu |u|) from its logarithm, which does not underflow. Eigen's exp never gives less than 5.6e-309.
std::vector<double> ratios(const PortraitOrbit& orbit) {
  return list(orbit.ln_k.unaryExpr([](double ln_k) { return std::exp(ln_k); }));
}

/// Returns true if beta is an axis of the view. The data then contain it for each state of an orbit.
bool has_beta(const PhasePortrait& portrait) { return portrait.view == View::regularised; }

Json json_of(const PhasePortrait& of, const PortraitOrbit& orbit) {
  Json json{{"u", list(orbit.u)}, {"v", list(orbit.v)}, {"ln_v", list(orbit.ln_v)}, {"k", ratios(orbit)}};
  if (has_beta(of)) {
    if (const Eigen::ArrayXd betas = regularised_times(of.flow, orbit); betas.size() > 0) json["beta"] = list(betas);
  }
  json["tau_left"] = list(orbit.tau_left);
  return json;
}

Json json_of(const PhasePortrait&, const Isochrone& isochrone) {
  return {{"tau_stop", isochrone.tau_stop}, {"u", list(isochrone.u)}, {"v", list(isochrone.v)}};
}

template <class Curve>
Json json_of(const PhasePortrait& of, const std::vector<Curve>& curves) {
  Json json = Json::array();
  for (const Curve& curve : curves) json.push_back(json_of(of, curve));
  return json;
}

/// Returns [U, V], or for a part [[U1, U2], [V1, V2]].
Json window_of(const PhasePortrait& portrait) {
  const auto& [u, v] = portrait.window;
  const auto& [u_low, u_high, v_low, v_high] = portrait.part;
  if (u_low == -u && u_high == u && v_low == 0 && v_high == v) return {u, v};
  return {{u_low, u_high}, {v_low, v_high}};
}

Json origin_of(const PhasePortrait& portrait, const PortraitSource& source) {
  const reduction::ReducedSystem& system = portrait.system();
  Json json{{"law", system.law().name()},
            {"mu", system.mu()},
            {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
            {"view", name(portrait.view)},
            {"window", window_of(portrait)}};
  if (system.drive() > 0) json["drive"] = system.drive();
  if (!source.version.empty()) json["version"] = source.version;
  if (!source.ball.empty()) json.update({{"ball", source.ball}, {"seconds_per_tau", source.seconds_per_tau}});
  return json;
}

/// Returns all members except the schema.
Json members_of(const PhasePortrait& portrait, const PortraitSource& source) {
  Json json = origin_of(portrait, source);
  json.update({{"orbits", json_of(portrait, portrait.orbits)}, {"isochrones", json_of(portrait, portrait.isochrones)}});
  if (portrait.highlight) json["highlight"] = json_of(portrait, *portrait.highlight);
  if (!portrait.through.empty()) json["through"] = json_of(portrait, portrait.through);
  for (const PhasePortrait& other : portrait.comparisons) {
    json["against"] = {{"law", other.system().law().name()},
                       {"orbits", json_of(other, other.orbits)},
                       {"isochrones", json_of(other, other.isochrones)}};
  }
  return json;
}

/// Returns a name as a CSV cell, quoted if necessary.
std::string cell(const std::string& name) {
  if (name.find_first_of(",\"\n") == name.npos) return name;
  std::string quoted;
  for (char each : name) quoted += each == '"' ? "\"\"" : std::string(1, each);
  return '"' + quoted + '"';
}

/// Returns the rows of a portrait as CSV.
/// @param lead  first cells of each row
std::string rows_of(const PhasePortrait& portrait, const PortraitSource& source, const std::string& lead) {
  std::string csv;
  const bool timed = source.seconds_per_tau > 0;
  const bool regularised = has_beta(portrait);
  const auto row = [&](std::string_view kind, std::size_t index, const PortraitOrbit::Instant& at,
                       std::optional<double> beta) {
    fmt::format_to(std::back_inserter(csv), "{}{},{},{},{},{},{},{}", lead, kind, index, at.u, at.v, at.tau_left,
                   at.ln_v, std::exp(at.ln_k));
    if (regularised) csv += beta ? fmt::format(",{}", *beta) : ",";
    csv += timed ? fmt::format(",{}\n", source.seconds_per_tau * at.tau_left) : "\n";
  };
  const auto orbits = [&](std::string_view kind, const PhasePortrait& of, const std::vector<PortraitOrbit>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Eigen::ArrayXd betas = regularised ? regularised_times(of.flow, all[i]) : Eigen::ArrayXd();
      for (Eigen::Index j = 0; j < all[i].rows(); ++j) {
        row(kind, i, all[i].at(j), betas.size() > 0 ? std::optional(betas[j]) : std::nullopt);
      }
    }
  };
  const auto isochrones = [&](std::string_view kind, const PhasePortrait& of) {
    for (std::size_t i = 0; i < of.isochrones.size(); ++i) {
      const auto& [tau, u, v] = of.isochrones[i];
      for (Eigen::Index j = 0; j < u.size(); ++j) {
        row(kind, i, {u[j], v[j], std::log(v[j]), std::log(v[j] / (of.system().mu() * std::abs(u[j]))), tau}, {});
      }
    }
  };
  orbits("orbit", portrait, portrait.orbits);
  if (portrait.highlight) orbits("highlight", portrait, {*portrait.highlight});
  orbits("through", portrait, portrait.through);
  isochrones("isochrone", portrait);
  for (const PhasePortrait& other : portrait.comparisons) {
    orbits("against_orbit", other, other.orbits);
    isochrones("against_isochrone", other);
  }
  return csv;
}

std::string heading_of(const PhasePortrait& portrait, const PortraitSource& source) {
  return fmt::format("kind,index,u,v,tau,ln_v,k{}{}\n", has_beta(portrait) ? ",beta" : "",
                     source.seconds_per_tau > 0 ? ",t" : "");
}

}  // namespace

std::string to_json(const PhasePortrait& portrait, const PortraitSource& source) {
  Json json{{"schema", 1}};
  json.update(members_of(portrait, source));
  return json_document(json);
}

std::string to_json(const std::vector<PhasePortrait>& portraits, const PortraitSource& source) {
  if (portraits.size() == 1) return to_json(portraits.front(), source);
  Json all = Json::array();
  for (const PhasePortrait& portrait : portraits) all.push_back(members_of(portrait, source));
  return json_document(Json{{"schema", 1}, {"portraits", all}});
}

std::string to_csv(const PhasePortrait& portrait, const PortraitSource& source) {
  return csv_remarks(origin_of(portrait, source)) + heading_of(portrait, source) + rows_of(portrait, source, "");
}

std::string to_csv(const std::vector<PhasePortrait>& portraits, const PortraitSource& source) {
  if (portraits.size() == 1) return to_csv(portraits.front(), source);
  std::string csv;
  for (const PhasePortrait& portrait : portraits) csv += csv_remarks(origin_of(portrait, source));
  csv += "mu,law," + heading_of(portraits.front(), source);
  for (const PhasePortrait& portrait : portraits) {
    csv +=
        rows_of(portrait, source, fmt::format("{},{},", portrait.system().mu(), cell(portrait.system().law().name())));
  }
  return csv;
}

}  // namespace contensou::portraits
