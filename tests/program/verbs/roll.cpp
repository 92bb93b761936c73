#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/si/catalogue.hpp"
#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string masse = "roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50";

/// Returns the columns of a CSV by name.
std::map<std::string, std::vector<double>> columns_of(const std::string& arguments) {
  const Run run = run_program(arguments);
  INFO(arguments << "\n" << run.err);
  REQUIRE(run.status == 0);
  const auto rows = rows_of(run.out);
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows[0].size(); ++j)
      columns[rows[0][j]].push_back(std::strtod(rows[i][j].c_str(), nullptr));
  }
  return columns;
}

const std::string general_file = R"([ball]
name = "pool ball on cloth"
mass = 0.1701
radius = 0.028575
[contact]
friction = 0.2
spin_deceleration = 10
[start]
velocity = [1, 0]
angular_velocity = [40, 35, -50]
)";

}  // namespace

TEST_CASE("roll gives 200 rows from the start to a little past the stop", "[cli]") {
  const Run run = run_program("roll --ball pool");
  CHECK(run.status == 0);
  const auto rows = rows_of(run.out);
  REQUIRE(rows.size() == 201);
  CHECK(rows[0] == std::vector<std::string>{"t", "x", "y", "vx", "vy", "wx", "wy", "wz", "slip", "energy"});
  CHECK(rows[1][0] == "0");
  CHECK(rows[1][3] == "1");
  CHECK(rows[1][7] == "100");
  CHECK(rows[1][8] == "1");
  const auto& last = rows.back();
  const auto stop = json_of("stop --ball pool --format json");
  CHECK(std::stod(last[0]) > stop.at("t_stop").get<double>());
  CHECK(std::stod(last[0]) < 1.2 * stop.at("t_stop").get<double>());
  CHECK(std::stod(last[3]) == Approx(stop.at("final").at("velocity").at(0).get<double>()).epsilon(1e-15));
  CHECK(last[7] == "0");
  CHECK(last[8] == "0");
}

TEST_CASE("a start by velocities, from a run file and from options", "[invariant]") {
  const TemporaryDirectory scratch;
  const std::string file = scratch.file("masse.toml");
  write_file(file, general_file);
  CHECK(run_program("roll --ball " + file + " --samples 9").out == run_program(masse + " --samples 9").out);
  // --velocity replaces only the velocity of a [start]; the angular velocity, or the spin, stays.
  CHECK(run_program("roll --ball " + file + " --velocity 2,3 --at 0").out ==
        run_program("roll --ball pool --velocity 2,3 --angular-velocity 40,35,-50 --at 0").out);
  CHECK(rows_of(run_program("roll --ball pool --velocity 2,3 --at 0").out)[1][7] == "100");
  // Other verbs accept a start by velocities, too: their slip is the speed of the contact point.
  const auto stop = json_of("stop --format json --ball " + file);
  const double R = 0.028575;
  CHECK(stop.at("v0").get<double>() == Approx(std::hypot(1 - R * 35, R * 40)).epsilon(1e-15));
  CHECK(stop.at("u0").get<double>() == Approx(-50 * R).epsilon(1e-15));
  CHECK(stop.at("final").at("velocity").at(1).get<double>() == Approx(-R * 40 * 2 / 7).epsilon(1e-14));
  CHECK_THAT(run_program("stop --ball " + file).out, Contains("axes of the start"));
  CHECK(run_program("check --ball " + file).status == 0);
}

