#include "contensou/portraits/phase_portrait_figure.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "data/round_numbers.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

const ViewLayout& layout_of(View view) { return *std::ranges::find(view_layouts, view, &ViewLayout::view); }

Text body_name(const reduction::Inertia& inertia) {
  const auto [chi, gamma] = inertia;
  if (chi == reduction::homogeneous_ball.chi && gamma == reduction::homogeneous_ball.gamma)
    return "Sliding and spinning ball";
  const bool flat = chi == 1;
  const char* kind = flat && gamma == 2           ? "Puck, a disc"
                     : flat && gamma == 1         ? "Puck, a ring"
                     : chi == 2.5 && gamma == 1.5 ? "Hollow ball"
                                                  : "Sliding and spinning body";
  return kind + (",  " + math("χ = ") + fmt::format("{:.4g}", chi)) + ", " + math("γ = ") +
         fmt::format("{:.4g}", gamma);
}

TimeBands bands_of(const PhasePortrait& portrait, const Palette& palette) {
  double longest = 0;
  for (const PortraitOrbit& orbit : portrait.orbits) longest = std::max(longest, orbit.tau_left[0]);
  for (const PortraitOrbit& orbit : portrait.through) longest = std::max(longest, orbit.tau_left[0]);
  if (longest == 0 && portrait.highlight) longest = portrait.highlight->tau_left[0];
  if (longest == 0) longest = 1;
  return linear_bands(
      longest, portrait.isochrones.empty() ? round_down(longest / 4) : portrait.isochrones.front().tau_stop, palette);
}

Text title(const PhasePortrait& portrait) {
  return title_of(body_name(portrait.system().inertia()), number(portrait.system().mu()), law_names(portrait));
}

}  // namespace

std::string_view name(View view) { return layout_of(view).name; }
std::string_view axes(View view) { return layout_of(view).axes; }

std::optional<View> find_view(std::string_view name) {
  const auto found = std::ranges::find(view_layouts, name, &ViewLayout::name);
  return found == view_layouts.end() ? std::nullopt : std::optional(found->view);
}

const std::vector<View>& views() {
  static const std::vector<View> all = [] {
    std::vector<View> list;
    for (const ViewLayout& layout : view_layouts) list.push_back(layout.view);
    return list;
  }();
  return all;
}

std::string law_names(const PhasePortrait& portrait) {
  std::string names = shortened(portrait.system().law().name());
  for (const PhasePortrait& other : portrait.comparisons) names += " against " + shortened(other.system().law().name());
  return names;
}

Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption, PortraitStyle style) {
  return draw_mapped(portrait, caption, style).figure;
}

MappedFigure draw_mapped(const PhasePortrait& portrait, const PortraitCaption& caption, PortraitStyle style) {
  const ViewLayout& layout = layout_of(portrait.view);
  const PaperSize size = fitted({layout.width_mm, layout.height_mm}, layout.panels_across, style.size);
  Drawing drawing{{palette(style.screen), {}, panel_size(size, layout.panels_across), 0}, portrait, caption, style};
  drawing.letter = letter_mm(size.width_mm) * drawing.palette.theme.letters;
  if (layout.times == nullptr) {
    drawing.bands = bands_of(portrait, drawing.palette);
  } else {
    const auto [shortest, longest] = layout.times(portrait);
    style.colour_by_time = style.colour_by_time && shortest < longest;
    drawing.bands = logarithmic_bands(shortest, 2 * longest, caption.time_unit, drawing.palette);
  }
  MappedFigure mapped;
  Figure& figure = mapped.figure;
  figure.title = caption.title.empty() ? title(portrait) : caption.title;
  figure.subtitle = !caption.subtitle.empty() ? caption.subtitle : portrait.scale.linear() ? layout.shows : bent_shows;
  if (const double drive = portrait.system().drive(); drive > 0) {
    figure.title += ",  drive " + math("ϱ = ") + number(drive);
    if (caption.subtitle.empty() && layout.shows_driven) figure.subtitle = driven_shows;
  }
  figure.size = size;
  figure.theme = drawing.palette.theme;
  for (MappedPanel& shown : layout.panels(drawing)) {
    figure.panels.push_back(std::move(shown.panel));
    mapped.maps.push_back(std::move(shown.map));
  }
  if (drawing.coloured() && !shows_moments(portrait.view)) figure.colour_bar = colour_bar(drawing.bands, caption);
  return mapped;
}

}  // namespace contensou::portraits
