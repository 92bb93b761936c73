#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/contact_cone.hpp"
#include "contensou/si/engine.hpp"
#include "run_program.hpp"

using namespace contensou;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Counts the rows of the table, the lines whose last word is a verdict.
int count_rows(const std::string& text, const std::string& verdict) {
  int rows = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) rows += line.ends_with(" " + verdict) ? 1 : 0;
  return rows;
}

int count_words(const std::string& text, const std::string& word) {
  int count = 0;
  std::istringstream words(text);
  for (std::string next; words >> next;) count += next == word ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("a law's name cannot break the table of check", "[cli]") {
  const TemporaryDirectory scratch;
  for (const std::string name : {"FAIL ok.csv", "two\nlines ok.csv", "FAILURE.csv", "ok", "a book on ok-FAIL.csv"}) {
    const std::string file = scratch.file(name);
    write_file(file, "rho,pressure\n0,1\n0.5,0.8\n1,0.1\n");
    const Run run =
        run_program(std::vector<std::string>{"check", "--mu", "0.3", "--u0", "1", "--v0", "1", "--law", file});
    INFO(run.out << run.err);
    CHECK(run.status == 0);
    CHECK(count_rows(run.out, "ok") >= 8);
    CHECK(count_words(run.out, "ok") == count_rows(run.out, "ok"));
    CHECK(run.out.find("FAIL") == std::string::npos);
    CHECK(count_rows(run.out, "ok") + 1 == std::ranges::count(run.out, '\n'));
    // At least one space stands between two columns.
    std::istringstream lines(run.out);
    std::string heading, row;
    std::getline(lines, heading);
    const std::size_t column = heading.find("check");
    while (std::getline(lines, row)) CHECK(row.substr(column - 2, 2) == "  ");
  }
}

TEST_CASE("a table of the textbook's motion leaves the exact one and is known for what it is", "[cli]") {
  // A motion computed by hand: slip falls at 7 f g/2, spin of this ball at 10 rad/s^2. The first row has t = 5 s.
  std::string table = "# made by hand\nspin, note,slip,t\n";
  for (int i = 0; i <= 100; ++i) {
    const double t = 11 * std::pow(i / 100.0, 3);
    table += fmt::format("{},a,{},{}\n", std::min(0.0, 10 * t - 100), std::max(0.0, 1 - 0.7 * 9.80665 * t), 5 + t);
  }
  const Run run = run_program("check --ball pool --against -", table);
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK(count_rows(run.out, "FAIL") == 2);
  CHECK(count_words(run.out, "FAIL") == 2);
  CHECK_THAT(run.out, Contains("nearest: textbook (uncoupled)\n"));

  const Run json = run_program("check --ball pool --format json --against -", table);
  const auto answer = nlohmann::json::parse(json.out);
  CHECK(json.status == 1);
  CHECK(answer.at("nearest") == "textbook (uncoupled)");
  CHECK(answer.at("start").at("spin") == -100);
  for (const auto& model : answer.at("models")) {
    const double off = std::max(model.at("slip").get<double>(), model.at("spin").get<double>());
    CHECK((off < 1e-14) == (model.at("model") == "textbook (uncoupled)"));
  }
  // The errors must be the differences from the motion that `roll` computes.
  const auto& slip = answer.at("checks").at(0);
  const double t = slip.at("t").get<double>() - 5;
  const auto exact = json_of(fmt::format("roll --ball pool --spin -100 --format json --at {:.17g}", t));
  CHECK(slip.at("error").get<double>() ==
        Approx(exact.at("slip").at(0).get<double>() - std::max(0.0, 1 - 0.7 * 9.80665 * t)).epsilon(1e-9));
  CHECK(slip.at("measured") == slip.at("error"));
  CHECK(slip.at("leaves") < slip.at("t"));
  const double leaves = slip.at("leaves").get<double>();
  const std::string tolerance = fmt::format(" --tolerance {:.17g} ", slip.at("measured").get<double>());
  const Run allowed = run_program("check --ball pool --format csv --against -" + tolerance, table);
  CHECK(allowed.status == 0);
  CHECK_THAT(allowed.out, StartsWith("law,check,measured,allowed,verdict,error,t,leaves,nearest\n") &&
                              Contains(",inf,textbook (uncoupled)\n"));
  const auto there = json_of(fmt::format("roll --ball pool --spin -100 --format json --at {:.17g}", leaves - 5));
  CHECK(there.at("slip").at(0).get<double>() - std::max(0.0, 1 - 0.7 * 9.80665 * (leaves - 5)) > 0.01);
}

TEST_CASE("an engine's pyramid is known for what it is", "[cli]") {
  si::Experiment ball = si::find_ball("pool")->experiment;
  ball.start = si::SlipAndSpin{1, 100};
  const double arm = si::contact_of(ball, reduction::HertzLaw{}).moment_arm();
  std::string table = "t,slip,spin\n";
  for (int i = 0; i <= 50; ++i) {
    const double t = i / 4.0;
    const auto [slip, spin] = si::speeds_under_pyramid(ball, arm, t);
    table += fmt::format("{},{},{}\n", t, slip, spin);
  }
  const Run run = run_program("check --ball pool --against -", table);
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  CHECK_THAT(run.out, Contains("nearest: pyramid (engines)\n"));
}

TEST_CASE("the log of a rigid body is a motion, too, in any units", "[route]") {
  // Returns the log of a motion (swerving balls, a puck) that `roll` computes in steps. The log has no column of slip.
  const auto log_of = [](const std::string& ball, bool lies_flat, double time_unit, double speed, double turning) {
    const auto json = json_of("roll --route integrated --format json --samples 80 " + ball);
    std::string table = lies_flat ? "time [ms],x,y,vx [mm/s],vy [mm/s],wz [rpm]\n"
                                  : "time [ms],x,y,vx [mm/s],vy [mm/s],wx [rpm],wy [rpm],wz [rpm]\n";
    for (std::size_t i = 0; i < json.at("t").size(); ++i) {
      const auto at = [&](const char* name) { return json.at(name)[i].get<double>(); };
      table +=
          fmt::format("{:.17g},{},{},{:.17g},{:.17g},", time_unit * at("t"), 0, 0, speed * at("vx"), speed * at("vy"));
      if (!lies_flat) table += fmt::format("{:.17g},{:.17g},", turning * at("wx"), turning * at("wy"));
      table += fmt::format("{:.17g}\n", turning * at("wz"));
    }
    return table;
  };
  const double rpm = 30 / std::acos(-1.0);
  for (const std::string start : {"--ball gel --velocity 1,0.3 --angular-velocity 20,-50,100",
                                  "--ball gel --velocity 1,2 --angular-velocity 10,0,0", "--ball puck"}) {
    const bool puck = start == "--ball puck";
    const std::string ball = puck ? "puck" : "gel";
    INFO(start);
    const Run run =
        run_program("check --tolerance 1e-9 --against - --ball " + ball, log_of(start, puck, 1e3, 1e3, rpm));
    INFO(run.out << run.err);
    CHECK(run.status == 0);
    CHECK_THAT(run.out, Contains(puck ? "nearest: uniform" : "nearest: exact"));
    // A table whose numbers are read in wrong units shows another motion.
    CHECK(run_program("check --against - --ball " + ball, log_of(start, puck, 1e3, 1e3, 1.1 * rpm)).status == 1);
  }
  // The slip belongs to the contact point and not to the centre: a rolling ball has no slip.
  const auto rolls = nlohmann::json::parse(
      run_program("check --format json --ball pool --against -",
                  "t,vx,vy,wx,wy,wz\n0,1,0,0,34.995625546806649,10\n1,1,0,0,34.995625546806649,0\n")
          .out);
  CHECK(rolls.at("start").at("slip") == 0);
  CHECK(rolls.at("start").at("spin") == 10);
}

TEST_CASE("a log in other axes or units resembles no model, and its reading is named", "[cli]") {
  constexpr double degree = std::numbers::pi / 180;
  struct Unit {
    std::string words;
    double size;
  };
  int unlike = 0;
  for (const std::string ball : {"gel", "puck"}) {
    const std::string start =
        ball == "gel" ? "--velocity 1,0.3 --angular-velocity 20,-50,100" : "--velocity 1,0.5 --angular-velocity 0,0,40";
    const auto json = json_of("roll --format json --samples 60 --ball " + ball + " " + start);
    for (const auto& [y_up, reversed] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
      for (const Unit& unit : {Unit{"", 1}, {"in degrees/s", degree}, {"in rpm", 6 * degree}}) {
        std::string table = "t,vx,vy,vz,wx,wy,wz\n";
        for (std::size_t i = 0; i < json.at("t").size(); ++i) {
          const auto at = [&](const char* name) { return json.at(name)[i].get<double>(); };
          const double turn = (reversed ? -1 : 1) / unit.size, wx = turn * at("wx"), wy = turn * at("wy");
          const double wz = turn * at("wz");
          table += y_up ? fmt::format("{},{},0,{},{},{},{}\n", at("t"), at("vx"), -at("vy"), wx, wz, -wy)
                        : fmt::format("{},{},{},0,{},{},{}\n", at("t"), at("vx"), at("vy"), wx, wy, wz);
        }
        INFO(ball << ": " << y_up << reversed << unit.words);
        const Run run = run_program("check --format json --against - --ball " + ball, table);
        const auto answer = nlohmann::json::parse(run.out);
        // The sense in which a puck turns about the vertical changes nothing.
        const bool other = y_up || (reversed && ball == "gel") || unit.size != 1;
        CHECK(run.status == (other ? 1 : 0));
        REQUIRE(answer.contains("reading") == other);
        double least = 1e300;
        for (const auto& model : answer.at("models"))
          least = std::min(least, std::max(model.at("slip").get<double>(), model.at("spin").get<double>()));
        CHECK((answer.at("nearest") == "none") == (least > 0.3));
        unlike += least > 0.3 ? 1 : 0;
        if (!other) continue;
        const std::string reading = answer.at("reading");
        INFO(reading);
        CHECK((reading.find("y up") != std::string::npos) == y_up);
        if (ball == "gel") CHECK((reading.find("left-handed") != std::string::npos) == reversed);
        for (const std::string each : {"in degrees/s", "in rpm"})
          CHECK((reading.find(each) != std::string::npos) == (each == unit.words));
        CHECK_THAT(
            run_program("check --against - --ball " + ball, table).out,
            Contains(reading) && (least > 0.3 ? Contains("nearest: none; the best model, ") : Contains("nearest")));
        // A unit in a heading is never doubted.
        std::string named = table;
        for (const std::string name : {"wx", "wy", "wz"}) named.replace(named.find(name), 2, name + " [rad/s]");
        const auto with_units =
            nlohmann::json::parse(run_program("check --format json --against - --ball " + ball, named).out);
        CHECK(with_units.contains("reading") == (other && unit.size == 1));
      }
    }
  }
  CHECK(unlike > 10);
}
