#include "contensou/portraits/theory_figures.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/laws.hpp"
#include "views/palette.hpp"

namespace contensou::portraits {

namespace {

using std::numbers::pi;

constexpr Colour law_guide{0x888888};
constexpr Colour law_force{0x0b4f8a};
constexpr Colour law_moment{0xb3003b};

/// Returns the look of a law's curves. Looks differ in grey, too: the exact law is heavy, the Pade law dashed.
Stroke stroke_of(const reduction::Law& law, Colour colour) {
  if (law.as<reduction::HertzLaw>()) return {colour, 2.4};
  if (law.as<reduction::PadeLaw>()) return {colour, 1.6, true};
  return {colour, 1.6, law.name() != "uniform", true};
}

constexpr double max_k = 4;

Polyline curve(const reduction::Law& law, double reduction::Resistance::*part) {
  constexpr int pieces = 400;
  Polyline line;
  for (int i = 0; i <= pieces; ++i) {
    const double k = max_k * i / pieces;
    line.push_back({k, law(reduction::slip_of_ratio(k)).*part});
  }
  return line;
}

}  // namespace

Figure law_figure(const std::vector<reduction::Law>& laws, const AskedSize& size) {
  const bool of_paper = laws.size() == 2 && laws[0].as<reduction::HertzLaw>() && laws[1].as<reduction::PadeLaw>();
  Panel panel;
  panel.x = {math("k = v/(ε|ω") + sub(math("z")) + "|)", 0, max_k, false, {}};
  panel.y = {math("Φ = F/(N f)") + ",   " + math("Ψ = M/(N f ε)"), 0, 1.05, false, {}};
  panel.lines.push_back({{{{0, 1}, {max_k, 1}}, {{1, 0}, {1, 1.05}}}, {law_guide, 0.8, true}, ""});
  for (const reduction::Law& law : laws) {
    const std::string name = shortened(law.name(), 20);
    const Text force = math("Φ") + ", " + name, moment = math("Ψ") + ", " + name;
    // Laws beside others have a colour each. A law alone, or the two of the paper, have a colour for each part.
    const bool by_law = laws.size() > 1 && !of_paper;
    const Colour its = viridis(0.4 * static_cast<double>(panel.lines.size() - 1) / static_cast<double>(laws.size()));
    const Colour of_force = by_law ? its : law_force, of_moment = by_law ? its : law_moment;
    panel.lines.push_back({{curve(law, &reduction::Resistance::force)}, stroke_of(law, of_force), force});
    panel.lines.push_back({{curve(law, &reduction::Resistance::moment)}, stroke_of(law, of_moment), moment});
    // Circles distinguish moments from forces.
    const Polyline& line = panel.lines.back().lines.front();
    Marks circles{{}, of_moment, 0.7, Marks::Shape::circle, moment};
    for (std::size_t i = line.size() / 16; i < line.size(); i += line.size() / 8) circles.points.push_back(line[i]);
    panel.marks.push_back(std::move(circles));
  }
  Figure figure;
  figure.title = "Combined dry friction of a circular patch";
  if (of_paper) {
    figure.subtitle = "Zhuravlev 1998, Fig. 2: the exact law (1.3), (1.5) and its Padé approximation (1.4), (1.6)";
    panel.labels = {
        {{0.5, 0.82}, "force  " + math("Φ"), law_force, Label::Align::centre},
        {{2.5, 0.2}, "moment  " + math("Ψ"), law_moment, Label::Align::centre},
        {{0.07, 0.64}, "3π/16", law_moment, Label::Align::left},
        {{1.04, 0.32}, "the centre of rotation leaves the patch", law_guide, Label::Align::left},
    };
  } else {
    figure.subtitle = "force and moment against the ratio of slip to spin";
  }
  figure.size = fitted({170, 115}, 1, size);
  figure.panels = {panel};
  return figure;
}

Figure limit_surface_figure(const std::vector<reduction::Law>& laws, const AskedSize& size) {
  Panel panel;
  panel.x = {"moment " + math("Ψ/Ψ(0) = M/M") + sub("max"), 0, 1.04, false, {}};
  panel.y = {"force " + math("Φ = F/(N f)"), 0, 1.04, false, {}};
  panel.to_scale = true;
  Polyline ellipse;
  constexpr int steps = 90;
  for (int i = 0; i <= steps; ++i) ellipse.push_back({std::cos(pi / 2 * i / steps), std::sin(pi / 2 * i / steps)});
  panel.lines.push_back({{std::move(ellipse)}, {law_guide, 1, true}, "ellipse"});
  panel.lines.push_back({{{{1, 0}, {0, 1}}}, {law_guide, 1, false, true}, "chord"});
  constexpr int pieces = 400;
  for (const reduction::Law& law : laws) {
    Polyline line;
    for (int i = 0; i <= pieces; ++i) {
      const auto [force, moment] = law(reduction::slip_of_ratio(std::tan(pi / 2 * i / pieces)));
      line.push_back({moment / law.pivoting_moment(), force});
    }
    line.push_back({0, 1});
    const double fraction = 0.8 * static_cast<double>(panel.lines.size() - 2) / static_cast<double>(laws.size());
    panel.lines.push_back({{std::move(line)}, stroke_of(law, viridis(fraction)), shortened(law.name(), 20)});
  }
  Figure figure;
  figure.title = "The limit surface of a circular patch";
  figure.subtitle = "force and moment at which a patch slips; under Coulomb friction they lie above the chord";
  const double width = size.width_mm.value_or(130);
  figure.size = {width, size.height_mm.value_or(1.05 * width)};
  figure.panels = {panel};
  return figure;
}

}  // namespace contensou::portraits
