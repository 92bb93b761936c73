#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/phase_plane.hpp"

namespace contensou::portraits {

/// An axis of v from height 0 at the stop to height 1 at the speed `top`: h = (x + x^s)/2 with x = v/top.
///
/// The term x shows sliding, while v falls and u hardly changes. The term x^s shows the approach to the stop. There k =
/// v/(mu |u|) tends to 0, the force Phi to Phi'(0) k and the moment Psi to Psi(0). The equations of motion (2.6) give d
/// ln|u|/d ln v = r k Psi/Phi, which tends to s = r Psi(0)/Phi'(0). Therefore |u| falls like v^s, and in x^s every
/// orbit is straight at the origin. For s = 1 the axis is linear.
struct SpeedScale {
  double top;
  double exponent = 1;  ///< s, in (0, 1]

  bool linear() const { return exponent == 1; }
  double height(double ln_v) const;
  double slope(double ln_v) const;  ///< returns d height/d ln v
  double ln_v(double height) const;
};

/// A rectangle of the plane, given by two corners.
struct Window {
  Eigen::Vector2d low, high;

  bool contains(reduction::State at) const {
    return at.u >= low[0] && at.u <= high[0] && at.v >= low[1] && at.v <= high[1];
  }
  Eigen::Vector2d sides() const { return high - low; }

  /// Return U and V of the smallest half-plane window |u| <= U, 0 <= v <= V that contains this window.
  double u() const { return std::max(std::abs(low[0]), std::abs(high[0])); }
  double v() const { return high[1]; }
};

/// The choice of axes. A new view is an entry here, a function in views/ and a row in views/portrait_views.hpp.
enum class View { uv, patch, log, similarity, blowup, disc, time, regularised, pair, story };

std::string_view name(View view);

/// Returns the quantities on the axes, in words.
std::string_view axes(View view);
std::optional<View> find_view(std::string_view name);

/// Returns true if the view shows the window. Such views contain isochrones and a field, and v may have a SpeedScale.
constexpr bool shows_window(View view) { return view == View::uv || view == View::patch || view == View::pair; }

/// Returns true if the axes of the view are times of motions, not states. Such views do not colour orbits by time.
constexpr bool shows_moments(View view) { return view == View::time || view == View::regularised; }

/// Returns all views in the order in which lists show them.
const std::vector<View>& views();

/// An orbit, or the part of an orbit in the window, as columns of equal length in the direction of the motion. An orbit
/// of the equations of motion (2.6) of reduction::ReducedSystem ends with the row of the stop: u = v = 0, ln_v =
/// -infinity, ln_k of the terminal ratio, tau_left = 0.
struct PortraitOrbit {
  Eigen::ArrayXd u = {};
  Eigen::ArrayXd v = {};
  Eigen::ArrayXd ln_v = {};      ///< only for (2.6)
  Eigen::ArrayXd ln_k = {};      ///< only for (2.6)
  Eigen::ArrayXd tau_left = {};  ///< time until the stop; for another system, until the centre or infinity, or infinite
  /// Regularised time beta (reduction::ReducedSystem) since the first state, in the inverse of the unit of speed. Only
  /// in the view regularised, for a motion that is one orbit.
  Eigen::ArrayXd beta = {};

  /// One state of the orbit or of a scaled copy of the orbit.
  struct Instant {
    double u, v, ln_v, ln_k, tau_left;
  };

