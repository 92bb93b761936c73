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

namespace {

/// A ball as a run file; each key as it is written there.
struct RunFile {
  std::string radius = "radius = 0.03", mass = "mass = 0.2", friction = "friction = 0.4",
              patch = "spin_deceleration = 10", law = {}, start = "slip = 0.7\nspin = 60", environment = {}, body = {};

  std::string text() const {
    return "[ball]\nname = \"mine\"\n" + body + "\n" + radius + "\n" + mass + "\n[contact]\n" + friction + "\n" + law +
           "\n" + patch + "\n[start]\n" + start + "\n[environment]\n" + environment + "\n";
  }
};

/// A run of a verb that takes a ball.
struct BallRun {
  std::string options, input = {};
  bool starts = true;  ///< takes --slip and --spin
  bool rolls = false;  ///< takes no body that lies flat
};

/// Every one: a verb that is new belongs here.
const std::vector<BallRun>& ball_runs() {
  static const std::vector<BallRun> runs{
      {"stop --format json"},
      {"stop --format text"},
      {.options = "stop --batch -", .input = "slip,spin\n1,50\n0.2,-9\n", .starts = false},
      {"orbit --samples 7 --format json"},
      {.options = "roll --samples 7 --format json", .rolls = true},
      {.options = "roll --format text", .rolls = true},
      {.options = "roll --batch -", .input = "slip,spin\n1,50\n0.2,-9\n", .starts = false, .rolls = true},
      {.options = "engine --format json", .rolls = true},
      {"check --format json"},
      {.options = "check --format json --against -", .input = "t,slip,spin\n0,1,50\n0.1,0.9,49\n", .starts = false},
      {"portrait --orbits 2 --isochrones 2 -o - --format json"},
      {.options = "sweep --slip 0:1:3 --spin 1:60:3", .starts = false},
      {.options = "fit --plan --fps 100 --noise slip=0.01,spin=1 --format json", .rolls = true}};
  return runs;
}

/// What two run files and the options to the second give, verb by verb: it must be the same, and differ from what the
/// second gives by itself.
void check_key(const RunFile& with, const RunFile& without, const std::string& options, bool of_start = false) {
  const TemporaryDirectory scratch;
  const std::string first = scratch.file("with.toml"), second = scratch.file("without.toml");
  write_file(first, with.text());
  write_file(second, without.text());
  for (const BallRun& run : ball_runs()) {
    if ((of_start && !run.starts) || (!with.body.empty() && run.rolls)) continue;
    INFO(run.options << " --ball with.toml, or without.toml " << options << "\n" << with.text());
    const Run by_file = run_program(run.options + " --ball " + first, run.input);
    const Run by_option = run_program(run.options + " --ball " + second + options, run.input);
    CHECK(by_file.err == "");
    REQUIRE(by_file.status == by_option.status);
    CHECK(by_file.out == by_option.out);
    CHECK(by_file.out != run_program(run.options + " --ball " + second, run.input).out);
  }
}

}  // namespace

TEST_CASE("a run file's law is that of every verb", "[cli]") {
  check_key({.law = "law = \"pade\""}, {}, " --law pade");
}
