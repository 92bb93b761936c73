#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "run_program.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("a ball that is pressed on the plane", "[invariant]") {
  const auto stop = [](const std::string& options) { return json_of("stop --format json --ball steel " + options); };
  // A load that equals the weight changes nothing.
  CHECK(stop("--load 0.320677455").at("t_stop").get<double>() ==
        Approx(stop("").at("t_stop").get<double>()).epsilon(1e-14));  // 0.0327 kg * 9.80665 m/s^2
  // A load of 100 N on 33 g: the friction is f N in place of f m g, and eps^3 of Hertz's patch is proportional to N.
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

TEST_CASE("routes and laws of stop agree with the library", "[route]") {
  for (const std::string route : {"quadrature", "regularised", "direct"}) {
    const json stop = json_of("stop --mu 0.3 --u0 1 --v0 1 --law exact --format json --route " + route);
    INFO(route);
    CHECK(stop.at("route") == route);
    CHECK(stop.at("law") == "exact");
    CHECK(stop.at("tau_stop").get<double>() == Approx(Flow(HertzLaw{}, 0.3).stop_time({1, 1}).tau).epsilon(1e-10));
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

TEST_CASE("overrides act as if the run file had said so", "[cli]") {
  // The patch radius of the pool ball is computed from its spin deceleration: eps is proportional to R^2/(f g).
  CHECK(json_of("stop --ball pool --radius 0.05715 --format json").at("mu").get<double>() ==
        Approx(2 * json_of("stop --ball pool --format json").at("mu").get<double>()).epsilon(1e-14));
  // The patch radius of the steel ball is computed by Hertz's formula: eps is proportional to m^(1/3).
  CHECK(json_of("stop --ball steel --mass 0.2616 --format json").at("mu").get<double>() ==
        Approx(2 * json_of("stop --ball steel --format json").at("mu").get<double>()).epsilon(1e-14));
  CHECK(json_of("stop --ball steel --patch-radius 1e-3 --format json").at("mu").get<double>() == 0.1);
  const json slow = json_of("stop --ball steel --slip 0 --spin-deceleration 4 --spin 2 --format json");
  CHECK(slow.at("t_stop").get<double>() == Approx(0.5).epsilon(1e-14));
  // A measured deceleration belongs to the ball and is the same under every law.
  for (const std::string law : {"exact", "pade", "uniform", "punch", "ring", "pressure:3"}) {
    for (const std::string verb : {"stop", "roll --samples 2"}) {
      const json pure = json_of(verb + " --ball pool --slip 0 --format json --law " + law);
      CHECK(pure.at("t_stop").get<double>() == Approx(10).epsilon(1e-14));
    }
  }
}

TEST_CASE("a known accuracy is in every format", "[cli]") {
  for (const Law& law : {Law(PadeLaw{}), Law(PressureLaw::uniform())}) {
    const double accuracy = Flow(law, 0.1).stop_time({2, 1}).accuracy;
    const std::string start = fmt::format("stop --mu 0.1 --u0 2 --v0 1 --law {}", law.name());
    CHECK(json_of(start + " --format json").at("accuracy") == accuracy);
    const auto rows = rows_of(run_program(start + " --format csv").out);
    const auto column = std::ranges::find(rows[0], "accuracy") - rows[0].begin();
    REQUIRE(column < std::ssize(rows[1]));
    CHECK(std::stod(rows[1][static_cast<std::size_t>(column)]) == accuracy);
    CHECK_THAT(run_program(start).out, Contains("numerical error below"));
  }
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
  // The rows sample the pressure of the exact law.
  const double missed = std::abs(json_of(start + "exact --format json").at("tau_stop").get<double>() - tau);
  CHECK(missed > 1e-4 * tau);
  CHECK(missed < said);
  CHECK(said < 5 * missed);
  CHECK_THAT(run_program(start + scratch.file("hertz.csv")).out,
             Contains("with 21 rows") && Contains("what interpolation between all 41 may cost"));
  // Only tables of pressures have this field. Named laws have no rows.
  CHECK_FALSE(json_of(start + "annulus:0.5 --format json").contains("coarser_table"));
  CHECK_FALSE(json_of(start + "exact --format json").contains("coarser_table"));
  CHECK_THAT(run_program("help laws").out, Contains("linear in rho^2 between two rows"));
}

TEST_CASE("T_stop is a number wherever it fits", "[cli]") {
  const json fast = json_of("stop --ball pool --spin 1e308 --format json");
  CHECK(fast.at("T_stop").get<double>() == Approx(fast.at("tau_stop").get<double>() / 4.71238898038469).epsilon(1e-15));
}

// r/r_high - 1 = 8.5e-14 is taken as 0. The stated accuracy, once 2.4e-15, must contain the error that this causes.
TEST_CASE("the accuracy next to a border counts what was taken for the border", "[cli]") {
  const json stop = json_of(
      "stop --mu 1 --law elliptic:0.05 --body 3.5,1400.0000000001196 --u0 1.5283057164038434 --v0 0.1665941353948894 "
      "--format json");
  // The reference is computed by mpmath from the elementary integrals of this law.
  const double error = std::abs(stop.at("tau_stop").get<double>() / 0.24677254949119878413 - 1);
  CHECK(error > 1e-14);
  CHECK(error < stop.at("accuracy").get<double>());
  CHECK(stop.at("accuracy").get<double>() < 1e-13);
}
