#include "contensou/portraits/law_figure.hpp"

#include <string>

#include <fmt/format.h>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"

namespace contensou::portraits {

namespace {

/// How the curves of one law look: the exact law heavy, its approximation dashed, further laws light.
struct Look {
  Colour force;
  Colour moment;
  double width;
  bool dashed;
};

constexpr Look exact_look{{0x0b4f8a}, {0xb3003b}, 2.4, false};
constexpr Look pade_look{{0x0b4f8a}, {0xb3003b}, 1.6, true};
constexpr Look other_look{{0x4aa3df}, {0xf0709a}, 1.6, false};

const Look& look_of(const reduction::Law& law) {
  if (law.as<reduction::HertzLaw>()) return exact_look;
  return law.as<reduction::PadeLaw>() ? pade_look : other_look;
}

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
  panel.y = {"{/:Italic Φ = F}/({/:Italic N f}),   {/:Italic Ψ = M}/({/:Italic N f ε})", 0, 1.05, false, {}};
  panel.lines.push_back({{{{0, 1}, {largest_k, 1}}, {{1, 0}, {1, 1.05}}}, {guide_colour, 0.8, true}, ""});
  for (const reduction::Law& law : laws) {
    const Look& look = look_of(law);
    panel.lines.push_back({{curve(law, &reduction::Resistance::force)},
                           {look.force, look.width, look.dashed},
                           fmt::format("{{/:Italic Φ}}, {}", literal(law.name(), 20))});
    panel.lines.push_back({{curve(law, &reduction::Resistance::moment)},
                           {look.moment, look.width, look.dashed},
                           fmt::format("{{/:Italic Ψ}}, {}", literal(law.name(), 20))});
  }
  Figure figure;
  figure.title = "Combined dry friction of a circular patch";
  figure.subtitle = "Zh98, Fig. 2: the exact law (1.3), (1.5) and its Padé approximation (1.4), (1.6)";
  if (laws.size() <= 2) {
    panel.labels = {
        {{2.9, 0.9}, "force  {/:Italic Φ}", exact_look.force, Label::Align::centre},
        {{2.5, 0.2}, "moment  {/:Italic Ψ}", exact_look.moment, Label::Align::centre},
        {{0.03, 0.63}, "3π/16", exact_look.moment, Label::Align::left},
        {{1.04, 0.32}, "the centre of rotation leaves the patch", guide_colour, Label::Align::left},
    };
  }
  figure.width_mm = 170;
  figure.height_mm = 115;
  figure.panels = {panel};
  return figure;
}

}  // namespace contensou::portraits
