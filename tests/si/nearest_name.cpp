#include "text/nearest_name.hpp"

#include <vector>

#include <catch2/catch.hpp>

using contensou::nearest_name;
using contensou::suggestion;

TEST_CASE("the nearest name, and the suggestion of a message", "[table]") {
  const std::vector<std::string> names{"pool", "steel", "bowling", "rubber", "gel", "u0"};
  for (const auto& [given, nearest] : {std::pair{"pol", "pool"},
                                       {"pool", "pool"},
                                       {"stel", "steel"},
                                       {"bowlingball", ""},
                                       {"zebra", ""},
                                       {"", ""},
                                       {"0u", "u0"}}) {  // two swapped neighbours count as one edit
    CHECK(nearest_name(given, names) == nearest);
  }
  CHECK(nearest_name("pool", {}).empty());
  CHECK(suggestion("bowilng", names) == " (did you mean 'bowling'?)");
  CHECK(suggestion("xyz", names).empty());
}
