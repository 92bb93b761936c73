#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "run_program.hpp"

using namespace contensou::reduction;

TEST_CASE("orbit gives 200 rows from the start to the stop", "[cli]") {
  const Run run = run_program("orbit --law pade --mu 0.3 --u0 -1 --v0 1");
  CHECK(run.status == 0);
  const auto rows = rows_of(run.out);
  REQUIRE(rows.size() == 201);
  CHECK(rows[0] == std::vector<std::string>{"tau", "u", "v", "ln_v", "k", "beta"});
  CHECK(rows[1][0] == "0");
  CHECK(rows[1][1] == "-1");
  CHECK(rows[1][5] == "0");
  CHECK(std::stod(rows[100][1]) < 0);  // u keeps the sign of its start
  const auto& last = rows.back();
  CHECK(std::stod(last[0]) == Flow(PadeLaw{}, 0.3).orbit({-1, 1}).stop_time());
  CHECK(last[1] == "0");
  CHECK(last[2] == "0");
  CHECK(last[3] == "-inf");
  CHECK(last[5] == "inf");
}

TEST_CASE("--at keeps its order, and rests past the stop", "[cli]") {
  for (const std::string route : {"closed", "quadrature", "regularised", "direct"}) {
    const auto rows =
        rows_of(run_program("orbit --law pade --mu 0.3 --u0 1 --v0 1 --at 3,0,99,1.5 --route " + route).out);
    INFO(route);
    REQUIRE(rows.size() == 5);
    const Orbit orbit = Flow(PadeLaw{}, 0.3).orbit({1, 1});
    for (std::size_t i : {1, 2, 4}) {
      const OrbitPoint point = orbit.at_time(std::stod(rows[i][0]));
      CHECK(std::stod(rows[i][1]) == Approx(point.u).epsilon(1e-9));
      CHECK(std::stod(rows[i][3]) == Approx(point.ln_v).epsilon(1e-9).margin(1e-12));
      CHECK(std::stod(rows[i][5]) == Approx(point.beta).epsilon(1e-9).margin(1e-15));
    }
    CHECK(rows[1][0] == "3");
    CHECK(rows[3] == std::vector<std::string>{"99", "0", "0", "-inf", "0", "inf"});
  }
}

TEST_CASE("half of an orbit's samples lie where it slides", "[cli]") {
  for (const std::string route : {"closed", "quadrature", "regularised"}) {
    const std::string command = "orbit --law pade --mu 0.1 --u0 1 --v0 1 --route " + route;
    const auto rows = rows_of(run_program(command).out);
    INFO(route);
    REQUIRE(rows.size() == 201);
    CHECK(std::stod(rows[101][2]) == Approx(1e-3).epsilon(1e-6));
    const double stop = std::stod(rows[200][0]);
    CHECK(stop == Approx(Flow(PadeLaw{}, 0.1).orbit({1, 1}).stop_time()).epsilon(1e-9));
    const auto even = rows_of(run_program(command + " --equidistant").out);
    CHECK(std::stod(even[100][0]) == Approx(stop * 99 / 199).epsilon(1e-9));
  }
}

TEST_CASE("the state by the time left", "[cli]") {
  const auto rows = rows_of(run_program("orbit --mu 0.3 --u0 1 --v0 1 --time-left 1e-30,0,2").out);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].back() == "tau_left");
  // Near the stop u = (5 mu/16) tau_left, accurate to the last digits.
  CHECK(std::stod(rows[1][1]) == Approx(5 * 0.3 / 16 * 1e-30).epsilon(1e-14));
  CHECK(rows[2][1] == "0");
  CHECK(rows[3].back() == "2");
  check_rejected("orbit --mu 0.3 --u0 1 --v0 1 --time-left 99", "99 is before the start, which is 11.626");
  check_rejected("orbit --mu 0.3 --u0 1 --v0 1 --time-left -1", "tau_left >= 0");
  check_rejected("orbit --mu 1e-155 --u0 1 --v0 1", "of mu = 1e-155: 1e-300 to 1e+250 is allowed");
  check_rejected("orbit --mu 0.3 --u0 1 --v0 1 --time-left 1 --samples 3", "exclude each other");
  check_rejected("orbit --mu 0.3 --u0 1 --v0 1 --time-left 1 --at 1", "exclude each other");
  check_rejected("orbit --mu 0.3 --u0 1 --v0 1 --time-left 1 --route direct", "--route closed or quadrature");
}

