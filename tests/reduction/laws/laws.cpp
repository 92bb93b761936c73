// Tests that every law must pass, and the names by which laws are found.
#include "contensou/reduction/laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/tabulated_pressure_law.hpp"
#include "dissipation.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;

namespace {

struct Asked {
  std::string type;
  Law law;
  std::string table, column;  ///< table in tests/reference; empty for a table of pressures
  long double steepest = 1;   ///< largest size of d ln Phi/d ln k and d ln Psi/d ln k
  double curvature = 0;       ///< value of (1 - Psi/Psi(0))/k^2 for k << 1
};

/// A pressure with a dip in the middle, a shoulder, and a loaded edge.
TabulatedPressureLaw uneven() {
  Eigen::ArrayXd rho(6), pressure(6);
  rho << 0, 0.2, 0.35, 0.6, 0.8, 1;
  pressure << 1, 3, 2.5, 4, 0, 0.5;
  return {"uneven", rho, pressure};
}

const std::vector<Asked>& all_laws() {
  static const std::vector<Asked> all = [] {
    std::vector<Asked> laws{
        {"HertzLaw", HertzLaw{}, "laws", "hertz", 1, 1},
        {"PadeLaw", PadeLaw{}, "laws", "pade", 1},
        {"PressureLaw", PressureLaw(0.5), "laws", "hertz", 2, 1},
        {"EllipticLaw", EllipticLaw{}, "", "", 1, 0.5 / EllipticLaw::hertz_moment / EllipticLaw::hertz_moment},
        {"EllipticLaw", EllipticLaw(1), "", "", 1, 0.5},
        {"TabulatedPressureLaw", *find_law("annulus:0.65"), "", ""},
        {"TabulatedPressureLaw", uneven(), "", ""}};
    const auto pressure = [&](const PressureLaw& law, long double steepest) {
      laws.push_back({"PressureLaw", law, "laws_pressure", Law(law).name(), steepest, (law.p() + 1.5) / 2});
    };
    pressure(PressureLaw::uniform(), 1.5L);
    pressure(PressureLaw::punch(), 2);
    pressure(PressureLaw::ring(), 16);  // this law has a logarithm at k = 1
    for (double p : {-0.3, 1.7, 25.0}) pressure(PressureLaw(p), 3);
    return laws;
  }();
  return all;
}

std::vector<double> ratios_of_slip() {
  std::vector<double> ratios;
  for (int i = -400; i <= 400; ++i) ratios.push_back(std::exp2(0.125 * i));
  return ratios;
}

/// Returns (Psi' + k Phi')/Psi' by central differences; 0 for a law with a dissipation potential.
double potential_defect(const Law& law, double k) {
  const double h = 1e-5;
  const auto ahead = law({k * (1 + h), 1}), behind = law({k * (1 - h), 1});
  const double moment_change = ahead.moment - behind.moment;
  return std::abs((moment_change + k * (ahead.force - behind.force)) / moment_change);
}

/// Returns the largest relative differences of Phi and Psi from the exact law.
Resistance farthest_from_exact(const Law& law) {
  Resistance worst{0, 0};
  for (double k = 1e-3; k < 1e3; k *= 1.001) {
    const auto exact = HertzLaw{}({k, 1}), other = law({k, 1});
    worst.force = std::max(worst.force, std::abs(other.force / exact.force - 1));
    worst.moment = std::max(worst.moment, std::abs(other.moment / exact.moment - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("every law keeps 4 eps for every k", "[laws][table]") {
  for (const auto& [type, law, table, column, steepest, curvature] : all_laws()) {
    if (table.empty()) continue;
    WorstCase given(law.name()), swapped(law.name() + " of 1 : 1/k"), deficit(law.name() + ", 1 - Psi/Psi(0)"),
        missing(law.name() + ", 1 - Phi");
    const auto rows = reference_table(table);
    const long double pure_pivoting = rows.front().result("psi_" + column);
    CHECK(law({0, 1}).moment == static_cast<double>(pure_pivoting));
    for (const ReferenceRow& row : rows) {
      const double k = row.input("k"), inverse = 1 / k;
      const long double force = row.result("phi_" + column), moment = row.result("psi_" + column);
      given.add(force, law({k, 1}).force, row.where());
      given.add(moment, law({k, 1}).moment, row.where());
      // Compare only if the difference 1 - moment/pure_pivoting in long double keeps enough digits.
      if (const long double wanted = 1 - moment / pure_pivoting; wanted > 1e-3L) {
        deficit.add(wanted, law.moment_deficit({k, 1}), row.where());
      }
      if (const long double wanted = 1 - force; wanted > 1e-3L) {
        missing.add(wanted, law.force_deficit({k, 1}), k < 1.5 ? 1 : wanted, row.where());  // Phi has the error eps
      }
      if (!std::isnormal(inverse)) continue;
      // 1/k is rounded unless k is a power of two.
      const long double rounding = std::fma(inverse, k, -1.0) == 0 ? 1 : 1 + 0.5L * steepest;
      swapped.add(force, law({1, inverse}).force, force * rounding, row.where());
      swapped.add(moment, law({1, inverse}).moment, moment * rounding, row.where());
    }
    CHECK_WITHIN_EPS(given, 4);
    CHECK_WITHIN_EPS(swapped, 4);
    CHECK_WITHIN_EPS(deficit, 6);
    CHECK_WITHIN_EPS(missing, 6);
  }
}

TEST_CASE("every law has both limits exactly", "[laws][limit]") {
  for (const Asked& asked : all_laws()) {
    const Law& law = asked.law;
    CAPTURE(law.name());
    for (double speed : {5e-324, 1e-300, 1.0, 1e300, std::numeric_limits<double>::max()}) {
      CHECK(law({0, speed}).force == 0);
      CHECK(law({0, speed}).moment == law.pivoting_moment());
      CHECK(law.moment_deficit({0, speed}) == 0);
      CHECK(law({speed, 0}).force == 1);
      CHECK(law({speed, 0}).moment == 0);
      CHECK(law.moment_deficit({speed, 0}) == 1);
    }
    if (asked.curvature == 0) continue;
    for (double k : {1e-9, 1e-20, 1e-100})
      CHECK(law.moment_deficit({k, 1}) / k / k == Approx(asked.curvature).epsilon(1e-14));
  }
  CHECK(uneven().moment_deficit({1e-9, 1}) == Approx(1e-8 * uneven().moment_deficit({1e-5, 1})).epsilon(1e-8));
}

TEST_CASE("every law states 1 - Phi for fast sliding: K/(2 k^2) of a pressure, K = k Psi", "[laws][limit]") {
  for (const char* name : {"exact", "uniform", "punch", "ring", "paraboloid", "pressure:25", "elliptic", "elliptic:1",
                           "annulus:0.65", "soft:4"}) {
    const Law law = *find_law(name);
    CAPTURE(name);
    REQUIRE(law.states_force_deficit());
    for (double k : {0x1p30, 0x1p50, 0x1p200})
      CHECK(law.force_deficit({k, 1}) * k == Approx(law({k, 1}).moment / 2).epsilon(4e-15));
    for (double k : {0.3, 1.01, 3.0, 1e3}) {
      CHECK(law.force_deficit({k, 1}) == Approx(1 - law({k, 1}).force).margin(4e-15));
    }
    CHECK(law.force_deficit({0, 1}) == 1);
    CHECK(law.force_deficit({1, 0}) == 0);
  }
  CHECK(PadeLaw{}.force_deficit({0x1p60, 1}) == Approx(8 / (3 * std::numbers::pi) * 0x1p-60).epsilon(1e-15));
}

TEST_CASE("every law is of degree 0, bit for bit", "[laws][symmetry]") {
  for (const Asked& asked : all_laws()) {
    for (double k : ratios_of_slip()) {
      const auto here = asked.law({k, 1});
      for (int power : {-900, -1, 1, 17, 900}) {
        const auto scaled = asked.law({std::ldexp(k, power), std::ldexp(1.0, power)});
        CAPTURE(asked.law.name(), k, power);
        CHECK((scaled.force == here.force && scaled.moment == here.moment));
      }
    }
  }
}

TEST_CASE("no law has a step where its form changes", "[laws][limit]") {
  for (const Asked& asked : all_laws()) {
    WorstCase step(asked.law.name() + " one ulp across a switch");
    for (double square : {0.0625, 0.125, 0.25, 0.5, 0.75, 1.0, 1.5625, 2.0}) {
      // The ring has infinite slopes at k = 1: one ulp of k changes the law by 36 ulp.
      if (asked.column == "ring" && square == 1) continue;
      const double k = std::sqrt(square), below = std::nextafter(k, 0), above = std::nextafter(k, 2 * k);
      for (double neighbour : {below, above, std::nextafter(below, 0), std::nextafter(above, 2 * k)}) {
        const std::string where = fmt::format("k = {} to {}", k, neighbour);
        step.add(asked.law({k, 1}).force, asked.law({neighbour, 1}).force, where);
        step.add(asked.law({k, 1}).moment, asked.law({neighbour, 1}).moment, where);
        step.add(asked.law.moment_deficit({k, 1}), asked.law.moment_deficit({neighbour, 1}), where);
      }
    }
    CHECK_WITHIN_EPS(step, 8);
  }
}

// Rounding may make the functions flat but must not reverse them. Coulomb friction has a convex curve (Phi, Psi). The
// curve of the Pade law lies on the other side of the chord.
TEST_CASE("forces rise, moments fall, and Phi + Psi/Psi(0) is on its side of 1", "[laws][invariant]") {
  for (const Asked& asked : all_laws()) {
    Resistance before = asked.law({0, 1});
    for (double k : ratios_of_slip()) {
      const auto here = asked.law({k, 1});
      const double deficit = asked.law.moment_deficit({k, 1});
      CAPTURE(asked.law.name(), k);
      CHECK(here.force >= before.force * (1 - 2e-16));
      CHECK(here.moment <= before.moment * (1 + 4e-16));
      CHECK(here.force <= 1);
      CHECK((asked.type == "PadeLaw" ? here.force <= deficit * (1 + 4e-16) : here.force >= deficit * (1 - 6e-16)));
      before = here;
    }
  }
}

// Compare Phi = R' and Psi = R - k R', R the dissipation, with difference quotients of order 4 away from k = 1.
TEST_CASE("every law but Pade's is the gradient of its dissipation", "[laws][invariant]") {
  const auto slope = [](auto function) {
    constexpr double h = 1e-3;
    return (8 * (function(h) - function(-h)) - (function(2 * h) - function(-2 * h))) / (12 * h);
  };
  for (const Asked& asked : all_laws()) {
    const Law& law = asked.law;
    if (law.as<PadeLaw>()) {
      CHECK(potential_defect(law, 1) > 0.5);
      continue;
    }
    for (double k : {0.01, 0.1, 0.3, 0.6, 0.9, 1.1, 1.5, 3.0, 10.0, 100.0}) {
      CAPTURE(law.name(), k);
      const auto [force, moment] = law({k, 1});
      CHECK(slope([&](double h) {
              return dissipation(law, {k * (1 + h), 1});
            }) / k ==
            Approx(force).epsilon(1e-8).margin(1e-12 / k));
      CHECK(slope([&](double h) {
              return dissipation(law, {k, 1 + h});
            }) == Approx(moment).epsilon(1e-8).margin(1e-12 * k));
      CHECK(potential_defect(law, k) < 1e-8 * std::max(1.0, k * k / 100) + 1e-10 / std::min(1.0, k * k));
    }
  }
}

TEST_CASE("the Pade law misses the exact one by as much as its header says", "[laws][route]") {
  CHECK(farthest_from_exact(PadeLaw{}).force == Approx(0.3914).margin(5e-5));
  CHECK(farthest_from_exact(PadeLaw{}).moment == Approx(0.4785).margin(5e-5));
}

TEST_CASE("every law rejects what is no slip", "[laws][domain]") {
  for (const Asked& asked : all_laws()) {
    CHECK_THROWS_WITH(asked.law({0, 0}), Contains(asked.type) && Contains("both 0"));
    for (double bad : {-1.0, -5e-324, infinity, not_a_number}) {
      CAPTURE(asked.type, bad);
      CHECK_THROWS_AS(asked.law({bad, 1}), std::domain_error);
      CHECK_THROWS_AS(asked.law({1, bad}), std::domain_error);
      CHECK_THROWS_AS(asked.law({bad, bad}), std::domain_error);
    }
  }
  CHECK_THROWS_WITH(HertzLaw{}({0.5, -3}), Contains("HertzLaw") && Contains("0.5") && Contains("-3"));
}

TEST_CASE("the slip of a ratio has 1 for the larger speed", "[slip][limit]") {
  for (double k : {0.0, 5e-324, 1e-300, 0.25, 1.0}) {
    CHECK(slip_of_ratio(k).sliding == k);
    CHECK(slip_of_ratio(k).pivoting == 1);
  }
  for (double k : {std::nextafter(1.0, 2.0), 3.0, 1e300, infinity}) {
    CHECK(slip_of_ratio(k).sliding == 1);
    CHECK(slip_of_ratio(k).pivoting == 1 / k);
  }
  for (double k : {-5e-324, -1.0, -infinity, not_a_number}) CHECK_THROWS_AS(slip_of_ratio(k), std::domain_error);
  CHECK_THROWS_WITH(slip_of_ratio(-2), Contains("slip_of_ratio") && Contains("-2"));
}

TEST_CASE("a law is found by its name", "[laws]") {
  REQUIRE(paper_laws().size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(paper_laws()[i].name() == named_laws()[i].name());
  CHECK(named_laws().front().name() == "exact");
  for (const Law& law : named_laws()) {
    const auto found = find_law(law.name());
    REQUIRE(found);
    CHECK(found->name() == law.name());
    CHECK((*found)({2, 1}).force == law({2, 1}).force);
  }
  for (const char* name : {"uniform", "punch", "ring", "paraboloid", "elliptic"}) CHECK(find_law(name));
  for (const LawFamily& family : law_families()) {
    for (double number : {family.min, family.example, family.max}) {
      const std::string name = fmt::format("{}:{}", family.name, number);
      CHECK(find_law(name)->name() == name);
    }
    for (double number : {std::nextafter(family.min, -2.0), std::nextafter(family.max, 99.0)}) {
      CHECK_THROWS_WITH(find_law(fmt::format("{}:{}", family.name, number)), Contains(std::string(family.allowed)));
    }
  }
  CHECK_FALSE(find_law("Pade"));
  CHECK_FALSE(find_law(""));
}

TEST_CASE("a law is found by the exponent of its pressure", "[laws]") {
  for (double p : {-0.3, 0.5, 0.1 + 0.2, 25.0}) {
    const auto found = find_law(Law(PressureLaw(p)).name());
    REQUIRE(found);
    REQUIRE(found->as<PressureLaw>());
    CHECK(found->as<PressureLaw>()->p() == p);
  }
  CHECK(find_law("pressure:+5e-1")->as<PressureLaw>()->p() == 0.5);
  for (const char* name : {"uniform", "pressure:0.5"})
    CHECK(find_law(name)->as<PressureLaw>() == find_law(name)->as<PressureLaw>());
  for (int i = 0; i < 200; ++i)
    CHECK(find_law(fmt::format("elliptic:0.{}", 100 + i))->pivoting_moment() == (100 + i) / 1000.0);
  for (const std::string exponent : {"", "x", "0.5abc", "0.5 ", "+-1", "nan", "inf", "1e999", "0,5"}) {
    CHECK_THROWS_WITH(find_law("pressure:" + exponent), Contains("'" + exponent + "'") && Contains("pressure:0.5"));
  }
  CHECK_THROWS_WITH(find_law("pressure:-1"), Contains("-1 < P <= 25") && Contains("ring"));
  CHECK_THROWS_WITH(find_law("pressure:25.1"), Contains("-1 < P <= 25"));
  for (double bad : {-1.0, -7.0, std::nextafter(PressureLaw::max_p, 100.0), not_a_number, infinity, -infinity}) {
    CHECK_THROWS_AS(PressureLaw(bad), std::domain_error);
  }
  CHECK_THROWS_WITH(PressureLaw(-1.5), Contains("PressureLaw") && Contains("-1.5"));
  CHECK(PressureLaw(std::nextafter(-1.0, 0.0))({1, 1}).force == Approx(2 / std::acos(-1.0)).epsilon(1e-14));
}