  /// Returns a row, scaled; the logarithms are NaN if their columns are empty.
  /// @param factor  > 0; a scaled orbit of (2.6) is also an orbit, by the scaling symmetry
  Instant at(Eigen::Index row, double factor = 1) const;
  Eigen::Index rows() const { return u.size(); }
};

/// A connected part of the line of all states with one stop time, or one time left.
struct Isochrone {
  double tau_stop;
  Eigen::ArrayXd u;
  Eigen::ArrayXd v;
};

/// The curves that are common to the portraits of all systems.
struct Portrait {
  Window window;                         ///< visible part of the plane
  std::vector<PortraitOrbit> orbits;     ///< for (2.6), from the border of the half-plane window to the origin
  std::vector<Isochrone> isochrones;     ///< isochrones in the window
  double isochrone_step;                 ///< all isochrones are multiples of this step; 0 if there is no such step
  std::vector<PortraitOrbit> highlight;  ///< visible parts of one start's orbit, one for (2.6); empty: not requested
  std::vector<PortraitOrbit> through;    ///< orbits through the requested points, from the border
  std::vector<reduction::State> points;  ///< the requested points
  /// For (2.6), if requested: motions of the uncoupled model from the first states of highlight and through.
  std::vector<PortraitOrbit> uncoupled = {};
};

/// The phase plane of one system (2.6) (reduction::ReducedSystem) as data, without a drawing.
///
/// The phase plane shows every motion of a body that slides at the speed v and pivots at the speed u (reduction::Flow)
/// as an orbit in the half-plane v >= 0. All orbits end at the origin, the stop. The data are the orbits, the
/// isochrones (lines of states with one stop time) and the singular points (reduction::PhasePlane). u, v and tau have
/// one unit.
///
///     const reduction::Flow flow(reduction::HertzLaw{}, 0.3);
///     const PhasePortrait portrait = phase_portrait(flow, {});  // the default view and window
///     render(draw(portrait), PictureFormat::svg);              // the bytes of a picture
struct PhasePortrait : Portrait {
  reduction::Flow flow;
  reduction::PhasePlane plane;
  View view;
  SpeedScale scale;  ///< scale of v, in views that show the window
  /// The portrait of another law in the same window, with isochrones at the same times; at most one.
  std::vector<PhasePortrait> comparisons;

