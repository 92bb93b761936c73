#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/laws.hpp"

using namespace contensou;

namespace {

portraits::PhasePortrait saved_portrait() {
  return portraits::phase_portrait(
      {{reduction::PadeLaw{}, 0.3}},
      {.highlight = reduction::State{-1, 2}, .through = {{0.5, 1}, {0.25, 1}}, .comparison = reduction::HertzLaw{}});
}

std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

}  // namespace

TEST_CASE("JSON has the documented fields, and its numbers read back to the same doubles", "[table]") {
  const auto portrait = saved_portrait();
  const auto json = nlohmann::json::parse(portraits::to_json({portrait}));
  CHECK(json["schema"] == 1);
  CHECK(json["law"] == "pade");
  CHECK(json["mu"] == 0.3);
  CHECK(json["view"] == "uv");
  CHECK(json["window"] == std::vector<double>{portrait.window.u(), portrait.window.v()});
  REQUIRE(json["orbits"].size() == portrait.orbits.size());
  CHECK(json["orbits"][3]["u"].get<std::vector<double>>() == list(portrait.orbits[3].u));
  CHECK(json["orbits"][3]["v"].get<std::vector<double>>() == list(portrait.orbits[3].v));
  CHECK(json["orbits"][3]["tau_left"].get<std::vector<double>>() == list(portrait.orbits[3].tau_left));
  REQUIRE(json["isochrones"].size() == portrait.isochrones.size());
  CHECK(json["isochrones"][1]["tau_stop"] == portrait.isochrones[1].tau_stop);
  CHECK(json["isochrones"][1]["u"].get<std::vector<double>>() == list(portrait.isochrones[1].u));
  CHECK(json["highlight"]["v"].get<std::vector<double>>() == list(portrait.highlight[0].v));
  CHECK(json["body"]["chi"] == 3.5);
  CHECK(json["through"].size() == 2);
  CHECK(json["through"][1]["u"].get<std::vector<double>>() == list(portrait.through[1].u));
  CHECK(json["against"]["law"] == "exact");
  CHECK(json["against"]["orbits"][3]["v"].get<std::vector<double>>() == list(portrait.comparisons[0].orbits[3].v));
  CHECK(portraits::to_json({portrait}).find("null") == std::string::npos);
  CHECK(json["orbits"][3]["k"][0].get<double>() ==
        Approx(portrait.orbits[3].v[0] / (0.3 * std::abs(portrait.orbits[3].u[0]))));
  const auto of_ball = nlohmann::json::parse(portraits::to_json({portrait}, {"1.2", "red ball", 0.5}));
  CHECK((of_ball["version"] == "1.2" && of_ball["ball"] == "red ball" && of_ball["seconds_per_tau"] == 0.5));
}

TEST_CASE("In the view of beta each state of an orbit has its beta, as its axis has it", "[route]") {
  const reduction::Flow flow(reduction::HertzLaw{}, 0.3);
  const auto portrait =
      portraits::phase_portrait(flow, {.view = portraits::View::regularised, .highlight = reduction::State{-1, 2}});
  const portraits::PanelMap map = portraits::draw_mapped(portrait).maps.front();
  const auto json = nlohmann::json::parse(portraits::to_json({portrait}));
  std::istringstream csv(portraits::to_csv({portrait}));
  std::string line;
  while (std::getline(csv, line) && line.starts_with('#')) continue;
  CHECK(line == "kind,index,u,v,tau,ln_v,k,beta");
  const auto check = [&](const portraits::PortraitOrbit& orbit, const nlohmann::json& told, const std::string& kind) {
    REQUIRE(told["beta"].size() == static_cast<std::size_t>(orbit.rows()));
    CHECK(told["beta"][0] == 0);
    CHECK(told["beta"].back() == "inf");
    // The axis of the view shows 1 + (40 mu^3 |u0| + 105 pi v0) beta, from (R39) of reduction/numerics.md.
    const double rate = 40 * 0.027 * std::abs(orbit.u[0]) + 105 * 3.141592653589793 * orbit.v[0];
    for (Eigen::Index i = 0; i + 1 < orbit.rows(); ++i) {
      const double beta = told["beta"][static_cast<std::size_t>(i)];
      CHECK(1 + rate * beta == Approx(map.place(orbit.at(i), orbit.at(0)).x).epsilon(1e-8));
      if (!std::getline(csv, line)) FAIL("a row is missing");
      CHECK_THAT(line, Catch::StartsWith(kind) && Catch::EndsWith(fmt::format(",{}", beta)));
    }
    std::getline(csv, line);
    CHECK_THAT(line, Catch::EndsWith(",inf"));
  };
  for (std::size_t i = 0; i < portrait.orbits.size(); ++i) {
    check(portrait.orbits[i], json["orbits"][i], fmt::format("orbit,{},", i));
  }
  check(portrait.highlight[0], json["highlight"], "highlight,0,");
  for (const char* view : {"uv", "time"}) {
    const auto other = portraits::phase_portrait(flow, {.view = portraits::find_view(view)});
    CHECK(portraits::to_json({other}).find("beta") == std::string::npos);
  }
}

TEST_CASE("CSV says where it comes from, and has one row for each point", "[table]") {
  const auto portrait = saved_portrait();
  std::istringstream csv(portraits::to_csv({portrait}, {"1.2", "red ball", 0.5}));
  std::string line, remarks;
  while (std::getline(csv, line) && line.starts_with('#')) remarks += line + '\n';
  CHECK_THAT(remarks, Catch::StartsWith("# law: \"pade\"\n# mu: 0.3\n# body: {\"chi\": 3.5, \"gamma\": 2.5}\n"));
  CHECK_THAT(remarks, Catch::EndsWith("# version: \"1.2\"\n# ball: \"red ball\"\n# seconds_per_tau: 0.5\n"));
  CHECK(line == "kind,index,u,v,tau,ln_v,k,t");
  const portraits::PortraitOrbit& first = portrait.orbits[0];
  const double tau = first.tau_left[0];
  const auto row = fmt::format("orbit,0,{},{},{},{},{},{}", first.u[0], first.v[0], tau, first.ln_v[0],
                               std::exp(first.ln_k[0]), 0.5 * tau);
  CHECK(portraits::to_csv({portrait}, {"", "b", 0.5}).find("k,t\n" + row + "\n") != std::string::npos);
  std::map<std::string, Eigen::Index> rows;
  while (std::getline(csv, line)) ++rows[line.substr(0, line.find(','))];
  std::map<std::string, Eigen::Index> wanted;
  for (const auto& orbit : portrait.orbits) wanted["orbit"] += orbit.u.size();
  for (const auto& isochrone : portrait.isochrones) wanted["isochrone"] += isochrone.u.size();
  for (const auto& orbit : portrait.through) wanted["through"] += orbit.u.size();
  for (const auto& orbit : portrait.comparisons[0].orbits) wanted["against_orbit"] += orbit.u.size();
  for (const auto& isochrone : portrait.comparisons[0].isochrones) wanted["against_isochrone"] += isochrone.u.size();
  wanted["highlight"] = portrait.highlight[0].u.size();
  CHECK(rows == wanted);
}
