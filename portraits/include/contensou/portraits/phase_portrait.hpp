#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/speed_scale.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/phase_plane.hpp"

namespace contensou::portraits {

/// The part of the half-plane that is shown: |u| <= u, 0 <= v <= v.
struct Window {
  double u;
  double v;
};

/// A rectangle of the half-plane that is shown of a window.
struct WindowPart {
  double u_low, u_high, v_low, v_high;

  bool contains(reduction::State at) const {
    return at.u >= u_low && at.u <= u_high && at.v >= v_low && at.v <= v_high;
  }
};

/// Which axes. A new view is an entry here, a function in views/ and a row in views/portrait_views.hpp.
enum class View { uv, patch, log, similarity, blowup, disc, time, regularised, pair };

std::string_view name(View view);

/// What is drawn against what, in words.
std::string_view axes(View view);
std::optional<View> find_view(std::string_view name);

/// Whether it shows the window itself: there isochrones and a field are drawn, and v may have a SpeedScale.
constexpr bool shows_window(View view) { return view == View::uv || view == View::patch || view == View::pair; }

/// Whether its points are moments of motions, and not states: then it has no colours of time.
constexpr bool shows_moments(View view) { return view == View::time || view == View::regularised; }

/// In the order in which they are listed.
const std::vector<View>& views();

/// One orbit. Equal lengths; the last entry is the stop: 0, 0, -inf, ln k of the terminal ratio, 0.
struct PortraitOrbit {
  Eigen::ArrayXd u;
  Eigen::ArrayXd v;
  Eigen::ArrayXd ln_v;
  Eigen::ArrayXd ln_k;
  Eigen::ArrayXd tau_left;

  /// One state of it, or of a copy.
  struct Instant {
    double u, v, ln_v, ln_k, tau_left;
  };

  /// @param factor  > 0, by which the state is scaled, as scaling symmetry allows
  Instant at(Eigen::Index row, double factor = 1) const;
  Eigen::Index rows() const { return u.size(); }
};

/// A piece of the line of all states with one stop time.
struct Isochrone {
  double tau_stop;
  Eigen::ArrayXd u;
  Eigen::ArrayXd v;
};

/// The phase plane of one system as data; nothing here is drawn. Speeds are in one unit, which is also that of tau.
struct PhasePortrait {
  reduction::Flow flow;
  reduction::PhasePlane plane;
  View view;
  Window window;
  WindowPart part;                         ///< of the window that is shown: all of it unless asked otherwise
  SpeedScale scale;                        ///< of v, in views that show the window
  std::vector<PortraitOrbit> orbits;       ///< from the border of the window to the origin
  std::vector<Isochrone> isochrones;       ///< in the part
  double isochrone_step;                   ///< isochrones are of all its multiples; 0 where they are of other times
  std::optional<PortraitOrbit> highlight;  ///< the orbit of one start, if asked for
  std::vector<PortraitOrbit> through;      ///< the orbits through the points asked for, from the border
  std::vector<reduction::State> points;    ///< those points
  /// Another law in the same window, with isochrones of the same times; one if asked for, else none.
  std::vector<PhasePortrait> comparisons;

  const reduction::ReducedSystem& system() const { return flow.system(); }
};

/// What to show. Left empty, the window follows from mu, and the view is uv.
struct PortraitRequest {
  std::optional<View> view = {};
  std::optional<Window> window = {};
  /// In place of a window, in views that show it. Orbits are those that enter it of the smallest window around it.
  std::optional<WindowPart> part = {};
  std::optional<reduction::State> highlight = {};  ///< the window then contains it
  std::vector<reduction::State> through = {};      ///< points in the window, neither u nor v 0
  std::optional<int> orbits_per_side = {};         ///< of u = 0, >= 0
  std::optional<int> isochrones = {};        ///< so many, >= 0, as nearly as round times allow; about 7 if not said
  std::vector<double> isochrone_times = {};  ///< of these stop times, in time units, each > 0, whatever the count
  std::optional<reduction::Law> comparison = {};
  bool stepped = false;  ///< orbits by (2.7), stepped in beta, in place of the flow's own
  /// The axis of v is linear also where the plane is then a comb of verticals: where orbits enter the origin along v =
  /// 0 with v falling faster than |u|^12, for the ball mu < 0.48. There, if orbits are not stepped, it is a SpeedScale.
  bool linear = false;
  /// Keep only what the view is drawn from: orbits and isochrones where it shows the window.
  bool drawn_only = false;
  double time_unit = 1;  ///< isochrones are at round multiples of this many tau
};

/// Computes the portrait: orbits seeded along the border at equal distances across the flow, u of both signs, and
/// isochrones by scaling one curve.
///
/// @throws std::domain_error  if the sides of the window are not within 1e-150 .. 1e150, a point lies on no orbit (u or
///                            v is 0) or out of the window, a number is negative, or no isochrone asked for is in the
///                            window
PhasePortrait phase_portrait(const reduction::Flow& flow, const PortraitRequest& request);

/// Portraits that compare: in one window (of patch without one asked for: with one rim speed), with one kind of axis and
/// isochrones of the same times. Where the stop times in the windows' corners differ much, isochrones are of a series 1, 2,
/// 5, 10, each plane's as many as asked for, or 3, below its last.
///
/// @param flows  one or more
/// @throws std::domain_error  as phase_portrait
std::vector<PhasePortrait> phase_portraits(const std::vector<reduction::Flow>& flows, const PortraitRequest& request);

/// The orbit through a state with u > 0, from beyond the window to the stop. The state is given by logarithms, which do
/// not underflow; it is neither on an axis nor on an invariant ray.
///
/// @param ln_k      ln of v/(mu u)
/// @param ln_v      of v in the unit of speed
/// @param upstream  >= 0: where it starts, the larger of mu u and v is exp(upstream) times as large
PortraitOrbit orbit_through(const reduction::Flow& flow, double ln_k, double ln_v, double upstream);

/// Where a portrait comes from, beside its system.
struct PortraitSource {
  std::string version = {};    ///< of the program; empty: not told
  std::string ball = {};       ///< its name, if speeds are in m/s
  double seconds_per_tau = 0;  ///< of that ball
};

/// The portrait as JSON: schema, law, mu, body {chi, gamma}, view, window [U, V] or [[U1, U2], [V1, V2]], version, ball,
/// seconds_per_tau,
/// orbits [{u, v, ln_v, k, tau_left}], isochrones [{tau_stop, u, v}]; where asked for also highlight (an orbit),
/// through (orbits), against {law, orbits, isochrones}. Numbers read back to the same doubles.
std::string to_json(const PhasePortrait& portrait, const PortraitSource& source = {});

/// Several: schema, and portraits, each as above without schema; of one that portrait alone.
std::string to_json(const std::vector<PhasePortrait>& portraits, const PortraitSource& source = {});

/// The portrait as CSV with the columns kind,index,u,v,tau,ln_v,k, and t of a ball: kind is orbit, highlight, through
/// or isochrone (of another law, against_orbit or against_isochrone), tau and t (s) the time left. Before them, in
/// lines that begin with #, what JSON has before its orbits.
std::string to_csv(const PhasePortrait& portrait, const PortraitSource& source = {});

/// Several: the same with two columns mu,law before them; of one that portrait alone.
std::string to_csv(const std::vector<PhasePortrait>& portraits, const PortraitSource& source = {});

}  // namespace contensou::portraits
