#include "contensou/portraits/theory_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/render.hpp"
#include "contensou/reduction/laws.hpp"
#include "figures.hpp"

using namespace contensou;
using namespace contensou::portraits;
using Catch::Matchers::Contains;

namespace {

/// Checks that everything drawn lies inside the frame.
void check_framed(const Figure& figure) {
  REQUIRE(figure.panels.size() == 1);
  const Panel& panel = figure.panels.front();
  CHECK(panel.bare);
  for (const Lines& layer : panel.lines) {
    for (const Polyline& line : layer.lines) {
      for (const Point& point : line) CHECK(inside(panel, point));
    }
  }
  for (const Label& label : panel.labels) CHECK(inside(panel, label.at));
  CHECK(panel.labels.size() >= 8);
  CHECK(panel.arrows.size() >= 5);
}

/// Checks that a circle of radius 1 is a circle on paper: as wide as high in millimetres.
void check_scale(const Figure& figure) {
  const Panel& panel = figure.panels.front();
  const Box box = lay_out(figure).panels.front().box;
  CHECK(box.width / (panel.x.high - panel.x.low) == Approx(box.height / (panel.y.high - panel.y.low)).epsilon(1e-12));
}

bool has_circle(const Figure& figure, Point centre) {
  for (const Lines& layer : figure.panels.front().lines) {
    for (const Polyline& line : layer.lines) {
      bool round =
          line.size() > 50 && std::hypot(line.front().x - line.back().x, line.front().y - line.back().y) < 1e-9;
      for (const Point& point : line) {
        round = round && std::abs(std::hypot(point.x - centre.x, point.y - centre.y) - 1) < 1e-9;
      }
      if (round) return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("Fig. 1 and Fig. 3 are drawn inside their frames and to scale", "[paper_drawings]") {
  for (const Figure& figure : {patch_drawing(), ball_drawing()}) {
    CAPTURE(figure.title.words());
    check_framed(figure);
    check_scale(figure);
    CHECK_THAT(figure.subtitle.words(), Contains("Zhuravlev 1998, Fig."));
  }
  CHECK(has_circle(patch_drawing(), {0, 0}));
  CHECK(has_circle(ball_drawing(), {0, 1}));
}

TEST_CASE("a bare panel has no axes, and its figure a heading without a legend", "[paper_drawings][gnuplot]") {
  const std::string script = gnuplot_script(patch_drawing());
  CHECK_THAT(script, Contains("unset border\nunset tics") && Contains("NaN notitle") && Contains("Fig. 1"));
}

TEST_CASE("Fig. 2 draws force and moment of each law from the law itself", "[table]") {
  const auto figure = law_figure({reduction::HertzLaw{}, reduction::PadeLaw{}});
  REQUIRE(figure.panels.size() == 1);
  const auto& lines = figure.panels[0].lines;
  REQUIRE(lines.size() == 5);  // the guides, and two curves for each of two laws
  const auto check = [](const Polyline& line, const reduction::Law& law, auto part) {
    CHECK(line.front().x == 0);
    CHECK(line.back().x == 4);
    for (const auto& point : line) CHECK(point.y == law(reduction::slip_of_ratio(point.x)).*part);
  };
  check(lines[1].lines[0], reduction::HertzLaw{}, &reduction::Resistance::force);
  check(lines[2].lines[0], reduction::HertzLaw{}, &reduction::Resistance::moment);
  check(lines[3].lines[0], reduction::PadeLaw{}, &reduction::Resistance::force);
  check(lines[4].lines[0], reduction::PadeLaw{}, &reduction::Resistance::moment);
  // The curves are those of the paper: F starts at 0 with dF/dk = 3 pi/8, and M starts at the value 3 pi/16.
  const auto& force = lines[1].lines[0];
  CHECK(force[1].y / force[1].x == Approx(3 * std::numbers::pi / 8).epsilon(1e-4));
  CHECK(lines[2].lines[0].front().y == Approx(3 * std::numbers::pi / 16).epsilon(1e-15));
}

TEST_CASE("A limit surface goes from the largest moment to the largest force, inside the square", "[invariant]") {
  const Figure figure = limit_surface_figure({reduction::HertzLaw{}, reduction::PadeLaw{}});
  const Panel& panel = figure.panels.front();
  CHECK(panel.to_scale);
  REQUIRE(panel.lines.size() == 4);  // ellipse, chord, and the curves of two laws
  for (const Lines& layer : panel.lines) {
    const Polyline& line = layer.lines.front();
    CHECK(line.front().x == Approx(1));
    CHECK(line.front().y == Approx(0).margin(1e-12));
    CHECK(line.back().x == Approx(0).margin(1e-12));
    CHECK(line.back().y == Approx(1));
    for (const Point& point : line) CHECK(std::hypot(point.x, point.y) < 1.1);
  }
  // The chord is Phi + Psi/Psi(0) = 1. The curve of Coulomb friction (exact law) lies above it, that of Pade below.
  const auto& hertz = panel.lines[2].lines.front();
  const auto& pade = panel.lines[3].lines.front();
  for (std::size_t i = 1; i + 2 < hertz.size(); ++i) {
    CHECK(hertz[i].x + hertz[i].y > 1);
    CHECK(pade[i].x + pade[i].y < 1);
  }
}

TEST_CASE("Every curve of the laws is told from the others without colours", "[invariant]") {
  const Panel panel = law_figure({reduction::HertzLaw{}, reduction::PadeLaw{}, *reduction::find_law("ring")}).panels[0];
  REQUIRE(panel.lines.size() == 7);
  REQUIRE(panel.marks.size() == 3);
  std::set<std::tuple<bool, bool, bool>> looks;
  for (std::size_t i = 1; i < panel.lines.size(); ++i) {
    const Lines& lines = panel.lines[i];
    looks.insert({lines.stroke.dashed, lines.stroke.dotted,
                  std::ranges::find(panel.marks, lines.legend, &Marks::legend) != panel.marks.end()});
  }
  CHECK(looks.size() == 6);
}
