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

/// A piece of an orbit that lies in the window. Equal lengths, in the way of the motion.
struct PlanarPortraitOrbit {
  Eigen::ArrayXd u, v;
  Eigen::ArrayXd tau_left;  ///< until it is at the centre, or at infinity; infinite if it takes for ever
};

/// The plane of any system, as data; nothing here is drawn.
struct PlanarPortrait {
  std::string name;  ///< of the system
  reduction::PlanarReduction plane;
  PlanarWindow window;
  std::vector<PlanarPortraitOrbit> orbits;
  std::vector<Isochrone> isochrones;           ///< of the time to the centre, or to infinity, in the window
  double isochrone_step;                       ///< as PhasePortrait's
  std::vector<PlanarPortraitOrbit> highlight;  ///< the orbit of one start, from there on; none, or its pieces
  std::vector<PlanarPortraitOrbit> through;    ///< the orbits through the points asked for
  std::vector<Eigen::Vector2d> points;         ///< those points
  // Without a scaling:
  std::vector<reduction::Equilibrium> equilibria = {};  ///< in the window
  std::vector<PlanarPortraitOrbit> separatrices = {};   ///< of its saddles
};

/// What to show.
struct PlanarPortraitRequest {
  std::optional<PlanarWindow> window = {};  ///< else a rectangle about the centre:
  std::optional<Eigen::Vector2d> sides =
      {};  ///< half its sides; else a square that contains all of the following, or 1
  std::optional<Eigen::Vector2d> highlight = {};
  std::vector<Eigen::Vector2d> through = {};
  std::optional<int> orbits = {};            ///< so many, >= 0; else as many as fill the window, and one of each sector
  std::optional<int> isochrones = {};        ///< so many, >= 0, as nearly as round times allow; about 7 if not said
  std::vector<double> isochrone_times = {};  ///< of exactly these times, each > 0, whatever the count
};

/// Computes the portrait: each orbit goes through the middle of the widest gap that is left. By a scaling each is one
/// curve of its sector, moved, and so is each isochrone; by V alone each is a quadrature of its own, and there are no
/// isochrones. Without a reduction (reduction::by_steps) orbits are steps in time.
///
/// @param name  of the system, for titles
/// @throws std::domain_error  if the window is empty or not finite, for a point out of it or without a value of the
///                            field, and if a number is negative
PlanarPortrait planar_portrait(const reduction::PlanarReduction& plane, std::string name,
                               const PlanarPortraitRequest& request = {});

/// The portrait as JSON: schema, system, kind, centre [u, v], window [[u, u], [v, v]], rays [{angle, attracts, to_centre}],
/// orbits [{u, v, tau_left}], isochrones [{tau_stop, u, v}], and where asked for highlight and through (orbits). Without
/// a scaling centre is null, and form, equilibria [{u, v, kind, eigenvalues [[re, im], [re, im]]}] and separatrices
/// (orbits) are there.
std::string to_json(const PlanarPortrait& portrait, const PortraitSource& source = {});

/// As CSV with the columns kind,index,u,v,tau; kind is orbit, highlight, through, separatrix
/// or isochrone, tau the time left.
std::string to_csv(const PlanarPortrait& portrait, const PortraitSource& source = {});

/// As a drawing. Of the style counts all but `asked`; both kinds of directions are those of the field.
Figure draw(const PlanarPortrait& portrait, const PortraitStyle& style = {});

}  // namespace contensou::portraits
