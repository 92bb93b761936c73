#include "contensou/portraits/phase_portrait.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/detail/infinity.hpp"
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

bool have_one_mu(std::span<const PhasePortrait> portraits) {
  return std::ranges::all_of(
      portraits, [&](const PhasePortrait& other) { return other.system().mu() == portraits.front().system().mu(); });
}

bool have_one_law(std::span<const PhasePortrait> portraits) {
  return std::ranges::all_of(
      portraits, [&](const PhasePortrait& other) { return law_names(other) == law_names(portraits.front()); });
}

/// Returns a title of the properties that all portraits have in common: the body, and mu or the law.
Text common_title(std::span<const PhasePortrait> portraits) {
  const PhasePortrait& first = portraits.front();
  Text title = body_name(first.system().inertia());
  if (have_one_mu(portraits)) title += ",  " + math("μ = ") + number(first.system().mu());
  if (have_one_law(portraits)) title += ",  law: " + law_names(first);
  return title;
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

namespace {

/// Returns the best size for a number of planes side by side.
PaperSize usual_size(const ViewLayout& layout, std::size_t count) {
  if (count == 1) return {layout.width_mm, layout.height_mm};
  const double width = count == 2 || count == 6 ? 250 : count == 4 ? 190 : 300;
  return fitted({layout.width_mm * static_cast<double>(count), layout.height_mm}, static_cast<int>(count),
                {.width_mm = width});
}

MappedFigure draw_all(std::span<const PhasePortrait> portraits, std::span<const PortraitCaption> captions,
                      PortraitStyle style) {
  const PhasePortrait& first = portraits.front();
  const ViewLayout& layout = layout_of(first.view);
  if (layout.has_drawings) {
    style.colour_by_time = false;
    if (style.arrows == PortraitStyle::Arrows::time) style.arrows = PortraitStyle::Arrows::one;
  }
  const int panels = layout.panels_across * static_cast<int>(portraits.size());
  PaperSize usual = usual_size(layout, portraits.size());
  // Curves that share an x axis and stand one above another need less height than planes.
  const bool stacked = style.size.width_mm && panel_columns(*style.size.width_mm, panels) < panels;
  if (shows_moments(first.view) && stacked) usual.height_mm *= 0.6;
  const PaperSize size = fitted(usual, panels, style.size);
  const double time_unit = captions.front().time_unit;
  LayerLook look = look_of(size, panels, style.screen);
  if (layout.times == nullptr) {
    std::vector<const Portrait*> all;
    for (const PhasePortrait& portrait : portraits) all.push_back(&portrait);
    look.bands = bands_of(all, time_unit, look.palette);
  } else {
    double shortest = infinity, longest = 0;
    for (const PhasePortrait& portrait : portraits) {
      const auto [its_shortest, its_longest] = layout.times(portrait);
      shortest = std::min(shortest, its_shortest);
      longest = std::max(longest, its_longest);
    }
    style.colour_by_time = style.colour_by_time && shortest < longest;
    look.bands = logarithmic_bands(shortest, 2 * longest, time_unit, look.palette);
  }
  MappedFigure mapped;
  Figure& figure = mapped.figure;
  figure.title = captions.front().title.empty() ? common_title(portraits) : captions.front().title;
  const double drive = first.system().drive();
  if (drive > 0) figure.title += ",  drive " + math("ϱ = ") + number(drive);
  const auto& most_rays =
      *std::ranges::max_element(portraits, {}, [](const PhasePortrait& of) { return of.plane.terminal.rays.size(); });
  figure.subtitle = !captions.front().subtitle.empty()                          ? captions.front().subtitle
                    : first.scale.linear() || portraits.size() > 1 || drive > 0 ? layout.shows(most_rays)
                                                                                : bent_shows;
  figure.size = size;
  figure.max_columns = std::max(figure.max_columns, panels);
  figure.theme = look.palette.theme;
  bool coloured = false;
  const auto add_panels = [&] {
    figure.panels.clear();
    mapped.maps.clear();
    for (std::size_t i = 0; i < portraits.size(); ++i) {
      const Drawing drawing{{look, portraits[i], captions[i], style, portraits[i].system().mu()}, portraits[i]};
      for (MappedPanel& shown : layout.panels(drawing)) {
        if (const Text& own = captions[i].panel; !own.empty())
          shown.panel.title = shown.panel.title.empty() ? own : own + ",  " + shown.panel.title;
        figure.panels.push_back(std::move(shown.panel));
        mapped.maps.push_back(std::move(shown.map));
      }
      coloured = drawing.coloured();
    }
  };
  add_panels();
  if (layout.has_drawings) {
    // The legend decides the height of the panel, and the drawings of the patch are circles on paper.
    const Box box = lay_out(figure).panels.front().box;
    look.panel_mm = {box.width, box.height};
    add_panels();
  }
  if (coloured && !shows_moments(first.view)) figure.colour_bar = colour_bar(look.bands, captions.front());
  return mapped;
}

}  // namespace

MappedFigure draw_mapped(const PhasePortrait& portrait, const PortraitCaption& caption, PortraitStyle style) {
  return draw_all({&portrait, 1}, {&caption, 1}, style);
}

Figure draw_together(const std::vector<PhasePortrait>& portraits, std::vector<PortraitCaption> captions,
                     const PortraitStyle& style) {
  if (portraits.size() == 1) return draw(portraits.front(), captions.front(), style);
  constexpr std::size_t most = 6;
  if (portraits.size() > most)
    throw std::domain_error(fmt::format("a figure has room for {} planes, got {}", most, portraits.size()));
  const ViewLayout& layout = layout_of(portraits.front().view);
  if (layout.panels_across > 1) {
    throw std::domain_error(
        fmt::format("the view {} has {} panels for each plane: several planes are drawn in uv, patch, log or disc",
                    layout.name, layout.panels_across));
  }
  for (std::size_t i = 0; i < portraits.size(); ++i) {
    Text& panel = captions[i].panel;
    if (!have_one_mu(portraits)) panel += math("μ = ") + number(portraits[i].system().mu());
    if (!have_one_law(portraits)) panel += (panel.empty() ? "law " : ",  law ") + law_names(portraits[i]);
    if (const auto& start = portraits[i].highlight; !start.empty()) {
      panel += ",  " + captions[i].time_symbol + math(" = ") +
               fmt::format("{:.4g}", start[0].tau_left[0] / captions[i].time_unit) +
               (captions[i].time_unit_name.empty() ? "" : " " + captions[i].time_unit_name);
    }
  }
  return draw_all(portraits, captions, style).figure;
}

}  // namespace contensou::portraits
