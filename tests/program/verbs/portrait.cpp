#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("portrait --facts prints the singular points of the paper's plane", "[cli]") {
  const auto facts = json_of("portrait --law pade --mu 0.3 --facts --format json");
  CHECK(facts["schema"] == 1);
  CHECK(facts["law"] == "pade");
  CHECK(facts["limit"] == "zero");
  CHECK(facts["mu_low"].get<double>() == Approx(std::sqrt(2.8)));
  CHECK(facts["mu_high"].get<double>() == Approx(std::sqrt(7.0)));
  CHECK(facts["tangent"] == "v = 0");
  CHECK(facts["contact_order"].get<double>() == Approx(14 / (5 * 0.09) - 1));
  const auto& points = facts["singular_points"];
  REQUIRE(points.size() == 4);
  const auto check = [&](int index, const char* half_line, const char* place, const char* kind, double radial) {
    CHECK(points[index]["half_line"] == half_line);
    CHECK(points[index]["place"] == place);
    CHECK(points[index]["kind"] == kind);
    CHECK(points[index]["separatrix"] == (std::string(kind) == "saddle"));
    CHECK(points[index]["eigenvalues"]["radial"].get<double>() == Approx(radial));
  };
  check(0, "v = 0", "origin", "stable node", -40 * 0.027);
  check(1, "v = 0", "infinity", "saddle", 40 * 0.027);
  check(2, "u = 0", "origin", "saddle", -105 * std::acos(-1.0));
  check(3, "u = 0", "infinity", "unstable node", 105 * std::acos(-1.0));
  CHECK(points[0]["eigenvalues"]["angular"].get<double>() == Approx(-0.3 * 8 * (14 - 5 * 0.09)));
  CHECK(points[2]["k"] == "inf");
}

TEST_CASE("portrait --facts prints the same as a table and as text, for a ball too", "[cli]") {
  const auto rows = rows_of(run_program("portrait --ball pool --facts --format csv").out);
  CHECK(rows.size() == 5);
  CHECK(rows[0] == std::vector<std::string>{"half_line", "place", "k", "q", "radial", "angular", "kind", "separatrix"});
  CHECK(rows[1][6] == "stable node");
  CHECK(rows[2][7] == "yes");
  const Run text = run_program("portrait --ball pool --law exact --facts --digits 4");
  CHECK(text.status == 0);
  CHECK(text.err.empty());
  CHECK_THAT(text.out, Contains("law    exact") && Contains("1.673 < mu < 2.646") && Contains("along v = 0"));
  const TemporaryDirectory scratch;
  CHECK(run_program("portrait --mu 1 --facts -o " + scratch.file("facts")).out.empty());
  CHECK(read_file(scratch.file("facts")) == run_program("portrait --mu 1 --facts").out);
  CHECK(scratch.names() == std::vector<std::string>{"facts"});
}

TEST_CASE("portrait writes every view as script, as LaTeX and as data", "[cli]") {
  const TemporaryDirectory scratch;
  for (const std::string& view : names_in_help("views")) {
    CAPTURE(view);
    const std::string start = "portrait --mu 0.3 --view " + view + " -o ";
    const Run script = run_program(start + scratch.file("p.gp"));
    CHECK(script.status == 0);
    CHECK(script.out.empty());
    CHECK(script.err == "wrote " + scratch.file("p.gp") + "\n");
    CHECK_THAT(read_file(scratch.file("p.gp")), Contains("set terminal svg"));
    CHECK(run_program(start + scratch.file("p.tex")).status == 0);
    CHECK_THAT(read_file(scratch.file("p.tex")), Contains("\\begin{tikzpicture}"));
    CHECK(json_of(start + "- --format json")["view"] == view);
    CHECK(run_program(start + "- --format gp").out == read_file(scratch.file("p.gp")));
  }
}

