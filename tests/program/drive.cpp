#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("stop with a drive: by every route one time, within its bounds", "[cli]") {
  const std::string start = "stop --mu 0.1 --u0 1 --v0 1 --drive 0.05 --format json";
  const auto best = json_of(start);
  const double tau = best.at("tau_stop").get<double>();
  CHECK(best.at("drive") == 0.05);
  CHECK(best.at("route") == "quadrature");
  for (const std::string route : {"regularised", "direct"})
    CHECK(json_of(start + " --route " + route).at("tau_stop").get<double>() == Approx(tau).epsilon(1e-10));
  CHECK(best.at("bounds")[0].get<double>() <= tau);
  CHECK(tau <= best.at("bounds")[1].get<double>());
  // A drive delays the stop. Without a drive, the answer does not contain the field drive.
  const auto free = json_of("stop --mu 0.1 --u0 1 --v0 1 --format json");
  CHECK(tau > free.at("tau_stop").get<double>());
  CHECK_FALSE(free.contains("drive"));
  CHECK(json_of("stop --mu 0.1 --u0 1 --v0 1 --drive 0 --format json") == free);
  // Without spin the stop time is (3 pi/7) v0/(1 - drive).
  CHECK(json_of("stop --mu 0.1 --u0 0 --v0 1 --drive 0.05 --format json").at("tau_stop").get<double>() ==
        Approx(3 * M_PI / 7 / 0.95).epsilon(1e-14));
  CHECK_THAT(run_program("stop --mu 0.1 --u0 1 --v0 1 --drive 0.05").out,
             Contains("drive 0.05 of f N") && Contains("creeps while it spins"));
}

TEST_CASE("orbit, terminal and check take a drive", "[cli]") {
  const auto ends = json_of("terminal --mu 0.1 --drive 0.05 --format json");
  CHECK(ends.at("limit") == "ray");
  CHECK(ends.at("drive") == 0.05);
  const double k = ends.at("k_star").get<double>();
  CHECK(json_of("terminal --mu 0.1 --drive 0.9999 --format json").at("limit") == "infinity");
  // A body that only spins begins to creep. Here its ratio k is checked.
  const auto rows = rows_of(run_program("orbit --mu 0.1 --u0 1 --v0 0 --drive 0.05 --samples 20").out);
  REQUIRE(rows.size() == 21);
  CHECK(std::stod(rows[1][4]) == 0);
  CHECK(std::stod(rows[15][4]) == Approx(k).epsilon(1e-9));
  const Run check = run_program("check --mu 0.1 --u0 1 --v0 1 --drive 0.05");
  CHECK(check.status == 0);
  CHECK_THAT(check.out, Contains("start of creeping"));
}

TEST_CASE("portraits with a drive: orbits begin at v = 0, isochrones end there, the ray is drawn", "[cli]") {
  const std::string system = "portrait --mu 0.3 --drive 0.3 ";
  for (const std::string view : {"uv", "patch", "log", "similarity", "blowup", "disc", "time", "regularised", "pair"}) {
    INFO(view);
    const Run script = run_program(system + "--view " + view + " -o - --format gp");
    CHECK(script.status == 0);
    CHECK_THAT(script.out, Contains("drive"));
    CHECK(script.out != run_program("portrait --mu 0.3 --view " + view + " -o - --format gp").out);
  }
  const auto data = json_of(system + "--u0 1 --v0 0 -o - --format json");
  CHECK(data.at("drive") == 0.3);
  CHECK_FALSE(json_of("portrait --mu 0.3 -o - --format json").contains("drive"));
  int from_below = 0;
  for (const auto& orbit : data.at("orbits")) {
    CHECK(orbit.at("u").back() == 0);
    CHECK(orbit.at("v").back() == 0);
    from_below += orbit.at("v")[0] == 0;
  }
  CHECK(from_below > 4);
  // A body that only spins begins to creep. Its speed v grows at first. Its stop time is the stop time of `stop`.
  const auto& creeping = data.at("highlight");
  CHECK(creeping.at("v")[0] == 0);
  CHECK(creeping.at("v")[20].get<double>() > 0);
  const double tau = json_of("stop --mu 0.3 --u0 1 --v0 0 --drive 0.3 --format json").at("tau_stop").get<double>();
  CHECK(creeping.at("tau_left")[0].get<double>() == Approx(tau).epsilon(1e-13));
  for (const auto& isochrone : data.at("isochrones")) {
    const double u = isochrone.at("u")[10].get<double>(), v = isochrone.at("v")[10].get<double>();
    const Run stop =
        run_program("stop --mu 0.3 --drive 0.3 --format csv --u0 " + std::to_string(u) + " --v0 " + std::to_string(v));
    CHECK(stop.status == 0);
  }
  const auto facts = json_of("portrait --facts --mu 0.3 --drive 0.3 --format json");
  CHECK_FALSE(facts.contains("mu_low"));
  for (const auto& point : facts.at("singular_points")) CHECK(point.at("half_line") != "v = 0");
  CHECK(facts.at("rays").size() == 1);
  CHECK(facts.at("tangents")[0].at("half_line") == "ray");
  check_rejected("portrait --mu 0.3 --drive 1", "from 1 on it would never stop");
  check_rejected("portrait --ball pool --drive 0.1", "exclude each other");
}

