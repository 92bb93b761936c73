#include "contensou/reduction/profile_law.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <catch2/catch.hpp>

#include "contensou/reduction/contact_patch.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "law_checks.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;

namespace {

ProfileLaw table(const std::function<double(double)>& pressure, int rows) {
  const Eigen::ArrayXd rho = Eigen::ArrayXd::LinSpaced(rows, 0, 1);
  return {"table", rho, rho.unaryExpr(pressure)};
}

/// A dip in the middle, a shoulder, and an edge under load.
ProfileLaw uneven() {
  Eigen::ArrayXd rho(6), pressure(6);
  rho << 0, 0.2, 0.35, 0.6, 0.8, 1;
  pressure << 1, 3, 2.5, 4, 0, 0.5;
  return {"uneven", rho, pressure};
}

}  // namespace

TEST_CASE("tables of a uniform disc and of a paraboloid are those laws", "[profile_law][route]") {
  WorstCase worst("two rows");
  Eigen::ArrayXd rho(2), flat(2), round(2);
  rho << 0, 1;
  flat << 7, 7;
  round << 3, 0;
  const PressureLaw uniform = PressureLaw::uniform(), paraboloid(1);
  for (double k : ratios_of_slip()) {
    const std::string where = fmt::format("k = {}", k);
    const auto [force, moment] = ProfileLaw("flat", rho, flat)({k, 1});
    worst.add(uniform({k, 1}).force, force, where);
    worst.add(uniform({k, 1}).moment, moment, where);
    const auto [round_force, round_moment] = ProfileLaw("round", rho, round)({k, 1});
    worst.add(paraboloid({k, 1}).force, round_force, where);
    worst.add(paraboloid({k, 1}).moment, round_moment, where);
  }
  CHECK_WITHIN_EPS(worst, 2);
}

TEST_CASE("a table of Hertz pressure tends to the exact law", "[profile_law][limit]") {
  const auto error = [](int rows) {
    const ProfileLaw law = table([](double rho) { return std::sqrt((1 - rho) * (1 + rho)); }, rows);
    double worst = 0;
    for (double k : {0.01, 0.3, 0.9, 1.0, 1.1, 3.0, 50.0}) {
      const auto exact = HertzLaw{}({k, 1});
      worst = std::max({worst, std::abs(law({k, 1}).force - exact.force), std::abs(law({k, 1}).moment - exact.moment)});
    }
    return worst;
  };
  CHECK(error(101) < 1e-3);
  CHECK(error(1601) < 1.6e-5);
  CHECK(error(1601) < error(101) / 50);  // 16^(3/2) = 64
}

TEST_CASE("a table by integration over the disc", "[profile_law][route]") {
  // 4 - 3 s up to s = 1/4, 3.25 - 7 (s - 1/4)/3 beyond: integrated piece by piece is beyond tanh-sinh, so to 1e-5 only.
  Eigen::ArrayXd rho(3), pressure(3);
  rho << 0, 0.5, 1;
  pressure << 4, 3.25, 1.5;
  const ProfileLaw law("bent", rho, pressure);
  const ContactPatch patch([](double rest) {
    const double s = 1 - rest;
    return s < 0.25 ? 4 - 3 * s : 3.25 - 7 * (s - 0.25) / 3;
  });
  for (double k : {0.1, 0.45, 0.8, 1.5, 6.0}) {
    CAPTURE(k);
    CHECK(law({k, 1}).force == Approx(patch.over_disc({k, 1}).force).margin(1e-5));
    CHECK(law({k, 1}).moment == Approx(patch.over_disc({k, 1}).moment).margin(1e-5));
  }
}

TEST_CASE("a table keeps what holds for every patch", "[profile_law][invariant]") {
  const ProfileLaw law = uneven();
  check_monotone(law);
  check_convex(law);
  check_potential(law);
  check_scaling(law);
  CHECK(law({1, 0}).force == 1);
  CHECK(law({0, 1}).force == 0);
  CHECK(law({1, 0}).moment == 0);
  CHECK(law.moment_deficit({0, 1}) == 0);
  for (double k : {0.1, 0.5, 2.0}) {
    CHECK(law.moment_deficit({k, 1}) == Approx(1 - law({k, 1}).moment / law({0, 1}).moment).epsilon(1e-13));
  }
  CHECK(law.moment_deficit({1e-9, 1}) == Approx(1e-18 * law.moment_deficit({1e-5, 1}) / 1e-10).epsilon(1e-8));
}

TEST_CASE("the unit of the pressure does not matter", "[profile_law][symmetry]") {
  for (double unit : {1e-300, 1e6, 1.7e308}) {
    const ProfileLaw law = table([unit](double rho) { return unit * (1 - rho / 2); }, 7);
    const ProfileLaw one = table([](double rho) { return 1 - rho / 2; }, 7);
    CHECK(law({0.7, 1}).force == Approx(one({0.7, 1}).force).epsilon(1e-14));
  }
}

TEST_CASE("a rough table is a law, too", "[profile_law][limit]") {
  const ProfileLaw rough = table([](double rho) { return 1 + 0.5 * std::sin(1e5 * rho); }, 400);
  const Law law = rough;
  CHECK(law.name() == "table");
  CHECK(law({1, 0}).force == 1);
}

TEST_CASE("stop times of a table by every route", "[profile_law][route]") {
  const ReducedSystem system(uneven(), 0.3);
  const double best = stop_time(system, {1, 0.5}, Route::quadrature).tau;
  CHECK(stop_time(system, {1, 0.5}, Route::regularised).tau == Approx(best).epsilon(1e-10));
  CHECK(stop_time(system, {1, 0.5}, Route::direct).tau == Approx(best).epsilon(1e-10));
}

TEST_CASE("a table that is no pressure is refused, naming the row", "[profile_law][domain]") {
  const auto attempt = [](std::vector<double> rho, std::vector<double> pressure) {
    return ProfileLaw("bad", Eigen::Map<Eigen::ArrayXd>(rho.data(), static_cast<Eigen::Index>(rho.size())),
                      Eigen::Map<Eigen::ArrayXd>(pressure.data(), static_cast<Eigen::Index>(pressure.size())));
  };
  CHECK_THROWS_WITH(attempt({0.1, 1}, {1, 1}), Contains("row 1") && Contains("begin at 0"));
  CHECK_THROWS_WITH(attempt({0, 0.9}, {1, 1}), Contains("row 2") && Contains("end at 1"));
  CHECK_THROWS_WITH(attempt({0, 0.5, 0.5, 1}, {1, 1, 1, 1}), Contains("row 3") && Contains("increase"));
  CHECK_THROWS_WITH(attempt({0, 1}, {1, -1}), Contains("row 2") && Contains("-1"));
  CHECK_THROWS_WITH(attempt({0, 1}, {HUGE_VAL, 1}), Contains("row 1"));
  CHECK_THROWS_WITH(attempt({0, std::nan(""), 1}, {1, 1, 1}), Contains("row 2"));
  CHECK_THROWS_WITH(attempt({0, 1}, {0, 0}), Contains("every row"));
  CHECK_THROWS_WITH(attempt({0}, {1}), Contains("two or more"));
  CHECK_THROWS_WITH(attempt({0, 1}, {1}), Contains("two or more"));
  check_domain(uneven(), "ProfileLaw");
}
