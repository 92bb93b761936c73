#include "contensou/portraits/phase_portrait_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

using Range = std::pair<double, double>;

/// The shortest and the longest time left that a stretched view is to tell apart.
Range corner_times(const PhasePortrait& portrait) {
  const double corner = stop_time(portrait, portrait.window.u, portrait.window.v);
  return {0.01 * corner, corner};
}

Range far_times(const PhasePortrait& portrait) {
  const double unit = stop_time(portrait, portrait.window.v / portrait.system.mu(), portrait.window.v);
  return {0.03 * unit, 20 * unit};
}

Range canonical_times(const PhasePortrait& portrait) {
  const double v = portrait.window.v, u = v / portrait.system.mu();
  return {stop_time(portrait, std::exp(-6.0) * u, std::exp(-4.0) * v), stop_time(portrait, std::exp(6.0) * u, v)};
}

/// How a view is made. Bands of time are equal where the plane is seen as it is, of equal ratio where it is stretched.
struct Maker {
  View view;
  std::vector<Panel> (*panels)(const Drawing&);
  int columns;  ///< panels side by side
  double width_mm;
  double height_mm;
  Range (*bands)(const PhasePortrait&);  ///< null: equal ones
  std::string_view shows;
};

constexpr std::string_view plane_shows =
    "every orbit runs from the border to the stop at the origin; both axes are invariant";

constexpr std::array makers{
    Maker{View::uv, plane_view, 1, 190, 125, nullptr, plane_shows},
    Maker{View::patch, patch_view, 1, 190, 125, nullptr,
          "the two speeds at the rim of the patch: sliding and pivoting compare"},
    Maker{View::log, log_view, 1, 175, 130, corner_times,
          "by scaling orbits are translates of one curve along the diagonal"},
    Maker{View::similarity, similarity_view, 2, 270, 125, canonical_times,
          "canonical coordinates: orbits are translates of one curve"},
    Maker{View::blowup, blowup_view, 2, 280, 112, far_times,
          "the origin, blown up: each half-line joins a saddle to a node"},
    Maker{View::disc, disc_view, 1, 210, 125, far_times,
          "the Poincaré disc: every orbit is born at infinity and dies at the stop"},
    Maker{View::time, time_view, 3, 270, 105, nullptr,
          "by scaling only {/:Italic k}_0 = {/:Italic v}_0/({/:Italic μu}_0) matters"},
    Maker{View::pair, pair_view, 2, 300, 125, nullptr, plane_shows},
};

std::string title(const PhasePortrait& portrait) {
  const reduction::ReducedSystem& system = portrait.system;
  const auto [chi, gamma] = system.inertia();
  const bool ball = chi == reduction::homogeneous_ball.chi && gamma == reduction::homogeneous_ball.gamma;
  const std::string body =
      ball ? "Sliding and spinning ball"
           : fmt::format("Sliding and spinning body,  {{/:Italic χ}} = {:.4g}, {{/:Italic γ}} = {:.4g}", chi, gamma);
  return fmt::format("{},  {{/:Italic μ}} = {},  law: {}", body, number(system.mu()), law_names(portrait));
}

}  // namespace

std::string law_names(const PhasePortrait& portrait) {
  std::string names = literal(portrait.system.law().name());
  for (const PhasePortrait& rival : portrait.against) names += " against " + literal(rival.system.law().name());
  return names;
}

Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption, const PortraitStyle& style) {
  const Maker& maker = *std::ranges::find(makers, portrait.view, &Maker::view);
  const double width = style.width_mm.value_or(maker.width_mm), height = style.height_mm.value_or(maker.height_mm);
  Drawing drawing{portrait, caption, style, palette(style.screen), {}, {width / maker.columns - 30, height - 40}};
  if (maker.bands == nullptr) {
    drawing.bands = linear_bands(portrait, drawing.palette);
  } else {
    const auto [shortest, longest] = maker.bands(portrait);
    drawing.bands = logarithmic_bands(shortest, longest, caption.time_unit, drawing.palette);
  }
  Figure figure;
  figure.title = caption.title.empty() ? title(portrait) : caption.title;
  figure.subtitle = caption.subtitle.empty() ? std::string(maker.shows) : caption.subtitle;
  figure.width_mm = width;
  figure.height_mm = height;
  figure.theme = drawing.palette.theme;
  figure.panels = maker.panels(drawing);
  if (drawing.coloured() && portrait.view != View::time) figure.colour_bar = colour_bar(drawing.bands, caption);
  return figure;
}

}  // namespace contensou::portraits
