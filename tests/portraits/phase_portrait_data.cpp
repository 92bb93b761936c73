#include "contensou/portraits/phase_portrait_data.hpp"

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "contensou/reduction/pade_law.hpp"

using namespace contensou;

namespace {

portraits::PhasePortrait sample() {
  portraits::PortraitRequest request;
  request.highlight = reduction::State{-1, 2};
  return portraits::phase_portrait({reduction::PadeLaw{}, 0.3}, request);
}

std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

}  // namespace

TEST_CASE("JSON has the documented fields, and its numbers read back to the same doubles", "[table]") {
  const auto portrait = sample();
  const auto json = nlohmann::json::parse(portraits::to_json(portrait));
  CHECK(json["schema"] == 1);
  CHECK(json["law"] == "pade");
  CHECK(json["mu"] == 0.3);
  CHECK(json["view"] == "uv");
  CHECK(json["window"] == std::vector<double>{portrait.window.u, portrait.window.v});
  REQUIRE(json["orbits"].size() == portrait.orbits.size());
  CHECK(json["orbits"][3]["u"].get<std::vector<double>>() == list(portrait.orbits[3].u));
  CHECK(json["orbits"][3]["v"].get<std::vector<double>>() == list(portrait.orbits[3].v));
  CHECK(json["orbits"][3]["tau_left"].get<std::vector<double>>() == list(portrait.orbits[3].tau_left));
  REQUIRE(json["isochrones"].size() == portrait.isochrones.size());
  CHECK(json["isochrones"][1]["tau_stop"] == portrait.isochrones[1].tau_stop);
  CHECK(json["isochrones"][1]["u"].get<std::vector<double>>() == list(portrait.isochrones[1].u));
  CHECK(json["highlight"]["v"].get<std::vector<double>>() == list(portrait.highlight->v));
  CHECK(portraits::to_json(portrait).find("null") == std::string::npos);
}

TEST_CASE("CSV has one row for each point", "[table]") {
  const auto portrait = sample();
  std::istringstream csv(portraits::to_csv(portrait));
  std::string line;
  std::getline(csv, line);
  CHECK(line == "kind,index,u,v,tau");
  std::map<std::string, Eigen::Index> rows;
  while (std::getline(csv, line)) ++rows[line.substr(0, line.find(','))];
  std::map<std::string, Eigen::Index> wanted;
  for (const auto& orbit : portrait.orbits) wanted["orbit"] += orbit.u.size();
  for (const auto& isochrone : portrait.isochrones) wanted["isochrone"] += isochrone.u.size();
  wanted["highlight"] = portrait.highlight->u.size();
  CHECK(rows == wanted);
}