TEST_CASE("portrait shows what its switches say", "[cli]") {
  const auto json = json_of(
      "portrait --mu 0.3 --orbits 4 --isochrones 0 --through 0.5,1 "
      "--through -0.25,2 --against exact --format json -o -");
  CHECK(json["orbits"].size() == 8);
  CHECK(json["isochrones"].empty());
  CHECK(json["through"].size() == 2);
  CHECK(json["through"][1]["u"][0].get<double>() < 0);
  CHECK(json["against"]["law"] == "exact");
  CHECK(json_of("portrait --mu 0.3 --isochrones --format json -o -")["isochrones"].size() ==
        json_of("portrait --mu 0.3 --format json -o -")["isochrones"].size());
  const auto script = [](const std::string& options) {
    const Run run = run_program("portrait --mu 0.3 -o - --format gp " + options);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    return run.out;
  };
  CHECK_THAT(script("--field"), Contains("direction of the motion (2.6)"));
  CHECK_THAT(script("--field regularised"), Contains("direction of the regularised motion (2.7)"));
  CHECK_THAT(script("--axes off"), !Contains("invariant axes"));
  CHECK_THAT(script("--arrows none"), !Contains("with vectors"));
  CHECK_THAT(script("--colour none"), Contains("'{/*1 orbits}'"));
  CHECK_THAT(script("--style screen"), Contains("background '#10141c'"));
  CHECK_THAT(script("--size 100x80"), Contains("size 500,400"));
  CHECK_THAT(script("--size single"), Contains("size 425,"));
  CHECK_THAT(script("--size double"), Contains("size 850,"));
  // Three panels stand one above the other: the figure is 1.5 times as high as wide. A size of the user is kept.
  CHECK_THAT(script("--view regularised --size single"), Contains("size 425,647"));
  CHECK_THAT(script("--view regularised --size 85x180"), Contains("size 425,900"));
  CHECK_THAT(script("--view regularised --size double"), Contains("size 850,"));
  CHECK_THAT(script("--title none"), !Contains("Sliding and spinning"));
  CHECK_THAT(script("--title a_b"), Contains("{/*1.2 a\\_b}") && !Contains("slip falls first"));
  CHECK_THAT(script(""), Contains("slip falls first"));
  CHECK_THAT(script("--view time --estimate"), Contains("estimate for small"));
  CHECK_THAT(script("--view time"), !Contains("estimate for small"));
  CHECK_THAT(script("--scale linear"), !Contains("slip falls first"));
  // Equal input gives equal bytes.
  CHECK(script("--view disc") == script("--view disc"));
  // A portrait of a ball has axes in the units of the ball.
  CHECK_THAT(run_program("portrait --ball pool --view patch --format gp -o -").out, Contains("m/s") && Contains(", s"));
}

TEST_CASE("k of an orbit's last points is 0, or what is left of it", "[cli]") {
  const auto portrait =
      json_of("portrait --ball pool --slip 4 --spin 104.98687664041995 --law exact -o - --format json");
  const auto& orbit = portrait.at("orbits").at(0);
  const auto k = orbit.at("k").get<std::vector<double>>();
  CHECK(k.front() > 1);
  CHECK(k.back() == 0);
  for (std::size_t i = 1; i < k.size(); ++i) CHECK((k[i] < k[i - 1] || k[i] == 0));
}

TEST_CASE("portrait draws any planar system that has a scaling", "[cli]") {
  // The twisting controller combines dry friction and a relay. From (0, v0) a motion comes to rest after v0 (1/(a + b)
  // + q/(a - b))/(1 - q) with q^2 = (a - b)/(a + b).
  const std::vector<std::string> twisting{
      "portrait", "--system", "u' = v; v' = -a*sign(u) - b*sign(v)", "--param", "a=1", "--param", "b=0.5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), twisting.begin(), twisting.end());
    return run_program(more);
  };
  const Run run = with({"--u0", "0", "--v0", "1", "--format", "json", "-o", "-"});
  REQUIRE(run.status == 0);
  CHECK(run.err.empty());
  const auto json = nlohmann::json::parse(run.out);
  CHECK(json["kind"] == "stable focus");
  CHECK(json["system"] == twisting[2]);
  const double q = std::sqrt(1.0 / 3);
  CHECK(json["highlight"][0]["tau_left"][0].get<double>() == Approx((1 / 1.5 + q / 0.5) / (1 - q)).epsilon(1e-12));
  CHECK(json["isochrones"].size() >= 4);
  CHECK(json["orbits"].size() >= 10);
  const Run csv = with({"--window", "-1:2,0:1", "--orbits", "3", "--isochrones", "0", "--format", "csv", "-o", "-"});
  CHECK_THAT(csv.out, Contains("# window: [[-1, 2], [0, 1]]\n") && Contains("\nkind,index,u,v,tau\norbit,0,"));
  const Run script = with({"--through", "-0.5,-1", "--field", "--format", "gp", "-o", "-"});
  CHECK(script.status == 0);
  CHECK_THAT(script.out, Contains("through the points given") && Contains("direction of the motion"));
}

