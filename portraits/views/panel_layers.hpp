#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"
#include "views/palette.hpp"

namespace contensou::portraits {

/// The look of the layers of a panel.
struct LayerLook {
  Palette palette;
  TimeBands bands;
  Point panel_mm;  ///< approximate size of a panel on paper
  double letter;   ///< size of letters, mm
};

/// Returns true if a place on paper (layout.hpp) is in its panel, at least a margin from the border.
inline bool inside(Point place, double margin) {
  return place.x >= margin && place.x <= 1 - margin && place.y >= margin && place.y <= 1 - margin;
}

/// A motion in the units of the axes, with the time left at each point. The time decreases along it or is infinite.
struct TimedLine {
  Polyline line;
  std::vector<double> left;
};

/// A part of an isochrone in the units of the axes.
struct TimedPiece {
  double time;
  Polyline line;
};

/// A short step of a motion in the units of the axes, and the speed there.
struct Drift {
  Point from, to;
  double size;
};

/// A panel to which layers of motions are added: lines in bands of time, arrows, labelled isochrones, directions.
class PanelLayers {
 public:
  PanelLayers(const LayerLook& look, PortraitStyle::Arrows arrows, Panel axes)
      : look_(look), arrows_(arrows), panel_(std::move(axes)) {}

  /// Sets the place of an orbit's only arrow, as a fraction of its length on paper, and the least distance of heads, in
  /// sizes of letters.
  void set_arrows(double fraction, double keep_off) {
    arrow_fraction_ = fraction;
    keep_off_ = keep_off;
  }

  void add_coloured(const std::vector<TimedLine>& orbits);
  void add_plain(const std::vector<TimedLine>& orbits, Stroke stroke, const Text& legend);

  /// Adds isochrones, with labels where orbits leave room.
  /// @param pieces   pieces by increasing time
  /// @param unit     time unit of the labels
  /// @param crossed  lines that labels avoid, beside the orbits
  /// @param middle   x on paper of another line that labels avoid
  void add_isochrones(const std::vector<TimedPiece>& pieces, const Text& legend, double unit,
                      const std::vector<Polyline>& crossed, double middle);

  /// Adds needles on a grid, whose length grows with the logarithm of the speed.
  /// @param at  returns the motion at a point of the axes
  void add_directions(const std::function<std::optional<Drift>(Point)>& at, const Text& legend);

  /// Adds circles at the requested points, with numbers if there are several.
  void add_points(const std::vector<Point>& points);

  /// Adds two heads to each part of the lines.
  void add_heads(const Lines& lines);

  Panel& panel() { return panel_; }

 protected:
  /// Returns points on paper along a line, at distances of at most a step.
  std::vector<Point> on_paper_along(const Polyline& line, double step) const;
  void forget_heads() { heads_.clear(); }

  const LayerLook& look_;
  PortraitStyle::Arrows arrows_;
  Panel panel_;
  bool early_arrows_ = false;  ///< true: one more arrow at the beginning of an orbit

 private:
  struct TimedArrow {
    Arrow arrow;
    double left;  ///< time left at the arrow
  };

  std::vector<TimedArrow> arrows_on(const TimedLine& orbit);
  std::vector<Point> obstacles(const std::vector<Polyline>& crossed) const;

  double arrow_fraction_ = 0.3;
  double keep_off_ = 2;
  std::vector<Polyline> orbits_;  ///< orbits that labels avoid
  std::vector<Point> heads_;      ///< places of arrow heads on paper
};

}  // namespace contensou::portraits
