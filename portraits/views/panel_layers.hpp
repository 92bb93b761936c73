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

/// How the layers of a panel look.
struct LayerLook {
  Palette palette;
  TimeBands bands;
  Point panel_mm;  ///< the size of a panel on paper, about
  double letter;   ///< the size of letters, mm
};

/// Whether a place on paper (layout.hpp) is in its panel and at least so far from the border.
inline bool inside(Point place, double margin) {
  return place.x >= margin && place.x <= 1 - margin && place.y >= margin && place.y <= 1 - margin;
}

/// A motion in the units of the axes, and the time left at each of its points, which falls along it or is infinite.
struct TimedLine {
  Polyline line;
  std::vector<double> left;
};

/// A piece of an isochrone in the units of the axes.
struct TimedPiece {
  double time;
  Polyline line;
};

/// A short step of a motion in the units of the axes, and how fast it is there.
struct Drift {
  Point from, to;
  double size;
};

/// A panel that fills with layers of motions: lines in bands of time, their arrows, labelled isochrones, directions.
class PanelLayers {
 public:
  PanelLayers(const LayerLook& look, PortraitStyle::Arrows arrows, Panel axes)
      : look_(look), arrows_(arrows), panel_(std::move(axes)) {}

  /// Where the arrow of an orbit that has none at equal times is: at that fraction of its length on paper; and how far
  /// heads are apart at least, in sizes of letters.
  void set_arrows(double fraction, double keep_off) {
    arrow_fraction_ = fraction;
    keep_off_ = keep_off;
  }

  void add_coloured(const std::vector<TimedLine>& orbits);
  void add_plain(const std::vector<TimedLine>& orbits, Stroke stroke, const Text& legend);

  /// Isochrones, labelled where orbits leave room.
  /// @param pieces   by growing time
  /// @param unit     of the labels' time
  /// @param crossed  lines that labels keep off, beside the orbits
  /// @param middle   on paper, x of another
  void add_isochrones(const std::vector<TimedPiece>& pieces, const Text& legend, double unit,
                      const std::vector<Polyline>& crossed, double middle);

  /// Needles on a grid, their length by logarithm.
  /// @param at  what moves at a point of the axes
  void add_directions(const std::function<std::optional<Drift>(Point)>& at, const Text& legend);

  /// Circles at the points that were asked for; where they are several, with their numbers.
  void add_points(const std::vector<Point>& points);

  /// Two heads on each part of the lines.
  void add_heads(const Lines& lines);

  Panel& panel() { return panel_; }

 protected:
  /// Points on paper along a line, no farther apart than a step.
  std::vector<Point> on_paper_along(const Polyline& line, double step) const;
  void forget_heads() { heads_.clear(); }

  const LayerLook& look_;
  PortraitStyle::Arrows arrows_;
  Panel panel_;
  bool early_arrows_ = false;  ///< one more where an orbit begins

 private:
  struct TimedArrow {
    Arrow arrow;
    double left;  ///< the time there
  };

  std::vector<TimedArrow> arrows_on(const TimedLine& orbit);
  std::vector<Point> obstacles(const std::vector<Polyline>& crossed) const;

  double arrow_fraction_ = 0.3;
  double keep_off_ = 2;
  std::vector<Polyline> orbits_;  ///< that labels keep off
  std::vector<Point> heads_;      ///< on paper
};

}  // namespace contensou::portraits
