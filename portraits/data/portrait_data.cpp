// The data of portraits as JSON and as CSV.
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contensou/portraits/json.hpp"
#include "contensou/portraits/planar_portrait.hpp"

namespace contensou::portraits {

namespace {

using Json = nlohmann::ordered_json;

std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

Json json_of(const PortraitOrbit& orbit) {
  Json json{{"u", list(orbit.u)}, {"v", list(orbit.v)}};
  if (orbit.ln_v.size() > 0) {
    json["ln_v"] = list(orbit.ln_v);
    // The logarithm does not underflow, but Eigen's exp does not return numbers below 5.6e-309.
    json["k"] = list(orbit.ln_k.unaryExpr([](double ln_k) { return std::exp(ln_k); }));
  }
  if (orbit.beta.size() > 0) json["beta"] = list(orbit.beta);
  json["tau_left"] = list(orbit.tau_left);
  return json;
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

/// Adds the curves that the portraits of all systems have.
void add_curves(Json& json, const Portrait& portrait) {
  json["orbits"] = json_of(portrait.orbits);
  json["isochrones"] = json_of(portrait.isochrones);
  // The motion of (2.6) is one orbit; that of another system has parts in the window.
  const auto& highlight = portrait.highlight;
  if (!highlight.empty()) json["highlight"] = highlight[0].ln_v.size() > 0 ? json_of(highlight[0]) : json_of(highlight);
  if (!portrait.through.empty()) json["through"] = json_of(portrait.through);
  if (!portrait.uncoupled.empty()) json["uncoupled"] = json_of(portrait.uncoupled);
}

/// The curves of a portrait as rows of CSV.
struct Table {
  const PhasePortrait* of = nullptr;  ///< portrait of (2.6), whose rows have ln_v and k; null for another system
  double seconds_per_tau = 0;         ///< if > 0, the table has a column t in seconds
  std::string lead = {};              ///< first cells of each row
  bool has_beta = of != nullptr && of->view == View::regularised;
  std::string rows = {};

  std::string heading() const {
    return fmt::format("kind,index,u,v,tau{}{}{}\n", of ? ",ln_v,k" : "", has_beta ? ",beta" : "",
                       seconds_per_tau > 0 ? ",t" : "");
  }
  void add(std::string_view kind, const std::vector<PortraitOrbit>& orbits) {
    for (std::size_t i = 0; i < orbits.size(); ++i) {
      for (Eigen::Index j = 0; j < orbits[i].rows(); ++j) {
        add(kind, i, orbits[i].at(j), orbits[i].beta.size() > 0 ? fmt::format("{}", orbits[i].beta[j]) : "");
      }
    }
  }
  void add(std::string_view kind, const std::vector<Isochrone>& isochrones) {
    for (std::size_t i = 0; i < isochrones.size(); ++i) {
      const auto& [tau, u, v] = isochrones[i];
      for (Eigen::Index j = 0; j < u.size(); ++j) {
        const double ln_k = of ? std::log(v[j] / (of->system().mu() * std::abs(u[j]))) : 0;
        add(kind, i, {u[j], v[j], std::log(v[j]), ln_k, tau}, "");
      }
    }
  }
  void add(std::string_view kind, std::size_t index, const PortraitOrbit::Instant& at, std::string_view beta) {
    fmt::format_to(std::back_inserter(rows), "{}{},{},{},{},{}", lead, kind, index, at.u, at.v, at.tau_left);
    if (of) fmt::format_to(std::back_inserter(rows), ",{},{}", at.ln_v, std::exp(at.ln_k));
    if (has_beta) fmt::format_to(std::back_inserter(rows), ",{}", beta);
    rows += seconds_per_tau > 0 ? fmt::format(",{}\n", seconds_per_tau * at.tau_left) : "\n";
  }
};

/// Adds the source to the members that describe the plane.
Json origin_of(Json json, const PortraitSource& source) {
  if (!source.version.empty()) json["version"] = source.version;
  if (!source.ball.empty()) json.update({{"ball", source.ball}, {"seconds_per_tau", source.seconds_per_tau}});
  return json;
}

Json ends_of(const Window& window) {
  const auto& [low, high] = window;
  return {{low[0], high[0]}, {low[1], high[1]}};
}

Json origin_of(const PhasePortrait& portrait, const PortraitSource& source) {
  const reduction::ReducedSystem& system = portrait.system();
  const auto& [low, high] = portrait.window;
  Json json{{"law", system.law().name()},
            {"mu", system.mu()},
            {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
            {"view", name(portrait.view)},
            {"window", low[0] == -high[0] && low[1] == 0 ? Json{high[0], high[1]} : ends_of(portrait.window)}};
  if (system.drive() > 0) json["drive"] = system.drive();
  return origin_of(std::move(json), source);
}

Json origin_of(const PlanarPortrait& portrait, const PortraitSource& source) {
  const reduction::PlanarReduction& plane = portrait.plane;
  Json rays = Json::array();
  for (const auto& ray : plane.rays()) {
    rays.push_back({{"angle", ray.q}, {"attracts", ray.attracts}, {"to_centre", ray.to_centre}});
  }
  Json json{{"system", portrait.name},
            {"variables", portrait.variables},
            {"kind", plane.kind().empty() ? Json() : Json(plane.kind())},
            {"centre", plane.scaling() ? Json{plane.centre()[0], plane.centre()[1]} : Json()},
            {"window", ends_of(portrait.window)},
            {"rays", rays}};
  if (!plane.scaling()) json["form"] = plane.form().empty() ? Json() : Json(plane.form());
  json.update(equilibria_members<Json>(portrait.equilibria));
  json["switching"] = switching_member<Json>(portrait.switching);
  if (portrait.disc) {
    json.update({{"view", name(View::disc)}, {"degree", portrait.disc->degree}, {"radius", portrait.disc->radius}});
    json["at_infinity"] = Json::array();
    for (const reduction::Equilibrium& each : portrait.disc->at_infinity) {
      json["at_infinity"].push_back({{"angle", std::atan2(each.x[1], each.x[0])}});
      json["at_infinity"].back().update(members_of_kind<Json>(each));
    }
  }
  return origin_of(std::move(json), source);
}

/// Returns all members except the schema.
Json members_of(const PhasePortrait& portrait, const PortraitSource& source) {
  Json json = origin_of(portrait, source);
  add_curves(json, portrait);
  for (const PhasePortrait& other : portrait.comparisons) {
    json["against"] = {{"law", other.system().law().name()},
                       {"orbits", json_of(other.orbits)},
                       {"isochrones", json_of(other.isochrones)}};
  }
  return json;
}

/// Returns a name as a CSV cell, quoted if necessary.
std::string cell(const std::string& name) {
  if (name.find_first_of(",\"\n") == std::string::npos) return name;
  std::string quoted;
  for (char each : name) quoted += each == '"' ? "\"\"" : std::string(1, each);
  return '"' + quoted + '"';
}

}  // namespace

std::string to_json(const std::vector<PhasePortrait>& portraits, const PortraitSource& source) {
  Json json{{"schema", 1}};
  for (const PhasePortrait& portrait : portraits) {
    if (portraits.size() == 1) json.update(members_of(portrait, source));
    if (portraits.size() > 1) json["portraits"].push_back(members_of(portrait, source));
  }
  return json_document(json);
}

std::string to_json(const PlanarPortrait& portrait, const PortraitSource& source) {
  Json json{{"schema", 1}};
  json.update(origin_of(portrait, source));
  add_curves(json, portrait);
  for (const Separatrix& each : portrait.separatrices) {
    json["separatrices"].push_back(json_of(each));
    json["separatrices"].back()["manifold"] = each.manifold;
  }
  const auto add_lines = [&](const char* name, const std::vector<PortraitOrbit>& lines) {
    for (const auto& line : lines) json[name].push_back({{"u", list(line.u)}, {"v", list(line.v)}});
  };
  add_lines("invariant", portrait.invariant);
  add_lines("equilibria_lines", portrait.lines_of_equilibria);
  add_lines("u_nullclines", portrait.nullclines[0]);
  add_lines("v_nullclines", portrait.nullclines[1]);
  json["cycles"] = Json::array();
  for (const reduction::LimitCycle& each : portrait.cycles) json["cycles"].push_back(cycle_members<Json>(each));
  return json_document(json);
}

std::string to_csv(const std::vector<PhasePortrait>& portraits, const PortraitSource& source) {
  const bool several = portraits.size() > 1;
  std::string remarks, heading, rows;
  for (const PhasePortrait& portrait : portraits) {
    const reduction::ReducedSystem& system = portrait.system();
    Table table{&portrait, source.seconds_per_tau};
    if (several) table.lead = fmt::format("{},{},", system.mu(), cell(system.law().name()));
    heading = table.heading();
    table.add("orbit", portrait.orbits);
    table.add("highlight", portrait.highlight);
    table.add("through", portrait.through);
    table.add("uncoupled", portrait.uncoupled);
    table.add("isochrone", portrait.isochrones);
    for (const PhasePortrait& other : portrait.comparisons) {
      table.of = &other;
      table.add("against_orbit", other.orbits);
      table.add("against_isochrone", other.isochrones);
    }
    remarks += csv_remarks(origin_of(portrait, source));
    rows += table.rows;
  }
  return remarks + (several ? "mu,law," : "") + heading + rows;
}

std::string to_csv(const PlanarPortrait& portrait, const PortraitSource& source) {
  Table table;
  table.add("orbit", portrait.orbits);
  table.add("highlight", portrait.highlight);
  table.add("through", portrait.through);
  table.add("separatrix", std::vector<PortraitOrbit>(portrait.separatrices.begin(), portrait.separatrices.end()));
  table.add("invariant", portrait.invariant);
  table.add("isochrone", portrait.isochrones);
  return csv_remarks(origin_of(portrait, source)) + table.heading() + table.rows;
}

}  // namespace contensou::portraits
