#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/dissipation.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

/// What every law is asked in the same words.
namespace contensou::tests {

inline std::vector<double> ratios_of_slip() {
  std::vector<double> ratios;
  for (int i = -400; i <= 400; ++i) ratios.push_back(std::exp2(0.125 * i));
  return ratios;
}

/// A table of laws, each k as Slip{k, 1} and as Slip{1, 1/k}; 1/k is rounded unless k is a power of two.
///
/// @param steepest  the largest logarithmic slope of Phi and Psi, by which that rounding comes in
template <class L>
void check_table(const L& law, const std::string& column, const std::string& table = "laws", long double steepest = 1) {
  WorstCase force("Phi(k)"), moment("Psi(k)"), swapped_force("Phi(1 : 1/k)"), swapped_moment("Psi(1 : 1/k)");
  for (const ReferenceRow& row : reference_table(table)) {
    const double k = row.input("k");
    const auto [phi, psi] = law(reduction::Slip{k, 1});
    force.add(row.result("phi_" + column), phi, row.where());
    moment.add(row.result("psi_" + column), psi, row.where());
    const double inverse = 1 / k;
    if (!std::isnormal(inverse)) continue;
    const auto [phi_swapped, psi_swapped] = law(reduction::Slip{1, inverse});
    const long double rounding = std::fma(inverse, k, -1.0) == 0 ? 0 : 0.5L * steepest;
    swapped_force.add(row.result("phi_" + column), phi_swapped, row.result("phi_" + column) * (1 + rounding),
                      row.where());
    swapped_moment.add(row.result("psi_" + column), psi_swapped, row.result("psi_" + column) * (1 + rounding),
                       row.where());
  }
  CHECK_WITHIN_EPS(force, 4);
  CHECK_WITHIN_EPS(moment, 4);
  CHECK_WITHIN_EPS(swapped_force, 4);
  CHECK_WITHIN_EPS(swapped_moment, 4);
}

/// 1 - Psi/Psi(0), from the table where long double leaves it its digits.
template <class L>
void check_moment_deficit(const L& law, const std::string& column, const std::string& table = "laws",
                          long double pure_pivoting = 0.589048622548086232211745634364906790787L) {
  WorstCase deficit("1 - Psi/Psi(0)");
  for (const ReferenceRow& row : reference_table(table)) {
    const double k = row.input("k");
    const long double wanted = 1 - row.result("psi_" + column) / pure_pivoting;
    if (wanted > 1e-3L) deficit.add(wanted, law.moment_deficit({k, 1}), row.where());
  }
  CHECK_WITHIN_EPS(deficit, 6);
}

template <class L>
void check_limits(const L& law, double pure_pivoting = 0.589048622548086232211745634364906790787) {
  for (double speed : {5e-324, 1e-300, 1.0, 1e300, std::numeric_limits<double>::max()}) {
    const auto pivoting = law(reduction::Slip{0, speed});
    CHECK(pivoting.force == 0);
    CHECK(pivoting.moment == pure_pivoting);
    CHECK(law.moment_deficit({0, speed}) == 0);
    const auto sliding = law(reduction::Slip{speed, 0});
    CHECK(sliding.force == 1);
    CHECK(sliding.moment == 0);
    CHECK(law.moment_deficit({speed, 0}) == 1);
  }
}

/// Degree 0, bit for bit, for factors that are powers of two.
template <class L>
void check_scaling(const L& law) {
  for (double k : ratios_of_slip()) {
    const auto here = law(reduction::Slip{k, 1});
    for (int power : {-900, -1, 1, 17, 900}) {
      const auto scaled = law(reduction::Slip{std::ldexp(k, power), std::ldexp(1.0, power)});
      CAPTURE(k, power);
      CHECK(scaled.force == here.force);
      CHECK(scaled.moment == here.moment);
    }
  }
}

/// No step across k from one double to the next.
template <class L>
void check_continuity(const L& law, double k) {
  const double below = std::nextafter(k, 0);
  const double above = std::nextafter(k, 2 * k);
  WorstCase step("one ulp across a switch");
  for (double neighbour : {below, above, std::nextafter(below, 0), std::nextafter(above, 2 * k)}) {
    const std::string where = fmt::format("k = {} to {}", k, neighbour);
    step.add(law(reduction::Slip{k, 1}).force, law(reduction::Slip{neighbour, 1}).force, where);
    step.add(law(reduction::Slip{k, 1}).moment, law(reduction::Slip{neighbour, 1}).moment, where);
    step.add(law.moment_deficit({k, 1}), law.moment_deficit({neighbour, 1}), where);
  }
  CHECK_WITHIN_EPS(step, 8);
}

/// Phi rises from 0 to 1, Psi falls from Psi(0) to 0; rounding may flatten but not turn them.
template <class L>
void check_monotone(const L& law) {
  reduction::Resistance before = law(reduction::Slip{0, 1});
  for (double k : ratios_of_slip()) {
    const auto here = law(reduction::Slip{k, 1});
    CAPTURE(k);
    CHECK(here.force >= before.force * (1 - 2e-16));
    CHECK(here.moment <= before.moment * (1 + 4e-16));
    CHECK(here.force <= 1);
    before = here;
  }
}

template <class L>
void check_domain(const L& law, const char* name) {
  using Catch::Matchers::Contains;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(law(reduction::Slip{0, 0}), Contains(name) && Contains("both 0"));
  for (double bad : {-1.0, -5e-324, infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(law(reduction::Slip{bad, 1}), std::domain_error);
    CHECK_THROWS_AS(law(reduction::Slip{1, bad}), std::domain_error);
    CHECK_THROWS_AS(law(reduction::Slip{bad, bad}), std::domain_error);
  }
}

/// Phi + Psi/Psi(0) >= 1: the curve (Phi, Psi) is convex.
template <class L>
void check_convex(const L& law) {
  for (double k : ratios_of_slip()) {
    CAPTURE(k);
    CHECK(law(reduction::Slip{k, 1}).force >= law.moment_deficit({k, 1}) * (1 - 6e-16));
  }
}

/// Psi' + k Phi' relative to Psi', by central differences: 0 for a law with a dissipation potential.
template <class L>
double potential_defect(const L& law, double k) {
  const double h = 1e-5;
  const auto ahead = law(reduction::Slip{k * (1 + h), 1});
  const auto behind = law(reduction::Slip{k * (1 - h), 1});
  const double moment_change = ahead.moment - behind.moment;
  const double force_change = ahead.force - behind.force;
  return std::abs((moment_change + k * force_change) / moment_change);
}

/// Phi = R' and Psi = R - k R' for the dissipation R(v, w), by difference quotients of the fourth order away from k
/// = 1.
template <class L>
void check_potential(const L& law) {
  const auto slope = [](auto function) {
    constexpr double h = 1e-3;
    return (8 * (function(h) - function(-h)) - (function(2 * h) - function(-2 * h))) / (12 * h);
  };
  for (double k : {0.01, 0.1, 0.3, 0.6, 0.9, 1.1, 1.5, 3.0, 10.0, 100.0}) {
    CAPTURE(k);
    const auto [force, moment] = law(reduction::Slip{k, 1});
    const double by_sliding = slope([&](double h) { return reduction::dissipation(law, {k * (1 + h), 1}); }) / k;
    const double by_pivoting = slope([&](double h) { return reduction::dissipation(law, {k, 1 + h}); });
    CHECK(by_sliding == Approx(force).epsilon(1e-8).margin(1e-12 / k));
    CHECK(by_pivoting == Approx(moment).epsilon(1e-8).margin(1e-12 * k));
    CHECK(potential_defect(law, k) < 1e-8 * std::max(1.0, k * k / 100) + 1e-10 / std::min(1.0, k * k));
  }
}

}  // namespace contensou::tests
