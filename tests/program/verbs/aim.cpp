// `aim` is compared with `stop` and `roll`, which compute the motion from a start.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "answers/figures/figures.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/scaling.hpp"
#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

struct Pair {
  const char *one, *other;
};

}  // namespace

TEST_CASE("aim leads back to the start that stop and roll begin with", "[cli]") {
  for (const std::string ball : {"pool", "puck", "basketball", "pool --law ring", "puck --inertia 1"}) {
    const double slip = 1.25, spin = -17;
    const std::string start = fmt::format(" --ball {} --slip {} --spin {} --format json", ball, slip, spin);
    const auto stop = json_of("stop" + start);
    const double time = stop.at("t_stop");
    const auto roll = json_of(fmt::format("roll{} --at {}", start, time));
    const double distance = roll.at("x")[0], turns = roll.at("turns");
    for (const auto& [one, other] : {Pair{"distance", "turns"}, {"distance", "time"}, {"turns", "time"}}) {
      const auto asked = [&](const std::string& what) {
        return fmt::format(" --{} {:.17g}", what, what == "distance" ? distance : what == "turns" ? turns : time);
      };
      const std::string words = "aim --ball " + ball + asked(one) + asked(other) + " --format json";
      INFO(words);
      const auto json = json_of(words);
      CHECK(json.at("distance").get<double>() == Approx(distance).epsilon(1e-12));
      CHECK(json.at("turns").get<double>() ==
            Approx(other == std::string("time") && one == std::string("distance") ? -turns : turns).epsilon(1e-9));
      CHECK(json.at("time").get<double>() == Approx(time).epsilon(1e-12));
      CHECK(json.at("slip").get<double>() == Approx(slip).epsilon(1e-9));
      CHECK(std::abs(json.at("spin").get<double>()) == Approx(-spin).epsilon(1e-9));
    }
  }
}

TEST_CASE("aim of a puck and of a ball in words", "[cli]") {
  const std::string puck = run_program("aim --ball puck --distance 20m --turns 3").out;
  CHECK_THAT(puck, Contains("start  slip 6.26255 m/s, spin 4.42701 rad/s\n") &&
                       Contains("end    20 m from the start, after 3 turns and 6.39157 s"));
  CHECK_THAT(puck, !Contains("cue") && !Contains("rolls"));
  CHECK(run_program("aim --ball puck --distance 2000cm --turns 3").out == puck);
  CHECK(run_program("aim --ball puck --distance 20m --turns 3 --format csv")
            .out.starts_with("law,slip,spin,vx,wy,distance,turns,time\n"));
  CHECK_THAT(run_program("aim --ball pool --distance 10cm --turns -5").out, Contains("no level stroke gives it"));
}

TEST_CASE("the cue of aim makes that start", "[cli]") {
  for (const std::string turns : {"0", "3", "-2"}) {
    const auto json = json_of("aim --ball pool --distance 1m --format json --turns " + turns);
    const auto& strike = json.at("strike");
    const auto roll = json_of(fmt::format("roll --ball pool --strike {} --tip {},0 --format json --at {}",
                                          strike.at("speed").get<double>(), strike.at("right").get<double>(),
                                          json.at("time").get<double>()));
    CHECK(roll.at("x")[0].get<double>() == Approx(1).epsilon(1e-12));
    CHECK(roll.at("turns").get<double>() == Approx(std::stod(turns)).epsilon(1e-12));
    CHECK(roll.at("vx")[0].get<double>() == Approx(json.at("final_velocity").get<double>()).epsilon(1e-9));
    CHECK(roll.at("rolls_after").at("x") == Approx(json.at("rolls_after").at("x").get<double>()).epsilon(1e-9));
  }
}

