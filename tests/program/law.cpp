#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "run_program.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("law at given ratios, 0 and infinity included", "[cli]") {
  const auto rows = rows_of(run_program("law --law exact --k 2,0,inf,0.5").out);
  REQUIRE(rows.size() == 5);
  CHECK(rows[0] == std::vector<std::string>{"k", "phi", "psi"});
  CHECK(rows[1][0] == "2");
  CHECK(std::stod(rows[1][1]) == HertzLaw{}({2, 1}).force);
  CHECK(std::stod(rows[1][2]) == HertzLaw{}({2, 1}).moment);
  CHECK(rows[2][1] == "0");
  CHECK(rows[3] == std::vector<std::string>{"inf", "1", "0"});
}

TEST_CASE("law at the ratios of a table", "[cli]") {
  const Run run = run_program("law --batch -", "name,k\na,inf\nb,0\n");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, StartsWith("k,phi,psi\ninf,1,0\n0,0,"));
  for (const std::string k : {"-1", "nan", "x", ""}) {
    const Run bad = run_program("law --batch -", "k,n\n1,a\n" + k + ",b\n");
    INFO(k);
    CHECK(bad.status == 2);
    CHECK(bad.out.empty());
    CHECK_THAT(bad.err, StartsWith("<stdin>:3: k: "));
  }
}

TEST_CASE("law as JSON, asked for or by the file's ending", "[cli]") {
  const auto law = json_of("law --k 1,inf --format json");
  CHECK(law.at("schema") == 1);
  CHECK(law.at("law") == "pade");
  CHECK(law.at("k").at(1) == "inf");
  CHECK(law.at("phi").at(1) == 1);
  const TemporaryDirectory scratch;
  CHECK(run_program("law --k 1,inf -o " + scratch.file("law.json")).status == 0);
  CHECK(nlohmann::json::parse(read_file(scratch.file("law.json"))) == law);
  CHECK(run_program("law --k 1 -o " + scratch.file("law.csv")).status == 0);
  CHECK_THAT(read_file(scratch.file("law.csv")), StartsWith("k,phi,psi\n1,"));
}
