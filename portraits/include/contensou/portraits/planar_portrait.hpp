#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "contensou/reduction/equilibria.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// A rectangle of the plane, by two corners.
struct PlanarWindow {
  Eigen::Vector2d low, high;
};

/// A part of an orbit within the window, as columns of equal length in the direction of the motion.
struct PlanarPortraitOrbit {
  Eigen::ArrayXd u, v;
  Eigen::ArrayXd tau_left;  ///< time until the centre or infinity; infinite if it takes for ever
};

/// The plane of any planar system as data, without a drawing.
struct PlanarPortrait {
  std::string name;  ///< name of the system
  reduction::PlanarReduction plane;
  PlanarWindow window;
  std::vector<PlanarPortraitOrbit> orbits;
  std::vector<Isochrone> isochrones;  ///< isochrones of the time to the centre, or to infinity, in the window
  double isochrone_step;              ///< step between isochrones, see PhasePortrait
  /// Parts of the orbit of one start, from the start on; empty if not requested.
  std::vector<PlanarPortraitOrbit> highlight;
  std::vector<PlanarPortraitOrbit> through;  ///< orbits through the requested points
  std::vector<Eigen::Vector2d> points;       ///< the requested points
  // Only without a scaling:
  std::vector<reduction::Equilibrium> equilibria = {};  ///< equilibria in the window
  std::vector<PlanarPortraitOrbit> separatrices = {};   ///< separatrices of the saddles
  std::vector<Polyline> invariant = {};                 ///< curves on which the inverse integrating factor V is 0
};

/// The contents of a portrait.
struct PlanarPortraitRequest {
  std::optional<PlanarWindow> window = {};  ///< window; the default is a rectangle about the centre
  /// Half the sides of that rectangle. By default it is a square that contains the points below; without points 1.
  std::optional<Eigen::Vector2d> sides = {};
  std::optional<Eigen::Vector2d> highlight = {};
  std::vector<Eigen::Vector2d> through = {};
  /// Number of orbits, >= 0; by default enough to fill the window, and one in each sector.
  std::optional<int> orbits = {};
  /// Number of isochrones, >= 0, approximate because times are round; about 7 by default.
  std::optional<int> isochrones = {};
  std::vector<double> isochrone_times = {};  ///< times of isochrones, each > 0; they replace the number
};

/// Computes the portrait. Each orbit goes through the middle of the widest gap that is left.
///
/// A scaling makes every orbit, and every isochrone, the scaled curve of its sector. An inverse integrating factor
/// alone gives every orbit by a quadrature, without isochrones. A plane without a reduction (reduction::by_steps) has
/// orbits by steps in time.
///
/// @param name  name of the system, for titles
/// @throws std::domain_error  if the window is empty or not finite, if a point lies outside it or the field has no
///                            value there, or if a number is negative
PlanarPortrait planar_portrait(const reduction::PlanarReduction& plane, std::string name,
                               const PlanarPortraitRequest& request = {});

/// Returns the portrait as JSON.
///
/// Members: schema, system, kind, centre [u, v], window [[u, u], [v, v]], rays [{angle, attracts, to_centre}], orbits
/// [{u, v, tau_left}], isochrones [{tau_stop, u, v}]; if requested highlight and through (orbits). Without a scaling:
/// centre null, form, equilibria [{u, v, kind, eigenvalues [[re, im], [re, im]]}], separatrices (orbits)
/// and invariant [{u, v}], the curves V = 0.
std::string to_json(const PlanarPortrait& portrait, const PortraitSource& source = {});

/// Returns equilibria as members of JSON, as to_json has them.
/// @tparam Json  nlohmann::ordered_json
template <class Json>
Json equilibria_json(const std::vector<reduction::Equilibrium>& equilibria) {
  Json json = Json::array();
  for (const reduction::Equilibrium& each : equilibria) {
    const auto [first, second] = each.eigenvalues();
    json.push_back({{"u", each.x[0]},
                    {"v", each.x[1]},
                    {"kind", each.kind()},
                    {"eigenvalues", {{first.real(), first.imag()}, {second.real(), second.imag()}}}});
  }
  return json;
}

/// Returns the portrait as CSV with the columns kind,index,u,v,tau. kind is orbit, highlight, through, separatrix or
/// isochrone; tau is the time left.
std::string to_csv(const PlanarPortrait& portrait, const PortraitSource& source = {});

/// Draws the portrait. The style's `asked` is ignored; both kinds of directions are those of the field.
Figure draw(const PlanarPortrait& portrait, const PortraitStyle& style = {});

}  // namespace contensou::portraits
