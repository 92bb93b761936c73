#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "views/panel_layers.hpp"

namespace contensou::portraits {

/// The data and options from which a view is drawn.
struct Drawing : LayerLook {
  const PhasePortrait& portrait;
  const PortraitCaption& caption;
  const PortraitStyle& style;

  /// Scales a number of lines meant for a panel 100 mm wide to this panel.
  int crowd(int count) const {
    return std::max(count / 2, std::min(count, static_cast<int>(count * panel_mm.x / 100)));
  }
  bool coloured() const { return style.colour_by_time && portrait.comparisons.empty(); }
  Text speed(const Text& name) const;  ///< the name with its unit
};

using Instant = PortraitOrbit::Instant;

/// Return the state at u and ln v, or at both logarithms for u > 0.
Instant instant_at(double mu, double u, double ln_v);
Instant instant_at_logarithms(double mu, double ln_k, double ln_v);

/// Returns the legend of a portrait's orbits if two laws are compared.
Text law_legend(const PhasePortrait& portrait);

/// Distance above k = 1, as a power of e, at which the one curve begins whose copies fill a panel.
inline constexpr double upstream_of_copies = 14;

/// Returns ln k of the invariant rays, increasing.
std::vector<double> ray_log_ratios(const PhasePortrait& portrait);

/// Returns the interpolated state of an orbit at a ln k; the last state before the stop if the orbit does not reach it.
Instant at_log_ratio(const PortraitOrbit& curve, double ln_k);

/// A panel with its map.
struct MappedPanel {
  Panel panel;
  PanelMap map;
};

/// A panel to which layers of the phase plane are added, placed by its map.
class PortraitPanel : public PanelLayers {
 public:
  PortraitPanel(const Drawing& drawing, Panel axes, PanelMap map)
      : PanelLayers(drawing, drawing.style.arrows, std::move(axes)), drawing_(drawing), map_(std::move(map)) {
    // On a bent axis of v, sliding takes place above the bend, in hardly any time.
    early_arrows_ = !drawing.portrait.scale.linear();
  }

  /// An orbit scaled by a factor; the sign -1 mirrors it.
  struct Copy {
    const PortraitOrbit& orbit;
    double factor = 1;
    double sign = 1;
  };

  /// Adds the orbits of the portrait, and those of the law that it is compared with.
  void add_orbits();

  /// Adds orbits beyond the window. Without invariant rays they are copies of one orbit. With rays orbits fill the
  /// panel one by one, each through the middle of the widest gap.
  ///
  /// @param copies    returns copies of a curve that passes k = 1 at v = 1
  /// @param mirrored  true if the left half of the panel is the mirror image of the right half
  void add_copies(const std::function<std::vector<Copy>(const PortraitOrbit& curve)>& copies, bool mirrored);
  void add_highlights();
  /// Adds isochrones, with labels where orbits leave room. Isochrones of the other law have no labels.
  void add_isochrones();
  /// Adds the axes and the invariant rays.
  /// @param axes, pivoting  lines of the axes; orbits in the direction of the motion
  /// @param ray             returns the lines of an invariant ray, by its ln k, likewise
  void add_invariant(std::vector<Polyline> axes, const std::vector<Polyline>& pivoting,
                     const std::function<std::vector<Polyline>(double ln_k)>& ray);
  void add_field();

  MappedPanel finished() && { return {std::move(panel_), std::move(map_)}; }

 private:
  void add_layers(const std::function<std::vector<Copy>(const PhasePortrait&)>& copies);
  std::vector<Copy> filling(const reduction::Flow& flow, bool mirrored);
  TimedLine line_of(const Copy& copy) const;
  std::vector<TimedLine> lines_of(const std::vector<Copy>& copies) const;
  Polyline line_of(const Isochrone& isochrone) const;
  Point place(double u, double v) const;

  const Drawing& drawing_;
  PanelMap map_;
  std::deque<PortraitOrbit> traced_;  ///< orbits to which copies refer
};

}  // namespace contensou::portraits
