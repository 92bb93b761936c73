// Estimates from films that need more than a line of awk. All other films are in transcripts/fit.txt.
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

/// Returns a film of the pool ball with errors: columns t, slip and spin, computed by `roll`.
std::string film(double slip_sd, double spin_sd, double rate, const std::string& options) {
  std::string instants;
  for (int i = 0; i <= 60; ++i) instants += fmt::format("{}{}", i == 0 ? "" : ",", i / rate);
  const auto roll = json_of("roll --ball pool --format json " + options + "--at " + instants);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::string text = "t,slip,spin\n";
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    text +=
        fmt::format("{},{},{}\n", roll["t"][i].get<double>(), roll["slip"][i].get<double>() + slip_sd * normal(random),
                    roll["wz"][i].get<double>() + spin_sd * normal(random));
  }
  return text;
}

/// Returns the JSON of a fit to a text.
nlohmann::json fit_of(const std::string& text, const std::string& options) {
  const Run run = run_program("fit - --ball pool --format json " + options, text);
  INFO(run.err);
  REQUIRE(run.status == 0);
  return nlohmann::json::parse(run.out);
}

double value(const nlohmann::json& fit, const char* name) { return fit.at(name).at("value"); }

}  // namespace

TEST_CASE("a slip that does not fade shows f - u_r only", "[cli][.full]") {
  std::string slip_alone = "t,slip\n";
  for (const auto& row : rows_of(film(0.001, 0.1, 400, "--rolling-friction 0.01 "))) {
    if (row[0] != "t" && std::stod(row[0]) < 0.1) slip_alone += row[0] + "," + row[1] + "\n";
  }
  const auto open = fit_of(slip_alone, "--noise slip=0.001 --rolling-friction 0.01");
  CHECK(open["rolling_friction"]["determined"] == false);
  CHECK(open["friction"]["low"].get<double>() == Approx(0.19).epsilon(0.02));
}

TEST_CASE("of a draw a fit with rolling friction says that it is none of its motions", "[cli][.full]") {
  const auto roll = json_of(
      "roll --ball pool --rolling-friction 0.01 --velocity 1,0 --angular-velocity 0,-20,50 --samples 60 --until 1 "
      "--format json");
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::string text = "t,x,y,spin\n";
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    text +=
        fmt::format("{},{},{},{}\n", roll["t"][i].get<double>(), roll["x"][i].get<double>() + 5e-4 * normal(random),
                    roll["y"][i].get<double>() + 5e-4 * normal(random), roll["wz"][i].get<double>() + normal(random));
  }
  const Run run = run_program("fit - --ball pool --rolling-friction 0.01 --noise x=0.0005,y=0.0005,spin=1", text);
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("turns against its sliding"));
}

TEST_CASE("a mark that turns more than half a turn between two pictures is followed, and that is said", "[cli]") {
  std::string instants;
  for (int i = 0; i <= 40; ++i) instants += fmt::format("{}{}", i == 0 ? "" : ",", i / 60.0);
  const std::string start = " --ball gel --slip 0.5 --spin 250 ";  // half a turn a picture is 60 pi = 188 rad/s
  const auto roll = json_of("roll --format json --samples 4001 --equidistant --until 0.6666666666666667" + start);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::string text = "t,x,y,angle [deg]\n";
  double angle = 0;
  for (std::size_t i = 0; i < roll["t"].size(); ++i) {
    if (i > 0) {
      angle += (roll["wz"][i].get<double>() + roll["wz"][i - 1].get<double>()) / 2 *
               (roll["t"][i].get<double>() - roll["t"][i - 1].get<double>());
    }
    if (i % 100 != 0) continue;
    text += fmt::format("{},{},{},{}\n", roll["t"][i].get<double>(), roll["x"][i].get<double>() + 3e-4 * normal(random),
                        roll["y"][i].get<double>() + 3e-4 * normal(random),
                        std::remainder(angle + 0.02 * normal(random), 2 * M_PI) * 180 / M_PI);
  }
  const Run run = run_program("fit - --ball gel --format json", text);
  INFO(run.err);
  CHECK(run.status == 0);
  const auto fit = nlohmann::json::parse(run.out);
  CHECK(value(fit, "spin") == Approx(250).epsilon(0.02));
  CHECK(value(fit, "friction") == Approx(0.5).epsilon(0.3));
  CHECK(fit["tracks"][0]["half_turn_spin"].get<double>() == Approx(60 * M_PI).epsilon(1e-6));
  CHECK_THAT(run_program("fit - --ball gel", text).out, Contains("more than half a turn between two pictures"));
  CHECK_THAT(run_program("fit --plan --fps 60 --until 0.3 --noise x=0.3mm,angle=2deg" + start).out,
             Contains("up to a spin of 188.5 rad/s"));
}

TEST_CASE("a puck by x and y has two motions that fit, and both are told", "[cli]") {
  const std::string film_of_it = read_file(CONTENSOU_PUCK_FILM);
  const std::string options = "--ball puck --noise x=0.002,y=0.002 ";
  const auto fit = nlohmann::json::parse(run_program("fit - --format json " + options, film_of_it).out);
  CHECK(value(fit, "spin") == Approx(64).epsilon(0.01));
  REQUIRE(fit["tracks"][0]["other_spins"].size() == 1);
  CHECK(fit["tracks"][0]["other_spins"][0].get<double>() == Approx(27.4).epsilon(0.02));
  CHECK(fit["friction"]["low"].get<double>() < 0.0985);
  CHECK(fit["friction"]["high"].get<double>() > 0.134);
  CHECK(fit["spin"]["low"].get<double>() < 27);
  CHECK_THAT(run_program("fit - " + options, film_of_it).out, Contains("another motion fits as well: friction 0.098"));
}
