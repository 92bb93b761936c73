#include "contensou/portraits/phase_portrait_figure.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"

using namespace contensou;
using portraits::Figure;
using portraits::Panel;

namespace {

Figure figure_of(double mu, std::optional<reduction::State> highlight = {}) {
  portraits::PortraitRequest request;
  request.highlight = highlight;
  return portraits::draw(portraits::phase_portrait({reduction::HertzLaw{}, mu}, request));
}

const portraits::Lines& layer(const Panel& panel, const std::string& legend) {
  const auto found =
      std::ranges::find_if(panel.lines, [&](const auto& lines) { return lines.legend.starts_with(legend); });
  REQUIRE(found != panel.lines.end());
  return *found;
}

bool inside(const Panel& panel, portraits::Point point) {
  return point.x >= panel.x.low && point.x <= panel.x.high && point.y >= panel.y.low && point.y <= panel.y.high;
}

}  // namespace

TEST_CASE("The plane shows orbits, isochrones and both invariant axes, each in the legend", "[table]") {
  for (double mu : {0.3, 0.099, 0.0035}) {
    CAPTURE(mu);
    const Panel panel = figure_of(mu).panels.front();
    CHECK(layer(panel, "orbits").lines.size() == 24);
    CHECK(layer(panel, "time left").lines.size() >= 4);
    const auto& axes = layer(panel, "invariant axes").lines;
    REQUIRE(axes.size() == 2);
    CHECK(std::ranges::all_of(axes[0], [](portraits::Point point) { return point.y == 0; }));
    CHECK(std::ranges::all_of(axes[1], [](portraits::Point point) { return point.x == 0; }));
  }
}

TEST_CASE("Each orbit carries an arrow that points the way of the motion", "[invariant]") {
  for (double mu : {0.3, 0.099, 0.0035}) {
    for (const Panel& panel : figure_of(mu).panels) {
      const auto& arrows = panel.arrows.front().arrows;
      CHECK(arrows.size() == layer(panel, "orbits").lines.size());
      for (const auto& arrow : arrows) {
        CHECK(inside(panel, arrow.at));
        CHECK(arrow.direction.y <= 0);
        CHECK(arrow.direction.x * arrow.at.x <= 0);
        CHECK(std::hypot(arrow.direction.x, arrow.direction.y) > 0);
      }
    }
  }
}

TEST_CASE("Every isochrone is labelled, inside the panel and no two labels at one place", "[invariant]") {
  for (double mu : {1.0, 0.3, 0.099, 0.0035}) {
    CAPTURE(mu);
    const Panel panel = figure_of(mu).panels.front();
    CHECK(panel.labels.size() >= 4);
    for (std::size_t i = 0; i < panel.labels.size(); ++i) {
      CHECK(inside(panel, panel.labels[i].at));
      for (std::size_t j = 0; j < i; ++j) {
        const double dx = (panel.labels[i].at.x - panel.labels[j].at.x) / (panel.x.high - panel.x.low);
        const double dy = (panel.labels[i].at.y - panel.labels[j].at.y) / (panel.y.high - panel.y.low);
        CHECK(std::hypot(dx, dy) > 0.03);
      }
    }
  }
}

TEST_CASE("No label touches an orbit", "[invariant]") {
  for (double mu : {0.5, 0.3, 0.2, 0.099, 0.0035}) {
    CAPTURE(mu);
    const Panel panel = figure_of(mu).panels.front();
    const double width = panel.x.high - panel.x.low;
    for (const auto& label : panel.labels) {
      CAPTURE(label.text);
      double nearest = width;
      for (const auto& line : layer(panel, "orbits").lines) {
        for (std::size_t i = 1; i < line.size(); ++i) {
          if (line[i - 1].y < label.at.y || line[i].y > label.at.y) continue;
          nearest = std::min(nearest, std::abs(line[i].x - label.at.x));
        }
      }
      CHECK(nearest / width > 0.01);  // half the width of a digit and its margins
    }
  }
}

TEST_CASE("Small mu gets a second panel in ln k, filled to its corners and finite", "[invariant]") {
  CHECK(figure_of(0.3).panels.size() == 1);
  for (double mu : {0.099, 0.0035, 1e-6}) {
    CAPTURE(mu);
    const Figure figure = figure_of(mu);
    REQUIRE(figure.panels.size() == 2);
    const Panel& panel = figure.panels[1];
    const auto& orbits = layer(panel, "orbits").lines;
    CHECK(orbits.size() > 24);
    double lowest_start = panel.y.high;
    for (const auto& line : orbits) {
      for (const auto& point : line) REQUIRE((std::isfinite(point.x) && std::isfinite(point.y)));
      lowest_start = std::min(lowest_start, line.front().y);
    }
    // Orbits enter through the sides nearly down to the bottom.
    CHECK(lowest_start < panel.y.low + 0.2 * (panel.y.high - panel.y.low));
  }
}

TEST_CASE("A highlighted orbit is marked at its start, and labels are on the other side", "[table]") {
  for (double sign : {1.0, -1.0}) {
    const Panel panel = figure_of(0.3, reduction::State{sign, 2}).panels.front();
    REQUIRE(panel.marks.size() == 1);
    CHECK(panel.marks[0].points[0].x == sign);
    for (const auto& label : panel.labels) CHECK(label.at.x * sign < 0);
  }
}

TEST_CASE("Captions replace title, units and the unit of the labels", "[table]") {
  portraits::PortraitRequest request;
  request.time_unit = 4;
  const auto portrait = portraits::phase_portrait({reduction::PadeLaw{}, 0.3}, request);
  portraits::PortraitCaption caption;
  caption.title = "A ball";
  caption.speed_unit = "m/s";
  caption.time_unit = 4;
  caption.time_unit_name = "s";
  const Figure figure = portraits::draw(portrait, caption);
  CHECK(figure.title == "A ball");
  CHECK(figure.panels[0].y.name.ends_with("m/s"));
  CHECK(layer(figure.panels[0], "time left").legend.ends_with(", s"));
  CHECK(figure.panels[0].labels.size() >= 4);
  for (const auto& label : figure.panels[0].labels) {
    const double multiple = std::stod(label.text) / std::stod(figure.panels[0].labels[0].text);
    CHECK(multiple == Approx(std::round(multiple)));
  }
}
