#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "views/portrait_panel.hpp"

namespace contensou::portraits {

/// Each of these functions returns the panels of one view.
std::vector<MappedPanel> plane_view(const Drawing& drawing);
std::vector<MappedPanel> patch_view(const Drawing& drawing);
std::vector<MappedPanel> log_view(const Drawing& drawing);
std::vector<MappedPanel> similarity_view(const Drawing& drawing);
std::vector<MappedPanel> blowup_view(const Drawing& drawing);
std::vector<MappedPanel> disc_view(const Drawing& drawing);
std::vector<MappedPanel> time_view(const Drawing& drawing);
std::vector<MappedPanel> regularised_view(const Drawing& drawing);
std::vector<MappedPanel> pair_view(const Drawing& drawing);
std::vector<MappedPanel> story_view(const Drawing& drawing);

/// Calls `add` for each motion of a view of motions: motions from start_ratios for each law, and requested motions.
void add_courses(const Drawing& drawing, const std::function<void(const PhasePortrait& of, const PortraitOrbit& orbit,
                                                                  Stroke stroke, const Text& legend)>& add);

/// Returns five ratios k, half a decade apart, about the k at which pure sliding and pure pivoting take the same time.
std::vector<double> start_ratios(const PhasePortrait& portrait);

/// Returns the panel of (u, ln k). It shows how orbits enter the origin, even if they touch an axis to the order 10^5.
MappedPanel contact_panel(const Drawing& drawing, bool right_half);

/// A view with its name for users and its layout on a page.
struct ViewLayout {
  View view;
  std::string_view name;
  std::string_view axes;  ///< quantities on the axes, in words
  std::vector<MappedPanel> (*panels)(const Drawing&);
  int panels_across;
  double width_mm;
  double height_mm;
  /// Returns the shortest and the longest time left for colours in bands of equal ratio, in views that distort the
  /// plane. If it is null, the bands are equal.
  std::pair<double, double> (*times)(const PhasePortrait&);
  Text (*shows)(const PhasePortrait&);  ///< subtitle
  /// True for a view with drawings of objects: orbits have no colours of time and one arrow each, and the panel is made
  /// again when its size on the page is known.
  bool has_drawings = false;
};

/// Returns the stop time of the state u = exp(x) V/mu, v = exp(y) V, where V is the height of the window.
inline double scaled_stop_time(const PhasePortrait& portrait, double x, double y) {
  const double V = portrait.window.v();
  return portrait.flow.orbit({std::exp(x) * V / portrait.system().mu(), std::exp(y) * V}).stop_time();
}

inline std::pair<double, double> far_times(const PhasePortrait& portrait) {
  const double tau = scaled_stop_time(portrait, 0, 0);
  return {0.03 * tau, 20 * tau};
}

/// Returns the subtitle of a view of the plane.
/// @param undriven  subtitle without a drive
inline Text plane_shows(const PhasePortrait& portrait,
                        const char* undriven = "every orbit runs to the stop; the axes are orbits, too") {
  return portrait.system().drive() > 0
             ? "the drive makes a body creep that only spins: orbits also begin at v = 0; every orbit runs to the stop"
             : undriven;
}
/// Returns the statement that orbits are copies of one curve. A copy stays on its side of a ray.
inline Text one_curve(const PhasePortrait& portrait) {
  const std::size_t rays = portrait.plane.terminal.rays.size();
  return rays == 0   ? "all orbits are one curve, shifted"
         : rays == 1 ? "on each side of the ray all orbits are one curve, shifted"
                     : "between two rays all orbits are one curve, shifted";
}
/// Subtitle for an axis of v with a SpeedScale.
constexpr std::string_view bent_shows = "slip falls first, at nearly constant spin; then the spin";

/// All views, in the order of lists.
inline const std::array view_layouts{
    ViewLayout{View::uv, "uv", "plane (u, v)", plane_view, 1, 190, 125, nullptr,
               [](const PhasePortrait& portrait) { return plane_shows(portrait); }},
    ViewLayout{View::patch, "patch", "plane (mu u, v): rim speed of the patch, and slip; both axes end at one speed",
               patch_view, 1, 190, 125, nullptr,
               [](const PhasePortrait& portrait) {
                 return plane_shows(portrait, "sliding speed against the rim speed of the patch");
               }},
    ViewLayout{View::log, "log", "plane (mu u, v) with logarithmic axes", log_view, 1, 175, 130,
               [](const PhasePortrait& portrait) {
                 const double tau = portrait.flow.orbit({portrait.window.u(), portrait.window.v()}).stop_time();
                 return std::pair{1e-4 * tau, tau};
               },
               [](const PhasePortrait& portrait) { return one_curve(portrait) + " along the diagonal"; }},
    ViewLayout{
        View::similarity, "similarity",
        "planes (v/u, ln v) and (ln k, ln v), in which orbits are shifted copies of one curve, or of one curve on each "
        "side of a ray",
        similarity_view, 2, 270, 125,
        [](const PhasePortrait& portrait) {
          return std::pair{scaled_stop_time(portrait, -6, -4), scaled_stop_time(portrait, 6, 0)};
        },
        [](const PhasePortrait& portrait) { return "canonical coordinates: " + one_curve(portrait); }},
    ViewLayout{View::blowup, "blowup",
               "plane in which the origin is drawn as a half-circle of directions, and plane (u, ln k)", blowup_view, 2,
               280, 97, far_times,
               [](const PhasePortrait&) {
                 return Text("the origin as a half-circle: each half-line joins a saddle to a node");
               }},
    ViewLayout{View::disc, "disc", "whole half-plane v >= 0 in a half-disc, with infinity as its rim (Poincare disc)",
               disc_view, 1, 210, 125, far_times,
               [](const PhasePortrait& portrait) {
                 return plane_shows(portrait,
                                    "the Poincaré disc: every orbit comes from infinity and ends at the stop");
               }},
    ViewLayout{View::time, "time", "curves of u, v and k against time divided by stop time", time_view, 3, 270, 105,
               nullptr,
               [](const PhasePortrait&) {
                 return "the curves depend on " + math("k") + sub("0") + math(" = v") + sub("0") + math("/(μu") +
                        sub("0") + ") alone";
               }},
    ViewLayout{
        View::regularised, "regularised",
        "curves of u, ln v and tau against 1 + beta/beta_1, with the time beta of (2.7) and a unit beta_1; for a ball "
        "under exact or pade 1/beta_1 is 40 mu^3 u0 + 105 pi v0",
        regularised_view, 3, 270, 105, nullptr,
        [](const PhasePortrait&) {
          return "(2.7) in " + math("β") +
                 " has no denominator and never reaches rest; (2.8) gives the finite stop time";
        }},
    ViewLayout{View::pair, "pair", "planes (u, v) and (u, ln k) side by side", pair_view, 2, 300, 125, nullptr,
               [](const PhasePortrait& portrait) { return plane_shows(portrait); }},
    ViewLayout{View::story, "story",
               "plane (u, v) with one motion beside the uncoupled model, and the contact patch at three of its states",
               story_view, 1, 170, 110, nullptr,
               [](const PhasePortrait&) {
                 return Text("spin turns the friction away from the slide: the body slides longer");
               },
               true},
};

}  // namespace contensou::portraits
