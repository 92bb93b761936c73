#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "views/palette.hpp"

namespace contensou::portraits {

/// What a view is drawn from.
struct Drawing {
  const PhasePortrait& portrait;
  const PortraitCaption& caption;
  const PortraitStyle& style;
  Palette palette;
  TimeBands bands;
  Point panel_mm;  ///< the size of a panel on paper, about
  double letter;   ///< the size of letters, mm

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

/// Whether a place on paper (layout.hpp) is in its panel and at least so far from the border.
inline bool inside(Point place, double margin) {
  return place.x >= margin && place.x <= 1 - margin && place.y >= margin && place.y <= 1 - margin;
}

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
class PortraitPanel {
 public:
  PortraitPanel(const Drawing& drawing, Panel axes, PanelMap map)
      : drawing_(drawing), panel_(std::move(axes)), map_(std::move(map)) {}

  /// Where the arrow of an orbit that has none at equal times is: at that fraction of its length on paper; and how far
  /// heads are apart at least, in sizes of letters.
  void set_arrows(double fraction, double keep_off) {
    arrow_fraction_ = fraction;
    keep_off_ = keep_off;
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
  void add_invariant(std::vector<Polyline> axes, const std::function<std::vector<Polyline>(double ln_k)>& ray);
  void add_field();

  Panel& panel() { return panel_; }
  MappedPanel finished() && { return {std::move(panel_), std::move(map_)}; }

 private:
  struct TimedArrow {
    Arrow arrow;
    double left;  ///< the time there
  };

  void add_layers(const std::function<std::vector<Copy>(const PhasePortrait&)>& copies);
  std::vector<Copy> filling(const reduction::Flow& flow, bool mirrored);
  void add_coloured(const std::vector<Copy>& copies);
  void add_plain(const std::vector<Copy>& copies, Stroke stroke, const Text& legend);
  Polyline line_of(const Copy& copy) const;
  Polyline line_of(const Isochrone& isochrone) const;
  Point place(double u, double v) const;
  std::vector<TimedArrow> arrows_on(const Copy& copy, const Polyline& line);
  std::vector<Point> on_paper_along(const Polyline& line, double step) const;
  std::vector<Point> obstacles() const;

  const Drawing& drawing_;
  Panel panel_;
  PanelMap map_;
  double arrow_fraction_ = 0.3;
  double keep_off_ = 2;
  std::deque<PortraitOrbit> traced_;  ///< that copies refer to
  std::vector<Polyline> orbits_;      ///< that labels keep off
  std::vector<Point> heads_;          ///< on paper
};

}  // namespace contensou::portraits
