#include "contensou/portraits/law_figure.hpp"

#include <string>

#include <fmt/format.h>

namespace contensou::portraits {

namespace {

constexpr Colour force_colour{0x0b4f8a};
constexpr Colour moment_colour{0xb3003b};
constexpr Colour guide_colour{0x999999};
constexpr double largest_k = 4;

Polyline curve(const reduction::Law& law, double reduction::Resistance::*part) {
  constexpr int pieces = 400;
  Polyline line;
  for (int i = 0; i <= pieces; ++i) {
    const double k = largest_k * i / pieces;
    line.push_back({k, law(reduction::slip_of_ratio(k)).*part});
  }
  return line;
}

}  // namespace

Figure law_figure(const std::vector<reduction::Law>& laws) {
  Panel panel;
  panel.x = {"{/:Italic k = v}/({/:Italic ε}|{/:Italic ω_z}|)", 0, largest_k, false, {}};
  panel.y = {"", 0, 1.05, false, {}};
  panel.lines.push_back({{{{0, 1}, {largest_k, 1}}, {{1, 0}, {1, 1.05}}}, {guide_colour, 0.8, true}, ""});
  for (const reduction::Law& law : laws) {
    const bool dashed = law.name() != "exact";
    const double width = dashed ? 1.6 : 2.4;
    panel.lines.push_back({{curve(law, &reduction::Resistance::force)},
                           {force_colour, width, dashed},
                           fmt::format("{{/:Italic Φ}}, {} law", literal(law.name()))});
    panel.lines.push_back({{curve(law, &reduction::Resistance::moment)},
                           {moment_colour, width, dashed},
                           fmt::format("{{/:Italic Ψ}}, {} law", literal(law.name()))});
  }
  panel.labels = {
      {{2.9, 0.9}, "force  {/:Italic Φ = F}/({/:Italic N f})", force_colour, Label::Align::centre},
      {{2.5, 0.2}, "moment  {/:Italic Ψ = M}/({/:Italic N f ε})", moment_colour, Label::Align::centre},
      {{0.03, 0.63}, "3π/16", moment_colour, Label::Align::left},
      {{1.04, 0.32}, "the centre of rotation leaves the patch", guide_colour, Label::Align::left},
  };
  Figure figure;
  figure.title = "Combined dry friction of a circular Hertz patch";
  figure.subtitle = "Zh98, Fig. 2: the exact law (1.3), (1.5) and its Padé approximation (1.4), (1.6)";
  figure.width_mm = 170;
  figure.height_mm = 115;
  figure.panels = {panel};
  return figure;
}

}  // namespace contensou::portraits
