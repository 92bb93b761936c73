#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

/// A ball as the keys of a run file.
struct RunFile {
  std::string radius = "radius = 0.03", mass = "mass = 0.2", friction = "friction = 0.4",
              patch = "spin_deceleration = 10", law = {}, start = "slip = 0.7\nspin = 60", environment = {}, body = {};

  std::string text() const {
    return "[ball]\nname = \"mine\"\n" + body + "\n" + radius + "\n" + mass + "\n[contact]\n" + friction + "\n" + law +
           "\n" + patch + "\n[start]\n" + start + "\n[environment]\n" + environment + "\n";
  }
};

/// A command of a verb that takes a ball.
struct BallRun {
  std::string options, input = {};
  bool starts = true;  ///< true: the verb takes --slip and --spin
  bool rolls = false;  ///< true: the verb rejects a body that lies flat
};

/// Returns a command for every verb with a ball. A new verb must be added here.
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

/// Compares two outputs of each verb: for the first run file, and for the second run file plus options. They must be
/// equal, and must differ from the output for the second run file alone. Some verbs refuse a drive, by its name.
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
    REQUIRE(by_file.status == by_option.status);
    CHECK(by_file.out == by_option.out);
    if (by_file.status == 2) {
      CHECK_THAT(by_file.err, Contains("rolling_friction and slope must be 0") || Contains("--slope 0 leaves it out"));
    } else {
      CHECK(by_file.err == "");
      CHECK(by_file.out != run_program(run.options + " --ball " + second, run.input).out);
    }
  }
}

}  // namespace

TEST_CASE("every key of a run file is what its option is, for every verb", "[cli]") {
  check_key({.law = "law = \"pade\""}, {}, " --law pade");
  check_key({.law = "law = \"phi=k/hypot(c,k);psi=c^2/hypot(c,k)\"\nparam = {c = 0.6}"}, {},
            " --law phi=k/hypot(c,k);psi=c^2/hypot(c,k) --param c=0.6");
  check_key({.radius = "radius = 0.025"}, {}, " --radius 0.025");
  check_key({.friction = "friction = 0.3"}, {}, " --friction 0.3");
  check_key({.patch = "patch_radius = 0.002"}, {}, " --patch-radius 0.002");
  check_key({.patch = "spin_deceleration = 7"}, {}, " --spin-deceleration 7");
  check_key({.patch = "hertz = {youngs_modulus = [1e6, 2e6], poisson_ratio = [0.4, 0.3]}"}, {},
            " --youngs-modulus 1e6,2e6 --poisson-ratio 0.4,0.3");
  check_key({.environment = "gravity = 1.6"}, {}, " --gravity 1.6");
  check_key({.mass = "mass = 0.1", .environment = "load = 3"}, {.environment = "load = 3"}, " --mass 0.1");
  check_key({.environment = "load = '3 N'"}, {}, " --load 3");
  for (const std::string slope : {"slope = -2", "slope = '-2 deg'"})
    check_key({.environment = slope}, {}, " --slope -2");
  check_key({.law = "rolling_friction = 0.01"}, {}, " --rolling-friction 0.01");
  check_key({.start = "slip = 2\nspin = 60"}, {}, " --slip 2", true);
  check_key({.start = "slip = 0.7\nspin = -9"}, {}, " --spin -9", true);
  check_key({.start = "velocity = [0.3, 1]\nangular_velocity = [0, 0, 60]"}, {}, " --velocity 0.3,1", true);
  check_key({.start = "velocity = [0.7, 0]\nangular_velocity = [0, 0, 5]"}, {}, " --angular-velocity 0,0,5", true);
}
