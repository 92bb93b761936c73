#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// A part of a switching curve on which motions slide or rest, or which they leave to both sides, reduction/planar.md
/// (R62).
struct SwitchingPart {
  reduction::SwitchingMotion::Kind motion;
  std::vector<Eigen::Vector2d> points;  ///< in the direction in which motions slide
};

/// Returns these parts of all switching curves in a rectangle. Their ends are exact to rounding. Parts shorter than
/// 1/1000 of the rectangle can be missed. Empty for a field without switching functions.
std::vector<SwitchingPart> switching_parts(const reduction::SmoothField& field, const Eigen::Vector2d& low,
                                           const Eigen::Vector2d& high);

/// Leaves out the equilibria that lie on parts at which motions rest, because they are not isolated.
void leave_out_rests(reduction::Equilibria& equilibria, const std::vector<SwitchingPart>& parts);

/// A motion along a manifold of a saddle.
struct Separatrix : PortraitOrbit {
  /// "stable": it ends in a saddle; "unstable": it begins there; "connection": it joins two saddles, or one to itself.
  std::string_view manifold;
};

/// The plane of any planar system as data, without a drawing. An isochrone is a line of states with the same time to
/// the centre of the scaling, or to infinity.
struct PlanarPortrait : Portrait {
  std::string name;  ///< name of the system
  reduction::PlanarReduction plane;
  std::array<std::string, 2> variables = {"u", "v"};  ///< names on the axes, such as x and x'
  std::map<std::string, double> parameters = {};      ///< values of letters in the name, for the subtitle
  reduction::Equilibria equilibria = {};              ///< equilibria in the window
  std::vector<SwitchingPart> switching = {};          ///< sliding, rest and ambiguity on switching curves
  /// For portrait_on_disc: the Poincaré disc. Then orbits are computed by steps, and there are no
  /// isochrones. `equilibria` contains those of the finite plane, and the curves are in u and v, too.
  std::optional<reduction::PoincareDisc> disc = {};
  // Only for a system without a scaling:
  std::vector<reduction::LimitCycle> cycles = {};             ///< limit cycles, also outside the window
  std::vector<Separatrix> separatrices = {};                  ///< separatrices of the saddles
  std::vector<PortraitOrbit> lines_of_equilibria = {};        ///< curves on which the field is 0
  std::vector<PortraitOrbit> invariant = {};                  ///< curves on which the inverse integrating factor V is 0
  std::array<std::vector<PortraitOrbit>, 2> nullclines = {};  ///< curves u' = 0 and v' = 0, on request
};

/// Computes the portrait. Each orbit goes through the middle of the widest gap between earlier lines. The default
/// window of a system with a scaling is a square about the centre that contains the requested points, or |u|, |v| <= 1.
/// The default window of another system contains the equilibria near the origin, the limit cycles about them, the
/// requested points and the separatrices that stay near these. It is the positive quadrant for a population, whose axes
/// are orbits, and one and a half periods of a periodic field.
///
/// If there is a scaling, every orbit is a scaled copy of the curve of its sector, and isochrones are copies likewise.
/// If there is only an inverse integrating factor, quadrature gives the orbits, and there are no isochrones. Without a
/// reduction (reduction::by_steps), orbits are computed by steps in time.
///
/// @param name  name of the system, for titles
/// @throws std::domain_error  if the window is empty or not finite, if a point lies outside it or the field has no
///                            value there, if a number is negative, or if the request has a part that is only for (2.6)
PlanarPortrait planar_portrait(const reduction::PlanarReduction& plane, std::string name,
                               const PortraitRequest& request = {});

/// Computes the portrait of the whole plane on the Poincaré disc. The radius of the disc follows from the window.
/// @throws std::domain_error  as planar_portrait and reduction::poincare_disc
PlanarPortrait portrait_on_disc(const reduction::PlanarReduction& plane, std::string name,
                                const PortraitRequest& request = {});

/// Return the portrait as JSON or CSV; `contensou help fields` describes members and columns. On
/// the disc, u and v near infinity are cut at a thousand million times the radius.
std::string to_json(const PlanarPortrait& portrait, const PortraitSource& source = {});
std::string to_csv(const PlanarPortrait& portrait, const PortraitSource& source = {});

/// Returns the members kind, eigenvalues [[re, im], [re, im]] and index of an equilibrium.
/// @tparam Json  nlohmann::ordered_json
template <class Json>
Json members_of_kind(const reduction::Equilibrium& each) {
  Json json{{"kind", each.kind}, {"eigenvalues", nullptr}};
  if (each.eigenvalues) {
    const auto& [first, second] = *each.eigenvalues;
    json["eigenvalues"] = {{first.real(), first.imag()}, {second.real(), second.imag()}};
  }
  json["index"] = each.index ? Json(*each.index) : Json();
  return json;
}

/// Returns the members equilibria [{u, v, kind, eigenvalues [[re, im], [re, im]], index}], equilibria_within [[u, u],
/// [v, v]], equilibria_complete and equilibria_curve [u, v], a point of a curve of equilibria or null. Eigenvalues that
/// do not exist and an index that is not known are null.
/// @tparam Json  nlohmann::ordered_json
template <class Json>
Json equilibria_members(const reduction::Equilibria& equilibria) {
  Json list = Json::array();
  for (const reduction::Equilibrium& each : equilibria.points) {
    list.push_back(Json{{"u", each.x[0]}, {"v", each.x[1]}});
    list.back().update(members_of_kind<Json>(each));
  }
  const auto &low = equilibria.low, &high = equilibria.high;
  return {
      {"equilibria", list},
      {"equilibria_within", {{low[0], high[0]}, {low[1], high[1]}}},
      {"equilibria_complete", equilibria.complete},
      {"equilibria_curve", equilibria.on_curve ? Json{(*equilibria.on_curve)[0], (*equilibria.on_curve)[1]} : Json()}};
}

/// Returns the members u, v, period, multiplier and stable of a limit cycle; a multiplier that is not certain is null.
/// @tparam Json  nlohmann::ordered_json
template <class Json>
Json cycle_members(const reduction::LimitCycle& cycle) {
  return {{"u", cycle.x[0]},
          {"v", cycle.x[1]},
          {"period", cycle.period},
          {"multiplier", std::isnan(cycle.multiplier) ? Json() : Json(cycle.multiplier)},
          {"stable", cycle.stable}};
}

/// Returns the member switching [{motion, u [...], v [...]}]; motion is "slides", "rests" or "leaves".
/// @tparam Json  nlohmann::ordered_json
template <class Json>
Json switching_member(const std::vector<SwitchingPart>& parts) {
  using Kind = reduction::SwitchingMotion::Kind;
  Json list = Json::array();
  for (const SwitchingPart& part : parts) {
    Json u = Json::array(), v = Json::array();
    for (const Eigen::Vector2d& x : part.points) {
      u.push_back(x[0]);
      v.push_back(x[1]);
    }
    const char* motion = part.motion == Kind::slides ? "slides" : part.motion == Kind::rests ? "rests" : "leaves";
    list.push_back({{"motion", motion}, {"u", std::move(u)}, {"v", std::move(v)}});
  }
  return list;
}

/// Draws the portrait. In PortraitStyle::Field, motion and regularised both mean the directions of the field.
Figure draw(const PlanarPortrait& portrait, const PortraitStyle& style = {});

}  // namespace contensou::portraits
