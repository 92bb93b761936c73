#include "text/nearest_name.hpp"

#include <vector>

#include <catch2/catch.hpp>

using contensou::nearest_name;
using contensou::suggestion;

TEST_CASE("the nearest name", "[table]") {
  const std::vector<std::string> names{"pool", "steel", "bowling", "rubber", "gel"};
  CHECK(nearest_name("pol", names) == "pool");
  CHECK(nearest_name("pool", names) == "pool");
  CHECK(nearest_name("bowlingball", names).empty());
  CHECK(nearest_name("stel", names) == "steel");
  CHECK(nearest_name("zebra", names).empty());
  CHECK(nearest_name("", names).empty());
  CHECK(nearest_name("pool", {}).empty());
}

TEST_CASE("swapped neighbours are one edit", "[table]") {
  const std::vector<std::string> names{"u0", "v0"};
  CHECK(nearest_name("0u", names) == "u0");  // two edits would be too many for two letters
}

TEST_CASE("the suggestion of a message", "[table]") {
  const std::vector<std::string> names{"closed", "direct"};
  CHECK(suggestion("clsoed", names) == " (did you mean 'closed'?)");
  CHECK(suggestion("xyz", names).empty());
}
