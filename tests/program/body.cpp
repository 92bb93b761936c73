// --body: bodies that are not the ball, and mu beyond 1.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("a puck's mu is its own", "[cli]") {
  const json puck = json_of("stop --law uniform --body disc --u0 1 --v0 1 --format json");
  CHECK(puck.at("mu") == 1);
  CHECK(puck.at("body") == json{{"chi", 1}, {"gamma", 2}});
  const json same = json_of("stop --law uniform --body 1,2 --mu 1 --u0 1 --v0 1 --format json");
  CHECK(puck == same);
}

TEST_CASE("every verb with a start takes a body", "[cli]") {
  const std::string start = " --body disc --law exact --u0 1 --v0 0.2";
  CHECK_THAT(run_program("stop" + start).out,
             Contains("body with chi = 1, gamma = 2: r = gamma mu^2/chi = 2") && Contains("lies still"));
  CHECK_THAT(run_program("stop --body hollow-ball --mu 0.1 --u0 1 --v0 1").out, Contains("-v0/chi = -0.4"));
  CHECK(run_program("check --body 1,2.6 --mu 1 --law exact --u0 1 --v0 0.2").status == 0);
  CHECK(json_of("portrait --body disc --law uniform -o - --format json").at("mu") == 1);
  const auto batch = run_program("stop --batch - --body 1,1 --law uniform", "mu,u0,v0\n1,1,3\n3,1,1\n");
  const auto rows = rows_of(batch.out);
  REQUIRE(rows.size() == 3);
  CHECK(std::stod(rows[1][3]) / 4.71238898038469 == Approx(3.739430054903977642774).epsilon(1e-14));
  const json single = json_of("stop --body 1,1 --law uniform --mu 3 --u0 1 --v0 1 --format json");
  CHECK(std::stod(rows[2][3]) == single.at("tau_stop").get<double>());
}

TEST_CASE("a puck in seconds", "[cli]") {
  const std::string start = " --ball puck --friction 0.2 --radius 0.04 --slip 2 --spin 30";
  const json stop = json_of("stop --format json" + start);
  CHECK(stop.at("law") == "uniform");
  CHECK(stop.at("mu") == 1);
  CHECK(stop.at("body") == json{{"chi", 1}, {"gamma", 2}});
  CHECK(stop.at("ball").at("body") == "disc");
  CHECK(stop.at("ball").at("patch_radius") == 0.04);
  CHECK(stop.at("final").at("velocity") == json{0, 0});
  // The same in the paper's variables: t = 2 tau/(3 pi f g).
  const json reduced = json_of("stop --format json --body disc --u0 1.2 --v0 2");
  const double tau = reduced.at("tau_stop").get<double>();
  const double t = 2 * tau / (3 * 3.14159265358979324) / 0.2 / 9.80665;
  CHECK(stop.at("t_stop").get<double>() == Approx(t).epsilon(1e-14));
  CHECK_THAT(run_program("stop" + start).out, Contains("ice hockey puck: disc, radius 0.04 m") &&
                                                  Contains("patch radius 0.04 m, its whole face: mu = 1") &&
                                                  Contains("then   it lies still, 1.11578 m from its start") &&
                                                  Contains("law    uniform"));
  const auto batch =
      rows_of(run_program("stop --ball puck --friction 0.2 --radius 0.04 --batch -", "slip,spin\n2,30\n").out);
  CHECK(std::stod(batch[1][2]) == Approx(t).epsilon(1e-14));
  const auto swept = rows_of(run_program("sweep --ball puck --friction 0.2 --radius 0.04 --slip 2 --spin 30").out);
  CHECK(std::stod(swept[1][2]) == Approx(t).epsilon(1e-14));
  CHECK(std::stod(rows_of(run_program("orbit --samples 3" + start).out).back().back()) == Approx(t).epsilon(1e-14));
  CHECK(json_of("portrait -o - --format json" + start).at("body") == stop.at("body"));
  CHECK(run_program("check" + start).status == 0);
  CHECK_THAT(run_program("portrait --ball puck -o - --format tex").out, !Contains("this ball"));
  CHECK(json_of("stop --format json --ball curling-stone").at("law") == "ring");
  CHECK(json_of("stop --format json --ball curling-stone --law exact").at("law") == "exact");
  // Slip, spin and rest end at once; the equations of motion by steps agree.
  const json roll = json_of("roll --format json --route integrated --samples 9" + start);
  CHECK(roll.at("t_stop") == stop.at("t_stop"));
  CHECK(roll.at("integrated").at("t_stop").get<double>() == Approx(t).epsilon(1e-11));
  CHECK_FALSE(roll.contains("rolls_after"));
  CHECK(roll.at("rest").at("t").get<double>() == Approx(t).epsilon(1e-14));
  CHECK(roll.at("rest").at("x").get<double>() == Approx(1.11578).epsilon(1e-5));
  for (const char* name : {"slip_length", "path"})
    CHECK(roll.at(name).get<double>() == Approx(roll.at("rest").at("x").get<double>()).epsilon(1e-9));
  CHECK(roll.at("textbook").at("rest").at("t").get<double>() == Approx(2 / (0.2 * 9.80665)).epsilon(1e-12));
  const json reduced_roll = json_of("roll --format json --samples 9" + start);
  for (const char* column : {"x", "vx", "wz"}) {
    for (std::size_t i = 0; i < 9; ++i) {
      INFO(column << " " << i);
      CHECK(roll.at(column)[i].get<double>() ==
            Approx(reduced_roll.at(column)[i].get<double>()).epsilon(1e-10).margin(1e-10));
    }
  }
  CHECK_THAT(run_program("roll --format text" + start).out,
             Contains("its centre rests after") && Contains("then   it lies still") && !Contains("roll"));
  const auto rolled =
      rows_of(run_program("roll --ball puck --friction 0.2 --radius 0.04 --batch -", "slip,spin\n2,30\n").out);
  CHECK(rolled[0][2] == "t_rest");
  CHECK(std::stod(rolled[1][2]) == Approx(t).epsilon(1e-14));
  // A file is read once, so that it may be a pipe.
  const TemporaryDirectory scratch;
  CHECK(run_program("balls puck -o " + scratch.file("puck.toml")).status == 0);
  CHECK(run_program("stop --ball /dev/stdin", read_file(scratch.file("puck.toml"))).out ==
        run_program("stop --ball puck").out);
}