TEST_CASE("a ball begins to roll where and as fast as aim was asked", "[cli]") {
  struct Asked {
    const char* ball;
    double place, speed, spin;
  };
  for (const auto& [ball, place, speed, spin] : {Asked{"pool", 0.5, 1, 0},
                                                 {"pool", 0.5, 0.5, 30},
                                                 {"pool", 1, 0, -80},
                                                 {"gel", 0.05, 0.2, 300},
                                                 {"basketball", 2, 3, 40},
                                                 {"pool --law pade", 1e-6, 1, 5},
                                                 {"pool", 1e6, 1, 100}}) {
    const auto json = json_of(fmt::format("aim --ball {} --rolls-at {} --rolling-speed {} --spin {} --format json",
                                          ball, place, speed, spin));
    INFO(json);
    const auto& v = json.at("velocity");
    const auto& w = json.at("angular_velocity");
    const auto roll = json_of(
        fmt::format("roll --ball {} --velocity {:.17g},0 --angular-velocity 0,{:.17g},{:.17g} "
                    "--format json --at {:.17g}",
                    ball, v[0].get<double>(), w[1].get<double>(), w[2].get<double>(), json.at("time").get<double>()));
    CHECK(w[2] == spin);
    CHECK(roll.at("rolls_after").at("x").get<double>() == Approx(place).epsilon(1e-9));
    CHECK(roll.at("vx")[0].get<double>() == Approx(speed).epsilon(1e-12).margin(1e-12 * v[0].get<double>()));
    CHECK(json.at("rolls_after").at("x").get<double>() == Approx(place).epsilon(1e-9));
    CHECK(json.at("final_velocity") == speed);
  }
  // Without spin, Coulomb's law applies: the slip falls at (7/2) f g to 1 mm/s, and the centre slows down at f g.
  const double fg = 0.2 * 9.80665;
  const auto json = json_of("aim --ball pool --rolls-at 0.5 --rolling-speed 1 --format json");
  const double slip = json.at("slip"), v = json.at("velocity")[0], t = (slip - 1e-3) / (3.5 * fg);
  CHECK(v * t - fg * t * t / 2 == Approx(0.5).epsilon(1e-12));
  CHECK(v - 2 * slip / 7 == Approx(1).epsilon(1e-12));
}

TEST_CASE("the cue of aim makes a ball roll there", "[cli]") {
  const auto json = json_of("aim --ball pool --rolls-at 10cm --rolling-speed 1 --spin 8 --format json");
  const auto& strike = json.at("strike");
  CHECK(strike.at("above").get<double>() > 0.1);
  const auto roll = json_of(fmt::format("roll --ball pool --strike {:.17g} --tip {:.17g},{:.17g} --format json",
                                        strike.at("speed").get<double>(), strike.at("right").get<double>(),
                                        strike.at("above").get<double>()));
  CHECK(roll.at("rolls_after").at("x").get<double>() == Approx(0.1).epsilon(1e-9));
  CHECK(json_of("aim --ball pool --rolls-at 10cm --rolling-speed 1 --spin 8rad/s --format json") == json);
  CHECK_THAT(run_program("aim --ball pool --rolls-at 10cm --rolling-speed 1 --spin 8").out,
             Contains(" radii right of the centre and ") && Contains(" above it\n") &&
                 Contains("turning forwards at") &&
                 Contains("it rolls on at 1 m/s; its slip is below 0.001 m/s from") && Contains(" s and 0.1 m on\n"));
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
  check_rejected("aim --ball pool --distance 0 --turns 0 -o x.svg", "a picture needs a start that moves");
  check_rejected("aim --ball pool --distance 1 --turns 1 --size 80x60", "--size");
}

TEST_CASE("aim with rolling friction: the motion from its start comes to the goal", "[cli]") {
  const auto motion_from = [](const nlohmann::json& aimed) {
    return json_of(
        fmt::format("roll --ball pool --rolling-friction 0.01 --format json --samples 2 --slip {:.17g} "
                    "--spin {:.17g}",
                    aimed.at("slip").get<double>(), aimed.at("spin").get<double>()));
  };
  const std::string aim = "aim --ball pool --rolling-friction 0.01 --format json ";
  for (const auto& [distance, turns] : {std::pair{2.0, -30.0}, {0.5, 3.0}, {3.0, 0.0}, {0.0, 5.0}}) {
    const auto aimed = json_of(aim + fmt::format("--distance {} --turns {}", distance, turns));
    const auto motion = motion_from(aimed);
    INFO(distance << ' ' << turns);
    CHECK(motion.at("rest").at("x").get<double>() == Approx(distance).epsilon(1e-9).margin(1e-12));
    CHECK(motion.at("turns").get<double>() == Approx(turns).epsilon(1e-9).margin(1e-12));
    CHECK(aimed.at("rest").at("t") == motion.at("rest").at("t"));
    CHECK_FALSE(aimed.contains("final_velocity"));
  }
  const auto aimed = json_of(aim + "--turns 30 --time 9");
  const auto motion = motion_from(aimed);
  CHECK(motion.at("turns").get<double>() == Approx(30).epsilon(1e-9));
  CHECK(std::max(motion.at("rest").at("t").get<double>(), motion.at("t_stop").get<double>()) ==
        Approx(9).epsilon(1e-9));
  CHECK_THAT(run_program("aim --ball pool --rolling-friction 0.01 --distance 2 --turns 30").out,
             Contains("rolling and spin end"));
  // These two starts give the same distance in the same time. Therefore distance and time together are refused.
  for (const auto& [slip, spin] : {std::pair{1.097088, 78.541367}, {1.098345, 48.564403}}) {
    const auto two = motion_from({{"slip", slip}, {"spin", spin}});
    CHECK(two.at("rest").at("x").get<double>() == Approx(3.1690917).epsilon(1e-5));
    CHECK(std::max(two.at("rest").at("t").get<double>(), two.at("t_stop").get<double>()) == Approx(8).epsilon(1e-5));
  }
}