TEST_CASE("roll has its events in JSON and as comments of CSV", "[cli]") {
  const auto roll = json_of(masse + " --samples 2 --format json");
  const auto& rolls = roll.at("rolls_after");
  CHECK(rolls.at("threshold") == 1e-3);
  const auto there = columns_of(fmt::format("{} --at {}", masse, rolls.at("t").get<double>()));
  CHECK(there.at("slip")[0] == Approx(1e-3).epsilon(1e-9));
  CHECK(there.at("x")[0] == rolls.at("x").get<double>());
  CHECK(there.at("y")[0] == rolls.at("y").get<double>());
  CHECK(roll.at("spin_ends").at("t") == roll.at("t_stop"));
  const auto& energy = roll.at("energy_balance");
  CHECK(energy.at("start").get<double>() == roll.at("energy").at(0).get<double>());
  CHECK(energy.at("kept").get<double>() == Approx(roll.at("energy").at(1).get<double>()).epsilon(1e-14));
  CHECK(energy.at("start").get<double>() - energy.at("lost_sliding").get<double>() -
            energy.at("lost_spinning").get<double>() ==
        Approx(energy.at("kept").get<double>()).epsilon(1e-14));
  CHECK(roll.at("slip_length").get<double>() == Approx(0.0970456).epsilon(1e-5));
  CHECK(roll.at("turns").get<double>() < 0);
  CHECK(roll.at("textbook").at("spin_ends").at("t").get<double>() == Approx(5).epsilon(1e-14));
  const std::string csv = run_program(masse + " --samples 2").out;
  CHECK_THAT(csv, StartsWith("# law: \"exact\"\n"));
  CHECK_THAT(csv, Contains(fmt::format("\n# t_stop: {}\n", roll.at("t_stop").get<double>())) &&
                      Contains("\n# rolls_after: {\"t\": ") && Contains("\nt,x,y,vx,vy,wx,wy,wz,slip,energy\n"));
}

TEST_CASE("half of the samples lie where the ball slides", "[cli]") {
  const double rolls = json_of("roll --ball pool --samples 2 --format json").at("rolls_after").at("t").get<double>();
  const auto adapted = columns_of("roll --ball pool").at("t");
  CHECK(adapted.size() == 200);
  CHECK(adapted[100] == Approx(rolls).epsilon(1e-12));
  CHECK(std::ranges::is_sorted(adapted));
  const auto even = columns_of("roll --ball pool --equidistant").at("t");
  for (std::size_t i = 0; i < even.size(); ++i) {
    CHECK(even[i] == Approx(even.back() * static_cast<double>(i) / 199).epsilon(1e-14));
  }
  CHECK(adapted.back() == even.back());
  check_rejected("roll --ball pool --at 1 --equidistant", "exclude each other");
  for (const std::string of_events : {"--gradient", "--uncertainty slip=1%"})
    check_rejected("roll --ball pool --format text --samples 3 --until 1 " + of_events,
                   "with --samples, --until the text is a table of instants");
}

TEST_CASE("rolling friction acts while the ball slides, too, and brings it to rest", "[cli]") {
  const std::string slowed = "roll --ball pool --slip 1 --spin 100 --rolling-friction 0.01";
  const auto roll = json_of(slowed + " --samples 2 --format json");
  CHECK(roll.at("route") == "reduced");
  CHECK(roll.at("creeps").at("k").get<double>() == Approx(0.0426093361).epsilon(1e-8));
  const auto& rest = roll.at("rest");
  CHECK(rest.at("t").get<double>() == Approx(7.3800736).epsilon(1e-7));
  CHECK(rest.at("x").get<double>() == Approx(2.6408730).epsilon(1e-7));
  const auto& energy = roll.at("energy_balance");
  CHECK(energy.at("kept") == 0);
  CHECK(energy.at("lost_sliding").get<double>() + energy.at("lost_spinning").get<double>() +
            energy.at("lost_rolling").get<double>() ==
        Approx(energy.at("start").get<double>()));
  CHECK_THAT(run_program(slowed + " --format text").out,
             Contains("its centre rests after") && Contains("u_r g = 0.0980665") && Contains("creeps while it spins"));
  CHECK_FALSE(json_of(masse + " --samples 2 --format json").contains("rest"));

  const auto stepped = columns_of(slowed + " --samples 9 --route integrated");
  const auto reduced = columns_of(slowed + " --samples 9");
  for (std::size_t i = 0; i < 9; ++i) CHECK(stepped.at("x")[i] == Approx(reduced.at("x")[i]).margin(1e-7));
  const auto both = json_of(slowed + " --samples 2 --route integrated --format json");
  CHECK(both.at("integrated").at("rest").at("x").get<double>() == Approx(rest.at("x").get<double>()).epsilon(1e-6));

  // If slip and rolling have different directions, the motion is integrated, and the output says this.
  const auto turned = json_of(masse + " --rolling-friction 0.01 --samples 2 --format json");
  CHECK(turned.at("route") == "integrated");
  CHECK_FALSE(turned.contains("creeps"));
  CHECK(turned.at("rest").at("t").get<double>() > 1);
}

