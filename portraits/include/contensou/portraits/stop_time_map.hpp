#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// The axes of a map: equal steps or equal ratios from the first value to the last.
struct MapAxes {
  Eigen::ArrayXd u0;  ///< increasing, two values or more
  Eigen::ArrayXd v0;  ///< the same, >= 0
  bool logarithmic = false;
};

/// Stop times over starts (u0, v0) of one system, as data; nothing here is drawn.
struct StopTimeMap {
  std::string law;
  double mu = 0;
  MapAxes axes;
  Eigen::ArrayXXd tau;                ///< a row for each v0, a column for each u0
  std::vector<Isochrone> isochrones;  ///< at round stop times, each piece of one inside the map by itself
};

/// Computes the map. Isochrones come from the flow itself, not from the map's values.
///
/// @param time_unit  in tau: isochrones are at round multiples of it
/// @throws std::domain_error  if an axis is not as MapAxes says, spans values outside 1e-100 .. 1e100, or a stop time
///                            is beyond the largest double
StopTimeMap stop_time_map(const reduction::Flow& flow, const MapAxes& axes, double time_unit = 1);

/// Words and units of a map's drawing; the defaults are the paper's.
struct MapCaption {
  Text title = {};  ///< empty: mu and the law
  Text subtitle = "stop time " + math("τ*") + " of every start, in the unit of the speeds";
  Text u = math("u") + sub("0") + ",  pivoting at the start", v = math("v") + sub("0") + ",  sliding at the start";
  Text time = math("τ*");
  double u_unit = 1;     ///< of the axis, in u
  double time_unit = 1;  ///< in tau
};

/// The map as a drawing: stop times as colours, dark for short ones, with a scale; labelled isochrones over them; the
/// ray k = 1, above which the centre of rotation is outside the patch.
Figure draw(StopTimeMap map, const MapCaption& caption = {}, const AskedSize& size = {});

}  // namespace contensou::portraits