TEST_CASE("beside the state what it is for small mu", "[cli]") {
  const std::string command = "orbit --law pade --mu 0.1 --u0 -1 --v0 1 --estimate --at 0,0.5,1.5,20,99";
  const auto rows = rows_of(run_program(command).out);
  REQUIRE(rows.size() == 6);
  CHECK(std::vector(rows[0].end() - 3, rows[0].end()) ==
        std::vector<std::string>{"u_estimate", "v_estimate", "ln_v_estimate"});
  const SmallMuMotion motion({PadeLaw{}, 0.1}, {-1, 1});
  for (std::size_t row = 1; row < rows.size(); ++row) {
    const auto speeds = motion.at_time(std::stod(rows[row][0]));
    CHECK(std::stod(rows[row][6]) == speeds.u);
    CHECK(std::stod(rows[row][7]) == speeds.v);
    CHECK(std::stod(rows[row][8]) == speeds.ln_v);
    CHECK(speeds.u == Approx(std::stod(rows[row][1])).epsilon(1e-3));
    if (row < 5) CHECK(std::abs(speeds.ln_v - std::stod(rows[row][3])) < 0.1);
  }
  CHECK(rows[5][8] == "-inf");
  const auto left = rows_of(run_program("orbit --mu 0.1 --u0 1 --v0 1 --estimate --time-left 2,0").out);
  CHECK(left[0].back() == "tau_left");
  CHECK(left[0][8] == "ln_v_estimate");
  CHECK(std::stod(left[1][6]) == Approx(std::stod(left[1][1])).epsilon(1e-2));
  for (const std::string start :
       {"--u0 0 --v0 1", "--u0 1 --v0 0", "--u0 0 --v0 0", "--u0 1 --v0 1 --mu 1 --law ring --body puck"}) {
    const std::string mu = start.find("mu") == std::string::npos ? " --mu 0.3" : "";
    const Run run = run_program("orbit --estimate --samples 5 " + start + mu);
    INFO(start << "\n" << run.err);
    CHECK(run.status == 0);
    CHECK(run.out.find("nan") == std::string::npos);
  }
}

TEST_CASE("orbit --reduction: canonical coordinates, and the first integral that does not change", "[cli]") {
  const auto integral_of = [](const std::string& options) {
    const auto orbit = json_of("orbit --reduction --format json --samples 60 " + options);
    const auto all = [&](const char* name) { return orbit.at(name); };
    INFO(options);
    const double first = all("integral")[0];
    for (std::size_t i = 0; i < 59; ++i) {
      const double u = all("u")[i], v = all("v")[i], q = all("q")[i];
      CHECK(q * u == Approx(v).epsilon(1e-14).margin(0));
      CHECK(all("p")[i] == all("ln_v")[i]);
      CHECK(all("integral")[i].get<double>() == Approx(first).epsilon(0).margin(1e-12));
    }
    CHECK(all("p")[59] == "-inf");
    CHECK(all("integral")[59] == "inf");
    return first;
  };
  for (const std::string law : {"--law pade --mu 0.9", "--law exact --mu 0.9", "--law uniform --body disc"}) {
    const double one = integral_of(law + " --u0 -0.5 --v0 2"), three = integral_of(law + " --u0 -1.5 --v0 6");
    CHECK(three - one == Approx(std::log(3)).epsilon(1e-13));
  }
  // p = ln v keeps its digits after v has underflowed.
  const auto small = json_of("orbit --reduction --mu 0.01 --u0 1 --v0 1 --time-left 80 --format json");
  CHECK(small.at("v")[0] == 0);
  CHECK(small.at("p")[0].get<double>() < -800);
  CHECK(small.at("integral")[0].get<double>() ==
        Approx(json_of("reduce --mu 0.01 --u0 1 --v0 1 --format json").at("first_integral").get<double>())
            .epsilon(0)
            .margin(1e-12));
  const auto ray =
      json_of("orbit --reduction --law uniform --body disc --u0 1 --v0 0.653001789205597639 --samples 3 --format json");
  CHECK(ray.at("integral") == nlohmann::json::parse(R"(["inf", "inf", "inf"])"));
  const auto axis = rows_of(run_program("orbit --reduction --mu 0.3 --u0 0 --v0 1 --at 0").out);
  CHECK(std::vector(axis[0].end() - 3, axis[0].end()) == std::vector<std::string>{"q", "p", "integral"});
  CHECK(std::vector(axis[1].end() - 3, axis[1].end()) == std::vector<std::string>{"inf", "0", "inf"});
}

TEST_CASE("a ball has seconds in its last column", "[cli]") {
  const auto rows = rows_of(run_program("orbit --ball pool --samples 2").out);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].back() == "t");
  CHECK(rows[1].back() == "0");
  CHECK(std::stod(rows[2].back()) == json_of("stop --ball pool --format json").at("t_stop").get<double>());
}

TEST_CASE("motions along the axes and at rest", "[limit]") {
  for (const std::string start : {"--u0 0 --v0 1", "--u0 1 --v0 0", "--u0 0 --v0 0"}) {
    for (const std::string route : {"closed", "regularised", "direct"}) {
      const Run run = run_program("orbit --law pade --mu 0.3 --samples 5 " + start + " --route " + route);
      INFO(start << " " << route << "\n" << run.err);
      CHECK(run.status == 0);
      CHECK(rows_of(run.out).size() == 6);
      CHECK(run.out.find("nan") == std::string::npos);
    }
  }
}

