#include "numerics/dilogarithm.hpp"

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("the dilogarithm over its table", "[dilogarithm][table]") {
  WorstCase li2("Li2(-exp(x))");
  for (const ReferenceRow& row : reference_table("dilogarithm")) {
    li2.add(row.result("li2"), dilogarithm_of_minus_exp(row.input("x")), row.where());
  }
  CHECK_WITHIN_EPS(li2, 4);
  CHECK(dilogarithm_of_minus_exp(-infinity) == 0);
  CHECK(dilogarithm_of_minus_exp(1e5) == Approx(-0.5e10).epsilon(1e-9));
}
