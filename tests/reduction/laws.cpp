#include "contensou/reduction/laws.hpp"

#include <catch2/catch.hpp>

using namespace contensou::reduction;

TEST_CASE("a law is found by its name", "[laws]") {
  REQUIRE(paper_laws().size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(paper_laws()[i].name() == named_laws()[i].name());
  CHECK(named_laws().front().name() == "pade");
  for (const Law& law : named_laws()) {
    const auto found = find_law(law.name());
    REQUIRE(found);
    CHECK(found->name() == law.name());
    CHECK((*found)({2, 1}).force == law({2, 1}).force);
  }
  for (const char* name : {"uniform", "punch", "ring", "potential8"}) CHECK(find_law(name));
  CHECK_FALSE(find_law("Pade"));
  CHECK_FALSE(find_law(""));
}
