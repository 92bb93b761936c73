#include <cmath>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"
#include "similarity/curves.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

constexpr double inertia_ratios[] = {1e-300, 1e-20, 1e-6, 0.1, 0.4, 5.0 / 7, PadeCurve::max_r};

}  // namespace

TEST_CASE("the Pade law's m runs from 5/2 to 1", "[pade_curve][limit]") {
  for (double r : inertia_ratios) {
    const PadeCurve curve(r);
    CAPTURE(r);
    CHECK(curve.sliding_coefficient(-infinity) == 2.5);
    CHECK(curve.sliding_coefficient(infinity) == 1);
    double before = 2.5;
    for (double ln_k = -45; ln_k < 60; ln_k += 0.25) {
      const double here = curve.sliding_coefficient(ln_k);
      CAPTURE(ln_k);
      CHECK(here <= before * (1 + 1e-15));
      CHECK(here >= 1);
      before = here;
    }
  }
}

TEST_CASE("the Pade law's m and o are those of the quadrature", "[pade_curve][route]") {
  WorstCase sliding("m"), angle("o");
  for (double r : inertia_ratios) {
    const PadeCurve curve(r);
    const QuadratureCurve other(PadeLaw{}, r);
    for (double ln_k = -20; ln_k < 40; ln_k += 0.7) {
      sliding.add(other.sliding_coefficient(ln_k), curve.sliding_coefficient(ln_k), fmt::format("r = {}, {}", r, ln_k));
      angle.add(other.angle_coefficient(ln_k), curve.angle_coefficient(ln_k), fmt::format("r = {}, {}", r, ln_k));
    }
  }
  CHECK_WITHIN_EPS(sliding, 8);
  CHECK_WITHIN_EPS(angle, 16);
}

TEST_CASE("the Pade law's m has no seam along k", "[pade_curve][limit]") {
  WorstCase seam("m on the two sides");
  for (double r : inertia_ratios) {
    const PadeCurve curve(r);
    for (double ln_k = -7; ln_k < 7; ln_k += 0.001) {
      seam.add(curve.sliding_coefficient(ln_k), curve.sliding_coefficient(std::nextafter(ln_k, 100)),
               fmt::format("r = {}, ln k = {}", r, ln_k));
    }
  }
  CHECK_WITHIN_EPS(seam, 6);
}
