#include "contensou/reduction/slip.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;

namespace {}  // namespace

TEST_CASE("the slip of a ratio has 1 for the larger speed", "[slip][limit]") {
  for (double k : {0.0, 5e-324, 1e-300, 0.25, 1.0}) {
    CHECK(slip_of_ratio(k).sliding == k);
    CHECK(slip_of_ratio(k).pivoting == 1);
  }
  for (double k : {std::nextafter(1.0, 2.0), 3.0, 1e300, infinity}) {
    CHECK(slip_of_ratio(k).sliding == 1);
    CHECK(slip_of_ratio(k).pivoting == 1 / k);
  }
  CHECK(slip_of_ratio(infinity).pivoting == 0);
}

TEST_CASE("a ratio is at least 0 and a number", "[slip][domain]") {
  for (double k : {-5e-324, -1.0, -infinity, not_a_number}) CHECK_THROWS_AS(slip_of_ratio(k), std::domain_error);
  CHECK_THROWS_WITH(slip_of_ratio(-2), Contains("slip_of_ratio") && Contains("-2"));
}

TEST_CASE("a slip is two finite speeds, not both 0", "[slip][domain]") {
  for (double speed : {-1.0, -5e-324, infinity, -infinity, not_a_number}) {
    CHECK_THROWS_AS(require_slip("SomeLaw", {speed, 1}), std::domain_error);
    CHECK_THROWS_AS(require_slip("SomeLaw", {1, speed}), std::domain_error);
  }
  CHECK_THROWS_WITH(require_slip("SomeLaw", {0.5, -3}), Contains("SomeLaw") && Contains("0.5") && Contains("-3"));
  CHECK_THROWS_WITH(require_slip("SomeLaw", {0, 0}), Contains("both 0"));
  CHECK_NOTHROW(require_slip("SomeLaw", {0, 5e-324}));
  CHECK_NOTHROW(require_slip("SomeLaw", {std::numeric_limits<double>::max(), 0}));
}
