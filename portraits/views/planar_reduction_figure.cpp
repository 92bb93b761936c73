// The symmetry of any planar system with a scaling.
#include <numbers>

#include "contensou/portraits/reduction_figure.hpp"
#include "views/reduced_panels.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using std::numbers::pi;

Figure reduction_figure(const reduction::PlanarReduction& plane, const Vector2d& start, const std::string& name,
                        const AskedSize& size) {
  const ReducedOrbits from = reduced_orbits(plane, start);
  const double p = from.start.y;
  Panel in_plane, strip;
  const Vector2d centre = plane.centre();
  const double half = plane_widths * (start - centre).lpNorm<Eigen::Infinity>(),
               first = from.rays.empty() ? 0 : from.rays[0];
  in_plane.x = {math("u"), centre[0] - half, centre[0] + half, false, {}};
  in_plane.y = {math("v"), centre[1] - half, centre[1] + half, false, {}};
  in_plane.to_scale = true;
  strip.x = {math("q") + ", the angle", first, first + 2 * pi, false, {}};
  strip.y = {math("p"), p - strip_below, p + strip_above, false, {}};
  return draw(from, in_plane, strip, "The reduction of  " + shortened(name), size);
}

}  // namespace contensou::portraits