TEST_CASE("instants of a ball in seconds", "[cli]") {
  using Catch::Matchers::Contains;
  const auto seconds = rows_of(run_program({"orbit", "--ball", "pool", "--at", "1, 2 s"}).out);
  REQUIRE(seconds.size() == 3);
  CHECK(std::stod(seconds[1].back()) == Approx(1).epsilon(1e-15));
  CHECK(std::stod(seconds[2].back()) == Approx(2).epsilon(1e-15));
  CHECK(rows_of(run_program({"orbit", "--ball", "pool", "--at", "2000 ms"}).out)[1] == seconds[2]);
  CHECK(seconds[2].back() == "2");                                                       // the number as it was typed
  auto by_tau = rows_of(run_program("orbit --ball pool --at " + seconds[2][0]).out)[1];  // without a unit: tau
  CHECK(std::stod(by_tau.back()) == Approx(2).epsilon(1e-15));
  by_tau.back() = seconds[2].back();
  CHECK(by_tau == seconds[2]);
  const auto left = rows_of(run_program({"orbit", "--ball", "pool", "--time-left", "3 s"}).out);
  const double stop = json_of("stop --ball pool --format json").at("t_stop").get<double>();
  CHECK(std::stod(left[1].back()) == Approx(stop - 3).epsilon(1e-13));
  const Run unknown = run_program({"orbit", "--mu", "1", "--u0", "1", "--v0", "1", "--at", "2 s"});
  CHECK(unknown.status == 2);
  CHECK_THAT(unknown.err, Contains("add --ball"));
  CHECK_THAT(run_program({"orbit", "--ball", "pool", "--at", "2 Hz"}).err, Contains("none of s, ms or min"));
}

TEST_CASE("instants by the regularised time", "[cli]") {
  const std::string start = "orbit --mu 0.3 --law pade --u0 -1 --v0 1 ";
  const auto rows = rows_of(run_program(start + "--at 0.3,2,7,11").out);
  std::string betas;
  for (std::size_t i = rows.size() - 1; i > 0; --i) betas += (betas.empty() ? "" : ",") + rows[i][5];
  const auto found = rows_of(run_program(start + "--beta " + betas).out);
  REQUIRE(found.size() == rows.size());
  CHECK(found[0] == rows[0]);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto &wanted = rows[rows.size() - i], &row = found[i];
    CHECK(row[5] == wanted[5]);  // the number as it was typed
    for (std::size_t column : {0, 1, 2, 3, 4})
      CHECK(std::stod(row[column]) == Approx(std::stod(wanted[column])).epsilon(1e-9));
  }
  // Cases: a ball, with t in seconds; a start on an axis; a start at rest; values of beta from a file.
  const auto pool = rows_of(run_program("orbit --ball pool --beta 0,0.1").out);
  CHECK((pool[0].back() == "t" && pool[1].back() == "0" && std::stod(pool[2].back()) > 0));
  const auto axis = rows_of(run_program("orbit --mu 0.3 --law pade --u0 0 --v0 1 --beta 1").out);
  CHECK(std::stod(axis[1][2]) == Approx(1 / (1 + 105 * std::numbers::pi)));
  CHECK(rows_of(run_program("orbit --mu 0.3 --u0 0 --v0 0 --beta 1").out)[1][2] == "0");
  const TemporaryDirectory scratch;
  write_file(scratch.file("beta.csv"), "beta\n0\n1\n");
  CHECK(rows_of(run_program(start + "--beta " + scratch.file("beta.csv")).out).size() == 3);
  check_rejected(start + "--beta -1", "--beta -1: -1 is not allowed: beta >= 0 is required");
  check_rejected(start + "--beta 1s", "--beta 1s: beta has no unit: plain numbers are needed");
  check_rejected(start + "--beta 1 --at 1", "exclude each other");
  check_rejected(start + "--beta 1 --samples 3", "--beta and --samples exclude each other");
  check_rejected(start + "--beta 1 --time-left 1", "--time-left and --beta exclude each other");
  check_rejected(start + "--beta 1 --route direct", "--beta needs --route closed or quadrature");
}

TEST_CASE("at rest k is what it tends to", "[cli]") {
  const auto last = [](const std::string& start) {
    return rows_of(run_program("orbit --samples 3 " + start).out).back();
  };
  const double k_star = json_of("terminal --body disc --format json")["k_star"];
  CHECK(std::stod(last("--body disc --u0 1 --v0 1")[4]) == k_star);
  CHECK(std::stod(last("--body disc --u0 -1 --v0 5 --route direct --reduction")[4]) == k_star);
  CHECK(std::stod(last("--body disc --u0 -1 --v0 5 --reduction")[6]) == Approx(-k_star));
  CHECK(last("--mu 0.3 --u0 1 --v0 1")[4] == "0");
  CHECK(last("--mu 0.3 --u0 0 --v0 1")[4] == "inf");
}
