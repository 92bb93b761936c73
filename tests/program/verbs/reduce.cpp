#include <cmath>
#include <string>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "reference_table.hpp"
#include "run_program.hpp"

namespace {

using Json = nlohmann::json;

Json json_of_system(const std::string& system, const std::string& u0, const std::string& v0) {
  const Run run = run_program({"reduce", "--system", system, "--u0=" + u0, "--v0=" + v0, "--format", "json"});
  INFO(system << run.err);
  CHECK(run.err.empty());
  CHECK((run.status == 0 || run.status == 1));
  return Json::parse(run.out);
}

}  // namespace

TEST_CASE("reduce: the orbit as a curve of the strip, and the starts of its copies", "[cli]") {
  for (const std::string start :
       {"--mu 0.3 --u0 1 --v0 1", "--mu 1e-3 --u0 -2 --v0 5", "--body disc --mu 1 --u0 1 --v0 3"}) {
    INFO(start);
    const Json reduced = json_of("reduce " + start + " --format json");
    REQUIRE(reduced["strip"].size() == 1);
    const Json& strip = reduced["strip"][0];
    REQUIRE(strip["p"].size() >= 50);
    CHECK(strip["p"].size() <= 101);
    for (std::size_t i = 0; i < strip["p"].size(); ++i) {
      const double u = strip["u"][i], v = strip["v"][i], left = strip["tau_left"][i];
      if (strip["p"][i] < -700) {  // then v is near the least double and has few correct digits
        CHECK(v <= 1e-300);
        continue;
      }
      CHECK(std::log(v) == Approx(strip["p"][i].get<double>()).epsilon(1e-12).margin(1e-12));
      CHECK(std::log(v / (reduced["mu"].get<double>() * std::abs(u))) ==
            Approx(strip["ln_k"][i].get<double>()).epsilon(1e-12).margin(1e-12));
      if (i % 10 != 0) continue;
      const std::string there = fmt::format(" --u0 {} --v0 {} --format json", u, v);
      const Json other = json_of("reduce " + start.substr(0, start.find("--u0")) + there);
      CHECK(other["first_integral"].get<double>() ==
            Approx(reduced["first_integral"].get<double>()).epsilon(1e-10).margin(1e-10));
      CHECK(other["tau_stop"].get<double>() == Approx(left).epsilon(1e-13));
    }
    REQUIRE(reduced["copies"].size() == 6);
    for (const Json& copy : reduced["copies"]) {
      const double factor = copy["factor"];
      for (const char* name : {"u0", "v0", "tau_stop"}) {
        CHECK(copy[name].get<double>() == Approx(factor * reduced[name].get<double>()).epsilon(1e-13));
      }
    }
  }
  const Json weighted = json_of_system("u' = v; v' = -sign(u) - 0.5*sign(v)", "0.5", "1");
  for (const Json& piece : weighted["strip"]) CHECK(piece["q"].size() == piece["tau_left"].size());
  for (const Json& copy : weighted["copies"]) {  // v and t have the same weight, and u has twice this weight
    const double factor = copy["factor"];
    CHECK(copy["u0"].get<double>() == Approx(0.5 * factor).epsilon(1e-13));
    CHECK(copy["v0"].get<double>() == Approx(std::sqrt(factor)).epsilon(1e-13));
    CHECK(copy["tau_stop"].get<double>() ==
          Approx(std::sqrt(factor) * weighted["tau_stop"].get<double>()).epsilon(1e-12));
  }
  // Long before the start, speeds overflow.
  const Json far =
      json_of("reduce --mu 1 --law phi=k/hypot(1,k);psi=1/(1+2*k) --body disc --u0 1 --v0 3 --format json");
  CHECK(far["strip"][0]["u"].size() == far["strip"][0]["tau_left"].size());
  CHECK_FALSE(json_of("reduce --mu 0.3 --u0 0 --v0 1 --format json").contains("strip"));
}

TEST_CASE("planar systems with known answers, typed as formulas", "[cli][table]") {
  const auto text = [](const Json& json, const char* name) {  // a missing member and null mean "not decided"
    return json.contains(name) && json[name].is_string() ? json[name].get<std::string>() : "?";
  };
  for (const contensou::tests::ReferenceRow& row : contensou::tests::reference_table("planar_systems")) {
    const std::string& end = row.text("end");
    const Json json = json_of_system(row.text("system"), row.text("u0"), row.text("v0"));
    CAPTURE(row.text("system"), row.text("u0"), json.dump());
    CHECK(json.contains("undecided") == (row.text("kind") == "?" || end == "?"));
    if (!row.text("kind").empty()) {
      CHECK(text(json, "kind") == row.text("kind"));
      CHECK(json["rays"].size() == std::stoul(row.text("rays")));
    } else {
      CHECK(text(json, "form") == (row.text("form").empty() ? "?" : row.text("form")));
    }
    if (!end.empty()) CHECK(text(json, "end") == end);
    if (row.text("time").empty()) continue;
    if (end == "centre" && row.text("time") != "inf") {
      CHECK(json["tau_stop"].get<double>() == Approx(row.input("time")).epsilon(json["accuracy"].get<double>()));
    } else {
      CHECK(text(json, "tau_stop") == (end == "border" || end == "?" ? "?" : "inf"));
    }
    if (end == "periodic") CHECK(json["period"].get<double>() == Approx(row.input("time")).epsilon(1e-12));
  }
}
