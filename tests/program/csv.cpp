#include "answers/input/csv.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "answers/input/parse.hpp"

using namespace contensou::answers;
using Catch::Matchers::Equals;

namespace {

/// Returns the results of a parser for a text: line, text and fields of each record, and the error message at the end.
std::vector<std::string> records_of(const std::vector<std::string_view>& pieces) {
  std::vector<std::string> found;
  CsvParser parser("f");
  CsvBlock block;
  const auto take = [&] {
    for (std::size_t i = 0; i < block.size(); ++i) {
      std::string record = fmt::format("{}: {}", block[i].line(), block[i].text());
      for (std::size_t field = 0; field < block[i].size(); ++field) record += fmt::format(" [{}]", block[i][field]);
      found.push_back(std::move(record));
    }
    block = {};
  };
  try {
    for (std::string_view piece : pieces) {
      parser.add(piece, block);
      take();
    }
    parser.finish(block);
    take();
  } catch (const BadLine& error) {
    take();
    found.emplace_back(error.what());
  }
  return found;
}

std::vector<std::string_view> letters(std::string_view text) {
  std::vector<std::string_view> pieces;
  for (std::size_t i = 0; i < text.size(); ++i) pieces.push_back(text.substr(i, 1));
  return pieces;
}

/// Returns the text. Each \n is replaced by the next of the given line ends, in turn.
std::string with_line_ends(std::string_view text, const std::vector<std::string>& ends) {
  std::string result;
  std::size_t count = 0;
  for (char letter : text) result += letter == '\n' ? ends[count++ % ends.size()] : std::string(1, letter);
  return result;
}

/// Returns the text with all line ends replaced by \n.
std::string with_feeds(std::string_view text) {
  std::string result;
  for (char letter : text) {
    if (letter == '\n' && result.ends_with('\r')) result.pop_back();
    result += letter;
  }
  std::ranges::replace(result, '\r', '\n');
  return result;
}

}  // namespace

TEST_CASE("records do not depend on the line ends, nor on where the text is cut", "[table][invariant]") {
  using namespace std::string_literals;
  const std::string text =
      "# a \"comment\n\nmu,u0,v0\n0.1,1,1\n\n\"two\n# lines\n\n\",\"a \"\"b\"\"\",\n # ,\"\",x\0y\n#\nlast, 2 ,3"s;
  const std::vector<std::vector<std::string>> line_ends{
      {"\n"}, {"\r\n"}, {"\r"}, {"\r", "\n"}, {"\n", "\r\n", "\r"}, {"\r\n", "\r"}, {"\r", "\r\n"}};
  for (const auto& ends : line_ends) {
    const std::string file = with_line_ends(text, ends);
    const std::vector<std::string> whole = records_of({file});
    INFO(escaped(file));
    REQUIRE(whole.size() == 5);
    if (with_feeds(file) == text) {  // otherwise \r and \n of two lines have met and are one line end
      const auto starts_at = [&](std::size_t record) { return std::stol(whole[record]); };
      CHECK(whole[0] == "3: mu,u0,v0 [mu] [u0] [v0]");
      CHECK(whole[1] == "4: 0.1,1,1 [0.1] [1] [1]");
      CHECK(starts_at(2) == 6);
      CHECK(whole[3] == "10:  # ,\"\",x\0y [ # ] [] [x\0y]"s);
      CHECK(whole[4] == "12: last, 2 ,3 [last] [ 2 ] [3]");
    }
    for (std::size_t cut = 0; cut <= file.size(); ++cut) {
      INFO(cut);
      const std::string_view all = file;
      CHECK(records_of({all.substr(0, cut), all.substr(cut)}) == whole);
    }
    CHECK(records_of(letters(file)) == whole);
    CHECK(records_of(letters(file + ends[0])) == whole);
  }
}

TEST_CASE("a fault has its line, after the records before it, wherever the text is cut", "[table][domain]") {
  struct Fault {
    std::string text;
    std::vector<std::string> found;
  };
  const std::vector<Fault> faults{
      {"a\nb\"\nc\n", {"1: a [a]", "f:2: a quote inside a field: put the field in quotes and double those inside"}},
      {"a\n\"b\nc\"d\n",
       {"1: a [a]",
        "f:2: a quote inside a field, or one that closes on line 3 only: "
        "put the field in quotes and double those inside"}},
      {"a\n\"b\nc\",\"d\ne\n", {"1: a [a]", "f:3: the quotes that open here are never closed"}},
      {"a\n\"b\"c\n", {"1: a [a]", "f:2: a quote inside a field: put the field in quotes and double those inside"}},
      {"a\n\n\"b\nc\n", {"1: a [a]", "f:3: the quotes that open here are never closed"}},
  };
  for (const auto& [text, found] : faults) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const std::string file = with_line_ends(text, {end});
      INFO(escaped(file));
      CHECK_THAT(records_of({file}), Equals(found));
      CHECK_THAT(records_of(letters(file)), Equals(found));
    }
  }
}

TEST_CASE("a message shows what was typed, but not all of it, and nothing that a terminal obeys", "[cli]") {
  CHECK(quotation("0.1x") == "'0.1x'");
  CHECK(quotation(std::string("a\0b\n\x7F\x1B[2J", 9)) == "'a\\x00b\\n\\x7f\\x1b[2J'");
  CHECK(quotation("\xC3\xA9 \xE2\x88\x9E \xF0\x9F\x8E\xB1") == "'\xC3\xA9 \xE2\x88\x9E \xF0\x9F\x8E\xB1'");
  // Cases: Latin-1; a lone continuation byte; an overlong slash; a surrogate; a C1 control; an incomplete character.
  CHECK(quotation("\xE9"
                  "a \x80 \xC0\xAF \xED\xA0\x80 \xC2\x9B \xE2\x88") ==
        "'\\xe9a \\x80 \\xc0\\xaf \\xed\\xa0\\x80 \\x9b \\xe2\\x88'");
  CHECK(quotation(std::string(20000, 'x')) == fmt::format("'{}...'", std::string(80, 'x')));
  CHECK(quotation(fmt::format("{}\xE2\x88\x9E", std::string(79, 'x'))) == fmt::format("'{}...'", std::string(79, 'x')));
}
