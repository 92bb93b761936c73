#include <fstream>
#include <sstream>
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

/// The words of a command; double quotes hold some together.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words(1);
  bool quoted = false;
  for (char letter : command) {
    if (letter == '"') {
      quoted = !quoted;
    } else if (letter == ' ' && !quoted) {
      words.emplace_back();
    } else {
      words.back() += letter;
    }
  }
  return words;
}

/// What is printed, without the lines that a line of dots stands for.
std::string shortened(const std::string& printed, const std::string& shown) {
  std::istringstream printed_lines(printed), shown_lines(shown);
  std::string result, line;
  for (std::string wanted; std::getline(shown_lines, wanted);) {
    if (wanted == "...") {
      result += "...\n";
      if (!std::getline(shown_lines, wanted)) return result;
      while (std::getline(printed_lines, line) && line != wanted) {
      }
    } else if (!std::getline(printed_lines, line)) {
      return result;
    }
    result += line + "\n";
  }
  while (std::getline(printed_lines, line)) result += line + "\n";
  return result;
}

}  // namespace

TEST_CASE("README.md shows what its commands print", "[cli]") {
  const std::vector<Example> examples = readme_examples();
  REQUIRE(examples.size() >= 2);
  for (const Example& example : examples) {
    CAPTURE(example.command);
    const Run run = run_program(words_of(example.command));
    CHECK(run.status == 0);
    CHECK(shortened(run.out, example.shown) == example.shown);
  }
}