TEST_CASE("a cue's stroke is a start", "[cli]") {
  const auto experiment =
      json_of("roll --ball pool --strike 2 --tip 0.3,-0.2 --elevation 30 --samples 2 --format json");
  const double m = 0.1701, R = 0.028575, root3 = std::sqrt(3);
  const double V = 2 * 2 / (1 + m / 0.54 + 2.5 * (0.09 + 0.04));
  CHECK(experiment.at("velocity").at(0).get<double>() == Approx(V * root3 / 2).epsilon(1e-14));
  CHECK(experiment.at("velocity").at(1) == 0);
  CHECK(experiment.at("angular_velocity").at(0).get<double>() == Approx(2.5 * V / R * 0.3 / 2).epsilon(1e-14));
  CHECK(experiment.at("angular_velocity").at(1).get<double>() == Approx(2.5 * V / R * -0.2).epsilon(1e-14));
  CHECK(experiment.at("angular_velocity").at(2).get<double>() == Approx(2.5 * V / R * 0.3 * root3 / 2).epsilon(1e-14));
  CHECK(json_of("roll --ball pool --strike 1 --cue-mass 0.1701 --samples 2 --format json").at("velocity").at(0) == 1);
}

TEST_CASE("a spinning ball never rolls before the textbook's, whatever counts as rolling", "[invariant]") {
  for (const std::string law : {"exact", "pade"}) {
    for (const auto& entry : contensou::si::catalogue()) {
      if (entry.experiment.ball.body.lies_flat()) continue;
      for (const char* below : {"1e-6", "1e-3", "0.1", "100"}) {
        const auto roll = json_of(fmt::format("roll --samples 2 --format json --ball {} --law {} --rolling-below {}",
                                              entry.name, law, below));
        CAPTURE(entry.name, law, below);
        CHECK(roll.at("rolls_after").at("t").get<double>() >=
              roll.at("textbook").at("rolls_after").at("t").get<double>());
        if (std::string(below) == "100") CHECK(roll.at("rolls_after").at("t") == 0);
      }
    }
  }
  // If the threshold is 0, the slip ends together with the spin.
  const auto all = json_of("roll --ball pool --samples 2 --format json --rolling-below 0");
  CHECK(all.at("rolls_after").at("t") == all.at("t_stop"));
}

TEST_CASE("a moving picture, in real time or a stated pace", "[cli][gnuplot]") {
  const TemporaryDirectory scratch;
  const Run run = run_program("roll --ball pool --until 0.01 --samples 30 --size 120x90 --font Serif -o " +
                              scratch.file("shot.gif"));
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.out.empty());
  const std::string film = read_file(scratch.file("shot.gif"));
  CHECK_THAT(film, StartsWith("GIF89a"));
  CHECK(film.size() < 500'000);
  // A frame has a graphic control extension, and its delay is 1/25 s.
  int frames = 0;
  for (auto at = film.find("\x21\xf9\x04"); at != std::string::npos; at = film.find("\x21\xf9\x04", at + 1)) {
    CHECK(film.substr(at + 4, 2) == std::string("\x04\0", 2));
    ++frames;
  }
  CHECK(frames == 30);
}