  const reduction::ReducedSystem& system() const { return flow.system(); }
};

/// The requested contents of a portrait. The default window follows from mu, and the default view is uv.
struct PortraitRequest {
  std::optional<View> view = {};  ///< for another system than (2.6) only disc, in portrait_on_disc
  /// A rectangle of the plane. For (2.6) v >= 0, and the view must show the window. The orbits are those of the
  /// smallest half-plane window that contains the rectangle, as far as they enter the rectangle.
  std::optional<Window> window = {};
  /// U and V instead of a rectangle: |u| <= U and 0 <= v <= V. For another system |u| <= U and |v| <= V, relative to
  /// the centre of the system.
  std::optional<Eigen::Vector2d> sides = {};
  std::optional<reduction::State> highlight = {};  ///< a start; the default window contains it
  std::vector<reduction::State> through = {};      ///< points in the window; for (2.6) with u and v both not 0
  /// Number of orbits, >= 0; for (2.6) on each side of u = 0. The default fills the window.
  std::optional<int> orbits = {};
  /// Number of isochrones, >= 0, about 7 by default. It is approximate, because their times are round numbers.
  std::optional<int> isochrones = {};
  /// Times of isochrones, in time units, each > 0. They replace the number of isochrones.
  std::vector<double> isochrone_times = {};
  bool nullclines = false;  ///< only for another system than (2.6): compute the curves u' = 0 and v' = 0
  // Only for (2.6):
  std::optional<reduction::Law> comparison = {};
  bool uncoupled = false;  ///< true: also the requested motions under the uncoupled model
  bool stepped = false;    ///< true: orbits by steps of the regularised equations (2.7); false: by the flow
  /// True: the axis of v is always linear. The default is a SpeedScale if orbits are not stepped and a linear axis
  /// would show a comb of vertical lines. Such lines appear if orbits enter the origin along v = 0 and v falls faster
  /// than |u|^12; for the ball, mu < 0.48.
  bool linear = false;
  /// True: compute only the data that the view draws. Views without the window get no orbits and isochrones.
  bool drawn_only = false;
  double time_unit = 1;  ///< number of tau in one time unit; isochrones are at round multiples of it
};

/// Computes a portrait.
///
/// Orbits start on the border at equal distances across the flow, for both signs of u. One isochrone is computed; the
/// others are copies of it by the scaling symmetry.
///
/// @throws std::domain_error  if the sides of the window are not within 1e-150 to 1e150, a point has u or v = 0 (no
///                            orbit) or lies outside the window, a number is negative, or no requested isochrone is
///                            visible
PhasePortrait phase_portrait(const reduction::Flow& flow, const PortraitRequest& request);

/// Returns the motion of the uncoupled model, as textbooks have it: the speed v falls at the constant rate of a body
/// that only slides, and |u| at that of a body that only spins. The motion is a straight line in the plane, then a part
/// of an axis. tau_left is the time until both have stopped. ln_k is infinite on the axes.
/// @param start  u and v not 0
PortraitOrbit uncoupled_orbit(const reduction::Flow& flow, const reduction::State& start);

/// Computes portraits for a comparison. They have one window, one kind of v axis and isochrones at the same times.
/// Without a requested window, the view patch has equal rim speeds in place of equal windows. If the stop times in the
/// corners of the windows differ much, the isochrones have the times of one series 1, 2, 5, 10. Each plane then
/// contains the requested number below its last time, by default 3.
///
/// @param flows  one or more
/// @throws std::domain_error  as phase_portrait
std::vector<PhasePortrait> phase_portraits(const std::vector<reduction::Flow>& flows, const PortraitRequest& request);

/// Returns the orbit through a state with u > 0, from beyond the window to the stop. The state is given by logarithms,
/// because they do not underflow. The state lies neither on an axis nor on an invariant ray.
///
/// @param ln_k      ln of v/(mu u)
/// @param ln_v      ln of v, in the unit of speed
/// @param upstream  >= 0; at the beginning of the orbit the larger of mu u and v is exp(upstream) times that of the
///                  state
PortraitOrbit orbit_through(const reduction::Flow& flow, double ln_k, double ln_v, double upstream);

/// The origin of a portrait, written into its files beside the system.
struct PortraitSource {
  std::string version = {};    ///< version of the program; empty: not written
  std::string ball = {};       ///< name of the ball, if speeds are in m/s
  double seconds_per_tau = 0;  ///< seconds of that ball per unit of tau
};

/// Return one or more portraits as JSON or CSV. `contensou help fields` describes members and columns. Numbers read
/// back to the same doubles. Comment lines (#) at the top of CSV contain the members that stand before the orbits in
/// JSON.
std::string to_json(const std::vector<PhasePortrait>& portraits, const PortraitSource& source = {});
std::string to_csv(const std::vector<PhasePortrait>& portraits, const PortraitSource& source = {});

/// Texts and units of a drawing. The defaults suit the dimensionless system (2.6).
struct PortraitCaption {
  Text title = {};                  ///< if empty, the title consists of the law and mu
  Text subtitle = {};               ///< if empty, the subtitle names the quantities that the view shows
  std::string speed_unit = {};      ///< unit of u and v, "m/s" for a ball; empty if any common unit may be used
  Text time_symbol = math("τ*");    ///< symbol in the labels of isochrones
  std::string time_unit_name = {};  ///< "s" for a ball
  double time_unit = 1;             ///< number of tau in one time unit
  Text highlight = {};              ///< legend of the highlighted orbit
  Text panel = {};                  ///< name of this panel among several, before the view's own title
};

/// Options of a drawing.
struct PortraitStyle {
  enum class Arrows { time, one, none } arrows = Arrows::time;  ///< heads: at equal times, one on each orbit, or none
  enum class Field { none, motion, regularised } field = Field::none;  ///< needles: none, of (2.6) or of (2.7)
  bool invariant = true;       ///< draw the axes and the invariant rays, on which k is constant
  bool colour_by_time = true;  ///< colour orbits by the time left, unless two laws are compared
  bool asked = true;      ///< true: draw the highlighted orbit and the orbits through the requested points; false: the
                          ///< caller draws these orbits
  bool estimate = false;  ///< draw the approximation for small mu beside each motion (view time)
  bool screen = false;    ///< light on dark for a projector; false: dark on light for paper
  AskedSize size = {};    ///< an empty side follows from the view
};

/// Returns the name of the law for a title, with the name of the compared law if there is one.
std::string law_names(const PhasePortrait& portrait);

/// The map of a panel from states to points of its axes, and back.
struct PanelMap {
  using Instant = PortraitOrbit::Instant;

  /// Returns the point of a state on an orbit. At rest, the first state of the orbit determines the side of u = 0.
  std::function<Point(const Instant& at, const Instant& start)> place;
  /// Returns the state at a point, without its time left; empty if there is none. The function is null if the axes are
  /// times. In the view time, x is the fraction of the stop time that has passed.
  std::function<std::optional<Instant>(Point)> state = {};

  Polyline line(const PortraitOrbit& orbit) const;
};

/// Draws the portrait in its view. All numbers come from the portrait.
Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

/// Draws portraits that are compared (phase_portraits), each in a panel with its name, with one colour scale.
/// @param captions  one for each portrait; title and subtitle are taken from the first
/// @throws std::domain_error  for more than 6 portraits, and in a view of several panels
Figure draw_together(const std::vector<PhasePortrait>& portraits, std::vector<PortraitCaption> captions,
                     const PortraitStyle& style = {});

/// A drawing and the map of each of its panels.
struct MappedFigure {
  Figure figure;
  std::vector<PanelMap> maps;
};
MappedFigure draw_mapped(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

}  // namespace contensou::portraits
