#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/si/catalogue.hpp"
#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("balls lists each ball on a line that begins with its name", "[cli]") {
  const Run run = run_program("balls");
  CHECK(run.status == 0);
  std::istringstream lines(run.out);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.size() <= 80);
    if (!line.starts_with(' ')) names.push_back(line.substr(0, line.find(' ')));
  }
  std::vector<std::string> built_in;
  for (const auto& entry : contensou::si::catalogue()) built_in.push_back(entry.name);
  CHECK(names == built_in);
  CHECK(json_of("balls --format json").at("balls").size() == contensou::si::catalogue().size());
  CHECK(rows_of(run_program("balls --format csv").out).size() == contensou::si::catalogue().size() + 1);
}

TEST_CASE("a ball that was printed is the ball that is built in", "[invariant]") {
  const TemporaryDirectory scratch;
  for (const auto& entry : contensou::si::catalogue()) {
    const std::string file = scratch.file(entry.name + ".toml");
    CHECK(run_program("balls " + entry.name + " -o " + file).status == 0);
    CHECK(run_program("balls " + entry.name).out == read_file(file));
    INFO(read_file(file));
    CHECK(json_of("stop --format json --ball " + file) == json_of("stop --format json --ball " + entry.name));
  }
}

TEST_CASE("assumed values are said to be assumed", "[table]") {
  for (const char* name : {"bowling", "rubber", "gel"}) {
    CHECK_THAT(run_program({std::string("balls"), std::string(name)}).out, Contains("assumed"));
  }
}
