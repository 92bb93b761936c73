#include "contensou/portraits/figure.hpp"

#include <catch2/catch.hpp>

using contensou::portraits::literal;

TEST_CASE("A literal text shows its own characters", "[table]") {
  CHECK(literal("plain text 1.5") == "plain text 1.5");
  CHECK(literal("a_b^c {x} @ & ~ \\") == "a\\_b\\^c \\{x\\} \\@ \\& \\~ \\\\");
}

TEST_CASE("A literal text is cut at whole characters", "[limit]") {
  CHECK(literal("abcdef", 6) == "abcdef");
  CHECK(literal("abcdef", 5) == "abcde…");
  CHECK(literal("μμμμ", 3) == "μμμ…");
  CHECK(literal("", 0) == "");
}
