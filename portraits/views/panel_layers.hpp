#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "views/palette.hpp"

namespace contensou::portraits {

/// The look of all layers of a panel.
struct LayerLook {
  Palette palette;
  TimeBands bands;
  Point panel_mm;  ///< approximate size of a panel on paper
  double letter;   ///< size of letters, mm
};

LayerLook look_of(const PaperSize& size, int panels, bool screen);

/// The data and options with which the plane of any system is drawn.
struct CurveDrawing : LayerLook {
  const Portrait& curves;
  const PortraitCaption& caption;
  const PortraitStyle& style;
  double mu = 1;  ///< mu of the equations of motion (2.6)
};

/// Returns true if a place on paper (layout.hpp) lies in its panel, farther from the border than a margin.
inline bool inside(Point place, double margin) {
  return place.x >= margin && place.x <= 1 - margin && place.y >= margin && place.y <= 1 - margin;
}

/// A motion in the units of the axes, with the time left at each point. The time left decreases or is infinite.
struct TimedLine {
  Polyline line;
  std::vector<double> left;
};

/// A short step of a motion, in the units of the axes, and the speed there.
struct Drift {
  Point from, to;
  double size;
};

/// An orbit scaled by a factor; the sign is 1, or -1 for the mirror image in u = 0.
struct OrbitCopy {
  const PortraitOrbit& orbit;
  double factor = 1;
  double sign = 1;
};

/// A panel to which layers of motions are added: lines in bands of time, arrows, labelled isochrones, directions. A map
/// of the panel places them.
class PanelLayers {
 public:
  PanelLayers(const CurveDrawing& drawing, Panel axes, PanelMap map)
      : look_(drawing), panel_(std::move(axes)), map_(std::move(map)) {}

  /// Sets the place of an orbit's only arrow, as a fraction of its length on paper, and the smallest distance between
  /// arrow heads, in letter sizes.
  void set_arrows(double fraction, double keep_off) {
    arrow_fraction_ = fraction;
    keep_off_ = keep_off;
  }

  /// Adds orbits in the colours of their times. Orbits of infinite time are plain; without `coloured`, all are plain.
  /// @param legend  legend of the orbits if all are plain
  /// @return  true if an orbit has colours
  bool add_orbits(std::vector<TimedLine> orbits, bool coloured, const Text& legend);
  void add_plain(const std::vector<TimedLine>& orbits, Stroke stroke, const Text& legend);

  /// Adds isochrones, with labels where orbits leave room.
  /// @param middle  x on paper of a vertical line that labels avoid
  void add_isochrones(double middle);

  /// Adds the orbits through the requested points, these points, and the orbit of the start.
  void add_highlights();

  /// Adds needles on a grid. Their length grows with the logarithm of the speed.
  /// @param at     returns the motion at a point of the axes
  /// @param heads  false for marks of equal length without heads
  void add_directions(const std::function<std::optional<Drift>(Point)>& at, const Text& legend, bool heads = true);

  /// Adds lines, with two arrow heads on each part.
  void add_invariant(Lines lines);

  Panel& panel() { return panel_; }
  /// @param orbits  PortraitOrbits, or copies of PortraitOrbits
  template <class Orbits>
  std::vector<TimedLine> lines_of(const Orbits& orbits) const {
    std::vector<TimedLine> lines;
    for (const auto& orbit : orbits) lines.push_back(line_of({orbit}));
    return lines;
  }

 protected:
  /// Returns points on paper along a line, at distances of at most a step.
  std::vector<Point> on_paper_along(const Polyline& line, double step) const;
  TimedLine line_of(const OrbitCopy& copy) const;
  Polyline line_of(const Isochrone& isochrone) const;
  Point place(double u, double v) const;

  const CurveDrawing& look_;
  Panel panel_;
  PanelMap map_;
  bool early_arrows_ = false;  ///< true: one more arrow at the beginning of an orbit
  bool asked_first_ = false;   ///< true: arrows of requested orbits need no distance from other arrows

 private:
  struct TimedArrow {
    Arrow arrow;
    double left;  ///< time left at the arrow
  };

  void add_coloured(const std::vector<TimedLine>& orbits);
  /// Adds circles at the requested points, with numbers if there are several.
  void add_points();
  std::vector<TimedArrow> arrows_on(const TimedLine& orbit);
  std::vector<Point> obstacles() const;

  double arrow_fraction_ = 0.3;
  double keep_off_ = 2;
  std::vector<Polyline> orbits_;  ///< orbits that labels avoid
  std::vector<Point> heads_;      ///< places of arrow heads on paper
};

}  // namespace contensou::portraits
