#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

const std::string pool = "bounce --ball pool --patch-radius 2.83mm --speed 1 ";

}  // namespace

TEST_CASE("bounce is roll with the impulse as time", "[cli][bounce]") {
  for (const std::string spin : {"0", "100", "400"}) {
    INFO(spin);
    const auto json = json_of(pool + "--normal-speed 1 --restitution 0.5 --format json --spin " + spin);
    const auto rows =
        rows_of(run_program("roll --ball pool --patch-radius 2.83mm --gravity 1 --slip 1 --at 1.5 --spin " + spin).out);
    const auto& after = json.at("after");
    for (std::size_t i = 3; i < 9; ++i)
      CHECK(after.at(rows[0][i]).get<double>() == Approx(std::stod(rows[1][i])).epsilon(1e-13).margin(1e-13));
    CHECK(after.at("vz") == 0.5);
    CHECK(json.at("start").at("vz") == -1);
    CHECK(json.at("textbook").at("change_vx").get<double>() == Approx(-2.0 / 7).epsilon(1e-13));
    CHECK(json.at("start").at("angle").get<double>() == Approx(45).epsilon(1e-14));
    CHECK((after.at("grip").get<double>() <= 1) == (spin == "0"));
  }
  const std::string text = run_program(pool + "--normal-speed 1 --restitution 0.5 --spin 400").out;
  CHECK_THAT(text, Contains("it slips through the whole impact, where the textbook's grips"));
  CHECK_THAT(text, Contains("(0.819518, 0)"));
  const auto csv = rows_of(run_program(pool + "--normal-speed 1 --restitution 0.5 --spin 400 --format csv").out);
  REQUIRE(csv.size() == 2);
  CHECK(csv[0].size() == csv[1].size());
}

TEST_CASE("a ball that is dropped comes down at sqrt(2 g h), on the patch of the impact", "[cli][bounce]") {
  const auto json = json_of("bounce --ball steel --speed 1 --drop 50cm --restitution 0.9 --format json");
  CHECK(json.at("normal_speed").get<double>() == Approx(std::sqrt(9.80665)).epsilon(1e-14));
  CHECK(json.at("height") == 0.5);
  const double rest = json_of("stop --ball steel --format json").at("ball").at("patch_radius").get<double>();
  CHECK(json.at("ball").at("patch_radius").get<double>() > 5 * rest);
  CHECK(run_program("bounce --ball steel --drop 0.5 --restitution 0.9").err.empty());
  CHECK_THAT(run_program("bounce --ball pool --drop 0.5 --restitution 0.9").err, Contains("the patch stays at"));
}

TEST_CASE("columns of a bounce stand apart, and its angle is right at any speed", "[cli][bounce]") {
  CHECK_THAT(run_program("bounce --ball pool --speed 1 --angular-velocity=-12.3456,23.4567,-345.678 --normal-speed 1 "
                         "--restitution 0.5")
                 .out,
             Contains("-345.678)  (") && !Contains(")("));
  for (const std::string speed : {"1e-200", "1e200"}) {
    const auto start = json_of("bounce --ball pool --format json --spin 0 --restitution 1 --speed " + speed +
                               " --normal-speed " + speed)
                           .at("start");
    CHECK(start.at("angle").get<double>() == Approx(45).epsilon(1e-12));
  }
}

TEST_CASE("a hollow ball has the inertia 2/3, as a fraction or rounded", "[cli][bounce]") {
  const auto after = [](const std::string& inertia) {
    return json_of("bounce --ball basketball --speed 1 --normal-speed 2 --restitution 0.8 --format json --inertia " +
                   inertia)
        .at("after");
  };
  for (const std::string inertia : {"0.667", "0.6667", "0.6666666667", "4/6"}) CHECK(after(inertia) == after("2/3"));
  check_rejected("bounce --ball basketball --speed 1 --normal-speed 2 --restitution 0.8 --inertia 2/0", "not a finite");
  check_rejected("bounce --ball basketball --speed 1 --normal-speed 2 --restitution 0.8 --inertia 2/x", "'x' is not a");
  check_rejected("bounce --ball basketball --speed 1 --normal-speed 2 --restitution 0.8 --inertia 0.67", "at most 2/3");
}

TEST_CASE("stop and orbit follow a load that changes, as roll does", "[cli][load]") {
  const TemporaryDirectory folder;
  const std::string table = folder.file("lift.csv");
  write_file(table, "t,load\n0,2\n1,4\n1,1\n1.2,1\n");
  for (const std::string body : {"puck --slip 1 --spin 60", "pool --patch-radius 3mm --slip 1 --spin 60"}) {
    INFO(body);
    const std::string ball = " --load " + table + " --ball " + body;
    const auto stop = json_of("stop --format json" + ball), roll = json_of("roll --format json --samples 5" + ball);
    const double t = roll.at("t_stop").get<double>();
    CHECK(stop.at("t_stop").get<double>() == Approx(t).epsilon(1e-12));
    CHECK(stop.at("slip_length").get<double>() == Approx(roll.at("slip_length").get<double>()).epsilon(1e-10));
    CHECK(stop.at("load") == roll.at("load"));
    CHECK_THAT(run_program("stop" + ball).out, Contains("the load changes until 1.2 s; tau is that of 2 N"));
    const auto orbit_rows = rows_of(run_program("orbit --samples 3" + ball).out);
    const auto at = rows_of(run_program("roll --at " + orbit_rows[2][6] + ball).out);
    CHECK(std::stod(at[1][8]) == Approx(std::stod(orbit_rows[2][2])).epsilon(1e-9).margin(1e-12));
    CHECK(std::stod(orbit_rows[3][6]) == Approx(t).epsilon(1e-12));
  }
  // An error names the row in which it stands, also below comments and empty lines.
  const std::vector<std::pair<std::string, std::string>> wrong_rows{{"2,-0.8", "a load must be 0 or more"},
                                                                    {"0.5,0.8", "t must begin with 0 and not decrease"},
                                                                    {"1e400,1", "t: "},
                                                                    {"2,inf", "load: "}};
  for (const auto& [wrong, words] : wrong_rows) {
    for (const int row : {0, 1, 40}) {
      std::string text = "# a load cell\n\nt,load\n0,1.6\n1,0.8\n";
      for (int i = 0; i < row; ++i) text += fmt::format("{},1\n{}", 1 + i * 1e-3, i % 7 == 3 ? "# a comment\n" : "");
      const auto line = std::ranges::count(text, '\n') + 1;
      write_file(table, text + wrong + "\n3,1\n4,1\n");
      check_rejected("roll --ball puck --load " + table, fmt::format("lift.csv:{}: {}", line, words));
    }
  }
  write_file(table, "t,load\n2,1\n3,1\n");
  check_rejected("roll --ball puck --load " + table, "lift.csv:2: t must begin with 0");
  write_file(table, "t,load\n0,2\n1,4\n1,1\n1.2,1\n");
  check_rejected("stop --ball steel --load " + table, "grows with the load");
  check_rejected("orbit --ball puck --slope -2 --load " + table, "a load and a slope exclude each other");
  check_rejected("orbit --ball pool --rolling-friction 0.01 --load " + table, "leave out the rolling friction");
  check_rejected("stop --batch - --ball puck --load " + table, "--batch needs a constant load", "slip,spin\n1,2\n");
  check_rejected("engine --ball puck --load " + table, "only roll, stop and orbit take a load that changes");
  write_file(table, "t,load\n0,2\n0.1,0\n");
  check_rejected("stop --ball puck --load " + table, "the load ends at 0 before the motion does");
}
