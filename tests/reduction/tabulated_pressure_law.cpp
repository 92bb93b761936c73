#include "contensou/reduction/tabulated_pressure_law.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/verification.hpp"
#include "law_checks.hpp"
#include "rings.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;

namespace {

TabulatedPressureLaw table(const std::function<double(double)>& pressure, int rows) {
  const Eigen::ArrayXd rho = Eigen::ArrayXd::LinSpaced(rows, 0, 1);
  return {"table", rho, rho.unaryExpr(pressure)};
}

TabulatedPressureLaw table_of(const std::vector<double>& rho, const std::vector<double>& pressure) {
  return {"table", Eigen::Map<const Eigen::ArrayXd>(rho.data(), std::ssize(rho)),
          Eigen::Map<const Eigen::ArrayXd>(pressure.data(), std::ssize(pressure))};
}

/// Phi, Psi and 1 - Psi/Psi(0) of a table against rings in long double, also beside every row.
struct Comparison {
  WorstCase force{"Phi"}, moment{"Psi"}, deficit{"1 - Psi/Psi(0)"};

  void add(const std::vector<double>& rho, const std::vector<double>& pressure, const std::string& name) {
    const TabulatedPressureLaw law = table_of(rho, pressure);
    const RingsOfTable rings(rho, pressure);
    std::vector<double> ks{1e-6, 1e-3, 0.05, 0.3, 0.77, 1, 1.3, 8, 1e3};
    for (double edge : rho) {
      if (edge == 0) continue;
      for (double factor : {1 - 1e-4, 1 - 1e-15, 1.0, 1 + 1e-9, 1 + 3e-2}) ks.push_back(factor * edge);
    }
    for (double k : ks) {
      const std::string where = fmt::format("{}, k = {}", name, k);
      const auto wanted = rings(k);
      force.add(wanted.force, law({k, 1}).force, where);
      moment.add(wanted.moment, law({k, 1}).moment, where);
      if (k > 0.02) deficit.add(wanted.deficit, law.moment_deficit({k, 1}), where);
    }
  }

  void check(double eps) const {
    CHECK_WITHIN_EPS(force, eps);
    CHECK_WITHIN_EPS(moment, eps);
    CHECK_WITHIN_EPS(deficit, eps);
  }
};

/// A dip in the middle, a shoulder, and an edge under load.
TabulatedPressureLaw uneven() {
  Eigen::ArrayXd rho(6), pressure(6);
  rho << 0, 0.2, 0.35, 0.6, 0.8, 1;
  pressure << 1, 3, 2.5, 4, 0, 0.5;
  return {"uneven", rho, pressure};
}

}  // namespace

TEST_CASE("tables of a uniform disc and of a paraboloid are those laws", "[tabulated_pressure_law][route]") {
  WorstCase worst("two rows");
  Eigen::ArrayXd rho(2), flat(2), round(2);
  rho << 0, 1;
  flat << 7, 7;
  round << 3, 0;
  const PressureLaw uniform = PressureLaw::uniform(), paraboloid(1);
  for (double k : ratios_of_slip()) {
    const std::string where = fmt::format("k = {}", k);
    const auto [force, moment] = TabulatedPressureLaw("flat", rho, flat)({k, 1});
    worst.add(uniform({k, 1}).force, force, where);
    worst.add(uniform({k, 1}).moment, moment, where);
    const auto [round_force, round_moment] = TabulatedPressureLaw("round", rho, round)({k, 1});
    worst.add(paraboloid({k, 1}).force, round_force, where);
    worst.add(paraboloid({k, 1}).moment, round_moment, where);
  }
  CHECK_WITHIN_EPS(worst, 2);
}

