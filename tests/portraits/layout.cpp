#include "contensou/portraits/layout.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace contensou::portraits;

namespace {

Panel square() {
  Panel panel;
  panel.x = {"x", -1, 1, false, {}};
  panel.y = {"y", 1, 100, true, {}};
  return panel;
}

}  // namespace

TEST_CASE("Places on paper and points of the panel lead back to each other", "[invariant]") {
  const Panel panel = square();
  CHECK(on_paper(panel, {0, 10}).x == Approx(0.5));
  CHECK(on_paper(panel, {0, 10}).y == Approx(0.5));
  for (Point point : {Point{-1, 1}, Point{0.3, 77}, Point{2, 1000}}) {
    const Point back = from_paper(panel, on_paper(panel, point));
    CHECK(back.x == Approx(point.x));
    CHECK(back.y == Approx(point.y));
  }
  CHECK(paper_distance(panel, {-1, 1}, {1, 100}) == Approx(std::sqrt(2.0)));
}

TEST_CASE("A line is cut at the axes, and where it is not finite", "[table]") {
  Panel panel;
  panel.x = {"", 0, 1, false, {}};
  panel.y = {"", 0, 1, false, {}};
  const auto parts = clipped(panel, {{-1, 0.5}, {0.5, 0.5}, {0.5, 3}, {0.8, 3}, {0.8, -1}});
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].front().x == Approx(0).margin(1e-15));
  CHECK(parts[0].size() == 3);
  CHECK(parts[0].back().y == Approx(1));
  CHECK(parts[1].front().y == Approx(1));
  CHECK(parts[1].back().y == Approx(0).margin(1e-15));
  CHECK(clipped(panel, {{2, 2}, {3, 0.5}}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(clipped(panel, {{0.1, 0.1}, {0.2, 0.1}, {nan, 0.1}, {0.4, 0.1}, {0.5, 0.1}}).size() == 2);
  CHECK(clipped(square(), {{0, 50}, {0, 0}, {0.5, 50}, {0.6, 50}}).size() == 1);  // 0 is nowhere on a logarithmic axis
  CHECK(clipped(panel, {{0.3, 0.3}}).empty());
}

TEST_CASE("A thinned line stays as near as promised, and keeps its ends", "[invariant]") {
  Panel panel;
  panel.x = {"", 0, 1, false, {}};
  panel.y = {"", 0, 1, false, {}};
  Polyline arc;
  for (int i = 0; i <= 1000; ++i) arc.push_back({std::cos(i * 1.5e-3), std::sin(i * 1.5e-3)});
  const double tolerance = 1e-3;
  const Polyline thin = thinned(panel, arc, tolerance);
  CHECK(thin.size() < 60);
  CHECK(thin.size() > 10);
  CHECK(thin.front().x == arc.front().x);
  CHECK(thin.back().y == arc.back().y);
  for (std::size_t i = 1; i < thin.size(); ++i) {
    const Point middle{(thin[i - 1].x + thin[i].x) / 2, (thin[i - 1].y + thin[i].y) / 2};
    CHECK(1 - std::hypot(middle.x, middle.y) < tolerance);
  }
}

TEST_CASE("Arrows lie on their line and point along it, also on logarithmic axes", "[table]") {
  const Panel panel = square();
  const Arrow arrow = arrow_along(panel, {{-1, 1}, {-1, 100}, {1, 100}}, 0.25);
  CHECK(arrow.at.x == Approx(-1));
  CHECK(arrow.at.y == Approx(10));
  CHECK(arrow.direction.x == 0);
  CHECK(arrow.direction.y > 0);
  const Box box{0, 0, 100, 50};
  const auto head = short_arrow(panel, box, arrow);
  REQUIRE(head);
  CHECK(head->at.x == Approx(-1));
  CHECK((on_paper(panel, arrow.at).y - on_paper(panel, head->at).y) * box.height == Approx(0.5));
  CHECK_FALSE(short_arrow(panel, box, {{0, 10}, {0, 0}}));
}

TEST_CASE("Nothing on the page overlaps or leaves it", "[invariant]") {
  for (double width : {80.0, 190.0, 400.0}) {
    for (std::size_t count : {1, 2, 3}) {
      for (bool bar : {false, true}) {
        Figure figure;
        figure.title = "title";
        figure.subtitle = "subtitle";
        figure.width_mm = width * static_cast<double>(count);
        figure.panels.assign(count, square());
        figure.panels[0].title = "name";
        figure.panels[0].lines.push_back({{}, {}, "legend"});
        if (bar) figure.colour_bar = ColourBar{"time", {Colour{1}, Colour{2}}, {}};
        const Layout layout = lay_out(figure);
        CHECK(layout.title < figure.height_mm);
        CHECK(layout.subtitle < layout.title - layout.letter);
        double right = 0;
        for (std::size_t i = 0; i < count; ++i) {
          const Box& box = layout.panels[i];
          CHECK(box.left > right + layout.letter);
          CHECK(box.width > 0.4 * width);
          CHECK(box.bottom > layout.legend + 3 * layout.letter);
          CHECK(layout.names[i] < layout.subtitle - layout.letter);
          CHECK(layout.names[i] > box.bottom + box.height);
          right = box.left + box.width;
        }
        CHECK(right < figure.width_mm);
        if (bar) {
          CHECK(layout.colour_bar.left > right);
          CHECK(layout.colour_bar.left + layout.colour_bar.width + 3 * layout.letter < figure.width_mm);
        } else {
          CHECK(layout.colour_bar.width == 0);
        }
      }
    }
  }
}

TEST_CASE("A panel to scale has units of one length", "[invariant]") {
  Figure figure;
  figure.panels.push_back(square());
  figure.panels[0].y = {"", 0, 1, false, {}};
  figure.panels[0].to_scale = true;
  const Box box = lay_out(figure).panels[0];
  CHECK(box.width / box.height == Approx(2));
}
