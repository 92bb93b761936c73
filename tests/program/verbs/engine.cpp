#include <cmath>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/si/engine.hpp"
#include "run_program.hpp"

using Catch::Matchers::Contains;
using contensou::si::engines;

TEST_CASE("engine lists each engine on a line that begins with its name", "[cli]") {
  const Run run = run_program("engine --ball pool");
  CHECK(run.status == 0);
  for (const auto& engine : engines()) CHECK_THAT(run.out, Contains("\n" + std::string(engine.name) + " "));
  const auto json = json_of("engine --ball pool --format json");
  REQUIRE(json.at("engines").size() == engines().size());
  std::size_t settings = 0;
  for (const auto& engine : engines()) settings += engine.ball.settings.size();
  CHECK(rows_of(run_program("engine --ball pool --format csv").out).size() == settings + 1);
}

TEST_CASE("engine says how far a puck slides and how often it turns, by law and in engines", "[published]") {
  const auto json = json_of("engine --ball puck --slip 5 --spin 100 --friction 0.1 --format json");
  const auto close = [](const nlohmann::ordered_json& it, double t_slip, double slid, double turns) {
    CHECK(it.at("t_slip").get<double>() == Approx(t_slip).epsilon(1e-3));
    CHECK(it.at("slip_length").get<double>() == Approx(slid).epsilon(1e-3));
    CHECK(it.at("turns").get<double>() == Approx(turns).epsilon(1e-3));
  };
  CHECK(json.at("body") == "disc");
  close(json, 6.2603, 14.7206, 57.2246);
  const double g = 9.80665, a = 0.0381;
  std::set<std::string> box;
  for (const auto& engine : json.at("engines")) {
    INFO(engine.at("name"));
    if (engine.at("settings").empty() || engine.at("settings")[0].at("cone") != "box") continue;
    box.insert(engine.at("name"));
    // Force f N and moment f c N act apart: time 0.999 v/(f g), path v^2/(2 f g), turns a^2 omega^2/(8 pi f g c).
    const double pi = std::acos(-1.0), slide = 0.999 * 5 / (0.1 * g), slid = 25 / (0.2 * g);
    close(engine.at("settings")[0], slide, slid, a * a * 1e4 / (4 * 0.1 * g * (2 * a / 3)) / (2 * pi));
    close(engine.at("settings")[1], slide, slid, a * a * 1e4 / (4 * 0.1 * g * a) / (2 * pi));
  }
  CHECK(box == std::set<std::string>{"jolt", "rapier", "box2d", "box3d", "bepu"});
  // bepu uses a quarter of the typed friction, so the body slides four times as far.
  const auto bepu =
      json_of("engine bepu --ball puck --slip 5 --spin 100 --friction 0.1 --format json").at("engines")[0];
  CHECK(bepu.at("settings")[2].at("slip_length").get<double>() ==
        Approx(4 * bepu.at("settings")[0].at("slip_length").get<double>()).epsilon(1e-12));
}
