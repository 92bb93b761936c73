#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "views/panel_layers.hpp"

namespace contensou::portraits {

/// The data and options from which a view is drawn.
struct Drawing : CurveDrawing {
  const PhasePortrait& portrait;

  /// Converts a number of lines that suits a panel 100 mm wide into a number for this panel.
  int crowd(int count) const {
    return std::max(count / 2, std::min(count, static_cast<int>(count * panel_mm.x / 100)));
  }
  bool coloured() const { return style.colour_by_time && portrait.comparisons.empty(); }
  Text speed(const Text& name) const;  ///< the name with its unit
};

using Instant = PortraitOrbit::Instant;

/// Return the state with the given u and ln v, or with the given logarithms of u > 0 and v.
Instant instant_at(double mu, double u, double ln_v);
Instant instant_at_logarithms(double mu, double ln_k, double ln_v);

/// Returns the legend of a portrait's orbits, used if two laws are compared.
Text law_legend(const PhasePortrait& portrait);

/// Copies of one curve fill a panel. The curve's larger speed falls by e to this power from its beginning to k = 1.
inline constexpr double upstream_of_copies = 14;

/// Returns ln k of the invariant rays, increasing.
std::vector<double> ray_log_ratios(const PhasePortrait& portrait);

/// Returns the interpolated state of an orbit at a ln k; the last state before the stop if the orbit does not reach it.
Instant at_log_ratio(const PortraitOrbit& curve, double ln_k);

/// A panel and its map between states and points.
struct MappedPanel {
  Panel panel;
  PanelMap map;
};

/// A panel to which layers of the phase plane are added, placed by its map.
class PortraitPanel : public PanelLayers {
 public:
  PortraitPanel(const Drawing& drawing, Panel axes, PanelMap map)
      : PanelLayers(drawing, std::move(axes), std::move(map)), drawing_(drawing) {
    // On a bent axis of v, sliding lies above the bend and takes hardly any time, so orbits get an early arrow.
    early_arrows_ = !drawing.portrait.scale.linear();
    asked_first_ = true;
  }

  /// Adds the orbits of the portrait, and the orbits of the compared law.
  void add_orbits();

  /// Adds orbits beyond the window. Without invariant rays the orbits are copies of one orbit. If there are rays,
  /// orbits are computed one by one, each through the middle of the widest gap, until they fill the panel.
  ///
  /// @param copies    returns copies of a curve that passes k = 1 at v = 1
  /// @param mirrored  true if the left half of the panel is the mirror image of the right half
  void add_copies(const std::function<std::vector<OrbitCopy>(const PortraitOrbit& curve)>& copies, bool mirrored);
  /// Adds isochrones, with labels where orbits leave room. Isochrones of the other law have no labels.
  void add_isochrones();
  /// Adds the axes and the invariant rays.
  /// @param axes, pivoting  lines of the axes; lines that are orbits have the direction of the motion
  /// @param ray             returns the lines of an invariant ray, given its ln k, in the direction of the motion
  void add_invariant(std::vector<Polyline> axes, const std::vector<Polyline>& pivoting,
                     const std::function<std::vector<Polyline>(double ln_k)>& ray);
  void add_field();

  MappedPanel finished() && { return {std::move(panel_), std::move(map_)}; }

 private:
  void add_layers(const std::function<std::vector<TimedLine>(const PhasePortrait&)>& lines);
  std::vector<OrbitCopy> filling(const reduction::Flow& flow, bool mirrored);

  const Drawing& drawing_;
  std::deque<PortraitOrbit> traced_;  ///< orbits that copies refer to
};

}  // namespace contensou::portraits
