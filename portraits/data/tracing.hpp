#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Checks the numbers of a request, and that its points lie in the window.
/// @throws std::domain_error  if a number is negative, or a point is not finite or lies outside
void require(const PortraitRequest& request, const Window& window);

/// Returns an empty panel whose axes are those of a window.
Panel panel_of(const Window& window);

/// Returns a line as columns, with the same time left at every point.
PortraitOrbit columns(const Polyline& line, double tau_left);

/// Appends the points of a curve at the given places, and points between them until neighbours are near.
/// @param track     points of the curve up to the place `from`, at least one
/// @param at        returns the point at a place
/// @param distance  returns the visible distance of two points, in units of the largest allowed distance
template <class Place, class At, class Distance>
void refine(std::vector<Place>& track, double from, const std::vector<double>& places, At at, Distance distance) {
  std::vector<std::pair<double, Place>> open;  // the next point is at the back
  for (double place : places) open.insert(open.begin(), {place, at(place)});
  while (!open.empty()) {
    const auto [place, point] = open.back();
    constexpr double closest = 1e-5;
    if (std::abs(place - from) > closest && distance(track.back(), point) > 1) {
      const double middle = (from + place) / 2;
      open.emplace_back(middle, at(middle));
      continue;
    }
    constexpr double near = 0.3;
    if (distance(track.back(), point) > near) track.push_back(point);
    from = place;
    open.pop_back();
  }
}

/// Returns true if a motion is one orbit of a flow and therefore has a regularised time. A ball that, under
/// rolling friction, turns during only a part of its motion has several orbits.
bool is_one_orbit(const reduction::Flow& flow, const PortraitOrbit& motion);

}  // namespace contensou::portraits
