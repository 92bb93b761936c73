// Motions under the laws that are not the paper's. The logarithm of the uniform disc and of the ring at k = 1 is what
// quadrature and steppers have to get over.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "contensou/reduction/quadrature_curve.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/verification.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

constexpr long double tau_of_T = 3 * std::numbers::pi_v<long double> / 2;

struct Stop {
  PressureLaw law;
  Inertia body;
  double mu, u0, v0;
  long double T;  ///< f g t, by Taylor series of the separated equations in 40 digits
};

std::vector<Stop> known() {
  const Inertia ball{}, ring{1, 1};
  return {{PressureLaw::uniform(), ball, 0.1, 0.25, 4, 2.625413954326368155953L},
          {PressureLaw::uniform(), ball, 1, 0.25, 4, 1.208153678201974100093L},
          {PressureLaw::uniform(), ring, 1, 1, 0.05, 1.501405372213311509928L},
          {PressureLaw::uniform(), ring, 1, 1, 0.6, 1.686963459133972195679L},
          {PressureLaw::uniform(), ring, 1, 1, 3, 3.739430054903977642774L},
          {PressureLaw::uniform(), ring, 1, 0.25, 4, 4.113379905078566805169L},
          // r = 5/7 > 1/2: to a ray, k* = 0.839.
          {PressureLaw::ring(), ball, 1, 1, 0.05, 0.4006100705537523492504L},
          {PressureLaw::ring(), ball, 1, 1, 0.6, 0.4620543175555292683940L},
          {PressureLaw::ring(), ball, 1, 1, 3, 1.037101857903903377377L}};
}

WorstCase over(const std::vector<Stop>& stops, Route route) {
  WorstCase worst(std::string(name(route)));
  for (const Stop& stop : stops) {
    const ReducedSystem system(stop.law, stop.mu, stop.body);
    worst.add(tau_of_T * stop.T, stop_time(system, {stop.u0, stop.v0}, route).tau,
              fmt::format("{}, mu = {}, v0 = {}", stop.law.name(), stop.mu, stop.v0));
  }
  return worst;
}

}  // namespace

TEST_CASE("stop times of uniform disc and ring", "[law_motions][table]") {
  CHECK_WITHIN_EPS(over(known(), Route::quadrature), 16);
  for (Route route : {Route::regularised, Route::direct}) {
    CHECK_WITHIN_EPS(over(known(), route), 3e-11 / eps);
  }
}

TEST_CASE("every named law passes every check, each on its side of the bounds", "[law_motions][route]") {
  std::vector<Law> laws = named_laws();
  for (double p : {-0.9, -0.3, 1.7, 10.0}) laws.emplace_back(PressureLaw(p));
  for (const Law& law : laws) {
    for (double mu : {0.0035, 0.1, 0.6}) {
      if (law.name() == "pressure:-0.9" && mu > 0.5) continue;
      std::vector<State> starts;
      for (double k : {1e-3, 0.3, 1.0, 3.0, 1e3}) starts.push_back({1, k * mu});
      for (const Check& check : verify(ReducedSystem(law, mu), starts)) {
        CAPTURE(law.name(), mu, check.name, check.measured, check.allowed);
        CHECK(check.measured <= check.allowed);
      }
    }
  }
}

TEST_CASE("the quadrature gets over the logarithm at k = 1", "[law_motions][limit]") {
  for (const char* name : {"uniform", "punch", "ring", "potential8"}) {
    for (double r : {1e-6, 0.01, 0.4}) {
      const QuadratureCurve curve(*find_law(name), r);
      CAPTURE(name, r, curve.evaluations());
      CHECK(curve.truncation() < 1e-14);
      CHECK(curve.evaluations() < 20'000);
    }
  }
}
