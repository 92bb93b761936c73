#include "contensou/reduction/wright_omega.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("the omega function over its table", "[wright_omega][table]") {
  WorstCase omega("omega");
  for (const ReferenceRow& row : reference_table("wright_omega")) {
    omega.add(row.result("omega"), wright_omega(row.input("x")), row.where());
  }
  CHECK_WITHIN_EPS(omega, 4);
}

TEST_CASE("the omega function solves its equation, also where its forms meet", "[wright_omega][invariant]") {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (double centre : {-40.0, -1.0, 0.0, 1.0, 30.0, 500.0, 700.0, 1e5}) {
    double before = 0;
    for (double x = centre - 1; x <= centre + 1; x += 1.0 / 64) {
      const double w = wright_omega(x);
      CAPTURE(x, w);
      CHECK(w > before);
      CHECK(std::abs(w + std::log(w) - x) <= 8 * eps * std::max(1.0, std::abs(x)));
      before = w;
    }
  }
}

TEST_CASE("the omega function at its ends", "[wright_omega][limit]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(wright_omega(-infinity) == 0);
  CHECK(wright_omega(-800) == 0);
  CHECK(wright_omega(infinity) == infinity);
  CHECK(wright_omega(1e308) == 1e308);
  CHECK(wright_omega(1) == 1);
  CHECK_THROWS_AS(wright_omega(std::nan("")), std::domain_error);
}
