#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "run_program.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("a ball that is pressed on the plane", "[invariant]") {
  const auto stop = [](const std::string& options) { return json_of("stop --format json --ball steel " + options); };
  // Its weight as a load is nothing new.
  CHECK(stop("--load 0.320677455").at("t_stop").get<double>() ==
        Approx(stop("").at("t_stop").get<double>()).epsilon(1e-14));  // 0.0327 kg * 9.80665 m/s^2
  // 100 N on 33 g: friction f N in place of f m g, and Hertz's patch of that load, eps^3 ~ N.
  const json pressed = stop("--load 100N --spin 0");
  CHECK(pressed.at("t_stop").get<double>() == Approx(2 * 0.5 * 0.0327 / (7 * 0.12 * 100)).epsilon(1e-12));
  const double share = 100 / 0.320677455;
  CHECK(pressed.at("mu").get<double>() == Approx(std::cbrt(share) * stop("").at("mu").get<double>()).epsilon(1e-12));
}

TEST_CASE("stop as JSON has its fields and no others", "[cli]") {
  const json stop = json_of("stop --law pade --mu 0.1 --u0 2 --v0 1 --format json");
  CHECK(stop.size() == 14);
  CHECK(stop.contains("version"));
  CHECK(stop.at("schema") == 1);
  CHECK(stop.at("law") == "pade");
  CHECK(stop.at("route") == "closed");
  CHECK(stop.at("mu") == 0.1);
  CHECK(stop.at("u0") == 2);
  CHECK(stop.at("v0") == 1);
  const ReducedSystem system(PadeLaw{}, 0.1);
  CHECK(stop.at("tau_stop").get<double>() == Flow(system).stop_time({2, 1}).tau);
  CHECK(stop.at("bounds").at(0).get<double>() == system.stop_time_bounds({2, 1}).lower);
  CHECK(stop.at("bounds").at(1).get<double>() == system.stop_time_bounds({2, 1}).upper);
  CHECK(stop.at("body") == json{{"chi", 3.5}, {"gamma", 2.5}});
  CHECK(stop.at("T_stop").get<double>() == Approx(stop.at("tau_stop").get<double>() / 4.71238898038469).epsilon(1e-15));
  CHECK(stop.at("limits").at("sliding_only").get<double>() == system.sliding_limit(1));
  CHECK(stop.at("limits").at("pivoting_only").get<double>() == system.pivoting_limit(2));
}

TEST_CASE("the law is exact, or that of the body's own pressure", "[cli]") {
  for (const auto& [given, law] : {std::pair{"ball", "exact"},
                                   {"hollow-ball", "exact"},
                                   {"1,2", "exact"},
                                   {"disc", "uniform"},
                                   {"ring", "ring"},
                                   {"ring --law pade", "pade"}}) {
    const std::string body = fmt::format("--body {}", given);
    const std::string start = fmt::format(" --mu 1 {} --u0 1 --v0 1", body);
    CAPTURE(start);
    for (const std::string verb : {"stop", "orbit", "terminal", "portrait -o -"}) {
      const std::string what = verb == "terminal" ? fmt::format(" --mu 1 {}", body) : start;
      CHECK(json_of(verb + " --format json" + what).at("law") == law);
    }
    const json checks = json_of("check --format json" + start).at("checks");
    const auto of_law = [law = std::string(law)](const json& row) { return row.at("law") == law; };
    CHECK(std::ranges::any_of(checks, of_law));
    if (std::string(law) != "exact") {
      CHECK(std::ranges::all_of(checks, of_law));
    }
    const double tau = json_of("stop --format json" + start).at("tau_stop").get<double>();
    const auto batch = rows_of(run_program(fmt::format("stop --batch - {}", body), "mu,u0,v0\n1,1,1\n").out);
    CHECK(std::stod(batch[1][3]) == Approx(tau).epsilon(1e-14));
  }
}

TEST_CASE("stop of a ball has seconds and the final motion", "[cli]") {
  const json stop = json_of("stop --ball pool --format json");
  CHECK(stop.size() == 20);
  CHECK(stop.at("t_stop").get<double>() == Approx(10.1).margin(0.05));
  CHECK(stop.at("final").at("velocity").size() == 2);
  CHECK(stop.at("final").at("velocity").at(0).get<double>() == Approx(5.0 / 7).epsilon(1e-15));
  CHECK(stop.at("final").at("velocity").at(1) == 0);
  CHECK(stop.at("final").at("angular_velocity").size() == 3);
  CHECK(stop.at("final").at("angular_velocity").at(1).get<double>() == Approx(5.0 / (7 * 0.028575)).epsilon(1e-15));
}

