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

TEST_CASE("check of one start, by one law and by both", "[cli]") {
  for (const std::string start : {"--mu 0.1 --u0 1 --v0 1", "--ball gel", "--mu 1 --u0 -1 --v0 1e-3",
                                  "--mu 0.1 --u0 0 --v0 1", "--mu 0.1 --u0 1 --v0 0"}) {
    const Run both = run_program("check " + start);
    INFO(start << "\n" << both.out << both.err);
    CHECK(both.status == 0);
    CHECK(count_rows(both.out, "FAIL") == 0);
    CHECK(count_words(both.out, "ok") == count_rows(both.out, "ok"));
    const int pade = count_rows(run_program("check --law pade " + start).out, "ok");
    const int exact = count_rows(run_program("check --law exact " + start).out, "ok");
    CHECK(pade >= 8);
    CHECK(exact >= 8);
    CHECK(count_rows(both.out, "ok") == pade + exact);
  }
}

TEST_CASE("check without a start", "[cli]") {
  const Run run = run_program("check");
  INFO(run.out);
  CHECK(run.status == 0);
  CHECK(count_rows(run.out, "ok") >= 16);
  for (const std::string law : {"exact", "pade "}) {
    for (const std::string route : {"(2.7) and (2.8) in beta", "(2.6) in tau"})
      CHECK_THAT(run.out, Contains(law + "  stop time: " + route + ", with a drive "));
  }
}

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

TEST_CASE("check as JSON and CSV", "[cli]") {
  const auto document = json_of("check --mu 0.1 --u0 1 --v0 1 --format json");
  CHECK(document.at("schema") == 1);
  REQUIRE(document.at("checks").size() >= 16);
  for (const auto& check : document.at("checks")) {
    CHECK(check.at("passed") == (check.at("measured").get<double>() <= check.at("allowed").get<double>()));
  }
  const Run csv = run_program("check --mu 0.1 --u0 1 --v0 1 --format csv");
  CHECK(csv.out.starts_with("law,check,measured,allowed,verdict\n"));
}

TEST_CASE("a table of the exact motion passes, to all digits", "[cli]") {
  for (const std::string start : {"--slip 2 --spin 50", "--slip 2 --spin 0", "--slip 0 --spin -50"}) {
    const std::string motion = run_program("roll --ball gel --samples 60 " + start).out;
    const Run run = run_program("check --ball gel --tolerance 1e-12 --against -", motion);
    INFO(start << "\n" << run.out << run.err);
    CHECK(run.status == 0);
    CHECK(count_rows(run.out, "ok") == 2);
    CHECK_THAT(run.out, Contains("nearest: exact\n"));
    CHECK(run_program("check --ball gel --law elliptic --tolerance 1e-12 --against -", motion).status ==
          (start == "--slip 2 --spin 50" ? 1 : 0));
  }
  const Run uniform = run_program("check --ball gel --tolerance 1e-12 --law exact --against -",
                                  run_program("roll --ball gel --law uniform").out);
  CHECK(uniform.status == 1);
  CHECK_THAT(uniform.out, Contains("nearest: uniform\n"));
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

TEST_CASE("a table is drawn against the law", "[cli]") {
  const std::string table = "t,slip,spin\n0,1,10\n1,0.2,9\n2,0,0\n";
  const Run run = run_program("check --ball pool --against - -o - --format svg", table);
  CHECK(run.status == 1);
  for (const char* words : {"<svg", "law exact", "nearest", "slip, m/s", "table"}) CHECK_THAT(run.out, Contains(words));
  check_rejected("check --ball pool -o check.svg", "a picture compares with a table: add --against FILE");
  check_rejected("check --ball pool --against - --size 80mm", "--size", table);
}

TEST_CASE("--slip and --spin are the start in place of the first row's", "[cli]") {
  const std::string motion = run_program("roll --ball pool --slip 2 --spin 50").out;
  CHECK(run_program("check --ball pool --slip 2 --against -", motion).status == 0);
  CHECK(run_program("check --ball pool --slip 3 --against -", motion).status == 1);
  CHECK(run_program("check --ball pool --spin 60 --against -", motion).status == 1);
}

TEST_CASE("mistakes in a table that is checked", "[cli]") {
  const std::vector<std::pair<std::string, std::string>> tables{
      {"", "<stdin>:1: empty input"},
      {"t,slip\n0,1\n", "<stdin>:1: no column is called 'spin'"},
      {"t,spin\n0,1\n", "<stdin>:1: no column is called 'slip': a motion has columns t (or time), slip and spin"},
      {"t,x,y,angle\n0,0,0,0\n0.1,0.2,0,3\n", "wx, wy, wz; 'contensou fit' reads positions and angles"},
      {"t,vx,vy,wx,wz\n0,1,0,0,0\n", "<stdin>:1: no column is called 'wy'"},
      {"t,vx,wx,wy,wz\n0,1,0,0,0\n", "<stdin>:1: no column is called 'vy'"},
      {"t,time,slip,spin\n0,0,1,1\n", "<stdin>:1: columns t and time are both there"},
      {"t,slip [kg],spin\n0,0,1\n", "<stdin>:1: column 'slip [kg]': 'kg' is no unit of it"},
      {"t,slip,slip [mm/s],spin\n0,0,0,1\n", "<stdin>:1: two columns are called 'slip'; one is allowed"},
      {"t,slip,spin\n", "<stdin>:1: two rows or more are needed, got 0"},
      {"t,slip,spin\n0,1,1\n", "<stdin>:2: two rows or more are needed, got 1"},
      {"t,slip,spin\n0,-1,1\n1,1,1\n", "<stdin>:2: slip: the start is a speed, 0 or more, got -1"},
      {"t,slip,spin\n0,1,1\n-1,1,1\n", "<stdin>:3: t: -1 is before 0 of the row above"},
      {"t,slip,spin\n0,1,1\n1,nan,1\n", "<stdin>:3: slip: 'nan' is not a finite number"},
      {"t,slip,spin\n0,1,1\n1,1\n", "<stdin>:3: 2 fields where the header has 3"},
      {"t,slip,spin\n\n0,0,0\n1,0,0\n", "<stdin>:3: the ball is at rest in the first row"},
      {"t,slip,spin\n0,1,1.7e308\n1,0,0\n", "<stdin>:2: the start: "},
  };
  for (const auto& [table, words] : tables)
    check_rejected("check --ball pool --radius 3 --patch-radius 1 --against -", words, table);
  CHECK(run_program("check --ball pool --against nosuch.csv").status == 4);
}