TEST_CASE("a table of Hertz pressure tends to the exact law", "[tabulated_pressure_law][limit]") {
  const auto error = [](int rows) {
    const TabulatedPressureLaw law = table([](double rho) { return std::sqrt((1 - rho) * (1 + rho)); }, rows);
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

TEST_CASE("a table of steps is a sum of discs", "[tabulated_pressure_law][route]") {
  const TabulatedPressureLaw law = table_of({0, 0.1, 0.1, 0.5, 0.5, 1}, {7, 7, 3, 3, 1, 1});
  const PressureLaw disc = PressureLaw::uniform();
  WorstCase force("Phi"), moment("Psi");
  for (double k : ratios_of_slip()) {
    long double total = 0, total_force = 0, total_moment = 0;
    for (const auto& [radius, pressure] : {std::pair{0.1L, 4}, {0.5L, 2}, {1.0L, 1}}) {
      const long double load = radius * radius * pressure;
      const auto part = disc({k, static_cast<double>(radius)});
      total += load;
      total_force += load * part.force;
      total_moment += load * radius * part.moment;
    }
    const std::string where = fmt::format("k = {}", k);
    force.add(total_force / total, law({k, 1}).force, where);
    moment.add(total_moment / total, law({k, 1}).moment, where);
  }
  CHECK_WITHIN_EPS(force, 8);
  CHECK_WITHIN_EPS(moment, 8);
}

TEST_CASE("a steep flank loses no digit, however steep", "[tabulated_pressure_law][route]") {
  Comparison comparison;
  for (double gap : {2e-16, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
    const double edge = 0.5 + gap;
    comparison.add({0, 0.5, edge, 1}, {1, 1, 0, 0}, fmt::format("down over {}", gap));
    comparison.add({0, 0.5, edge, 1}, {1e-3, 0, 1, 1}, fmt::format("up over {}", gap));
    comparison.add({0, 0.5, 0.5, edge, edge, 1}, {0, 0, 1, 1, 0, 0}, fmt::format("annulus of {}", gap));
    comparison.add({0, 0.5, edge, edge + gap, 1}, {0, 0, 1, 0, 0}, fmt::format("roof over {}", gap));
  }
  comparison.add({0, 1e-3, 1.001e-3, 0.999, 1}, {1e4, 1e4, 1, 1, 0}, "a spike in the centre");
  comparison.add({0, 1e-3, 1.001e-3, 0.9, 0.9001, 0.9002, 1}, {1e6, 1e6, 0, 0, 4e-3, 0, 0}, "a spike and a thin ring");
  comparison.check(12);
}

TEST_CASE("tables at random, with steps and spikes", "[tabulated_pressure_law][route]") {
  std::mt19937 random(11);
  const auto uniform = [&] { return std::generate_canonical<double, 53>(random); };
  Comparison comparison;
  for (int i = 0; i < 12; ++i) {
    std::vector<double> rho{0};
    const int rows = 2 + static_cast<int>(random() % 9);
    while (std::ssize(rho) < rows) rho.push_back(uniform());
    for (int n = 0; n < rows / 3; ++n) rho.push_back(std::min(rho.back() * (1 + std::pow(10, -16 * uniform())), 1.0));
    std::ranges::sort(rho);
    rho.push_back(1);
    std::vector<double> pressure;
    for (std::size_t n = 0; n < rho.size(); ++n) pressure.push_back(uniform() < 0.3 ? 0 : std::pow(10, 6 * uniform()));
    comparison.add(rho, pressure, fmt::format("table {}", i));
  }
  comparison.check(12);
}

TEST_CASE("rows far from k count in groups: a thousand rows up and down", "[tabulated_pressure_law][route]") {
  std::vector<double> rho, pressure;
  for (int i = 0; i <= 1000; ++i) {
    rho.push_back(i / 1000.0);
    pressure.push_back(i % 2 == 0 ? 1 : 100);
  }
  const TabulatedPressureLaw law = table_of(rho, pressure);
  const RingsOfTable rings(rho, pressure);
  WorstCase force("Phi"), moment("Psi");
  for (double k : {1e-9, 0.01, 0.3335, 0.9, 2.0}) {
    force.add(rings(k).force, law({k, 1}).force, fmt::format("k = {}", k));
    moment.add(rings(k).moment, law({k, 1}).moment, fmt::format("k = {}", k));
  }
  CHECK_WITHIN_EPS(force, 12);
  CHECK_WITHIN_EPS(moment, 12);
}

TEST_CASE("a table keeps what holds for every patch", "[tabulated_pressure_law][invariant]") {
  const TabulatedPressureLaw law = uneven();
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

TEST_CASE("the unit of the pressure does not matter", "[tabulated_pressure_law][symmetry]") {
  for (double unit : {1e-300, 1e6, 1.7e308}) {
    const TabulatedPressureLaw law = table([unit](double rho) { return unit * (1 - rho / 2); }, 7);
    const TabulatedPressureLaw one = table([](double rho) { return 1 - rho / 2; }, 7);
    CHECK(law({0.7, 1}).force == Approx(one({0.7, 1}).force).epsilon(1e-14));
  }
}

TEST_CASE("a rough table is a law, too", "[tabulated_pressure_law][limit]") {
  const TabulatedPressureLaw rough = table([](double rho) { return 1 + 0.5 * std::sin(1e5 * rho); }, 400);
  const Law law = rough;
  CHECK(law.name() == "table");
  CHECK(law({1, 0}).force == 1);
}

TEST_CASE("stop times of a table by every route", "[tabulated_pressure_law][route]") {
  const ReducedSystem system(uneven(), 0.3);
  const double best = stop_time(system, {1, 0.5}, Route::quadrature).tau;
  CHECK(stop_time(system, {1, 0.5}, Route::regularised).tau == Approx(best).epsilon(1e-10));
  CHECK(stop_time(system, {1, 0.5}, Route::direct).tau == Approx(best).epsilon(1e-10));
}

TEST_CASE("a disc of half the patch stops like a patch of half the radius", "[tabulated_pressure_law][symmetry]") {
  for (double gap : {0.0, 2e-16}) {
    const Flow step({table_of({0, 0.5, 0.5 + gap, 1}, {1, 1, 0, 0}), 1, {.chi = 1, .gamma = 2}});
    const Flow half({PressureLaw::uniform(), 0.5, {.chi = 1, .gamma = 2}});
    for (double v : {0.01, 0.5, 1.0, 7.0, 1e3}) {
      CAPTURE(gap, v);
      CHECK(step.stop_time({1, v}).tau == Approx(half.stop_time({1, v}).tau).epsilon(4e-15));
    }
  }
}

TEST_CASE("a thin annulus stops like a ring", "[tabulated_pressure_law][limit]") {
  const Flow annulus({table_of({0, 0.5, 0.5, 0.5 + 1e-12, 0.5 + 1e-12, 1}, {0, 0, 1, 1, 0, 0}), 1});
  const Flow ring({PressureLaw::ring(), 0.5});
  CHECK(annulus.stop_time({1, 1}).tau == Approx(ring.stop_time({1, 1}).tau).epsilon(1e-11));
}

TEST_CASE("a table names its steps and sharp bends as kinks", "[tabulated_pressure_law][limit]") {
  using Kinks = std::vector<double>;
  CHECK(table_of({0, 0.3, 0.3, 0.5, 0.5 + 2e-16, 1}, {1, 1, 2, 2, 0, 0}).kinks() == Kinks{0.3, 0.5, 0.5 + 2e-16});
  CHECK(table_of({0, 0.5, 1}, {1, 1, 1}).kinks() == Kinks{1});
  CHECK(table_of({0, 0.5, 1}, {1, 0.75, 0}).kinks().empty());
  CHECK(table([](double rho) { return std::sin(1e3 * rho) + 1; }, 1000).kinks().size() == 32);
  CHECK(Law(table_of({0, 0.3, 0.3, 1}, {1, 1, 0, 0})).kinks() == Kinks{0.3});
}

TEST_CASE("every statement of the theory holds under a table with steps", "[tabulated_pressure_law][invariant]") {
  const TabulatedPressureLaw tables[] = {table_of({0, 0.5, 0.5, 1}, {1, 1, 0, 0}),
                                         table_of({0, 0.5, 0.5 + 2e-16, 1}, {1, 1, 0, 0}),
                                         table_of({0, 0.2, 0.2, 0.6, 0.6, 0.8, 1}, {1, 3, 1, 4, 2.5, 0, 0.5}),
                                         table_of({0, 0.5, 0.5, 0.5 + 1e-6, 0.5 + 1e-6, 1}, {0, 0, 1, 1, 0, 0})};
  for (const TabulatedPressureLaw& law : tables) {
    for (double v : {0.3, 0.5, 1.0, 5.0}) {
      for (const Check& check : verify(ReducedSystem(law, 1, {.chi = 1, .gamma = 2}), State{1, v})) {
        CAPTURE(law.kinks(), v, check.name, check.measured);
        CHECK(check.passed());
      }
    }
  }
}

TEST_CASE("a load within the centre's last digits is refused with a way out", "[tabulated_pressure_law][domain]") {
  for (double radius : {1e-12, 1e-160}) {
    CHECK_THROWS_MATCHES(table_of({0, radius, radius, 1}, {1, 1, 0, 0}), std::runtime_error,
                         Catch::Matchers::Predicate<std::runtime_error>([](const std::runtime_error& error) {
                           return std::string(error.what()).find("radius of the loaded part") != std::string::npos;
                         }));
  }
  CHECK_NOTHROW(table_of({0, 1e-300, 1e-12, 1}, {1, 2, 1, 1}));
  CHECK_NOTHROW(table_of({0, 1e-9, 1e-9, 1}, {1, 1, 0, 0}));
}

TEST_CASE("a table that is no pressure is refused, naming the row", "[tabulated_pressure_law][domain]") {
  const auto attempt = [](std::vector<double> rho, std::vector<double> pressure) {
    return TabulatedPressureLaw(
        "bad", Eigen::Map<Eigen::ArrayXd>(rho.data(), static_cast<Eigen::Index>(rho.size())),
        Eigen::Map<Eigen::ArrayXd>(pressure.data(), static_cast<Eigen::Index>(pressure.size())));
  };
  CHECK_THROWS_WITH(attempt({0.1, 1}, {1, 1}), Contains("row 1") && Contains("begin at 0"));
  CHECK_THROWS_WITH(attempt({0, 0.9}, {1, 1}), Contains("row 2") && Contains("end at 1"));
  CHECK_THROWS_WITH(attempt({0, 0.5, 0.4, 1}, {1, 1, 1, 1}), Contains("row 3") && Contains("not decrease"));
  CHECK_THROWS_WITH(attempt({0, 0.5, 0.5, 0.5, 1}, {1, 1, 1, 1, 1}), Contains("row 4") && Contains("two rows"));
  CHECK_THROWS_WITH(attempt({0, 0, 1}, {1, 1, 1}), Contains("row 2") && Contains("one row only"));
  CHECK_THROWS_WITH(attempt({0, 1}, {1, -1}), Contains("row 2") && Contains("-1"));
  CHECK_THROWS_WITH(attempt({0, 1}, {HUGE_VAL, 1}), Contains("row 1"));
  CHECK_THROWS_WITH(attempt({0, std::nan(""), 1}, {1, 1, 1}), Contains("row 2"));
  CHECK_THROWS_WITH(attempt({0, 1}, {0, 0}), Contains("every row"));
  CHECK_THROWS_WITH(attempt({0}, {1}), Contains("two or more"));
  CHECK_THROWS_WITH(attempt({0, 1}, {1}), Contains("two or more"));
  check_domain(uneven(), "TabulatedPressureLaw");
}
