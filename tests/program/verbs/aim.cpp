// `aim` is compared with `roll`, which computes the motion from a start.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "answers/figures/figures.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/scaling.hpp"
#include "run_program.hpp"

TEST_CASE("the motion from an aimed start comes to its goals, and so does that of its stroke", "[cli][route]") {
  struct Aimed {
    const char* ball;
    std::vector<std::pair<std::string, double>> goals;
  };
  const std::vector<Aimed> cases{{"pool", {{"distance", 1}, {"turns", 3}}},
                                 {"pool", {{"distance", 1}, {"turns", 0}}},
                                 {"puck", {{"distance", 20}, {"time", 6.5}}},
                                 {"puck --inertia 1", {{"turns", -7}, {"time", 3}}},
                                 {"basketball", {{"distance", 0.8}, {"turns", -2}}},
                                 {"pool --law ring", {{"turns", -9}, {"time", 4}}},
                                 {"pool", {{"rolls-at", 0.5}, {"rolling-speed", 1}, {"spin", 0}}},
                                 {"pool", {{"rolls-at", 0.5}, {"rolling-speed", 0.5}, {"spin", 30}}},
                                 {"pool", {{"rolls-at", 1}, {"rolling-speed", 0}, {"spin", -80}}},
                                 {"gel", {{"rolls-at", 0.05}, {"rolling-speed", 0.2}, {"spin", 300}}},
                                 {"basketball", {{"rolls-at", 2}, {"rolling-speed", 3}, {"spin", 40}}},
                                 {"pool --law pade", {{"rolls-at", 1e-6}, {"rolling-speed", 1}, {"spin", 5}}},
                                 {"pool", {{"rolls-at", 1e6}, {"rolling-speed", 1}, {"spin", 100}}},
                                 {"pool --rolling-friction 0.01", {{"distance", 2}, {"turns", -30}}},
                                 {"pool --rolling-friction 0.01", {{"distance", 0.5}, {"turns", 3}}},
                                 {"pool --rolling-friction 0.01", {{"distance", 3}, {"turns", 0}}},
                                 {"pool --rolling-friction 0.01", {{"distance", 0}, {"turns", 5}}},
                                 {"pool --rolling-friction 0.01", {{"turns", 30}, {"time", 9}}}};
  int struck = 0;
  for (const auto& [ball, goals] : cases) {
    std::string asked = fmt::format("aim --format json --ball {}", ball);
    for (const auto& [name, value] : goals) asked += fmt::format(" --{} {}", name, value);
    INFO(asked);
    const auto aimed = json_of(asked);
    const auto number = [](const nlohmann::json& json, const char* place) {
      return json.at(nlohmann::json::json_pointer(place)).get<double>();
    };
    const double v = number(aimed, "/velocity/0"), wy = number(aimed, "/angular_velocity/1"),
                 spin = number(aimed, "/angular_velocity/2");
    const auto roll = json_of(fmt::format(
        "roll --format json --ball {} --velocity {:.17g},0 --angular-velocity 0,{:.17g},{:.17g} --at {:.17g}", ball, v,
        wy, spin, number(aimed, "/time")));
    const bool rests = roll.contains("rest");
    for (const auto& [name, value] : goals) {
      const double got = name == "distance"   ? number(roll, rests ? "/rest/x" : "/x/0")
                         : name == "turns"    ? number(roll, "/turns")
                         : name == "time"     ? std::max(rests ? number(roll, "/rest/t") : 0, number(roll, "/t_stop"))
                         : name == "rolls-at" ? number(roll, "/rolls_after/x")
                         : name == "rolling-speed" ? number(roll, "/vx/0")
                                                   : spin;
      CHECK(got == Approx(value).epsilon(1e-9).margin(1e-12 * (1 + v)));
    }
    CHECK(aimed.contains("final_velocity") == (std::string(ball).find("friction") == std::string::npos && !rests));
    if (!aimed.contains("strike")) continue;
    ++struck;
    const auto stroke = json_of(
        fmt::format("roll --samples 2 --format json --ball {} --strike {:.17g} --tip {:.17g},{:.17g}", ball,
                    number(aimed, "/strike/speed"), number(aimed, "/strike/right"), number(aimed, "/strike/above")));
    CHECK(number(stroke, "/velocity/0") == Approx(v).epsilon(1e-12));
    CHECK(number(stroke, "/angular_velocity/1") == Approx(wy).epsilon(1e-12).margin(1e-12));
    CHECK(number(stroke, "/angular_velocity/2") == Approx(spin).epsilon(1e-12).margin(1e-12));
  }
  CHECK(struck > 4);
}

TEST_CASE("what the lines of aim's picture say is what its points need", "[figure]") {
  namespace si = contensou::si;
  namespace portraits = contensou::portraits;
  const si::Experiment ball = si::find_ball("pool")->experiment;
  const contensou::reduction::Law law{contensou::reduction::HertzLaw{}};
  const contensou::reduction::Flow flow(si::undriven_system(ball, law));
  const portraits::Figure figure = contensou::answers::aim_figure(ball, law, {1.0, -4.0, {}}, {});
  const portraits::Panel& panel = figure.panels.front();
  CHECK(panel.marks.front().points.front().x == Approx(1).epsilon(1e-12));
  CHECK(panel.marks.front().points.front().y == Approx(4).epsilon(1e-12));
  REQUIRE(panel.lines.size() == 4);
  std::array<int, 3> found{};
  for (const portraits::Label& label : panel.labels) {
    const si::SlipAndSpin start = si::aimed(ball, flow, {label.at.x, label.at.y, {}});
    const double time = si::seconds(ball, flow.stop_time({ball.ball.radius * start.spin, start.slip}).tau);
    const std::array needed{start.slip, start.spin, time};
    for (std::size_t i = 0; i < needed.size(); ++i) {
      if (label.colour.rgb != panel.lines[i].stroke.colour.rgb) continue;
      CAPTURE(i, label.at.x, label.at.y);
      CHECK(needed[i] == Approx(std::stod(label.text.words())).epsilon(2e-3));
      ++found[i];
    }
  }
  for (int count : found) CHECK(count >= 4);
}
