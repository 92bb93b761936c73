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

/// What a view is drawn from.
struct Drawing : LayerLook {
  const PhasePortrait& portrait;
  const PortraitCaption& caption;
  const PortraitStyle& style;

  /// So many lines as fill a panel of this width as well as that count a wide one.
  int crowd(int count) const {
    return std::max(count / 2, std::min(count, static_cast<int>(count * panel_mm.x / 100)));
  }
  bool coloured() const { return style.colour_by_time && portrait.comparisons.empty(); }
  Text speed(const Text& name) const;  ///< with its unit
};

using Instant = PortraitOrbit::Instant;

/// The state by u and ln v, or by both logarithms where u > 0.
Instant instant_at(double mu, double u, double ln_v);
Instant instant_at_logarithms(double mu, double ln_k, double ln_v);

/// The legend of a portrait's orbits where two laws are compared.
Text law_legend(const PhasePortrait& portrait);

/// How many powers of e above k = 1 the one curve begins whose copies fill a panel.
inline constexpr double upstream_of_copies = 14;

/// ln k of the invariant rays, by growing k.
std::vector<double> ray_log_ratios(const PhasePortrait& portrait);

/// The state at which an orbit has that ln k, interpolated between its rows; the last before the stop if it has none.
Instant at_log_ratio(const PortraitOrbit& curve, double ln_k);

/// A panel with its map.
struct MappedPanel {
  Panel panel;
  PanelMap map;
};

/// A panel that fills with layers of the phase plane, placed by its map.
class PortraitPanel : public PanelLayers {
 public:
  PortraitPanel(const Drawing& drawing, Panel axes, PanelMap map)
      : PanelLayers(drawing, drawing.style.arrows, std::move(axes)), drawing_(drawing), map_(std::move(map)) {
    // Where v is bent it slides above the bend, and hardly any time passes.
    early_arrows_ = !drawing.portrait.scale.linear();
  }

  /// An orbit, scaled by a factor; sign -1 mirrors it.
  struct Copy {
    const PortraitOrbit& orbit;
    double factor = 1;
    double sign = 1;
  };

  /// The orbits of the portrait, and those of the law that it is compared with.
  void add_orbits();

  /// The same for what is seen beyond the window. Without invariant rays all orbits off the axes are copies of one;
  /// with rays orbits fill the panel one by one, each through the middle of the widest gap.
  ///
  /// @param copies    some of a curve that passes k = 1 at v = 1
  /// @param mirrored  whether the left half of the panel is the mirror image of the right one
  void add_copies(const std::function<std::vector<Copy>(const PortraitOrbit& curve)>& copies, bool mirrored);
  void add_highlights();
  /// Isochrones, labelled where orbits leave room; those of the other law without labels.
  void add_isochrones();
  /// @param axes  and
  /// @param ray   the lines of an invariant ray, by its ln k: orbits, in the way of the motion
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
  std::deque<PortraitOrbit> traced_;  ///< that copies refer to
};

}  // namespace contensou::portraits
