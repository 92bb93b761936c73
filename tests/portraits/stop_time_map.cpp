#include "contensou/portraits/stop_time_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/render.hpp"
#include "contensou/reduction/laws.hpp"
#include "figures.hpp"

using namespace contensou;
using namespace contensou::portraits;
using reduction::Flow;

namespace {

Eigen::ArrayXd even(Eigen::Index count, double low, double high) { return Eigen::ArrayXd::LinSpaced(count, low, high); }

/// Returns numbers from 10^low to 10^high.
Eigen::ArrayXd decades(Eigen::Index count, double low, double high) {
  return (even(count, low, high) * std::numbers::ln10).exp();
}

StopTimeMap map_of(double mu, const MapAxes& axes) { return stop_time_map({{reduction::PadeLaw{}, mu}}, axes); }

Figure figure_of(double mu, const MapAxes& axes) { return draw(map_of(mu, axes)); }
Figure linear() { return figure_of(0.3, {even(101, -2, 2), even(101, 0, 3)}); }
Figure logarithmic() { return figure_of(0.1, {decades(101, -2, 2), decades(101, -3, 2), true}); }

}  // namespace

TEST_CASE("A map has a row for each v0 and a column for each u0", "[route]") {
  const Flow flow(reduction::HertzLaw{}, 0.3);
  const StopTimeMap map = stop_time_map(flow, {even(7, -1, 2), even(3, 0, 4)});
  REQUIRE(map.tau.rows() == 3);
  REQUIRE(map.tau.cols() == 7);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 7; ++j) {
      const double tau = flow.stop_time({map.axes.u0[j], map.axes.v0[i]}).tau;
      CHECK(map.tau(i, j) == Approx(tau).epsilon(1e-14));
    }
  }
}

TEST_CASE("A map in units of its own is the same picture", "[route]") {
  const Flow flow(reduction::HertzLaw{}, 0.3);
  const MapAxes axes{even(7, 0, 2), even(5, 0, 4)};
  const Figure plain = draw(stop_time_map(flow, axes));
  // The unit of u is 0.5 and the unit of time 10.
  const Figure figure = draw(stop_time_map(flow, axes, 10),
                             {.title = "ball", .time = "t", .u_unit = 0.5, .time_unit = 10}, {.width_mm = 85});
  CHECK(figure.size.width_mm == 85);
  CHECK(figure.title == "ball");
  const Panel &one = plain.panels[0], &other = figure.panels[0];
  CHECK(other.x.high == 4);
  CHECK(other.colours->scale.high == Approx(one.colours->scale.high / 10));
  CHECK(layer(other, "k = 1").lines[0][1].x == Approx(2 * layer(one, "k = 1").lines[0][1].x));
  for (const Label& label : other.labels) {
    CHECK(flow.stop_time({0.5 * label.at.x, label.at.y}).tau ==
          Approx(10 * std::stod(label.text.words())).epsilon(1e-3));
  }
  CHECK(other.labels.size() >= 4);
}

TEST_CASE("Every point of an isochrone stops at its time, and lies in the map", "[invariant]") {
  for (const double mu : {0.01, 0.3, 1.0}) {
    const reduction::Flow flow(reduction::PadeLaw{}, mu);
    for (const MapAxes& axes :
         {MapAxes{even(5, -2, 2), even(5, 0, 3), false}, MapAxes{even(5, 1, 2), even(5, 1, 3), false},
          MapAxes{even(5, -4, -1), even(5, 0, 3), false}, MapAxes{even(5, 1e-3, 2), even(5, 1e-5, 30), true}}) {
      const StopTimeMap map = stop_time_map(flow, axes);
      CHECK(map.isochrones.size() >= 3);
      for (const Isochrone& isochrone : map.isochrones) {
        for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) {
          const double u = isochrone.u[i], v = isochrone.v[i];
          CHECK(flow.stop_time({u, v}).tau == Approx(isochrone.tau_stop).epsilon(1e-12));
          CHECK((u >= axes.u0[0] && u <= axes.u0[4] && v >= axes.v0[0] && v <= axes.v0[4]));
        }
      }
    }
  }
}

TEST_CASE("An isochrone runs from border to border", "[limit]") {
  const StopTimeMap map = map_of(0.5, {even(3, -2, 2), even(3, 0, 3)});
  for (const Isochrone& isochrone : map.isochrones) {
    for (const Eigen::Index end : {Eigen::Index{0}, isochrone.u.size() - 1}) {
      const double u = isochrone.u[end], v = isochrone.v[end];
      const double gap = std::min({2 - std::abs(u), v, 3 - v});
      CHECK(gap == Approx(0).margin(1e-9));
    }
    // The isochrone has no jump.
    for (Eigen::Index i = 1; i < isochrone.u.size(); ++i) {
      CHECK(std::hypot(isochrone.u[i] - isochrone.u[i - 1], isochrone.v[i] - isochrone.v[i - 1]) < 0.1);
    }
  }
}

