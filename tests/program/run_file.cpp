#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

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
/// equal, and must differ from the output for the second run file alone.
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
  check_key({.start = "slip = 2\nspin = 60"}, {}, " --slip 2", true);
  check_key({.start = "slip = 0.7\nspin = -9"}, {}, " --spin -9", true);
  check_key({.start = "velocity = [0.3, 1]\nangular_velocity = [0, 0, 60]"}, {}, " --velocity 0.3,1", true);
  check_key({.start = "velocity = [0.7, 0]\nangular_velocity = [0, 0, 5]"}, {}, " --angular-velocity 0,0,5", true);
}

TEST_CASE("a run file's law as formulas: its parameters, and mistakes at their line", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string file = scratch.file("own.toml");
  const std::string formulas = "phi = k/hypot(c, k); psi = c^2/hypot(c, k)";
  const auto stop = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"stop", "--format", "json"});
    const Run run = run_program(options);
    INFO(run.err);
    REQUIRE(run.status == 0);
    return nlohmann::json::parse(run.out)["t_stop"];
  };
  write_file(file, RunFile{.law = "law = \"" + formulas + "\"\n[contact.param]\nc = 0.6\n[contact]"}.text());
  CHECK(run_program("stop --ball " + file).status == 2);  // [contact] twice is no TOML
  write_file(file, RunFile{.law = "law = \"" + formulas + "\"\nparam.c = 0.6"}.text());
  const auto own = stop({"--ball", file});
  CHECK(stop({"--ball", file, "--law", formulas + "; c = 0.6"}) == own);
  CHECK(stop({"--ball", file, "--law", formulas + "; c = 7; c = 0.6"}) == own);
  CHECK(stop({"--ball", file, "--law", formulas + "; c = 7", "--param", "c=0.6"}) == own);
  const auto other = stop({"--ball", file, "--param", "c=0.9"});
  CHECK(other != own);
  CHECK(stop({"--ball", file, "--law", formulas, "--param", "c=0.9"}) == other);
  CHECK(stop({"--ball", file, "--law", "exact"}) != own);
  CHECK_THAT(run_program("stop --ball " + file + " --param d=1").err, Contains("has the parameter 'd'"));

  const auto mistake = [&](const std::string& law, const std::string& place, const std::string& words) {
    write_file(file, RunFile{.law = law}.text());
    for (const std::string verb : {"stop", "roll", "engine", "roll --batch -"}) {
      INFO(verb << " with " << law);
      const Run run = run_program(verb + " --ball " + file, verb.ends_with("-") ? "slip,spin\n1,2\n" : "");
      CHECK(run.status == 2);
      CHECK(run.out.empty());
      CHECK_THAT(run.err, StartsWith(file + place) && Contains(words));
    }
  };
  mistake("law = \"phi = k/hypt(1, k); psi = 1/hypot(1, k)\"", ":8:7: ", "did you mean 'hypot'?)");
  mistake("law = \"phi = k/hypot(c, k); psi = 1/hypot(1, k)\"", ":8:7: ", "'c' is no variable, parameter or function");
  mistake("law = \"phi = k/hypot(1, k)\"", ":8:7: ", "psi = is missing");
  mistake("law = \"phi = -k/hypot(1, k); psi = 1/hypot(1, k)\"", ":8:7: ", "friction resists");
  mistake("law = \"phi = v/hypot(1, k); psi = 1/hypot(1, k)\"", ":8:7: ", "not on the size of speeds");
  mistake("law = \"" + formulas + "\"\nparam = {c = 0.6, d = 1}", ":8:7: ", "has the parameter 'd'");
  mistake("law = \"" + formulas + "\"\nparam = {c = 0.6, d = \"1\"}",
          ":9:23: ", "'d' in [contact.param] must be a number");
  mistake("law = \"" + formulas + "\"\nparam = {c = nan}", ":9:14: ", "must be a number");
  mistake("law = \"" + formulas + "\"\nparam = 0.6", ":9:9: ", "param = {a = 2}");
  mistake("law = \"pade\"\nparam = {c = 0.6}", ":8:7: ", "phi = or psi = is missing");
  mistake("param = {c = 0.6}", ":8:9: ", "add law = \"phi = F; psi = G\"");
}

TEST_CASE("a run file keeps a cloth: its rolling friction is that of roll", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string cloth = scratch.file("cloth.toml"), without = scratch.file("without.toml");
  write_file(cloth, RunFile{.law = "rolling_friction = 0.008"}.text());
  write_file(without, RunFile{}.text());
  for (const std::string options : {"roll --format json", "roll --format text"}) {
    const Run run = run_program(options + " --ball " + cloth);
    CHECK_THAT(run.out, Contains("rest"));
    CHECK(run.out == run_program(options + " --rolling-friction 0.008 --ball " + without).out);
    CHECK(run_program(options + " --rolling-friction 0 --ball " + cloth).out ==
          run_program(options + " --ball " + without).out);
  }
  const Run batch = run_program("roll --batch - --ball " + cloth, "slip,spin\n1,2\n");
  CHECK(rows_of(batch.out)[0].back() == "y_rest");
  CHECK(json_of("stop --format json --ball " + cloth).at("ball").at("rolling_friction") == 0.008);
}

