#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace {

struct Example {
  std::string command;
  std::string shown;
};

/// The commands of the console blocks of README.md and what it says they print.
std::vector<Example> readme_examples() {
  const std::string prompt = "$ contensou ";
  std::ifstream readme(CONTENSOU_README);
  std::vector<Example> examples;
  bool in_block = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("```")) {
      in_block = line == "```console";
    } else if (in_block && line.starts_with(prompt)) {
      examples.push_back({line.substr(prompt.size()), ""});
    } else if (in_block) {
      REQUIRE_FALSE(examples.empty());
      examples.back().shown += line + "\n";
    }
  }
  return examples;
}

}  // namespace

TEST_CASE("README.md shows what its commands print", "[cli]") {
  const std::vector<Example> examples = readme_examples();
  REQUIRE(examples.size() >= 2);
  for (const Example& example : examples) {
    CAPTURE(example.command);
    const Run run = run_program(example.command);
    CHECK(run.status == 0);
    CHECK(run.out == example.shown);
  }
}
