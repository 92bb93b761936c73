#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace {

const std::filesystem::path folder = std::filesystem::path(CONTENSOU_README).parent_path() / "src/site/cases";

std::string text_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::set<std::string> cases() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") names.insert(entry.path().stem());
  }
  return names;
}

std::string ball_of(const std::string& name) { return "--ball " + (folder / (name + ".toml")).string(); }

}  // namespace

TEST_CASE("reference motions are what both routes give, and have enough digits", "[route]") {
  CHECK(cases().size() == 10);
  for (const std::string& name : cases()) {
    INFO(name);
    const auto rows = rows_of(text_of(folder / (name + ".csv")));
    REQUIRE(rows.size() == 65);
    CHECK(rows[0] == std::vector<std::string>{"t", "x", "y", "vx", "vy", "wx", "wy", "wz"});
    std::string times;
    for (std::size_t i = 1; i < rows.size(); ++i) times += (i > 1 ? "," : "") + rows[i][0];
    const auto start = json_of("roll --format json --samples 2 " + ball_of(name));
    double speed = 0, turning = 0;  // largest speeds of the motion, as scales for differences
    for (const auto& v : start.at("velocity")) speed = std::hypot(speed, v.get<double>());
    for (const auto& w : start.at("angular_velocity")) turning = std::hypot(turning, w.get<double>());
    const double R = start.at("ball").at("radius").get<double>();
    speed = std::max(speed, R * turning);
    const double length = speed * start.at("t_stop").get<double>();
    const std::map<std::string, double> scales{{"t", 1e300},  {"x", length},     {"y", length},     {"vx", speed},
                                               {"vy", speed}, {"wx", speed / R}, {"wy", speed / R}, {"wz", speed / R}};
    // Steps treat a ball as held by resistance if its rolling speed is below 1e-9 of the speeds.
    const bool resisted = start.at("ball").value("rolling_friction", 0.0) > 0;
    for (const auto& [route, allowed] : {std::pair{"reduced", 1e-12}, {"integrated", resisted ? 1e-9 : 1e-10}}) {
      const auto motion = json_of(fmt::format("roll --format json --route {} {} --at {}", route, ball_of(name), times));
      double worst = 0;
      for (std::size_t column = 1; column < 8; ++column) {
        for (std::size_t i = 1; i < rows.size(); ++i) {
          const double here = motion.at(rows[0][column])[i - 1].get<double>();
          worst = std::max(worst, std::abs(std::stod(rows[i][column]) - here) / scales.at(rows[0][column]));
        }
      }
      CAPTURE(route, worst);
      CHECK(worst <= allowed);
    }
  }
}

TEST_CASE("the table of where reference motions end is what the program says", "[table]") {
  std::string table;
  for (const std::string& name : cases()) {
    const auto roll = json_of("roll --format json --samples 2 " + ball_of(name));
    const auto end =
        json_of(fmt::format("roll --format json {} --at {:.17g}", ball_of(name), roll.at("t_stop").get<double>()));
    const auto number = [&](const char* column) { return fmt::format("{:.10g}", end.at(column)[0].get<double>()); };
    const auto of = [&](const char* field) { return fmt::format("{:.10g}", roll.at(field).get<double>()); };
    const Run beside = run_program(fmt::format("check --format json {} --tolerance 1e-12 --against {}", ball_of(name),
                                               (folder / (name + ".csv")).string()));
    CHECK(beside.status == 0);
    std::map<std::string, double> off;
    const auto compared = nlohmann::json::parse(beside.out);
    for (const auto& model : compared.at("models"))
      off[model.at("model")] = 100 * std::max(model.at("slip").get<double>(), model.at("spin").get<double>());
    table +=
        fmt::format("| [{0}]({0}.toml), [csv]({0}.csv) | {1} | {2}, {3} | {4}, {5} | {6} | {7} | {8:.1f} | {9:.1f} |\n",
                    name, of("t_stop"), number("x"), number("y"), number("vx"), number("vy"), of("turns"),
                    of("slip_length"), off.at("textbook (uncoupled)"), off.at("elliptic"));
  }
  const std::string readme = text_of(folder / "README.md");
  const std::string head = "|---|---|---|---|---|---|---|---|\n";
  const auto begin = readme.find(head);
  REQUIRE(begin != std::string::npos);
  const auto first = begin + head.size();
  CHECK(readme.substr(first, readme.find("\n\n", first) + 1 - first) == table);
}
