#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("every verb has help with an example", "[cli]") {
  for (const std::string verb :
       {"stop", "sweep", "orbit", "roll", "law", "portrait", "check", "explore", "paper", "balls"}) {
    const Run run = run_program(verb + " --help");
    INFO(verb);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK_THAT(run.out, Contains("Example:") && Contains("contensou " + verb));
    CHECK_THAT(run_program("--help").out, Contains("contensou " + verb));
  }
}

TEST_CASE("the examples of the help work", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string help = run_program("--help").out;
  std::size_t at = help.find("Examples:");
  REQUIRE(at != std::string::npos);
  int examples = 0;
  while ((at = help.find("\n  contensou ", at)) != std::string::npos) {
    at += std::string("\n  contensou ").size();
    std::string example = help.substr(at, help.find('\n', at) - at);
    if (const auto file = example.find("-o "); file != std::string::npos) {
      if (example.ends_with(".svg") || example.ends_with(".html")) continue;  // needs gnuplot, or a page built in
      example.replace(file, 3, "-o " + scratch.path().string() + "/");
    }
    if (example.find("--out ") != std::string::npos) continue;  // needs gnuplot
    INFO(example);
    CHECK(run_program(example).status == 0);
    ++examples;
  }
  CHECK(examples >= 5);
}

TEST_CASE("the version", "[cli]") {
  const Run run = run_program("--version");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, StartsWith("contensou 0."));
}
