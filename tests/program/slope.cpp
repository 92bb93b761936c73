#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

double number(const nlohmann::json& of, const char* name) { return of.at(name).get<double>(); }

/// Returns the number in a row and a column of a CSV.
double cell(const std::vector<std::vector<std::string>>& rows, std::size_t row, std::size_t column) {
  return std::stod(rows.at(row).at(column));
}

}  // namespace

TEST_CASE("stop, orbit, roll, sweep and batches agree on a slope and with rolling friction", "[cli][slope]") {
  for (const std::string driven :
       {"--slope -2", "--rolling-friction 0.01", "--slope -0.3deg --rolling-friction 0.01"}) {
    INFO(driven);
    const std::string ball = " --ball pool --slip 1 --spin 100 " + driven;
    const auto stop = json_of("stop --format json" + ball), roll = json_of("roll --format json --samples 5" + ball);
    const double t = number(stop, "t_stop");
    CHECK(number(roll, "t_stop") == Approx(t).epsilon(1e-13));
    CHECK(roll.at("route") == "reduced");
    CHECK(number(stop, "slip_length") == Approx(number(roll, "slip_length")).epsilon(1e-12));
    CHECK(stop.contains("rest") == roll.contains("rest"));
    const auto batch = rows_of(run_program("stop --batch - --ball pool " + driven, "slip,spin\n1,100\n").out);
    CHECK(cell(batch, 1, 2) == Approx(t).epsilon(1e-13));
    const auto sweep = rows_of(run_program("sweep --slip 1 --spin 0:100:2 --ball pool " + driven).out);
    CHECK(cell(sweep, 2, 2) == Approx(t).epsilon(1e-13));
    const auto orbit = rows_of(run_program("orbit --samples 11" + ball).out);
    const auto at = rows_of(run_program("roll --at " + std::to_string(0.3 * t) + ball).out);
    CHECK(cell(orbit, 11, 6) == Approx(t).epsilon(1e-13));
    CHECK(cell(orbit, 11, 2) == 0);
    CHECK(cell(orbit, 4, 2) == Approx(cell(at, 1, 8)).epsilon(1e-5));
    for (std::size_t i = 2; i <= 11; ++i) CHECK(cell(orbit, i, 5) > cell(orbit, i - 1, 5));  // beta grows
    const auto left =
        rows_of(run_program("orbit --time-left " + std::to_string(0.7 * number(stop, "tau_stop")) + ball).out);
    CHECK(cell(left, 1, 2) == Approx(cell(orbit, 4, 2)).epsilon(1e-4));
    CHECK(run_program("check" + ball).status == 0);
    const auto portrait = json_of("portrait -o - --format json" + ball);
    CHECK(portrait.at("drive") == stop.at("drive"));
    CHECK(number(portrait, "seconds_per_tau") * portrait.at("highlight").at("tau_left")[0].get<double>() ==
          Approx(t).epsilon(1e-12));
    const Run text = run_program("roll --format text" + ball);
    CHECK_THAT(text.out, Contains("route  reduced") && Contains("with a drive of"));
  }
  // The drive of a homogeneous ball: 2 tan(angle)/(7 f).
  CHECK(number(json_of("stop --ball pool --slope -2 --format json"), "drive") ==
        Approx(2 * std::tan(2 * M_PI / 180) /
               (7 * number(json_of("stop --ball pool --format json").at("ball"), "friction")))
            .epsilon(1e-15));
}

TEST_CASE("in pieces: a ball that rolling friction ceases to let turn", "[cli][slope]") {
  const std::string ball = " --ball pool --slip 1 --spin 100 --rolling-friction 0.01";
  const auto stop = json_of("stop --format json" + ball);
  REQUIRE(stop.at("pieces").size() == 2);
  CHECK(stop.at("pieces")[0].at("turns") == true);
  CHECK(stop.at("pieces")[1].at("turns") == false);
  CHECK_FALSE(stop.contains("bounds"));
  CHECK(number(stop.at("rest"), "t") == Approx(7.38007).epsilon(1e-6));
  CHECK_THAT(run_program("stop" + ball).out, Contains("rolling resistance keeps it from turning"));
  check_rejected("stop --route regularised" + ball, "which quadrature alone joins");
  check_rejected("orbit --estimate" + ball, "--estimate needs one orbit");
  check_rejected("orbit --reduction" + ball, "--reduction needs one orbit");
  check_rejected("reduce" + ball, "lets this ball turn for a part of its motion only");
  check_rejected("sweep --slip 0:1:3 --spin 0:9:3 -o a.svg --ball pool --rolling-friction 0.01", "write npy or csv");
}

TEST_CASE("uphill the slip turns round: roll integrates, and others say so", "[cli][slope]") {
  const auto roll = json_of("roll --ball pool --slip 1 --spin 100 --slope 3 --format json --samples 5");
  CHECK(roll.at("route") == "integrated");
  CHECK_FALSE(roll.contains("rest"));
  CHECK(roll.at("energy_balance").contains("gained_on_slope"));
  CHECK_THAT(run_program("roll --ball pool --slip 1 --spin 100 --slope 3 --format text").out,
             Contains("slope  3 degrees, uphill along x") && Contains("rolls down the slope for ever") &&
                 Contains("route  integrated"));
  for (const std::string verb : {"stop", "orbit", "check", "portrait -o - --format json", "reduce", "stop --batch -",
                                 "sweep --slip 0:1:2 --spin 0:9:2"}) {
    const bool many = verb.find("batch") != std::string::npos || verb.find("sweep") != std::string::npos;
    check_rejected(verb + " --ball pool --slope 3" + (many ? "" : " --slip 1 --spin 100"), "must slide straight down",
                   "slip,spin\n1,100\n");
  }
  const auto rows = rows_of(run_program("roll --batch - --ball pool --slope 3", "slip,spin\n1,100\n").out);
  CHECK(rows[0].back() == "path");  // without columns of rest, as the ball never rests
  CHECK(std::stod(rows[1].at(2)) == Approx(number(roll.at("rolls_after"), "t")).epsilon(1e-12));
}

TEST_CASE("a slope that friction does not hold: it never stops, and that is said", "[cli][slope][errors]") {
  for (const std::string verb : {"stop", "orbit", "roll", "check", "portrait -o - --format json"})
    check_rejected(verb + " --ball pool --slip 1 --spin 100 --slope -40", "never stops sliding");
  check_rejected("roll --ball pool --slope 90", "--slope 90: slope must be above -90 and below 90, in deg");
  check_rejected("roll --ball pool --slope 2m", "which is none of deg or rad");
  check_rejected("stop --ball pool --slope -2 --load 3", "a load and a slope exclude each other");
  CHECK(run_program("stop --ball pool --slope -0.03rad").status == 0);
}

TEST_CASE("a puck on a slope", "[cli][slope]") {
  const auto roll = json_of("roll --ball puck --slip 1 --spin 30 --slope -2 --format json --samples 5");
  const auto stop = json_of("stop --ball puck --slip 1 --spin 30 --slope -2 --format json");
  CHECK(number(roll.at("rest"), "t") == Approx(number(stop, "t_stop")).epsilon(1e-12));
  CHECK(number(roll.at("rest"), "x") == Approx(number(stop, "slip_length")).epsilon(1e-10));
  CHECK(number(stop, "drive") == Approx(std::tan(2 * M_PI / 180) / number(stop.at("ball"), "friction")).epsilon(1e-15));
  check_rejected("stop --ball puck --rolling-friction 0.01", "it has no rolling friction");
}