TEST_CASE("routes and laws of stop agree with the library", "[route]") {
  for (const std::string route : {"quadrature", "regularised", "direct"}) {
    const json stop = json_of("stop --mu 0.3 --u0 1 --v0 1 --law exact --format json --route " + route);
    INFO(route);
    CHECK(stop.at("route") == route);
    CHECK(stop.at("law") == "exact");
    CHECK(stop.at("tau_stop").get<double>() == Approx(Flow({HertzLaw{}, 0.3}).stop_time({1, 1}).tau).epsilon(1e-10));
  }
}

TEST_CASE("negative numbers are values, not options", "[cli]") {
  const json positive = json_of("stop --mu 0.1 --u0 5 --v0 1 --format json");
  for (const std::string u0 : {"--u0 -5", "--u0=-5", "--u0 -5e0"}) {
    const json stop = json_of("stop --mu 0.1 --v0 1 --format json " + u0);
    CHECK(stop.at("u0") == -5);
    CHECK(stop.at("tau_stop") == positive.at("tau_stop"));
  }
  CHECK(json_of("stop --ball pool --spin -100 --format json").at("t_stop") ==
        json_of("stop --ball pool --spin +100 --format json").at("t_stop"));
}

// What `stop --ball pool` prints is on README's console.
TEST_CASE("stop for people", "[cli]") {
  CHECK_THAT(run_program("stop --ball pool --law pade").out,
             Contains("law exact") && Contains("% shorter") && Contains("the paper's approximation"));
  CHECK_THAT(run_program("stop --ball pool --digits 3").out, Contains("93.4 ") && !Contains("93.39"));
  CHECK_THAT(run_program("stop --mu 0.1 --u0 1 --v0 1").out, Contains("unit of u0 and v0") && !Contains("(s)"));
}

TEST_CASE("each law of the paper has the other beside it, in every format", "[cli]") {
  const std::string start = "stop --mu 0.1 --u0 2 --v0 1 --law ";
  for (const auto& [law, other] : {std::pair{"pade", "exact"}, {"exact", "pade"}}) {
    const double tau = json_of(start + other + " --format json").at("tau_stop").get<double>();
    CHECK(json_of(start + law + " --format json").at("other_law") == json{{"law", other}, {"tau_stop", tau}});
    const auto rows = rows_of(run_program(start + law + " --format csv").out);
    const std::vector<std::string> names(rows[0].end() - 2, rows[0].end());
    CHECK(names == std::vector<std::string>{"other_law", "other_tau"});
    CHECK(*(rows[1].end() - 2) == other);
    CHECK(std::stod(rows[1].back()) == tau);
    CHECK_THAT(run_program(start + law).out, Contains(std::string("law ") + other));
  }
  // Of another pressure they say nothing, nor of rest or where one speed is alone: no limit is then worth a line.
  for (const std::string axis : {"stop --ball pool --spin 0", "stop --ball pool --slip 0"}) {
    CHECK_FALSE(json_of(axis + " --format json").contains("other_law"));
    CHECK_THAT(run_program(axis).out, !Contains("law pade") && !Contains("only") && !Contains("at most"));
  }
  CHECK_FALSE(json_of(start + "uniform --format json").contains("other_law"));
  CHECK_THAT(run_program(start + "uniform").out, !Contains("law pade") && !Contains("law exact"));
  CHECK_FALSE(json_of("stop --mu 0.1 --u0 0 --v0 0 --format json").contains("other_law"));
}

TEST_CASE("a ball at rest has stopped", "[limit]") {
  const Run run = run_program("stop --mu 0.1 --u0 0 --v0 0");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("rolls already") && !Contains("nan"));
  CHECK(json_of("stop --mu 0.1 --u0 0 --v0 0 --format json").at("tau_stop") == 0);
  const json ball = json_of("stop --ball pool --spin 0 --slip 0 --format json");
  CHECK(ball.at("t_stop") == 0);
  CHECK(ball.at("bounds").at(1) == 0);
}

TEST_CASE("a stop time that overflows is said to be infinite", "[limit]") {
  const json stop = json_of("stop --mu 1e-100 --u0 1e300 --v0 1 --format json");
  CHECK(stop.at("tau_stop") == "inf");
  CHECK(stop.at("limits").at("pivoting_only") == "inf");
  CHECK_THAT(run_program("stop --mu 1e-100 --u0 1e300 --v0 1").out, Contains("inf") && !Contains("nan"));
}

