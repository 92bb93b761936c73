#include "contensou/reduction/paper_claim.hpp"

#include <limits>

#include <catch2/catch.hpp>

using namespace contensou::reduction;

TEST_CASE("a printed number holds, is a slip, or is false", "[paper_claim]") {
  CHECK(Evidence{1, 1 + 1e-12, 1e-10}.verdict() == Verdict::holds);
  CHECK(Evidence{1, 1.1, 1e-10}.verdict() == Verdict::not_true);
  CHECK(Evidence{1, 1.1, 1e-10, "", 1.1}.verdict() == Verdict::slip);
  CHECK(Evidence{1, 1.1, 1e-10, "", 1.2}.verdict() == Verdict::not_true);
  CHECK(Evidence{1e6, 1e6 + 1e-5, 1e-10}.verdict() == Verdict::holds);  // relative to what is large

  CHECK(Evidence{.printed = 2, .computed = 3, .allowed = 0, .at_least = true}.verdict() == Verdict::holds);
  CHECK(Evidence{.printed = 2, .computed = 1.9, .allowed = 0, .at_least = true}.verdict() == Verdict::not_true);

  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK(Evidence{infinity, 1, 1e-10, "", 1}.verdict() == Verdict::slip);
  CHECK(Evidence{not_a_number, 1, 1e-10}.verdict() == Verdict::not_true);
  CHECK(Evidence{1, not_a_number, 1e-10}.verdict() == Verdict::not_true);
  CHECK(Evidence{.printed = 1, .computed = not_a_number, .allowed = 0, .at_least = true}.verdict() ==
        Verdict::not_true);

  CHECK(name(Verdict::holds) == "holds");
  CHECK(name(Verdict::slip) == "slip");
  CHECK(name(Verdict::not_true) == "false");
  CHECK(PaperClaim{"", "", "", Verdict::slip, {1, 2, 0.1, "", 2}}.as_recorded());
  CHECK_FALSE(PaperClaim{"", "", "", Verdict::holds, {1, 2, 0.1, "", 2}}.as_recorded());
}
