#include "contensou/portraits/figure.hpp"

#include <catch2/catch.hpp>

using contensou::portraits::literal;
using contensou::portraits::text_width;
using contensou::portraits::with_minus_signs;

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

TEST_CASE("The width of a text is that of its characters, not of its markup", "[table]") {
  CHECK(text_width("aaa") == Approx(3 * text_width("a")));
  CHECK(text_width("{/:Italic μ} = 0.3") == Approx(text_width("μ = 0.3")));
  CHECK(text_width("10^{−3}") < text_width("10−3"));
  CHECK(text_width("10^{−3}a") - text_width("10^{−3}") == Approx(text_width("a")));
  CHECK(text_width("ω_zz") - text_width("ω_z") == Approx(text_width("z")));
  CHECK(text_width("a\\_b") == Approx(text_width("aab")));
  CHECK(text_width("") == 0);
}

TEST_CASE("A hyphen before a number is a minus sign, one within a word is none", "[table]") {
  CHECK(with_minus_signs("-1") == "−1");
  CHECK(with_minus_signs("10^{-3}, -0.5") == "10^{−3}, −0.5");
  for (const char* kept : {"2007-06", "cue-ball", "x -", "μ-1", "a--1"}) CHECK(with_minus_signs(kept) == kept);
}
