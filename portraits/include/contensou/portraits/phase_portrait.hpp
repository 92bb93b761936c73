#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/stop_time.hpp"

namespace contensou::portraits {

/// The part of the half-plane that is shown: |u| <= u, 0 <= v <= v.
struct Window {
  double u;
  double v;
};

/// Which axes.
enum class View {
  uv,    ///< the paper's plane (u, v)
  pair,  ///< beside it (u, ln k), where orbits of small mu have a shape
};

std::string_view name(View view);

/// One orbit from the border of the window to the origin. Equal lengths; the last entry is the stop: 0, 0, -inf, 0.
struct PortraitOrbit {
  Eigen::ArrayXd u;
  Eigen::ArrayXd v;
  Eigen::ArrayXd ln_k;
  Eigen::ArrayXd tau_left;
};

/// All states of one stop time, from one end of the half-plane to the other.
struct Isochrone {
  double tau_stop;
  Eigen::ArrayXd u;
  Eigen::ArrayXd v;
};

/// The phase plane of one system as data; nothing here is drawn.
struct PhasePortrait {
  std::string law;
  double mu = 0;
  View view = View::uv;
  Window window{};
  double pivoting_slope = 0;  ///< d ln k/d ln |u| as k -> 0: the order at which orbits touch v = 0
  std::vector<PortraitOrbit> orbits;
  std::vector<Isochrone> isochrones;
  std::optional<PortraitOrbit> highlight;  ///< the orbit of one start, if asked for
};

/// What to show. Left empty, the window, the view and the isochrones follow from mu.
struct PortraitRequest {
  std::optional<Window> window;
  std::optional<reduction::State> highlight;  ///< the window then contains it
  /// closed or quadrature: the similarity solution. regularised: (2.7) stepped in beta.
  reduction::Route route = reduction::Route::closed;
  double time_unit = 1;  ///< isochrones are at round multiples of this many tau
};

/// Computes the portrait: orbits seeded along the border at equal distances across the flow, u of both signs, and
/// isochrones by scaling one curve.
///
/// @throws std::domain_error  if the window is not positive and finite, or the route is direct, or r is beyond the
/// regime
///                            k -> 0
PhasePortrait phase_portrait(const reduction::ReducedSystem& system, const PortraitRequest& request);

}  // namespace contensou::portraits
