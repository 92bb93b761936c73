#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
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

TEST_CASE("a law's name that is no UTF-8", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string file = scratch.file("bad\xFF.csv");
  write_file(file, "rho,pressure\n0,1\n1,0.5\n");
  const std::vector<std::vector<std::string>> commands{{"portrait", "--mu", "0.3", "-o", "-"},
                                                       {"stop", "--mu", "0.3", "--u0", "1", "--v0", "1"}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), {"--format", "json", "--law", file});
    const Run run = run_program(command);
    INFO(run.err);
    REQUIRE(run.status == 0);
    CHECK_THAT(nlohmann::json::parse(run.out).at("law").get<std::string>(), Contains("bad\xEF\xBF\xBD.csv"));
  }
}

namespace {

const std::string pade_by_formulas = "phi = a*k/(8 + a*k); psi = a/(16 + 5*a*k)";

std::vector<std::string> with_law(std::vector<std::string> arguments, const std::string& law) {
  arguments.insert(arguments.end(), {"--law", law});
  return arguments;
}

}  // namespace

TEST_CASE("a law typed in as formulas gives the numbers of the law that it is", "[cli]") {
  const auto stop_time = [](std::vector<std::string> start, const std::vector<std::string>& law) {
    start.insert(start.begin(), {"stop", "--format", "json"});
    start.insert(start.end(), law.begin(), law.end());
    const Run run = run_program(start);
    INFO(run.err);
    REQUIRE(run.status == 0);
    return nlohmann::json::parse(run.out)["tau_stop"].get<double>();
  };
  const std::vector<std::string> typed{"--law", pade_by_formulas, "--param", "a=9.42477796076937972"};
  for (const std::vector<std::string>& start : {std::vector<std::string>{"--mu", "0.3", "--u0", "1", "--v0", "1"},
                                                {"--mu", "1", "--u0", "-2", "--v0", "1e-5"},
                                                {"--mu", "0.01", "--u0", "3", "--v0", "0.2"},
                                                {"--body", "disc", "--u0", "1", "--v0", "3"},
                                                {"--mu", "0.3", "--u0", "0", "--v0", "2"},
                                                {"--ball", "pool"}}) {
    const double wanted = stop_time(start, {"--law", "pade"});
    CHECK(stop_time(start, typed) == Approx(wanted).epsilon(1e-13));
    for (const std::string route : {"regularised", "direct"}) {
      std::vector<std::string> stepped = typed;
      stepped.insert(stepped.end(), {"--route", route});
      CHECK(stop_time(start, stepped) == Approx(wanted).epsilon(1e-8));
    }
  }
  const Run batch = run_program({"sweep", "--mu", "0.3", "--u0", "0:1:40", "--v0", "0:1:40", "--threads", "4", "--law",
                                 pade_by_formulas, "--param", "a=9.42477796076937972", "-o", "-", "--format", "csv"});
  CHECK(batch.status == 0);
  const auto rows = rows_of(batch.out),
             own = rows_of(run_program("sweep --mu 0.3 --u0 0:1:40 --v0 0:1:40 --law pade -o - --format csv").out);
  REQUIRE(rows.size() == 1601);
  for (std::size_t i = 1; i < rows.size(); ++i)
    CHECK(std::stod(rows[i][3]) == Approx(std::stod(own[i][3])).epsilon(1e-12));
  CHECK_THAT(run_program(with_law({"law", "--k", "0,inf"}, "psi = 1/(2+k); phi = k/(2 + k)")).out,
             Contains("0,0,0.5\ninf,1,0\n"));
}