TEST_CASE("overrides act as if the run file had said so", "[cli]") {
  // The patch of the pool ball follows from its spin deceleration: eps ~ R^2/(f g).
  CHECK(json_of("stop --ball pool --radius 0.05715 --format json").at("mu").get<double>() ==
        Approx(2 * json_of("stop --ball pool --format json").at("mu").get<double>()).epsilon(1e-14));
  // That of the steel ball from Hertz's formula: eps ~ m^(1/3).
  CHECK(json_of("stop --ball steel --mass 0.2616 --format json").at("mu").get<double>() ==
        Approx(2 * json_of("stop --ball steel --format json").at("mu").get<double>()).epsilon(1e-14));
  CHECK(json_of("stop --ball steel --patch-radius 1e-3 --format json").at("mu").get<double>() == 0.1);
  const json slow = json_of("stop --ball steel --slip 0 --spin-deceleration 4 --spin 2 --format json");
  CHECK(slow.at("t_stop").get<double>() == Approx(0.5).epsilon(1e-14));
  // A deceleration that was measured is the ball's, whatever the law.
  for (const std::string law : {"exact", "pade", "uniform", "punch", "ring", "pressure:3"}) {
    for (const std::string verb : {"stop", "roll --samples 2"}) {
      const json pure = json_of(verb + " --ball pool --slip 0 --format json --law " + law);
      CHECK(pure.at("t_stop").get<double>() == Approx(10).epsilon(1e-14));
    }
  }
}

TEST_CASE("a known accuracy is in every format", "[cli]") {
  for (const Law& law : {Law(PadeLaw{}), Law(PressureLaw::uniform())}) {
    const double accuracy = Flow({law, 0.1}).stop_time({2, 1}).accuracy;
    const std::string start = fmt::format("stop --mu 0.1 --u0 2 --v0 1 --law {}", law.name());
    CHECK(json_of(start + " --format json").at("accuracy") == accuracy);
    const auto rows = rows_of(run_program(start + " --format csv").out);
    const auto column = std::ranges::find(rows[0], "accuracy") - rows[0].begin();
    REQUIRE(column < std::ssize(rows[1]));
    CHECK(std::stod(rows[1][static_cast<std::size_t>(column)]) == accuracy);
    CHECK_THAT(run_program(start).out, Contains("numerical error below"));
  }
}

TEST_CASE("stop --gradient: derivatives of the stop time, in every format", "[cli]") {
  const std::string question = "stop --law pade --mu 0.3 --u0 1 --v0 1 --gradient";
  const json gradient = json_of(question + " --format json").at("gradient");
  CHECK(gradient.at("u").get<double>() == Approx(10.9679009161).epsilon(1e-11));
  CHECK(gradient.at("v").get<double>() == Approx(1.52868423111).epsilon(1e-11));
  CHECK(gradient.size() == 6);
  CHECK_THAT(run_program(question).out, Contains("derivative by") && Contains("1 % more of it: 0.88 % longer"));
  CHECK_THAT(run_program(question + " --format csv").out, Contains(",by_u,by_v,by_mu,by_chi,by_gamma,by_drive\n"));
  // By the stepper, too; at rest there is none.
  CHECK(json_of(question + " --route direct --format json").at("gradient") == gradient);
  CHECK_FALSE(json_of("stop --mu 0.3 --u0 0 --v0 0 --gradient --format json").contains("gradient"));
}

