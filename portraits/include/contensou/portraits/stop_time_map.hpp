#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// The axes of a map. Values have equal steps or equal ratios from the first to the last.
struct MapAxes {
  Eigen::ArrayXd u0;  ///< increasing, two values or more
  Eigen::ArrayXd v0;  ///< increasing, two values or more, >= 0
  bool logarithmic = false;
};

/// The stop times of starts (u0, v0) of one system as data, without a drawing.
struct StopTimeMap {
  std::string law;
  double mu = 0;
  MapAxes axes;
  Eigen::ArrayXXd tau;                ///< stop times: one row for each v0, one column for each u0
  std::vector<Isochrone> isochrones;  ///< isochrones at round stop times, in parts that lie inside the map
};

/// Computes the map. Isochrones are computed from the flow, not from the values of the map.
///
/// @param time_unit  unit of time, in tau; isochrones are at round multiples of it
/// @throws std::domain_error  if an axis is not as MapAxes requires, values are outside 1e-100 to 1e100, or a stop time
///                            overflows
StopTimeMap stop_time_map(const reduction::Flow& flow, const MapAxes& axes, double time_unit = 1);

/// Texts and units of a map's drawing. The defaults suit the dimensionless system.
struct MapCaption {
  Text title = {};  ///< if empty, mu and the law
  Text subtitle = "stop time " + math("τ*") + " of every start, in the unit of the speeds";
  Text u = math("u") + sub("0") + ",  spin at the start", v = math("v") + sub("0") + ",  slip at the start";
  Text time = math("τ*");
  double u_unit = 1;     ///< number of u in one unit of the axes
  double time_unit = 1;  ///< number of tau in one unit of time
};

/// Draws the map: stop times as colours, dark for short times, with a colour scale and labelled isochrones, and the ray
/// k = 1. Above this ray the centre of rotation lies outside the patch.
Figure draw(StopTimeMap map, const MapCaption& caption = {}, const AskedSize& size = {});

}  // namespace contensou::portraits
