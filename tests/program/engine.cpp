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

TEST_CASE("engine NAME says what to type in and what then happens", "[cli]") {
  const auto json = json_of("engine mujoco --ball pool --format json");
  CHECK(json.at("schema") == 1);
  CHECK(json.at("law") == "exact");
  REQUIRE(json.at("engines").size() == 1);
  const auto& engine = json.at("engines")[0];
  CHECK(engine.at("parameters").at("friction[0]").at("value") == 0.2);
  CHECK(engine.at("parameters").at("friction[1]").at("value") == json.at("moment_arm"));
  CHECK(engine.at("parameters").at("friction[1]").at("unit") == "m");
  // Elliptic: near the law. Pyramidal: the slip lasts as long as the spin. No moment: for ever.
  const auto& settings = engine.at("settings");
  CHECK(settings[0].at("t_slip").get<double>() == Approx(0.2590).epsilon(1e-3));
  CHECK(json.at("t_slip").get<double>() == Approx(0.3080).epsilon(1e-3));
  CHECK(settings[1].at("cone") == "pyramid");
  CHECK(settings[1].at("t_slip").get<double>() == Approx(10.0855).epsilon(1e-5));
  CHECK(settings[1].at("t_spin").get<double>() == Approx(10.1356).epsilon(1e-5));
  CHECK(settings.back().at("cone") == "none");
  CHECK(settings.back().at("t_spin") == "inf");

  const std::string text = run_program("engine mujoco --ball pool").out;
  for (const char* part : {"friction[1] = 0.000333052 m", "condim=\"4\"", "cone pyramidal (default)", "10.0855",
                           "     17       0.60374       0.60786", "src/engine/engine_collision_driver.c:"}) {
    CHECK_THAT(text, Contains(part));
  }
}

TEST_CASE("the numbers follow from the ball, its start and the law", "[invariant]") {
  const auto arm = [](const std::string& options) {
    return json_of("engine physx --format json --ball pool " + options).at("moment_arm").get<double>();
  };
  // A measured spin deceleration is the moment: whatever the friction and the law.
  CHECK(arm("--law uniform --friction 0.3") == Approx(arm("")).epsilon(1e-12));
  CHECK(arm("--spin-deceleration 5") == Approx(arm("") / 2).epsilon(1e-12));
  CHECK(arm("--patch-radius 2mm --law ring") == Approx(0.2 * 2e-3).epsilon(1e-12));
  const auto slow = json_of("engine physx --format json --ball pool --slip 0.5 --spin 0");
  CHECK(slow.at("t_spin") == 0);
  CHECK(slow.at("engines")[0].at("settings")[0].at("t_slip").get<double>() == Approx(0.145528 / 2).epsilon(1e-5));
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
    // Force f N and moment f c N, each for itself: v/(f g), v^2/(2 f g), (a^2/2) omega^2/(2 f g c)/(2 pi).
    const double pi = std::acos(-1.0), slide = 0.999 * 5 / (0.1 * g), slid = 25 / (0.2 * g);
    close(engine.at("settings")[0], slide, slid, a * a * 1e4 / (4 * 0.1 * g * (2 * a / 3)) / (2 * pi));
    close(engine.at("settings")[1], slide, slid, a * a * 1e4 / (4 * 0.1 * g * a) / (2 * pi));
  }
  CHECK(box == std::set<std::string>{"jolt", "rapier", "box3d", "bepu"});
  // What is typed in is a quarter there, so it slides four times as far.
  const auto bepu =
      json_of("engine bepu --ball puck --slip 5 --spin 100 --friction 0.1 --format json").at("engines")[0];
  CHECK(bepu.at("settings")[2].at("slip_length").get<double>() ==
        Approx(4 * bepu.at("settings")[0].at("slip_length").get<double>()).epsilon(1e-12));

  const Run text = run_program("engine --ball puck");
  CHECK(text.status == 0);
  for (const char* part : {"the disc  law uniform", "\njolt      radius of the shape = 0.0254 m",
                           "\nchrono    has no body that lies flat, or was not read for it\n", "57.2246"})
    CHECK_THAT(text.out, Contains(part));
  CHECK_THAT(run_program("engine chrono --ball puck").out, Contains("type in   has no body that lies flat"));
}

TEST_CASE("a program that stands on an engine is told which", "[cli]") {
  const Run unity = run_program("engine unity --ball pool");
  CHECK(unity.status == 0);
  CHECK_THAT(unity.err, Contains("note: Unity's built-in 3D physics stands on PhysX"));
  CHECK(unity.out == run_program("engine physx --ball pool").out);
}