TEST_CASE("sweep, stop --batch and reduce with a drive", "[cli]") {
  const auto stop = [](const std::string& start) {
    return json_of("stop " + start + " --drive 0.2 --format json").at("tau_stop").get<double>();
  };
  const auto rows = rows_of(run_program("sweep --mu 0.3 --u0 -1:1:3 --v0 0:2:3 --drive 0.2").out);
  REQUIRE(rows.size() == 10);
  CHECK(std::stod(rows[1][3]) == stop("--mu 0.3 --u0 -1 --v0 0"));
  CHECK(std::stod(rows[9][3]) == stop("--mu 0.3 --u0 1 --v0 2"));
  // Rows with many mu share some flows. Sharing has an error of 8 eps/(1 - drive).
  const auto many = rows_of(run_program("sweep --mu 0.1:0.3:1001 --u0 1 --v0 1 --drive 0.2").out);
  CHECK(std::stod(many[1][3]) == Approx(stop("--mu 0.1 --u0 1 --v0 1")).epsilon(2.2e-15));
  CHECK(std::stod(many[1001][3]) == Approx(stop("--mu 0.3 --u0 1 --v0 1")).epsilon(2.2e-15));
  const auto batch = rows_of(run_program("stop --batch - --drive 0.2", "mu,u0,v0\n0.3,1,2\n0.1,1,1\n").out);
  CHECK(std::stod(batch[1][3]) == stop("--mu 0.3 --u0 1 --v0 2"));
  CHECK(std::stod(batch[2][3]) == stop("--mu 0.1 --u0 1 --v0 1"));

  const auto reduced = json_of("reduce --mu 0.3 --u0 1 --v0 1 --drive 0.2 --format json");
  CHECK(reduced.at("drive") == 0.2);
  CHECK(reduced.at("singular_values")[0].get<double>() < 1e-13);
  CHECK(reduced.at("rays").size() == 2);  // the lines u = 0 and v = 0 are no rays here
  for (const auto& route : reduced.at("routes"))
    CHECK(route.at("tau_stop").get<double>() == Approx(stop("--mu 0.3 --u0 1 --v0 1")).epsilon(1e-9));
  CHECK_THAT(run_program("reduce --mu 0.3 --u0 1 --v0 1 --drive 0.2").out, Contains("(Phi(k) - 0.2)"));
  CHECK(run_program("reduce --mu 0.3 --u0 1 --v0 1 --drive 0.2 -o - --format gp").status == 0);
}

TEST_CASE("rolling friction as large as friction, and larger, holds the ball: it slides like a puck", "[cli][route]") {
  for (const std::string u_r : {"0.2", "0.25"}) {
    const std::string ball = " --ball pool --format json --rolling-friction " + u_r;
    const double t = json_of("stop" + ball).at("t_stop").get<double>();
    CHECK(t == json_of("roll" + ball).at("t_stop").get<double>());
    CHECK(t ==
          Approx(json_of("roll --route integrated" + ball).at("integrated").at("t_stop").get<double>()).epsilon(1e-6));
  }
}