TEST_CASE("stop --estimate: the estimates for small mu and what they miss by", "[cli]") {
  const json stop = json_of("stop --law pade --mu 0.1 --u0 1 --v0 1 --estimate --format json");
  const auto& estimates = stop.at("estimates");
  REQUIRE(estimates.size() == 2);
  CHECK(estimates.at(0).at("name") == "E1");
  CHECK(estimates.at(0).at("error").get<double>() == Approx(4.6e-4).epsilon(0.02));
  CHECK(estimates.at(1).at("name") == "E2");
  CHECK(std::abs(estimates.at(1).at("error").get<double>()) == Approx(2.465e-7).epsilon(0.02));
  for (const auto& estimate : estimates) {
    CHECK(estimate.at("tau_stop").get<double>() - stop.at("tau_stop").get<double>() == estimate.at("error"));
  }
  CHECK_FALSE(json_of("stop --mu 0.1 --u0 1 --v0 1 --format json").contains("estimates"));

  // A patch under Coulomb friction has the logarithm, beyond k0 = 1.
  CHECK(json_of("stop --mu 0.01 --u0 1 --v0 1 --law exact --estimate --format json").at("estimates").size() == 3);
  CHECK(json_of("stop --mu 0.01 --u0 1 --v0 1e-3 --law exact --estimate --format json").at("estimates").size() == 2);

  const auto rows = rows_of(run_program("stop --law pade --mu 0.1 --u0 1 --v0 1 --estimate --format csv").out);
  const std::vector<std::string> last(rows[0].end() - 4, rows[0].end());
  CHECK(last == std::vector<std::string>{"tau_E1", "error_E1", "tau_E2", "error_E2"});
  REQUIRE(rows[1].size() == rows[0].size());
  CHECK(std::stod(*(rows[1].end() - 2)) == estimates.at(1).at("tau_stop"));

  CHECK_THAT(run_program("stop --ball pool --estimate").out, Contains("for small mu") && !Contains("not small"));
  CHECK_THAT(run_program("stop --mu 1 --u0 1 --v0 1 --estimate").out, Contains("not small"));
  CHECK_THAT(run_program("stop --mu 1e-100 --u0 1e300 --v0 1 --estimate --format json").out, !Contains("nan"));
  CHECK(run_program("stop --batch - --estimate", "mu,u0,v0\n0.1,1,1\n").status == 2);
}

TEST_CASE("a patch that follows from a spin deceleration says so, and when it changes", "[cli]") {
  CHECK_THAT(run_program("stop --ball pool").out,
             Contains("patch radius 0.00282703 m, from its spin deceleration 10 rad/s^2: mu = 0.0989337\n"));
  CHECK_THAT(run_program("stop --ball steel").out, Contains("m, by Hertz's formula: mu"));
  CHECK_THAT(run_program("roll --ball pool --patch-radius 0.002 --format text").out,
             Contains("patch radius 0.002 m, given: mu = 0.0699913\n"));
  for (const auto& [changed, patch] : {std::pair{"--gravity 1.62", "0.0171134"},
                                       {"--friction 0.1", "0.00565406"},
                                       {"--radius 0.03", "0.003116"},
                                       {"--law uniform", "0.00249789"}}) {
    for (const std::string verb : {"stop", "orbit", "roll", "portrait -o - --format csv"}) {
      const Run run = run_program(fmt::format("{} --ball pool {}", verb, changed));
      INFO(verb << changed);
      CHECK(run.status == 0);
      CHECK_THAT(run.err, Contains(fmt::format("goes from 0.00282703 m to {}", patch)) &&
                              Contains("--patch-radius 0.00282703 keeps"));
      CHECK(json_of(fmt::format("stop --format json --ball pool {} --patch-radius 0.00282703", changed))
                .at("ball")
                .at("patch_radius") == 0.00282703);
    }
  }
  for (const std::string silent :
       {"--mass 1", "--law pade", "--gravity 1.62 --spin-deceleration 10", "--gravity 1.62 --patch-radius 0.003"}) {
    CHECK(run_program("stop --ball pool " + silent).err.empty());
  }
  CHECK(run_program("stop --ball steel --gravity 1.62").err.empty());
  // A file that leaves a value to the command line has no patch of its own.
  const TemporaryDirectory scratch;
  write_file(scratch.file("b.toml"),
             "[ball]\nmass=1\nradius=0.1\n[contact]\nspin_deceleration=10\n[start]\nslip=1\nspin=1\n");
  const Run run = run_program("stop --ball " + scratch.file("b.toml") + " --friction 0.9");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
}

TEST_CASE("data of a ball say which ball it is", "[cli]") {
  for (const std::string verb : {"stop", "orbit", "roll"}) {
    const json answer = json_of(verb + " --ball pool --format json");
    CAPTURE(verb);
    CHECK_THAT(answer.at("version").get<std::string>(), Catch::Matchers::StartsWith("0."));
    const json& ball = answer.at("ball");
    CHECK(ball.at("name") == "pool ball on cloth");
    CHECK(ball.at("radius") == 0.028575);
    CHECK(ball.at("mass") == 0.1701);
    CHECK(ball.at("friction") == 0.2);
    CHECK(ball.at("gravity") == 9.80665);
    CHECK(ball.at("spin_deceleration") == 10);
    CHECK(ball.at("patch_radius").get<double>() == Approx(0.00282703).epsilon(1e-6));
  }
  const json stop = json_of("stop --ball pool --slip 2 --spin 50 --format json");
  CHECK(stop.at("slip") == 2);
  CHECK(stop.at("spin") == 50);
  CHECK(json_of("stop --ball steel --format json").at("ball").at("youngs_modulus") == json{2.1e11, 7e10});
  CHECK_THAT(run_program("roll --ball pool --samples 2").out,
             Contains("\n# ball: {\"name\": \"pool ball on cloth\", \"body\": \"ball\", \"radius\": 0.028575") &&
                 Contains("\n# version: \"0."));
}

