#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/flow.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "contensou/reduction/stop_time_table.hpp"
#include "reference_table.hpp"
#include "stepper_checks.hpp"
#include "stops_above_one.hpp"
#include "user_laws.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

namespace {

WorstCase over_table(const std::string& table, const Law& law, Route route) {
  WorstCase stop(table + " " + std::string(name(route)));
  for (const ReferenceRow& row : reference_table(table)) {
    const ReducedSystem system(law, row.input("mu"));
    const StopTime got = stop_time(system, {row.input("u0"), row.input("v0")}, route);
    CHECK(got.route == route);
    stop.add(row.result("tau_stop"), got.tau, row.where());
  }
  return stop;
}

}  // namespace

TEST_CASE("stop time of the Pade ball, closed form", "[stop_time][table]") {
  CHECK_WITHIN_EPS(over_table("stop_pade", PadeLaw{}, Route::closed), 4);
}

TEST_CASE("stop time of the Pade ball, quadrature", "[stop_time][table]") {
  CHECK_WITHIN_EPS(over_table("stop_pade", PadeLaw{}, Route::quadrature), 8);
}

TEST_CASE("stop time of the exact ball, quadrature", "[stop_time][table]") {
  CHECK_WITHIN_EPS(over_table("stop_hertz", HertzLaw{}, Route::quadrature), 8);
}

TEST_CASE("stop time by steppers over the tables", "[stop_time][table]") {
  for (Route route : {Route::regularised, Route::direct}) {
    CHECK_WITHIN_EPS(over_table("stop_pade", PadeLaw{}, route), 3e-11 / eps);
    CHECK_WITHIN_EPS(over_table("stop_hertz", HertzLaw{}, route), 3e-11 / eps);
  }
}

TEST_CASE("on and beside invariant rays stop times keep the accuracy they state", "[stop_time][table]") {
  WorstCase quadrature("quadrature"), tables("tables");
  for (const ReferenceRow& row : reference_table("rays")) {
    const std::string& name = row.text("law");
    const auto named = find_law(name);
    const Law law = named ? *named : PressureLaw(std::stod(name.substr(name.find(':') + 1)));
    const Flow flow = Flow::by_quadrature({law, row.input("mu"), {row.input("chi"), row.input("gamma")}});
    const State start{row.input("u0"), row.input("v0")};
    const long double wanted = row.result("tau_stop");
    const StopTime got = flow.stop_time(start);
    quadrature.add(wanted, got.tau, row.where());
    tables.add(wanted, flow.table()(start.u, start.v), row.where());
    CAPTURE(row.where());
    CHECK(std::abs(got.tau - wanted) <= got.accuracy * wanted);
    CHECK(got.accuracy < 3e-15);
  }
  CHECK_WITHIN_EPS(quadrature, 3);
  CHECK_WITHIN_EPS(tables, 4);
}

TEST_CASE("stop time of other bodies, by every route", "[stop_time][table][route]") {
  WorstCase closed("bodies closed"), quadrature("bodies quadrature"), steppers("bodies steppers");
  for (const ReferenceRow& row : reference_table("bodies")) {
    const Law law = row.text("law") == "pade" ? Law(PadeLaw{}) : Law(HertzLaw{});
    const ReducedSystem system(law, row.input("mu"), {row.input("chi"), row.input("gamma")});
    const State start{row.input("u0"), row.input("v0")};
    for (Route route : routes(system)) {
      WorstCase& worst = route == Route::closed ? closed : route == Route::quadrature ? quadrature : steppers;
      worst.add(row.result("tau_stop"), stop_time(system, start, route).tau, row.where());
    }
  }
  CHECK_WITHIN_EPS(closed, 4);
  CHECK_WITHIN_EPS(quadrature, 8);
  CHECK_WITHIN_EPS(steppers, 3e-11 / eps);
}

TEST_CASE("all routes give one stop time", "[stop_time][route]") {
  WorstCase closed("closed against quadrature"), regularised("regularised"), direct("direct");
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0}) {
      const ReducedSystem system(law, mu);
      for (double k0 : {1e-4, 1e-2, 0.5, 1.0, 1.25, 3.0, 1e2, 1e4, 1e6}) {
        for (double u0 : {1.0, -7.0}) {
          const State start{u0, mu * k0 * std::abs(u0)};
          const std::string where = fmt::format("{}, mu = {}, u0 = {}, k0 = {}", law.name(), mu, u0, k0);
          const double best = stop_time(system, start, Route::quadrature).tau;
          if (law.as<PadeLaw>()) closed.add(stop_time(system, start, Route::closed).tau, best, where);
          regularised.add(best, stop_time(system, start, Route::regularised).tau, where);
          direct.add(best, stop_time(system, start, Route::direct).tau, where);
        }
      }
    }
  }
  CHECK_WITHIN_EPS(closed, 4);
  CHECK_WITHIN_EPS(regularised, 3e-11 / eps);
  CHECK_WITHIN_EPS(direct, 3e-11 / eps);
}

