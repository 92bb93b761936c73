#include "contensou/reduction/laws.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/pressure_law.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;

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
  for (const char* name : {"uniform", "punch", "ring", "potential8"}) CHECK(find_law(name));
  CHECK_FALSE(find_law("Pade"));
  CHECK_FALSE(find_law(""));
}

TEST_CASE("a law is found by the exponent of its pressure", "[laws]") {
  for (double p : {-0.3, 0.5, 0.1 + 0.2, 25.0}) {
    const auto found = find_law(PressureLaw(p).name());
    REQUIRE(found);
    REQUIRE(found->as<PressureLaw>());
    CHECK(found->as<PressureLaw>()->p() == p);
  }
  CHECK(find_law("pressure:+5e-1")->as<PressureLaw>()->p() == 0.5);
  for (const std::string exponent : {"", "x", "0.5abc", "0.5 ", "+-1", "nan", "inf", "1e999", "0,5"}) {
    CHECK_THROWS_WITH(find_law("pressure:" + exponent), Contains("'" + exponent + "'") && Contains("pressure:0.5"));
  }
  CHECK_THROWS_WITH(find_law("pressure:-1"), Contains("-1 < P <= 25") && Contains("ring"));
  CHECK_THROWS_WITH(find_law("pressure:25.1"), Contains("-1 < P <= 25") && !Contains("ring"));
}
