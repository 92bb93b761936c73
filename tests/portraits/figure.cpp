#include "contensou/portraits/figure.hpp"

#include <catch2/catch.hpp>

using contensou::portraits::literal;
using contensou::portraits::shown_length;

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

TEST_CASE("The shown length of a text counts characters, not markup", "[table]") {
  CHECK(shown_length("plain") == 5);
  CHECK(shown_length("{/:Italic μ} = 0.3") == 7);
  CHECK(shown_length("10^{-3}") == 4);
  CHECK(shown_length("ω_z") == 2);
  CHECK(shown_length("a\\_b") == 3);
  CHECK(shown_length("") == 0);
}