TEST_CASE("beyond mu^2 = 14/5 the Pade ball stops by every route", "[stop_time][route]") {
  WorstCase closed("closed"), regularised("regularised"), direct("direct"), quadrature("quadrature");
  for (const StopAboveOne& row : stops_above_one) {
    const ReducedSystem system(PadeLaw{}, row.mu);
    const State start{row.u0, row.v0};
    const std::string where = fmt::format("mu = {}, u0 = {}, v0 = {}", row.mu, row.u0, row.v0);
    regularised.add(row.tau, stop_time(system, start, Route::regularised).tau, where);
    direct.add(row.tau, stop_time(system, start, Route::direct).tau, where);
    CHECK(routes(system).front() == Route::closed);
    closed.add(row.tau, stop_time(system, start, Route::closed).tau, where);
    quadrature.add(row.tau, stop_time(system, start, Route::quadrature).tau, where);
  }
  CHECK_WITHIN_EPS(closed, 4);
  CHECK_WITHIN_EPS(regularised, 1e-10 / eps);
  CHECK_WITHIN_EPS(direct, 1e-10 / eps);
  CHECK_WITHIN_EPS(quadrature, 8);
}

TEST_CASE("beyond r = 2 the two steppers agree for the exact law", "[stop_time][route]") {
  WorstCase routes("regularised against direct");
  for (double mu : {1.8, 2.0, 2.6, 3.0}) {
    const ReducedSystem system(HertzLaw{}, mu);
    for (double k0 : {1e-3, 0.5, 3.0, 1e3}) {
      const State start{-1, mu * k0};
      routes.add(stop_time(system, start, Route::direct).tau, stop_time(system, start, Route::regularised).tau,
                 fmt::format("mu = {}, k0 = {}", mu, k0));
    }
  }
  CHECK_WITHIN_EPS(routes, 1e-10 / eps);
}

TEST_CASE("the stop time on the axes, at rest and without the sign of u0", "[stop_time][limit]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.1);
    for (Route route : routes(system)) {
      CAPTURE(law.name(), name(route));
      CHECK(stop_time(system, {0, 7}, route).tau == Approx(3 * pi).epsilon(4e-16));
      CHECK(stop_time(system, {1, 0}, route).tau == Approx(32).epsilon(4e-16));
      CHECK(stop_time(system, {0, 0}, route).tau == 0);
      CHECK(stop_time(system, {-1, 2}, route).tau == stop_time(system, {1, 2}, route).tau);
    }
  }
}

TEST_CASE("v0/(mu u0) may overflow and underflow", "[stop_time][limit]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 1e-4);
    for (Route route : routes(system)) {
      // The steppers carry logarithms: 500 eps of the exponent are in the speed.
      const double rounding = route == Route::closed || route == Route::quadrature ? 4e-16 : 1e-12;
      CAPTURE(law.name(), name(route));
      CHECK(stop_time(system, {1e-200, 1e200}, route).tau == Approx(3 * pi / 7 * 1e200).epsilon(rounding));
      CHECK(stop_time(system, {5e-324, 1e308}, route).tau == Approx(3 * pi / 7 * 1e308).epsilon(rounding));
      CHECK(stop_time(system, {1e200, 1e-200}, route).tau == Approx(3.2e204).epsilon(rounding));
      CHECK(stop_time(system, {1e300, 5e-324}, route).tau == Approx(3.2e304).epsilon(rounding));
    }
  }
}

TEST_CASE("a stop time above the largest double is infinite", "[stop_time][limit]") {
  constexpr double largest = std::numeric_limits<double>::max();
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 1e-3);
    for (Route route : routes(system)) {
      CAPTURE(law.name(), name(route));
      CHECK(stop_time(system, {largest, 1}, route).tau == infinity);
      CHECK(stop_time(system, {-1e306, 1e306}, route).tau == infinity);
      CHECK(stop_time(system, {0, largest}, route).tau == infinity);
      CHECK(stop_time(system, {1e304, 1}, route).tau == Approx(3.2e307).epsilon(1e-11));
    }
  }
}

