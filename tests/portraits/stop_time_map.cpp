#include "contensou/portraits/stop_time_map.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"

using namespace contensou;
using portraits::MapAxes;
using portraits::StopTimeMap;

namespace {

Eigen::ArrayXd even(Eigen::Index count, double low, double high) { return Eigen::ArrayXd::LinSpaced(count, low, high); }

StopTimeMap map_of(const reduction::Law& law, double mu, const MapAxes& axes) {
  return portraits::stop_time_map(reduction::StopTimeTable(reduction::ReducedSystem(law, mu)), axes);
}

}  // namespace

TEST_CASE("A map has a row for each v0 and a column for each u0", "[route]") {
  const reduction::Flow flow({reduction::HertzLaw{}, 0.3});
  const StopTimeMap map = map_of(flow.system().law(), 0.3, {even(7, -1, 2), even(3, 0, 4)});
  REQUIRE(map.tau.rows() == 3);
  REQUIRE(map.tau.cols() == 7);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 7; ++j) {
      const double tau = flow.stop_time({map.axes.u0[j], map.axes.v0[i]}).tau;
      CHECK(map.tau(i, j) == Approx(tau).epsilon(1e-14));
    }
  }
}

TEST_CASE("Every point of an isochrone stops at its time, and lies in the map", "[invariant]") {
  for (const double mu : {0.01, 0.3, 1.0}) {
    const reduction::Flow flow({reduction::PadeLaw{}, mu});
    for (const MapAxes& axes :
         {MapAxes{even(5, -2, 2), even(5, 0, 3), false}, MapAxes{even(5, 1, 2), even(5, 1, 3), false},
          MapAxes{even(5, -4, -1), even(5, 0, 3), false}, MapAxes{even(5, 1e-3, 2), even(5, 1e-5, 30), true}}) {
      const StopTimeMap map = map_of(reduction::PadeLaw{}, mu, axes);
      CHECK(map.isochrones.size() >= 3);
      for (const portraits::Isochrone& isochrone : map.isochrones) {
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
  const StopTimeMap map = map_of(reduction::PadeLaw{}, 0.5, {even(3, -2, 2), even(3, 0, 3)});
  for (const portraits::Isochrone& isochrone : map.isochrones) {
    for (const Eigen::Index end : {Eigen::Index{0}, isochrone.u.size() - 1}) {
      const double u = isochrone.u[end], v = isochrone.v[end];
      const double gap = std::min({2 - std::abs(u), v, 3 - v});
      CHECK(gap == Approx(0).margin(1e-9));
    }
    // And without a jump on the way.
    for (Eigen::Index i = 1; i < isochrone.u.size(); ++i) {
      CHECK(std::hypot(isochrone.u[i] - isochrone.u[i - 1], isochrone.v[i] - isochrone.v[i - 1]) < 0.1);
    }
  }
}

TEST_CASE("Isochrones are at round times", "[table]") {
  std::vector<double> times;
  // From 0 to 16 * 1/(5 * 0.32) = 10.
  for (const auto& isochrone : map_of(reduction::PadeLaw{}, 0.32, {even(3, 0, 1), even(2, 0, 1e-3)}).isochrones) {
    times.push_back(isochrone.tau_stop);
  }
  CHECK(times == std::vector<double>{2, 4, 6, 8, 10});
  times.clear();
  const MapAxes wide{even(2, 1e-3, 1), even(2, 1e-9, 1e-6), true};
  for (const auto& isochrone : map_of(reduction::PadeLaw{}, 0.32, wide).isochrones) times.push_back(isochrone.tau_stop);
  REQUIRE(times.size() == 9);
  CHECK(times[0] == Approx(0.02));
  CHECK(times[1] == Approx(0.05));
  CHECK(times[8] == Approx(10));
}

TEST_CASE("A map that cannot be drawn is refused", "[domain]") {
  const auto refused = [](const MapAxes& axes, const std::string& word) {
    CHECK_THROWS_WITH(map_of(reduction::PadeLaw{}, 0.3, axes),
                      Catch::Contains("stop_time_map: ") && Catch::Contains(word));
  };
  refused({even(1, 1, 1), even(2, 0, 1)}, "u0 needs two values or more, got 1");
  refused({even(2, 0, 1), even(1, 1, 1)}, "v0 needs two values or more, got 1");
  refused({even(3, 1, 0), even(2, 0, 1)}, "u0 must increase");
  refused({even(3, 0, 1), even(2, -1, 1)}, "v0 must be >= 0, got -1");
  refused({even(3, 0, 1), even(2, 1, 2), true}, "u0 must be > 0 on logarithmic axes, got 0");
  refused({even(3, 0, 1e101), even(2, 1, 2)}, "u0 from 0 to 1e+101 cannot be drawn");
  refused({even(3, 0, 1e-101), even(2, 1, 2)}, "u0 from 0 to 1e-101 cannot be drawn");
  CHECK_THROWS_WITH(map_of(reduction::PadeLaw{}, 1e-300, {even(2, 0, 1e99), even(2, 0, 1)}),
                    Catch::Contains("beyond the largest double"));
}
