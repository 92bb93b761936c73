#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a run file's mistakes come with file, line and column", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string file = scratch.file("ball.toml");
  write_file(file, "[ball]\nmas = 1\n");
  const Run run = run_program("stop --ball " + file);
  CHECK(run.status == 2);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, StartsWith(file + ":2:1: ") && Contains("did you mean 'mass'"));
}

TEST_CASE("what counts as a file", "[cli]") {
  CHECK(run_program("stop --ball nosuch.toml").status == 4);
  CHECK(run_program("stop --ball ./pool").status == 4);
  CHECK(run_program("stop --ball nosuch").status == 2);
  const TemporaryDirectory scratch;
  const Run directory = run_program("stop --ball " + scratch.path().string());
  CHECK(directory.status == 4);
  CHECK_THAT(directory.err, Contains(scratch.path().string()) && Contains("directory"));
}
