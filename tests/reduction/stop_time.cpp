#include "contensou/reduction/stop_time.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "motion/stop_time_table.hpp"
#include "octic_law.hpp"
#include "reference_table.hpp"
#include "similarity/curves.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;
using std::numbers::pi;

namespace {

constexpr double largest = std::numeric_limits<double>::max();

bool is_stepper(Route route) { return route == Route::regularised || route == Route::direct; }

ReducedSystem system_of(const std::string& table, const ReferenceRow& row) {
  const std::string name = row.has("law") ? row.text("law") : table.substr(table.find('_') + 1);
  const Inertia body = row.has("chi") ? Inertia{row.input("chi"), row.input("gamma")} : Inertia{};
  const Law law = name == "octic" ? OcticLaw{} : *find_law(name == "hertz" ? "exact" : name);
  return {law, row.input("mu"), body};
}

bool same(const ReducedSystem& a, const ReducedSystem& b) {
  return a.law().name() == b.law().name() && a.mu() == b.mu() && a.r() == b.r() && a.inertia().chi == b.inertia().chi;
}

}  // namespace

TEST_CASE("stop times against 40 digits: every route, tables, bounds", "[stop_time][table]") {
  struct Table {
    std::string name;
    double quadrature, arrays;  ///< bounds of the errors in eps
  };
  for (const auto& [name, quadrature, arrays] :
       {Table{"stop_pade", 8, 2}, {"stop_hertz", 8, 2}, {"bodies", 8, 2}, {"rays", 3, 4}}) {
    std::map<Route, WorstCase> worst;
    WorstCase by_table(name + " by table");
    std::optional<Flow> flow;
    std::optional<StopTimeTable> arrayed;
    for (const ReferenceRow& row : reference_table(name)) {
      const ReducedSystem system = system_of(name, row);
      if (!flow || !same(flow->system(), system)) {
        flow = Flow::by_quadrature(system);
        arrayed.emplace(system);
      }
      const State start{row.input("u0"), row.input("v0")};
      const long double wanted = row.result("tau_stop");
      CAPTURE(row.where());
      for (Route route : routes(system)) {
        const StopTime got = route == Route::quadrature ? flow->stop_time(start) : stop_time(system, start, route);
        worst.try_emplace(route, name + " " + std::string(contensou::reduction::name(route)))
            .first->second.add(wanted, got.tau, row.where());
        if (std::isnormal(got.tau)) CHECK(std::abs(got.tau - wanted) <= got.accuracy * wanted);
        if (!is_stepper(route)) CHECK(got.accuracy < 3e-15);
      }
      by_table.add(wanted, (*arrayed)(start.u, start.v), row.where());
      const auto [lower, upper] = system.stop_time_bounds(start);
      CHECK(lower <= static_cast<double>(wanted));
      CHECK(static_cast<double>(wanted) <= upper);
      CHECK(upper <= lower * 2.5 * (1 + 1e-14));
    }
    for (const auto& [route, cases] : worst) {
      CHECK_WITHIN_EPS(cases, is_stepper(route) ? 3e-11 / eps : route == Route::quadrature ? quadrature : 4);
    }
    CHECK_WITHIN_EPS(by_table, arrays);
  }
}

TEST_CASE("stop times on the axes, at rest and at the ends of the double range", "[stop_time][limit]") {
  struct Case {
    double mu;
    State start;
    double tau;
  };
  std::vector<Case> cases{{1e-4, {1e-200, 1e200}, 3 * pi / 7 * 1e200},
                          {1e-4, {5e-324, 1e308}, 3 * pi / 7 * 1e308},
                          {1e-4, {1e200, -0.0}, 3.2e204},
                          {1e-4, {1e200, 1e-200}, 3.2e204},
                          {1e-4, {1e300, 5e-324}, 3.2e304},
                          {1e-3, {largest, 1}, infinity},
                          {1e-3, {-1e306, 1e306}, infinity},
                          {1e-3, {0, largest}, infinity},
                          {1e-3, {1e304, 1}, 3.2e307}};
  for (double mu : {1e-10, 0.1, 1.0, 1.6733200530681511, 2.0, 2.6457513110645907, 3.0}) {
    cases.insert(cases.end(), {{mu, {0, 7}, 3 * pi}, {mu, {1, 0}, 3.2 / mu}, {mu, {-0.0, 0}, 0}});
  }
  for (const Law& law : paper_laws()) {
    for (const auto& [mu, start, tau] : cases) {
      const ReducedSystem system(law, mu, homogeneous_ball);
      const State mirrored{-start.u, start.v};
      CAPTURE(law.name(), mu, start.u, start.v);
      for (Route route : routes(system)) {
        // The steppers use ln of a speed, so the speed has an error of up to 500 eps.
        const double here = stop_time(system, start, route).tau;
        CHECK((here == tau || here == Approx(tau).epsilon(is_stepper(route) ? 1e-11 : 4e-16)));
        CHECK(stop_time(system, mirrored, route).tau == here);
      }
      const StopTimeTable table(system);
      CHECK((table(start.u, start.v) == tau || table(start.u, start.v) == Approx(tau).epsilon(4 * eps)));
      CHECK(table(mirrored.u, mirrored.v) == table(start.u, start.v));
    }
  }
}