TEST_CASE("the stop time scales with the speeds, bit for bit for powers of two", "[stop_time][symmetry]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.03);
    for (const State start : {State{1, 0.1}, State{-0.3, 5}, State{2, 1e-7}}) {
      for (Route route : {Route::closed, Route::quadrature}) {
        if (route == Route::closed && !law.as<PadeLaw>()) continue;
        const double tau = stop_time(system, start, route).tau;
        for (int power : {-900, -3, 1, 900}) {
          const State scaled{std::ldexp(start.u, power), std::ldexp(start.v, power)};
          CHECK(stop_time(system, scaled, route).tau == std::ldexp(tau, power));
        }
        CHECK(stop_time(system, {3 * start.u, 3 * start.v}, route).tau == Approx(3 * tau).epsilon(2e-15));
      }
    }
  }
}

TEST_CASE("the stop time grows with both speeds", "[stop_time][invariant]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-3, 0.1, 1.0}) {
      const ReducedSystem system(law, mu);
      double before = 0;
      for (double v = 1e-6; v < 1e6; v *= 3) {
        const double here = Flow(system).stop_time({1, v}).tau;
        CHECK(here >= before);
        CHECK(here > Flow(system).stop_time({0.5, v}).tau);
        before = here;
      }
    }
  }
}

TEST_CASE("routes have names and say what they do", "[stop_time]") {
  const ReducedSystem pade(PadeLaw{}, 0.1);
  const std::vector<Route> all{Route::closed, Route::quadrature, Route::regularised, Route::direct};
  CHECK(routes(pade) == all);
  CHECK(routes(ReducedSystem(HertzLaw{}, 0.1)) == std::vector<Route>(all.begin() + 1, all.end()));
  CHECK(routes(ReducedSystem(HertzLaw{}, 2)) == std::vector<Route>(all.begin() + 1, all.end()));
  for (Route route : all) {
    CHECK(find_route(name(route)) == route);
    CHECK(description(route).size() > 20);
    CHECK(description(route).find('\n') == std::string_view::npos);
    const StopTime got = stop_time(pade, {1, 1}, route);
    CHECK(got.route == route);
    CHECK((got.evaluations == 0) == (route == Route::closed));
    CHECK(got.accuracy > 0);
    CHECK(got.accuracy <= 1e-10);
  }
  CHECK_FALSE(find_route("closed form"));
  CHECK_FALSE(find_route(""));
  CHECK(Flow(pade).stop_time({1, 1}).route == Route::closed);
  CHECK(Flow(ReducedSystem(HertzLaw{}, 0.1)).stop_time({1, 1}).route == Route::quadrature);
  CHECK(Flow(ReducedSystem(HertzLaw{}, 2)).stop_time({1, 1}).route == Route::quadrature);
}

TEST_CASE("the error a route answers for is its error", "[stop_time][table]") {
  for (const ReferenceRow& row : reference_table("stop_pade")) {
    const ReducedSystem system(PadeLaw{}, row.input("mu"));
    for (Route route : {Route::closed, Route::quadrature}) {
      const StopTime got = stop_time(system, {row.input("u0"), row.input("v0")}, route);
      const long double wanted = row.result("tau_stop");
      CAPTURE(row.where(), name(route));
      if (std::isnormal(got.tau)) CHECK(std::abs(got.tau / wanted - 1) <= got.accuracy);
    }
  }
}

TEST_CASE("a route that the system does not have is refused", "[stop_time][domain]") {
  using Catch::Matchers::Contains;
  const ReducedSystem exact(HertzLaw{}, 0.1);
  CHECK_THROWS_WITH(stop_time(exact, {1, 1}, Route::closed), Contains("exact") && Contains("closed form"));
  for (Route route : {Route::quadrature, Route::regularised, Route::direct}) {
    for (const State bad :
         {State{1, -1}, State{not_a_number, 1}, State{1, not_a_number}, State{infinity, 1}, State{1, infinity}}) {
      CHECK_THROWS_AS(stop_time(exact, bad, route), std::domain_error);
    }
  }
}

TEST_CASE("a stepper that does not arrive throws its sentence", "[stop_time][domain]") {
  const ReducedSystem system(BrokenLaw{}, 0.3);
  for (Route route : {Route::regularised, Route::direct}) {
    CHECK_THROWS_AS(stop_time(system, {1, 1}, route), std::runtime_error);
    CHECK_THROWS_WITH(stop_time(system, {1, 1}, route), Catch::Matchers::Contains("not finite"));
  }
}
