#pragma once

#include <functional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"

namespace contensou::portraits {

/// The colours of what portraits are made of. Lightness tells the times apart, so they survive in grey.
struct Palette {
  Theme theme;
  Colour orbit, rival, highlight, invariant, isochrone, field, region;
  std::vector<Colour> times;  ///< from the stop on
};

Palette palette(bool screen);

/// Times left cut into bands, each of one colour.
struct TimeBands {
  std::vector<double> edges;    ///< increasing, between bands
  std::vector<Colour> colours;  ///< one more than edges
  std::vector<double> marked;   ///< times that the colour bar names
  bool linear = true;

  std::size_t band(double tau) const;
};

/// Equal bands, some for each isochrone interval of the portrait; or bands of equal ratio over the given decades.
TimeBands linear_bands(const PhasePortrait& portrait, const Palette& palette);
TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette);

/// The stop time of a state from the portrait's profile.
double stop_time(const PhasePortrait& portrait, double u, double v);

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption);

/// What a view is drawn from.
struct Drawing {
  const PhasePortrait& portrait;
  const PortraitCaption& caption;
  const PortraitStyle& style;
  Palette palette;
  TimeBands bands;
  Point panel_mm;  ///< the size of a panel on paper, about

  bool coloured() const { return style.colour_by_time && portrait.against.empty(); }
  std::string speed(const std::string& name) const;  ///< with its unit
};

using Instant = PortraitOrbit::Instant;
/// Where a state lies in a panel.
using Place = std::function<Point(const Instant&)>;

/// The legend of a portrait's orbits where two laws are compared.
std::string law_legend(const PhasePortrait& portrait);

/// A panel that fills with layers of the phase plane, placed by one function of the state.
class PortraitPanel {
 public:
  PortraitPanel(const Drawing& drawing, Panel axes, Place place)
      : drawing_(drawing), panel_(std::move(axes)), place_(std::move(place)) {}

  /// Where the arrow of an orbit that has none at equal times is: at that share of its length on paper, and how far
  /// heads are apart at least.
  void set_arrows(double share, double keep_off) {
    arrow_share_ = share;
    keep_off_ = keep_off;
  }

  /// An orbit, scaled by a factor; sign -1 mirrors it.
  struct Copy {
    const PortraitOrbit& orbit;
    double factor = 1;
    double sign = 1;
  };

  /// Orbits of the portrait, and in the same way those of the laws that it is compared with.
  void add_orbits(const std::function<std::vector<Copy>(const PhasePortrait&)>& copies);
  void add_highlights();
  /// Isochrones of those stop times, labelled where orbits leave room; left and right.
  void add_isochrones(const std::vector<double>& times);
  /// Those of another law, without labels.
  void add_rival_isochrones(const std::vector<double>& times, const PhasePortrait& rival);
  /// @param ray  the line of an invariant ray, by its ln k
  void add_invariant(std::vector<Polyline> axes, const std::function<std::vector<Polyline>(double ln_k)>& ray);
  /// @param state  the state at a point of the panel; u = v = 0 where there is none
  void add_field(const std::function<reduction::State(Point)>& state);

  Panel& panel() { return panel_; }
  Panel finished() && { return std::move(panel_); }

 private:
  void add_coloured(const std::vector<Copy>& copies);
  Polyline line_of(const Copy& copy) const;
  void add_arrows(const Copy& copy, Arrows& arrows);
  void add_plain(const std::vector<Copy>& copies, Stroke stroke, const std::string& legend);
  std::vector<Polyline> isochrone(const PhasePortrait& portrait, double time) const;

  const Drawing& drawing_;
  Panel panel_;
  Place place_;
  double arrow_share_ = 0.3;
  double keep_off_ = 0.04;
  std::vector<Polyline> orbits_;  ///< that labels keep off
  std::vector<Point> heads_;      ///< on paper
};

/// A number as people write it; large ones with their power of ten.
std::string number(double value);

}  // namespace contensou::portraits