TEST_CASE("portrait draws the curves on which the inverse integrating factor vanishes", "[cli]") {
  const auto invariant = [](const char* system) {
    const auto json = nlohmann::json::parse(run_program({"portrait", "--system", system, "--window", "2,1.5",
                                                         "--orbits", "3", "--format", "json", "-o", "-"})
                                                .out);
    return json.value("invariant", nlohmann::json::array());
  };
  const nlohmann::json cycle = invariant("u' = -v+u*(1-u^2-v^2); v' = u+v*(1-u^2-v^2)");
  REQUIRE(cycle.size() == 1);
  REQUIRE(cycle[0]["u"].size() > 300);
  for (std::size_t i = 0; i < cycle[0]["u"].size(); ++i) {
    CHECK(std::hypot(cycle[0]["u"][i].get<double>(), cycle[0]["v"][i].get<double>()) == Approx(1).epsilon(1e-8));
  }
  const nlohmann::json axes = invariant("u' = u*(1-v); v' = v*(u-1)");
  REQUIRE_FALSE(axes.empty());
  double longest = 0;
  for (const nlohmann::json& line : axes) {
    for (std::size_t i = 0; i < line["u"].size(); ++i) {
      const double u = line["u"][i], v = line["v"][i];
      CHECK(std::min(std::abs(u), std::abs(v)) < 1e-8);
      longest = std::max(longest, std::abs(u) + std::abs(v));
    }
  }
  CHECK(longest == Approx(2).epsilon(0.02));
  CHECK(invariant("x'' = -sin(x)").empty());
  CHECK(invariant("u' = v; v' = (1-u^2)*v-u").empty());
  const Run script = run_program({"portrait", "--system", "u' = u*(1-v); v' = v*(u-1)", "--format", "gp", "-o", "-"});
  CHECK_THAT(script.out, Contains("invariant curves: V = 0"));
}

TEST_CASE("portrait draws fields without a scaling, by quadrature or by steps", "[cli]") {
  const auto drawn = [](const char* system) {
    return nlohmann::json::parse(
        run_program({"portrait", "--system", system, "--window", "4,3", "--orbits", "6", "--format", "json", "-o", "-"})
            .out);
  };
  const nlohmann::json pendulum = drawn("x'' = -sin(x)");
  CHECK(pendulum["form"] == "constant");
  REQUIRE(pendulum["equilibria"].size() == 3);
  CHECK(pendulum["equilibria"][0]["u"].get<double>() == Approx(-3.14159265358979324).epsilon(1e-14));
  CHECK(pendulum["equilibria"][0]["kind"] == "saddle");
  CHECK(pendulum["equilibria"][1]["kind"] == "center");
  CHECK(pendulum["equilibria"][1]["eigenvalues"][0][1].get<double>() == Approx(-1).epsilon(1e-12));
  REQUIRE(pendulum["separatrices"].size() >= 4);
  // The energy of an orbit is constant. On a separatrix it must equal the energy of the saddles.
  const auto energy = [](const nlohmann::json& orbit, std::size_t i) {
    return std::pow(orbit["v"][i].get<double>(), 2) / 2 - std::cos(orbit["u"][i].get<double>());
  };
  for (const nlohmann::json& orbit : pendulum["separatrices"]) {
    for (std::size_t i = 1; i + 1 < orbit["u"].size(); i += 7) CHECK(energy(orbit, i) == Approx(1).epsilon(1e-9));
  }
  for (const nlohmann::json& orbit : pendulum["orbits"]) {
    for (std::size_t i = 1; i + 1 < orbit["u"].size(); i += 7) {
      CHECK(energy(orbit, i) == Approx(energy(orbit, 1)).epsilon(1e-9));
    }
  }
  const nlohmann::json van_der_pol = drawn("u' = v; v' = (1-u^2)*v-u");
  CHECK(van_der_pol["form"].is_null());
  CHECK(van_der_pol["orbits"].size() >= 6);
  REQUIRE(van_der_pol["equilibria"].size() == 1);
  CHECK(van_der_pol["equilibria"][0]["kind"] == "unstable focus");
  const Run script = run_program({"portrait", "--system", "u' = v; v' = (1-u^2)*v-u", "--format", "gp", "-o", "-"});
  CHECK_THAT(script.out, Contains("no exact solution found: orbits by time steps"));
}
