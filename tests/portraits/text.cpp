#include "contensou/portraits/text.hpp"

#include <stdexcept>

#include <catch2/catch.hpp>

using namespace contensou::portraits;

TEST_CASE("A text is runs that differ in their look from their neighbours", "[table]") {
  const Text text = "the ray " + math("u") + sub("0") + math(" = R ω") + sub(math("z")) + " and " + "more";
  CHECK(text.runs() == std::vector<Run>{{"the ray "},
                                        {"u", true},
                                        {"0", false, -1},
                                        {"\u00A0=\u00A0"},
                                        {"R\u00A0ω", true},
                                        {"z", true, -1},
                                        {" and more"}});
  CHECK(text.words() == "the ray u0\u00A0=\u00A0R\u00A0ωz and more");
  CHECK(("10" + sup("−3")).runs() == std::vector<Run>{{"10"}, {"−3", false, 1}});
  Text twice = math("k");
  CHECK((twice += twice) == math("kk"));
  CHECK(Text().empty());
  CHECK(("" + sub("") + math("")).empty());
}

TEST_CASE("A power of a power is refused: it would lose its level", "[domain]") {
  for (const Text& text : {"2.8·10" + sup("8"), math("x") + sub("0"), sup("2")}) {
    CHECK_THROWS_AS(sup(text), std::logic_error);
    CHECK_THROWS_AS(sub(text), std::logic_error);
  }
}

TEST_CASE("In a formula letters are in italics, and it is not broken", "[table]") {
  CHECK(math("k = v/(μ|u|)").runs() ==
        std::vector<Run>{{"k", true}, {"\u00A0=\u00A0"}, {"v", true}, {"/("}, {"μ", true}, {"|"}, {"u", true}, {"|)"}});
  CHECK(math("u → −∞").runs() == std::vector<Run>{{"u", true}, {"\u00A0→\u00A0−∞"}});
  CHECK(math("N f").runs() == std::vector<Run>{{"N\u00A0f", true}});
  CHECK(unbroken("0.2 s") == "0.2\u00A0s");
}

TEST_CASE("Words of somebody else's are cut at whole characters", "[limit]") {
  CHECK(shortened("a_b^c {x} @ & ~ \\") == "a_b^c {x} @ & ~ \\");
  CHECK(shortened("abcdef", 6) == "abcdef");
  CHECK(shortened("abcdef", 5) == "abcde…");
  CHECK(shortened("μμμμ", 3) == "μμμ…");
  CHECK(shortened("", 0).empty());
}

TEST_CASE("The width of a text is that of its characters, an index is smaller", "[table]") {
  CHECK(text_width("aaa") == Approx(3 * text_width("a")));
  CHECK(text_width(math("μ = 0.3")) == Approx(text_width("μ = 0.3")));
  CHECK(text_width("10" + sup("−3")) == Approx(text_width("10") + 0.8 * text_width("−3")));
  CHECK(text_width("10" + sub("−3")) == text_width("10" + sup("−3")));
  CHECK(text_width("") == 0);
  // A minus sign, which a hyphen before a number becomes, is wider than a digit.
  CHECK(text_width("-1") == text_width("−1"));
  CHECK(text_width("-1") > text_width("11"));
}

TEST_CASE("A hyphen before a number is a minus sign, one within a word is none", "[table]") {
  CHECK(with_minus_signs("-1") == "−1");
  CHECK(with_minus_signs("x = -3, -0.5") == "x = −3, −0.5");
  for (const char* kept : {"2007-06", "cue-ball", "x -", "μ-1", "a--1"}) CHECK(with_minus_signs(kept) == kept);
}