TEST_CASE("the stop time grows with both speeds", "[stop_time][invariant]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-3, 0.1, 1.0}) {
      const Flow flow({law, mu, homogeneous_ball});
      double before = 0;
      for (double v = 1e-6; v < 1e6; v *= 3) {
        const double here = flow.stop_time({1, v}).tau;
        CHECK(here >= before);
        CHECK(here > flow.stop_time({0.5, v}).tau);
        before = here;
      }
    }
  }
}

TEST_CASE("without a route the first of routes() gives the stop time", "[stop_time][route]") {
  for (const Law& law : {Law(PadeLaw{}), Law(HertzLaw{})}) {
    const ReducedSystem system(law, 0.3);
    const StopTime stop = stop_time(system, {-1, 2}), first = stop_time(system, {-1, 2}, routes(system).front());
    CHECK(stop.tau == first.tau);
    CHECK(stop.accuracy == first.accuracy);
  }
}

TEST_CASE("routes have names and say what they do", "[stop_time]") {
  const ReducedSystem pade(PadeLaw{}, 0.1);
  const std::vector<Route> all{Route::closed, Route::quadrature, Route::regularised, Route::direct};
  CHECK(routes(pade) == all);
  CHECK(routes(ReducedSystem(HertzLaw{}, 2, homogeneous_ball)) == std::vector<Route>(all.begin() + 1, all.end()));
  for (Route route : all) {
    CHECK(description(route).size() > 20);
    CHECK(description(route).find('\n') == std::string_view::npos);
    const StopTime got = stop_time(pade, {1, 1}, route);
    CHECK((got.evaluations == 0) == (route == Route::closed));
  }
}

TEST_CASE("a route that the system does not have is refused, and what is no state", "[stop_time][domain]") {
  const ReducedSystem exact(HertzLaw{}, 0.1);
  CHECK_THROWS_WITH(stop_time(exact, {1, 1}, Route::closed), Contains("exact") && Contains("closed form"));
  for (Route route : routes(exact)) {
    for (const State bad :
         {State{1, -1}, State{not_a_number, 1}, State{1, not_a_number}, State{infinity, 1}, State{1, infinity}}) {
      CHECK_THROWS_AS(stop_time(exact, bad, route), std::domain_error);
    }
  }
}

TEST_CASE("a stop time scales bit for bit, also below and above the ordinary", "[stop_time][symmetry]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-3, 0.83, 1.7, 2.9}) {
      const Flow flow({law, mu, homogeneous_ball});
      for (const State start : {State{1, 0.1}, State{-0.3, 5}, State{2, 1e-7}}) {
        const double tau = flow.stop_time(start).tau;
        for (int power : {-900, -301, -299, 1, 299, 301, 900}) {
          const State scaled{std::ldexp(start.u, power), std::ldexp(start.v, power)};
          CHECK(flow.stop_time(scaled).tau == std::ldexp(tau, power));
        }
      }
    }
  }
  CHECK(Flow(PadeLaw{}, 1).stop_time({5e-324, 0}).tau == 1.5e-323);  // exact: 3.2 times the smallest double
  CHECK(std::isfinite(Flow({PadeLaw{}, 1e150, homogeneous_ball}).stop_time({1, 1}).tau));
}

TEST_CASE("beyond every ball the Pade law is solved by quadrature, without a seam", "[stop_time][limit]") {
  constexpr double max_r = PadeCurve::max_r;
  const ReducedSystem last(PadeLaw{}, 1, {.chi = 1, .gamma = max_r});
  const ReducedSystem beyond(PadeLaw{}, 1, {.chi = 1, .gamma = std::nextafter(max_r, 1)});
  CHECK(routes(last).front() == Route::closed);
  CHECK(routes(beyond).front() == Route::quadrature);
  CHECK_THROWS_WITH(stop_time(beyond, {1, 1}, Route::closed),
                    Contains("pade") && Contains("no closed form at r = 0.72"));
  WorstCase seam("stop time on the two sides");
  const Flow closed(last), by_quadrature(beyond);
  for (double v = 1e-6; v < 1e8; v *= 1.1) {
    seam.add(closed.stop_time({1, v}).tau, by_quadrature.stop_time({1, v}).tau, std::to_string(v));
  }
  CHECK_WITHIN_EPS(seam, 4);
}
