#include "contensou/portraits/json.hpp"
#include "contensou/reduction/detail/infinity.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using contensou::portraits::append_json;
using contensou::portraits::json_document;
using Json = nlohmann::ordered_json;

namespace {

std::string text_of(const Json& value) {
  std::string text;
  append_json(text, value);
  return text;
}

using contensou::infinity;

}  // namespace

TEST_CASE("a document of JSON", "[table]") {
  const Json document{{"schema", 1},
                      {"name", "\"quoted\"\n"},
                      {"numbers", {0.1, 1.0, -1e300, 5e-324, -infinity, infinity}},
                      {"inner", {{"yes", true}, {"list", Json::array()}, {"object", Json::object()}}}};
  CHECK(json_document(document) ==
        "{\n"
        "  \"schema\": 1,\n"
        "  \"name\": \"\\\"quoted\\\"\\n\",\n"
        "  \"numbers\": [0.1, 1, -1e+300, 5e-324, \"-inf\", \"inf\"],\n"
        "  \"inner\": {\"yes\": true, \"list\": [], \"object\": {}}\n"
        "}\n");
  CHECK(text_of("\xC3\xA4 \xFF") == "\"\xC3\xA4 \xEF\xBF\xBD\"");
  CHECK_THROWS_AS(text_of(std::nan("")), std::runtime_error);
}

TEST_CASE("numbers of JSON have the shortest digits that read back", "[invariant]") {
  // A number for which nlohmann's own text has one digit more.
  CHECK(text_of(0.11979881415871) == "0.11979881415871");
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const auto number = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
    if (!std::isfinite(number)) continue;
    const std::string text = text_of(number);
    char shortest[64];
    const auto digits = [](std::string_view spelled) {
      std::string found;
      for (char c : spelled.substr(0, spelled.find('e'))) {
        if (c >= '0' && c <= '9' && !(found.empty() && c == '0')) found += c;
      }
      return found.substr(0, found.find_last_not_of('0') + 1);
    };
    const auto end = std::to_chars(shortest, shortest + sizeof shortest, number, std::chars_format::scientific).ptr;
    REQUIRE(digits(text) == digits({shortest, end}));
    REQUIRE(Json::parse(text).get<double>() == number);
  }
}
