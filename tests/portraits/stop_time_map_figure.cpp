#include "contensou/portraits/stop_time_map_figure.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/portraits/gnuplot.hpp"
#include "contensou/reduction/pade_law.hpp"

using namespace contensou;
using namespace contensou::portraits;

namespace {

Figure figure_of(double mu, const MapAxes& axes) {
  return draw(stop_time_map(reduction::StopTimeTable(reduction::ReducedSystem(reduction::PadeLaw{}, mu)), axes));
}

Eigen::ArrayXd even(Eigen::Index count, double low, double high) { return Eigen::ArrayXd::LinSpaced(count, low, high); }

Figure linear() { return figure_of(0.3, {even(101, -2, 2), even(101, 0, 3)}); }

/// 1e-2 to 1e2 and 1e-3 to 1e2.
Figure logarithmic() {
  return figure_of(0.1, {(even(101, -2, 2) * std::log(10)).exp(), (even(101, -3, 2) * std::log(10)).exp(), true});
}

}  // namespace

TEST_CASE("The colours of a map are its stop times, from the lower left", "[table]") {
  for (const Figure& figure : {linear(), logarithmic()}) {
    const Panel& panel = figure.panels.at(0);
    REQUIRE(panel.colours);
    const ColourMap& colours = *panel.colours;
    const std::size_t rows = colours.values.size() / colours.columns;
    const auto at = [](const Axis& axis, double share) {
      return axis.logarithmic ? axis.low * std::pow(axis.high / axis.low, share)
                              : axis.low + share * (axis.high - axis.low);
    };
    const reduction::StopTimeTable table(
        reduction::ReducedSystem(reduction::PadeLaw{}, panel.x.logarithmic ? 0.1 : 0.3));
    double worst = 0;
    for (std::size_t i = 0; i < rows; i += 7) {
      for (std::size_t j = 0; j < colours.columns; j += 7) {
        const double u = at(panel.x, (static_cast<double>(j) + 0.5) / static_cast<double>(colours.columns));
        const double v = at(panel.y, (static_cast<double>(i) + 0.5) / static_cast<double>(rows));
        const double tau = table(u, v);
        const double unit = panel.x.logarithmic ? tau : colours.scale.high;
        worst = std::max(worst, std::abs(colours.values[i * colours.columns + j] - tau) / unit);
      }
    }
    CHECK(worst < 2e-3);  // of interpolation between the map's values
    CHECK(colours.scale.low <= *std::ranges::min_element(colours.values));
    CHECK(colours.scale.high >= *std::ranges::max_element(colours.values));
    CHECK(colours.scale.logarithmic == panel.x.logarithmic);
  }
}

TEST_CASE("Isochrones have labels that lie on them, inside the panel", "[invariant]") {
  for (const Figure& figure : {linear(), logarithmic()}) {
    const Panel& panel = figure.panels.at(0);
    CHECK(panel.labels.size() >= 6);
    for (const Label& label : panel.labels) {
      const auto on = [&](const Polyline& line) {
        return std::ranges::any_of(line, [&](Point p) { return p.x == label.at.x && p.y == label.at.y; });
      };
      CHECK(std::ranges::count_if(panel.lines.at(0).lines, on) == 1);
      CHECK((label.at.x >= panel.x.low && label.at.x <= panel.x.high));
      CHECK((label.at.y >= panel.y.low && label.at.y <= panel.y.high));
    }
  }
}

TEST_CASE("The ray k = 1 is drawn where it crosses the map, and only there", "[limit]") {
  const auto ray = [](const Figure& figure) { return figure.panels.at(0).lines.at(1).lines; };
  REQUIRE(ray(linear()).size() == 2);
  CHECK(ray(linear())[0].back().x == 2);
  CHECK(ray(linear())[0].back().y == Approx(0.6));
  CHECK(ray(linear())[1].back().x == -2);
  CHECK(ray(logarithmic())[0].front().y == Approx(1e-3));
  CHECK(figure_of(0.3, {even(2, 0, 1), even(2, 1, 2)}).panels.at(0).lines.size() == 1);
  CHECK(figure_of(0.3, {even(2, 10, 11), even(2, 0, 1)}).panels.at(0).lines.size() == 1);
  CHECK(ray(figure_of(1, {even(2, -3, -1), even(2, 0, 2)})).at(0).back().x == -2);
}

TEST_CASE("Axes have ticks whatever they span", "[limit]") {
  for (const double decades : {0.01, 0.1, 0.5, 1.0, 2.0, 4.0, 30.0}) {
    const MapAxes axes{(even(3, 0, decades) * std::log(10)).exp(), (even(3, 0, decades) * std::log(10)).exp(), true};
    const Panel panel = figure_of(0.3, axes).panels.at(0);
    INFO(decades);
    for (const Axis& axis : {panel.x, panel.y, panel.colours->scale}) {
      CHECK(axis.ticks.size() >= 2);
      CHECK(axis.ticks.size() <= 13);
      for (const Axis::Tick& tick : axis.ticks) {
        CHECK((tick.at >= axis.low * 0.999 && tick.at <= axis.high * 1.001));
      }
    }
  }
}

TEST_CASE("A map is drawn by gnuplot, over axes of its own", "[table]") {
  const std::string script = gnuplot_script(logarithmic());
  CHECK(script.find("'-' matrix using ($1+0.5):($2+0.5):3 axes x2y2 with image") != std::string::npos);
  CHECK(script.find("set palette defined") != std::string::npos);
  CHECK(script.find("nan") == std::string::npos);
  CHECK(script == gnuplot_script(logarithmic()));
  CHECK(render(logarithmic(), PictureFormat::svg).find("<image") != std::string::npos);
  CHECK(render(linear(), PictureFormat::png).starts_with("\x89PNG"));
}