TEST_CASE("Isochrones are at round times", "[table]") {
  const auto times = [](const MapAxes& axes) {
    std::vector<double> result;
    for (const Isochrone& isochrone : map_of(0.32, axes).isochrones) result.push_back(isochrone.tau_stop);
    return result;
  };
  // Stop times run from 0 to 16 * 1/(5 * 0.32) = 10.
  CHECK(times({even(3, 0, 1), even(2, 0, 1e-3)}) == std::vector<double>{2, 4, 6, 8, 10});
  const std::vector<double> wide = times({even(2, 1e-3, 1), even(2, 1e-9, 1e-6), true});
  REQUIRE(wide.size() == 9);
  CHECK(wide[0] == Approx(0.02));
  CHECK(wide[1] == Approx(0.05));
  CHECK(wide[8] == Approx(10));
}

TEST_CASE("A map that cannot be drawn is refused", "[domain]") {
  const auto refused = [](const MapAxes& axes, const std::string& word) {
    CHECK_THROWS_WITH(map_of(0.3, axes), Catch::Contains("stop_time_map: ") && Catch::Contains(word));
  };
  refused({even(1, 1, 1), even(2, 0, 1)}, "u0 needs two values or more, got 1");
  refused({even(2, 0, 1), even(1, 1, 1)}, "v0 needs two values or more, got 1");
  refused({even(3, 1, 0), even(2, 0, 1)}, "u0 must increase");
  refused({even(3, 0, 1), even(2, -1, 1)}, "v0 must be >= 0, got -1");
  refused({even(3, 0, 1), even(2, 1, 2), true}, "u0 must be > 0 on logarithmic axes, got 0");
  refused({even(3, 0, 1e101), even(2, 1, 2)}, "u0 from 0 to 1e+101 cannot be drawn");
  refused({even(3, 0, 1e-101), even(2, 1, 2)}, "u0 from 0 to 1e-101 cannot be drawn");
  CHECK_THROWS_WITH(map_of(1e-300, {even(2, 0, 1e99), even(2, 0, 1)}), Catch::Contains("beyond the largest double"));
}

TEST_CASE("The colours of a map are its stop times, from the lower left", "[table]") {
  for (const Figure& figure : {linear(), logarithmic()}) {
    const Panel& panel = figure.panels.at(0);
    REQUIRE(panel.colours);
    const ColourMap& colours = *panel.colours;
    const std::size_t rows = colours.values.size() / colours.columns;
    const auto at = [](const Axis& axis, double fraction) {
      return axis.logarithmic ? axis.low * std::pow(axis.high / axis.low, fraction)
                              : axis.low + fraction * (axis.high - axis.low);
    };
    const Flow flow(reduction::PadeLaw{}, panel.x.logarithmic ? 0.1 : 0.3);
    double worst = 0;
    for (std::size_t i = 0; i < rows; i += 7) {
      for (std::size_t j = 0; j < colours.columns; j += 7) {
        const double u = at(panel.x, (static_cast<double>(j) + 0.5) / static_cast<double>(colours.columns));
        const double v = at(panel.y, (static_cast<double>(i) + 0.5) / static_cast<double>(rows));
        const double tau = flow.stop_time({u, v}).tau;
        const double unit = panel.x.logarithmic ? tau : colours.scale.high;
        worst = std::max(worst, std::abs(colours.values[i * colours.columns + j] - tau) / unit);
      }
    }
    CHECK(worst < 2e-3);  // error of interpolation between the values of the map
    CHECK(colours.scale.low <= *std::ranges::min_element(colours.values));
    CHECK(colours.scale.high >= *std::ranges::max_element(colours.values));
    CHECK(colours.scale.logarithmic == panel.x.logarithmic);
  }
}

TEST_CASE("Isochrones have labels that tell their time, inside the panel", "[invariant]") {
  for (const Figure& figure : {linear(), logarithmic()}) {
    const Panel& panel = figure.panels.at(0);
    const Flow flow(reduction::PadeLaw{}, panel.x.logarithmic ? 0.1 : 0.3);
    CHECK(panel.labels.size() >= 6);
    for (const Label& label : panel.labels) {
      CHECK(flow.stop_time({label.at.x, label.at.y}).tau == Approx(std::stod(label.text.words())).epsilon(1e-3));
      CHECK(inside(panel, label.at));
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
  for (const double span : {0.01, 0.1, 0.5, 1.0, 2.0, 4.0, 30.0}) {
    const Figure figure = figure_of(0.3, {decades(3, 0, span), decades(3, 0, span), true});
    const Panel& panel = figure.panels.at(0);
    const PanelPlace place = lay_out(figure).panels.at(0);
    INFO(span);
    for (const auto& [axis, ticks] :
         {std::pair{panel.x, place.x}, std::pair{panel.y, place.y}, std::pair{panel.colours->scale, place.scale}}) {
      CHECK(ticks.size() >= 2);
      CHECK(ticks.size() <= 13);
      for (const Axis::Tick& tick : ticks) {
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
