#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("portrait --facts prints the singular points of the paper's plane", "[cli]") {
  const auto facts = json_of("portrait --mu 0.3 --facts --format json");
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

TEST_CASE("portrait --facts excludes what it does not draw", "[cli]") {
  const auto rejected = [](const std::string& arguments, const std::string& words) {
    CAPTURE(arguments);
    const Run run = run_program("portrait " + arguments);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Contains(words));
  };
  rejected("--facts", "--mu missing");
  rejected("--mu 2 --facts", "0 < mu <= 1");
  rejected("--mu 0.3 --facts --window 1,1", "--window 1,1: --facts prints the whole plane");
  rejected("--mu 0.3 --facts --route closed", "--facts and --route exclude each other");
  rejected("--mu 0.3 --facts --format svg", "--format svg: unknown format");
  rejected("--mu 0.3 --facts --format csv --digits 3", "--digits 3: csv and json always have all digits");
  rejected("--mu 0.3 --digits 3", "--digits 3: a picture has no digits");
  rejected("--mu 0.3 --facts --law pad", "no such law");
}