TEST_CASE("a start is given in one way", "[cli]") {
  CHECK_THAT(run_program("roll --ball pool --batch -", "slip,spin,wz\n5,7,1\n").err,
             StartsWith("<stdin>:1: columns slip, spin and vx, vy, wx, wy, wz exclude each other"));
  CHECK_THAT(run_program("check --ball pool --against -", "t,slip,spin,wz\n0,1,7,7\n1,0,5,6\n").err,
             StartsWith("<stdin>:3: spin 5 and wz 6 are one angular velocity, and differ"));
  CHECK(run_program("check --ball pool --against -", "t,slip,spin,wz\n0,1,7,7\n1,0,5,5\n").status == 1);
  // A start that is given by velocities works with every verb.
  CHECK(json_of("stop --format json --ball pool --velocity 0,2 --angular-velocity 0,0,9").at("t_stop") ==
        json_of("stop --format json --ball pool --slip 2 --spin 9").at("t_stop"));
  // A number in another unit is allowed if it fits a double in SI units.
  CHECK(json_of("stop --format json --ball pool --slip 1e308km/h").at("v0") == 1e308 / 3.6);
}

TEST_CASE("a load is told as one", "[cli]") {
  CHECK_THAT(run_program("stop --ball gel --load 3").out, Contains("friction 0.5, load 3 N\n") && !Contains("gravity"));
  CHECK_THAT(run_program("engine --ball gel --load 3").out, Contains("mass 0.113 kg, load 3 N, friction f = 0.5"));
  CHECK(json_of("engine --ball gel --format json").at("load") == 0.113 * 9.80665);
}

TEST_CASE("rolling friction and a slope are taken or refused by name, by every verb", "[cli]") {
  for (const std::string driven : {"rolling_friction = 0.01", "slope = -2", "slope = '-2 deg'"}) {
    const bool slopes = driven[0] == 's';
    const RunFile with = slopes ? RunFile{.environment = driven} : RunFile{.law = driven};
    const std::string option = slopes ? " --slope -2" : " --rolling-friction 0.01";
    const TemporaryDirectory scratch;
    const std::string first = scratch.file("with.toml"), second = scratch.file("without.toml");
    write_file(first, with.text());
    write_file(second, RunFile{}.text());
    for (const BallRun& run : ball_runs()) {
      INFO(run.options << " with " << driven);
      const Run by_file = run_program(run.options + " --ball " + first, run.input);
      const Run by_option = run_program(run.options + " --ball " + second + option, run.input);
      const Run level = run_program(run.options + " --ball " + second, run.input);
      CHECK(by_file.status == by_option.status);
      CHECK(by_file.out == by_option.out);
      // The value of an option replaces the value of the file.
      const std::string none = slopes ? " --slope 0" : " --rolling-friction 0";
      CHECK(run_program(run.options + none + " --ball " + first, run.input).out == level.out);
      if (by_file.status == 2) {
        CHECK_THAT(by_file.err,
                   Contains("rolling_friction and slope must be 0") || Contains("--slope 0 leaves it out"));
      } else {
        CHECK(by_file.out != level.out);
        CHECK(by_file.err == "");
      }
    }
  }
}

TEST_CASE("a slip or a spin on the command line replaces a whole [start] of velocities", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string file = scratch.file("moves.toml"), stop = "stop --format json --ball " + file;
  const auto write = [&](const std::string& start) {
    std::ofstream(file) << "[ball]\nmass = 0.1701\nradius = 0.028575\n[contact]\nfriction = 0.2\n"
                           "patch_radius = 2.83e-3\n[start]\n"
                        << start << "[uncertainty]\nfriction = 0.01\n";
  };
  const auto check_anew = [&](const std::string& given, const std::string& whole) {
    CAPTURE(given);
    const Run anew = run_program(stop + given), same = run_program(stop + whole);
    CHECK(anew.out == same.out);
    CHECK(same.err.empty());
    CHECK_THAT(anew.err, Contains("replaces [start] of " + file + "; the rest of the start is 0"));
  };
  write("velocity = [1, 2]\nangular_velocity = [3, 4, 70]\n");
  check_anew(" --slip 2", " --slip 2 --spin 0");
  check_anew(" --spin 5", " --slip 0 --spin 5");
  CHECK(json_of(stop + " --slip 2 --uncertainty fit").contains("uncertainty"));
  write("slip = 3\nspin = 70\n");
  CHECK(run_program(stop + " --slip 2").out == run_program(stop + " --slip 2 --spin 70").out);
}