TEST_CASE("a batch of motions has the events of each", "[cli]") {
  const std::string options = "roll --ball pool --rolling-friction 0.01 ";
  const auto one = [&](const std::string& start) {
    const auto json = json_of(options + "--format json --samples 2 " + start);
    std::vector<double> values;
    for (const char* event : {"rolls_after", "spin_ends"}) {
      for (const char* member : {"t", "x", "y"}) values.push_back(json[event][member].get<double>());
    }
    for (const char* member : {"slip_length", "turns", "path"}) values.push_back(json[member].get<double>());
    for (const char* member : {"t", "x", "y"}) values.push_back(json["rest"][member].get<double>());
    return values;
  };
  const auto check = [&](const std::string& table, std::size_t inputs, const std::vector<std::string>& starts) {
    const Run run = run_program(options + "--batch -", table);
    INFO(run.err);
    CHECK(run.status == 0);
    const auto rows = rows_of(run.out);
    REQUIRE(rows.size() == starts.size() + 1);
    CHECK(rows[0][inputs] == "t_rolls");
    CHECK(rows[0].back() == "y_rest");
    for (std::size_t i = 0; i < starts.size(); ++i) {
      std::vector<double> values;
      for (std::size_t j = inputs; j < rows[0].size(); ++j) values.push_back(std::stod(rows[i + 1][j]));
      CHECK(values == one(starts[i]));
    }
  };
  check("spin,note,slip\n100,a,1\n0,b,2\n-50,c,0\n", 3,
        {"--slip 1 --spin 100", "--slip 2 --spin 0", "--slip 0 --spin -50"});
  check("vx,vy,wx,wy,wz\n1,0,40,35,-50\n", 5, {"--velocity 1,0 --angular-velocity 40,35,-50"});
  const Run kept = run_program("roll --ball pool --keep-going --batch -", "spin,slip\n1,-1\n1,1\n");
  CHECK(kept.status == 2);
  CHECK_THAT(kept.out, Contains("\n1,-1,,,,,,,,,\n1,1,0.1"));
  CHECK(rows_of(kept.out)[0].back() == "path");
}

TEST_CASE("mistakes in a motion are bad input", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string file = scratch.file("mixed.toml");
  write_file(file, general_file + "spin = 3\n");
  const Run mixed = run_program("roll --ball " + file);
  CHECK(mixed.status == 2);
  CHECK_THAT(mixed.err, StartsWith(file + ":11:1: ") && Contains("exclude each other"));
  write_file(file, general_file);
  CHECK(run_program("roll --spin 3 --ball " + file).status == 0);
  CHECK(run_program("roll --ball nosuch.toml").status == 4);
}

TEST_CASE("what is 0 by symmetry is 0, and nothing is -0", "[cli]") {
  // A stroke 2/5 of a radius above the centre makes a ball roll at once.
  const auto rolls = json_of("roll --ball pool --strike 2 --tip 0,0.4 --format json --samples 3");
  CHECK(rolls.at("slip") == nlohmann::json{0, 0, 0});
  CHECK(rolls.at("t_stop") == 0);
  for (const std::string start :
       {"--velocity=-1,0 --angular-velocity 0,0,0", "--velocity=-1,0 --angular-velocity 0,0,5",
        "--velocity 0,-1 --angular-velocity 0,0,0"}) {
    const bool along_x = start.find("-1,0 ") != std::string::npos;
    for (const std::string route : {"reduced", "integrated"}) {
      const Run run =
          run_program("roll --ball pool --samples 7 --rolling-friction 0.01 --route " + route + " " + start);
      CAPTURE(start, route);
      const auto rows = rows_of(run.out);
      const auto header = std::ranges::find(rows, "t", [](const auto& row) { return row.front(); });
      REQUIRE(rows.end() - header == 8);
      for (auto row = header + 1; row != rows.end(); ++row) {
        for (const std::string& cell : *row) CHECK(cell != "-0");
        for (std::size_t i = 0; i < row->size(); ++i) {
          const std::string& name = (*header)[i];
          const bool across =
              along_x ? name == "y" || name == "vy" || name == "wx" : name == "x" || name == "vx" || name == "wy";
          if (across) CHECK((*row)[i] == "0");
        }
      }
    }
  }
}

TEST_CASE("roll and aim say that the built-in curling stone does not curl", "[cli]") {
  for (const std::string verb : {"roll", "aim --distance 20m --turns 3"}) {
    CHECK_THAT(run_program(verb + " --ball curling-stone").err, Contains("the curling stone does not curl here"));
    CHECK(run_program(verb + " --ball puck").err.empty());
  }
}
