#include "contensou/portraits/paper_drawings.hpp"

#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/portraits/gnuplot.hpp"

using namespace contensou::portraits;
using Catch::Matchers::Contains;

namespace {

/// Whether everything that is drawn lies inside the frame.
void check_framed(const Figure& figure) {
  REQUIRE(figure.panels.size() == 1);
  const Panel& panel = figure.panels.front();
  CHECK(panel.bare);
  const auto check = [&](const Point& point) {
    CHECK(point.x > panel.x.low);
    CHECK(point.x < panel.x.high);
    CHECK(point.y > panel.y.low);
    CHECK(point.y < panel.y.high);
  };
  for (const Lines& layer : panel.lines) {
    for (const Polyline& line : layer.lines) {
      for (const Point& point : line) check(point);
    }
  }
  for (const Label& label : panel.labels) check(label.at);
  CHECK(panel.labels.size() >= 8);
  CHECK(panel.arrows.size() >= 5);
}

/// A circle of radius 1 that is one on paper, too: as wide as high in millimetres.
void check_scale(const Figure& figure) {
  const Panel& panel = figure.panels.front();
  const double width = (figure.width_mm - 25) / (panel.x.high - panel.x.low);
  const double height = 0.8 * figure.height_mm / (panel.y.high - panel.y.low);
  CHECK(width == Approx(height).epsilon(1e-12));
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
    CAPTURE(figure.title);
    check_framed(figure);
    check_scale(figure);
    CHECK_THAT(figure.subtitle, Contains("Zh98, Fig."));
  }
  CHECK(has_circle(patch_drawing(), {0, 0}));
  CHECK(has_circle(ball_drawing(), {0, 1}));
}

TEST_CASE("a bare panel has no axes, and its figure a heading without a legend", "[paper_drawings][gnuplot]") {
  const std::string script = gnuplot_script(patch_drawing());
  CHECK_THAT(script, Contains("unset border\nunset tics") && Contains("NaN notitle") && Contains("Fig. 1"));
}
