#include "contensou/reduction/laws.hpp"

#include <catch2/catch.hpp>

using namespace contensou::reduction;

TEST_CASE("a law is found by its name", "[laws]") {
  REQUIRE(named_laws().size() == 2);
  CHECK(named_laws().front().name() == "pade");
  for (const Law& law : named_laws()) {
    const auto found = find_law(law.name());
    REQUIRE(found);
    CHECK(found->name() == law.name());
    CHECK((*found)({2, 1}).force == law({2, 1}).force);
  }
  CHECK(find_law("exact")->inner_log_rim());
  CHECK_FALSE(find_law("Pade"));
  CHECK_FALSE(find_law(""));
}
