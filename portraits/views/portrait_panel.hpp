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
  Colour orbit, comparison, highlight, invariant, isochrone, field, region;
  std::vector<Colour> times;  ///< from the stop on
};

Palette palette(bool screen);

/// Times left cut into bands, each of one colour.
struct TimeBands {
  std::vector<double> edges;        ///< increasing, between bands
  std::vector<Colour> colours;      ///< one more than edges
  std::vector<std::size_t> marked;  ///< bands that the colour bar names the beginning of
  std::vector<double> arrows;       ///< times left at which orbits have an arrow head

  std::size_t band(double tau) const;
  double begin(std::size_t band) const { return band == 0 ? 0 : edges[band - 1]; }
};

/// Equal bands, some for each isochrone interval of the portrait; or bands of equal ratio from the shortest time to the
/// longest, in tau, with edges at round multiples of the unit.
TimeBands linear_bands(const PhasePortrait& portrait, const Palette& palette);
TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette);

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption);

/// What a view is drawn from.
struct Drawing {
  const PhasePortrait& portrait;
  const PortraitCaption& caption;
  const PortraitStyle& style;
  Palette palette;
  TimeBands bands;
  Point panel_mm;  ///< the size of a panel on paper, about

  bool coloured() const { return style.colour_by_time && portrait.comparisons.empty(); }
  std::string speed(const std::string& name) const;  ///< with its unit
};

using Instant = PortraitOrbit::Instant;
/// Where a state lies in a panel.
using Place = std::function<Point(const Instant&)>;

/// The legend of a portrait's orbits where two laws are compared.
std::string law_legend(const PhasePortrait& portrait);

/// ln k of the invariant rays, by growing k.
std::vector<double> ray_log_ratios(const PhasePortrait& portrait);

/// ln k at which copies of a whole curve are spread: half-way between two rays, `away` from the only one, 0 without.
double spread_log_ratio(const WholeCurve& curve, double away);

/// Whether ln k passes that value along a whole curve.
bool reaches(const PortraitOrbit& curve, double ln_k);

/// The state at which a whole curve has that ln k, interpolated between its rows; the last that it reaches otherwise.
Instant at_log_ratio(const PortraitOrbit& curve, double ln_k);

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

  /// Orbits of the portrait, and in the same way those of the law that it is compared with.
  void add_orbits(const std::function<std::vector<Copy>(const PhasePortrait&)>& copies);
  void add_highlights();
  /// Isochrones, labelled where orbits leave room; those of the other law without labels.
  void add_isochrones();
  /// @param ray  the line of an invariant ray, by its ln k
  void add_invariant(std::vector<Polyline> axes, const std::function<std::vector<Polyline>(double ln_k)>& ray);
  /// @param state  the state at a point of the panel; u = v = 0 where there is none
  void add_field(const std::function<reduction::State(Point)>& state);

  Panel& panel() { return panel_; }
  Panel finished() && { return std::move(panel_); }

 private:
  struct TimedArrow {
    Arrow arrow;
    double left;  ///< the time there
  };

  void add_coloured(const std::vector<Copy>& copies);
  void add_plain(const std::vector<Copy>& copies, Stroke stroke, const std::string& legend);
  Polyline line_of(const Copy& copy) const;
  Polyline line_of(const Isochrone& isochrone) const;
  Point place(double u, double v) const;
  std::vector<TimedArrow> arrows_on(const Copy& copy, const Polyline& line);
  std::vector<Point> obstacles() const;

  const Drawing& drawing_;
  Panel panel_;
  Place place_;
  double arrow_share_ = 0.3;
  double keep_off_ = 0.04;
  std::vector<Polyline> orbits_;  ///< that labels keep off
  std::vector<Point> heads_;      ///< on paper
};

}  // namespace contensou::portraits
