#include "contensou/reduction/pade_sliding_coefficient.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/similarity_solution.hpp"
#include "contensou/reduction/terminal_ratio.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

namespace {

constexpr double inertia_ratios[] = {1e-300,   1e-20, 1e-6, 0.1, 5.0 / 7,  0.7200001, 1,   1.5, 1.99, 2 - 1e-9, 2,
                                     2 + 1e-9, 2.1,   2.5,  3,   10.0 / 3, 4,         4.8, 5,   5.2,  6.4,      100};

}  // namespace

TEST_CASE("the sliding coefficient of any r runs from 5/2 to 1", "[pade_sliding_coefficient][limit]") {
  for (double r : inertia_ratios) {
    CAPTURE(r);
    CHECK(pade_sliding_coefficient(r, 0) == 2.5);
    CHECK(pade_sliding_coefficient(r, infinity) == 1);
    double before = 2.5;
    for (double ln_k = -45; ln_k < 60; ln_k += 0.25) {
      const double here = pade_sliding_coefficient(r, std::exp(ln_k));
      CAPTURE(ln_k);
      CHECK(here <= before * (1 + 1e-15));
      CHECK(here >= 1);
      before = here;
    }
  }
}

TEST_CASE("on the ray the sliding coefficient is 5/r", "[pade_sliding_coefficient][limit]") {
  for (double r : {2.001, 2.3, 2.5, 3.0, 3.5, 4.0, 4.9}) {
    const double k = 8 * (r - 2) / (3 * pi * (5 - r));
    CAPTURE(r);
    CHECK(pade_sliding_coefficient(r, k) == Approx(5 / r).epsilon(1e-15));
    CHECK(pade_sliding_coefficient(r, std::nextafter(k, 0)) == Approx(5 / r).epsilon(1e-15));
    CHECK(pade_sliding_coefficient(r, std::nextafter(k, 100)) == Approx(5 / r).epsilon(1e-15));
  }
}

TEST_CASE("the sliding coefficient keeps the power y^Q where the series ends early",
          "[pade_sliding_coefficient][table]") {
  // 2F1 of (R28), and the mean of 5 (1 + z)/(2 + 5 z) over the sliding that is left, both in 60 digits (mpmath).
  struct Row {
    double r, k;
    long double m;
  };
  WorstCase share("m");
  for (const auto& [r, k, m] :
       {Row{1.67, 7e8, 1.00000000217824487592958986L},
        Row{1.6798627813773566, 689539331.1936437, 1.00000000219831396825065550L},
        Row{1.75, 1e9, 1.00000000145510433886924390943L},
        Row{2.0000000036874326, 721907556.8642803, 1.00000000176371148003770066L},
        Row{2.1, 8e8, 1.00000000151576012905900195L}, Row{2.4, 2e9, 1.00000000053051646601243186L},
        Row{3.1, 5e-11, 2.49999999950912619371672459603L},
        Row{3.3312764644666943, 8.777472076089674e-11, 2.49999999884029102629759985L}}) {
    share.add(m, pade_sliding_coefficient(r, k), fmt::format("r = {}, k = {}", r, k));
  }
  CHECK_WITHIN_EPS(share, 1);
}

TEST_CASE("the sliding coefficient of any r is that of the quadrature", "[pade_sliding_coefficient][route]") {
  WorstCase share("m");
  for (double r : inertia_ratios) {
    const SimilaritySolution solution = quadrature_solution(PadeLaw{}, r, terminal_ratios(PadeLaw{}, r));
    for (double k : {1e-9, 1e-3, 0.05, 0.3, 0.8, 1.5, 4.0, 30.0, 1e3, 1e9}) {
      const auto& curve = *solution.through(std::log(k));
      share.add(curve.sliding_coefficient(curve.chart().coordinate(std::log(k))), pade_sliding_coefficient(r, k),
                fmt::format("r = {}, k = {}", r, k));
    }
  }
  CHECK_WITHIN_EPS(share, 8);
}

TEST_CASE("the sliding coefficient has no seam", "[pade_sliding_coefficient][limit]") {
  // Where one formula takes over from another: r = 0.72, 2, 5, and along k.
  WorstCase seam("m on the two sides");
  for (double r : {0.72, 2.0, 5.0}) {
    for (double k = 1e-6; k < 1e8; k *= 1.1) {
      seam.add(pade_sliding_coefficient(r, k), pade_sliding_coefficient(std::nextafter(r, 10), k),
               fmt::format("r = {}, k = {}", r, k));
    }
  }
  for (double r : inertia_ratios) {
    for (double k = 1e-3; k < 1e3; k *= 1.001) {
      seam.add(pade_sliding_coefficient(r, k), pade_sliding_coefficient(r, std::nextafter(k, 1e9)),
               fmt::format("r = {}, k = {}", r, k));
    }
  }
  CHECK_WITHIN_EPS(seam, 6);
}
