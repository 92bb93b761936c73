#include "contensou/portraits/law_figure.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"

using namespace contensou;

TEST_CASE("Fig. 2 draws force and moment of each law from the law itself", "[table]") {
  const auto figure = portraits::law_figure({reduction::HertzLaw{}, reduction::PadeLaw{}});
  REQUIRE(figure.panels.size() == 1);
  const auto& lines = figure.panels[0].lines;
  REQUIRE(lines.size() == 5);  // guides, and two curves for each of two laws
  const auto check = [](const portraits::Polyline& line, const reduction::Law& law, auto part) {
    CHECK(line.front().x == 0);
    CHECK(line.back().x == 4);
    for (const auto& point : line) CHECK(point.y == law(reduction::slip_of_ratio(point.x)).*part);
  };
  check(lines[1].lines[0], reduction::HertzLaw{}, &reduction::Resistance::force);
  check(lines[2].lines[0], reduction::HertzLaw{}, &reduction::Resistance::moment);
  check(lines[3].lines[0], reduction::PadeLaw{}, &reduction::Resistance::force);
  check(lines[4].lines[0], reduction::PadeLaw{}, &reduction::Resistance::moment);
  // As the paper draws them: F from 0 with slope 3 pi/8, M from 3 pi/16.
  const auto& force = lines[1].lines[0];
  CHECK(force[1].y / force[1].x == Approx(3 * std::numbers::pi / 8).epsilon(1e-4));
  CHECK(lines[2].lines[0].front().y == Approx(3 * std::numbers::pi / 16).epsilon(1e-15));
}