TEST_CASE("aim refuses what no start in doubles comes to, in the units of who asks", "[cli]") {
  check_rejected("aim --ball pool --distance 1 --time 1e200", "1 m and 1e+200 s are too far apart for a double");
  check_rejected("aim --ball pool --turns 1 --time 1e138", "1 turns and 1e+138 s are too far apart for a double");
  check_rejected("aim --ball pool --turns 1 --time 1e200 --rolling-friction 0.01", "1 turns and 1e+200 s are too far");
  check_rejected("aim --ball pool --rolls-at 100 --rolling-speed 1e13", "within 1e-6 of 100 m");
  check_rejected("aim --ball pool --rolls-at 1e100 --rolling-speed 1e100", "within 1e-6 of 1e+100 m");
  const std::string law = "phi=k/hypot(1,k)*(1+6*k^2/(1+k^2)^2);psi=0.6/hypot(1,k)";
  for (const std::string goal : {"puck --distance 1 --time 1.15", "pool --rolls-at 1 --rolling-speed 1",
                                 "pool --rolling-friction 0.01 --turns 1 --time 9"})
    check_rejected("aim --law " + law + " --ball " + goal, "this law's Phi falls from");
}

TEST_CASE("aim with rolling friction at the least time, and at far scales", "[cli]") {
  const auto least = json_of(
      "aim --ball steel --rolling-friction 0.01 --turns 0.5238089926174072 --time 3.2911889661822333 --format json");
  CHECK(least.at("slip") == 0);
  CHECK(least.at("spin").get<double>() == Approx(2).epsilon(1e-10));
  // At the solution of this search the result jumps by more than the tolerance of the search.
  const auto far = json_of(
      "aim --ball pool --mass 1 --radius 0.03 --friction 0.4 --rolling-friction 0.03 --patch-radius 1e-5 "
      "--turns 4010.4623044603322 --time 886.1097135698567 --format json");
  CHECK(far.at("turns").get<double>() == Approx(4010.4623044603322).epsilon(3e-9));
  CHECK(far.at("time").get<double>() == Approx(886.1097135698567).epsilon(3e-9));
  CHECK(run_program("aim --ball pool --turns 1e20 --distance 1 --rolling-friction 0.01").err.find("tau must") ==
        std::string::npos);
}

TEST_CASE("aim says what goes with what, and where nothing moves", "[cli]") {
  check_rejected("aim --ball pool --spin 8 --distance 1", "--spin and --distance exclude each other");
  check_rejected("aim --ball pool --distance -20 --turns 1", "--distance -20: a value >= 0 is needed, in m");
  check_rejected("aim --ball pool --rolls-at -1 --rolling-speed 1", "--rolls-at -1: a value > 0 is needed");
  check_rejected("roll --ball puck --strike 2", "leave out --strike");
  check_rejected("roll --ball pool --strike 2 --tip 0.6,0", "--strike, --tip: the tip slips off");
  CHECK_THAT(run_program("aim --ball pool --distance 0 --turns 0").out,
             Contains("it is at rest") && !Contains("no level stroke"));
  CHECK_THAT(run_program("aim --ball pool --rolls-at 1 --rolling-speed 0").out, Contains("it stays there"));
  CHECK_THAT(run_program("stop --ball pool --uncertainty mass=1%").out, !Contains("fails here"));
  CHECK_THAT(run_program("roll --ball pool --format text --uncertainty mass=1%").out,
             Contains("none of these numbers changes it"));
}
