#include "contensou/portraits/layout.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

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
  CHECK(clipped(square(), {{0, 50}, {0, 0}, {0.5, 50}, {0.6, 50}}).size() == 1);  // a logarithmic axis has no 0
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

namespace {

Box around(const PlacedText& text, double letter) {
  double width = letter * text.size * text_width(text.text), height = letter * text.size;
  if (text.turned) std::swap(width, height);
  const double left = text.at.x - (text.align == Label::Align::left ? 0 : width / 2);
  return {left, text.at.y - height / 2, width, height};
}

bool overlap(const Box& a, const Box& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.bottom < b.bottom + b.height &&
         b.bottom < a.bottom + a.height;
}

/// Returns the boxes of all parts beside the panels of a figure.
std::vector<Box> parts(const Figure& figure, const Layout& layout) {
  std::vector<Box> all;
  for (const PlacedText& text : layout.texts) all.push_back(around(text, layout.letter));
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    const auto& [box, x, y, scale, colour_scale] = layout.panels[i];
    const double em = layout.letter;
    all.push_back(box);
    if (figure.panels[i].bare) continue;
    for (const Axis::Tick& tick : y) {
      const double width = 0.9 * em * text_width(tick.text);
      const double at = box.bottom + on_paper(figure.panels[i], {0, tick.at}).y * box.height;
      all.push_back({box.left - 0.9 * em - width, at - 0.5 * em, width, em});
    }
    for (const Axis::Tick& tick : x) {
      const double width = 0.9 * em * text_width(tick.text);
      const double at = box.left + on_paper(figure.panels[i], {tick.at, 10}).x * box.width;
      all.push_back({at - width / 2, box.bottom - 1.9 * em, width, em});
    }
  }
  return all;
}

}  // namespace

TEST_CASE("Nothing on the page overlaps or leaves it, in a column or on a page", "[invariant]") {
  for (double width : {60.0, 85.0, 170.0, 300.0}) {
    for (std::size_t count : {1, 2, 3}) {
      for (bool bar : {false, true}) {
        Figure figure;
        figure.title = "a title that is as long as those of portraits are";
        figure.subtitle = "a subtitle that has no room in one line of a column, but in two";
        figure.panels.assign(count, square());
        figure.panels[0].title = "the name of a panel that is far from short";
        figure.panels[0].y = {math("Φ = F/(N f)") + ",   " + math("Ψ"), -1234567, 0, false, {}};
        for (const char* entry : {"first", "the second of the legend", "third of it"}) {
          figure.panels[0].lines.push_back({{}, {}, entry});
        }
        if (bar)
          figure.colour_bar = ColourBar{"time left, s", {Colour{1}, Colour{2}}, {{0, "0"}, {0.02, "1"}, {1, "10"}}};
        const PaperSize size = fitted({190, 125}, static_cast<int>(count), {.width_mm = width});
        figure.size.width_mm = size.width_mm;
        figure.size.height_mm = size.height_mm + 15;
        CAPTURE(width, count, bar);
        const Layout layout = lay_out(figure);
        CHECK(layout.letter * 72 / 25.4 >= 6.2);
        CHECK(layout.legend.size() == 3);
        const std::vector<Box> all = parts(figure, layout);
        for (std::size_t i = 0; i < all.size(); ++i) {
          CHECK(all[i].left >= 0);
          CHECK(all[i].bottom >= 0);
          CHECK(all[i].left + all[i].width <= figure.size.width_mm);
          CHECK(all[i].bottom + all[i].height <= figure.size.height_mm);
          for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(overlap(all[i], all[j]));
        }
        CHECK(layout.colours.size() == (bar ? 2 : 0));
      }
    }
  }
}

TEST_CASE("A title of several lines leaves no word alone", "[limit]") {
  Figure figure;
  figure.title = "a title of a few words that fill a line of a column, and a bit of one more";
  figure.panels = {square()};
  figure.size = {85, 85};
  std::vector<double> widths;
  for (const PlacedText& text : lay_out(figure).texts) {
    if (text.size > 1) widths.push_back(text_width(text.text));
  }
  REQUIRE(widths.size() == 2);
  for (double width : widths) CHECK(width > 0.75 * std::ranges::max(widths));
}

TEST_CASE("A figure without room for its panels is refused, with a way out", "[domain]") {
  Figure figure;
  figure.title = "title";
  figure.panels.assign(2, square());
  figure.size.width_mm = 85;
  figure.size.height_mm = 40;
  CHECK_THROWS_WITH(lay_out(figure), Catch::Contains("85 x 40 mm") && Catch::Contains("make it larger"));
  figure.size.height_mm = 90;
  CHECK_NOTHROW(lay_out(figure));
}

TEST_CASE("Ticks are round, in the axis, and as many as have room", "[table]") {
  Figure figure;
  figure.panels.push_back(square());
  figure.panels[0].x = {"", -1, 1, false, {}};
  std::size_t before = 2;
  for (double width : {60.0, 120.0, 400.0}) {
    figure.size.width_mm = width;
    const auto ticks = lay_out(figure).panels[0].x;
    CHECK(ticks.size() > before);
    before = ticks.size();
    CHECK(ticks.front().at == Approx(-1));
    CHECK(ticks.back().text == Text("1"));
  }
  CHECK(lay_out(figure).panels[0].y.front().at == Approx(1));
}

TEST_CASE("The texts of ticks far from 0 differ", "[table]") {
  Panel panel;
  panel.x = {"", -6.58125, -6.58071, false, {}};
  panel.y = {"", 3.00000001e7, 3.00000009e7, false, {}};
  Figure figure;
  figure.size = {170, 120};
  figure.panels = {panel};
  const auto laid = lay_out(figure).panels[0];
  for (const auto* ticks : {&laid.x, &laid.y}) {
    std::set<std::string> texts;
    for (const auto& tick : *ticks) texts.insert(tick.text.words());
    CHECK(texts.size() >= 3);
    CHECK(texts.size() == ticks->size());
  }
}

TEST_CASE("A panel to scale has units of one length", "[invariant]") {
  Figure figure;
  figure.panels.push_back(square());
  figure.panels[0].y = {"", 0, 1, false, {}};
  figure.panels[0].to_scale = true;
  const Box box = lay_out(figure).panels[0].box;
  CHECK(box.width / box.height == Approx(2));
}

TEST_CASE("A panel to scale leaves no height empty when its figure is trimmed", "[table]") {
  Figure figure;
  figure.panels = {{}};
  figure.panels.front().x = {"x", 0, 4, false, {}};
  figure.panels.front().y = {"y", 0, 1, false, {}};
  CHECK(trimmed(figure).size.height_mm == figure.size.height_mm);
  figure.panels.front().to_scale = true;
  const Box before = lay_out(figure).panels.front().box;
  figure = trimmed(figure);
  CHECK(figure.size.height_mm < 90);  // the height was 120 mm before
  const Box after = lay_out(figure).panels.front().box;
  CHECK(after.width == Approx(before.width));
  CHECK(after.height == Approx(before.height));
  CHECK(trimmed(figure).size.height_mm == Approx(figure.size.height_mm));
}