TEST_CASE("what interpolation of a pressure table may cost stands beside its stop time", "[cli]") {
  const TemporaryDirectory scratch;
  std::string rows = "rho,pressure\n";
  for (int i = 0; i <= 40; ++i) rows += fmt::format("{},{}\n", i / 40.0, std::sqrt(1 - i / 40.0 * (i / 40.0)));
  write_file(scratch.file("hertz.csv"), rows);
  const std::string start = "stop --mu 0.1 --u0 3 --v0 1 --law ";
  const json table = json_of(start + scratch.file("hertz.csv") + " --format json");
  const double tau = table.at("tau_stop").get<double>();
  const double said = std::abs(table.at("coarser_table").at("tau_stop").get<double>() - tau);
  CHECK(table.at("coarser_table").at("rows") == 21);
  // The curve that the rows sample is the exact law's pressure.
  const double missed = std::abs(json_of(start + "exact --format json").at("tau_stop").get<double>() - tau);
  CHECK(missed > 1e-4 * tau);
  CHECK(missed < said);
  CHECK(said < 5 * missed);
  CHECK_THAT(run_program(start + scratch.file("hertz.csv")).out,
             Contains("with 21 rows") && Contains("what interpolation between all 41 may cost"));
  // Rows of steps are needed, and named laws have none.
  CHECK_FALSE(json_of(start + "annulus:0.5 --format json").contains("coarser_table"));
  CHECK_FALSE(json_of(start + "exact --format json").contains("coarser_table"));
  CHECK_THAT(run_program("help laws").out, Contains("linear in rho^2 between two rows"));
}

TEST_CASE("T_stop is a number wherever it fits", "[cli]") {
  const json fast = json_of("stop --ball pool --spin 1e308 --format json");
  CHECK(fast.at("T_stop").get<double>() == Approx(fast.at("tau_stop").get<double>() / 4.71238898038469).epsilon(1e-15));
}

// r/r_high - 1 = 8.5e-14 counts as 0, which costs a fraction of that: the accuracy was stated as 2.4e-15.
TEST_CASE("the accuracy next to a border counts what was taken for the border", "[cli]") {
  const json stop = json_of(
      "stop --mu 1 --law elliptic:0.05 --body 3.5,1400.0000000001196 --u0 1.5283057164038434 --v0 0.1665941353948894 "
      "--format json");
  // By mpmath, from the elementary integrals of this law.
  const double error = std::abs(stop.at("tau_stop").get<double>() / 0.24677254949119878413 - 1);
  CHECK(error > 1e-14);
  CHECK(error < stop.at("accuracy").get<double>());
  CHECK(stop.at("accuracy").get<double>() < 1e-13);
}

TEST_CASE("the text of stop opens with one sentence of plain words", "[cli]") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"--ball pool --slip 1 --spin 100",
       "Slip and spin end after 10 s; the uncoupled model says the same to two digits.\n"},
      {"--ball pool --slip 1 --spin 0",
       "Its slip ends after 0.15 s; the uncoupled model says the same to two digits.\n"},
      {"--ball pool --slip 0 --spin 100",
       "Its spin ends after 10 s; the uncoupled model says the same to two digits.\n"},
      {"--ball pool --slip 0 --spin 0", "It neither slides nor spins: its stop time is 0.\n"},
      {"--ball puck --slip 0.5 --spin 60", "It rests after "},
      {"--ball pool --slip 1 --spin 100 --rolling-friction 0.01", ", and its centre rests after "},
      {"--mu 0.1 --u0 1 --v0 1", "Slip and spin end after tau = "},
      {"--mu 0.1 --u0 1 --v0 1 --drive 0.05", "Slip and spin end after tau = "},
  };
  for (const auto& [arguments, opening] : cases) {
    const Run run = run_program("stop " + arguments);
    INFO(arguments << "\n" << run.out << run.err);
    CHECK(run.status == 0);
    CHECK_THAT(run.out.substr(0, run.out.find('\n') + 1), Contains(opening));
  }
}
