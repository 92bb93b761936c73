#include <string>
#include <vector>

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

TEST_CASE("law by every name, by exponent and by table", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("flat.csv"), "# flat\nrho,pressure\n0,3\n0.5,3\n1,3\n");
  const auto phi = [](const std::string& law) {
    const Run run = run_program("law --k 0.5 --law " + law);
    INFO(law << ": " << run.err);
    REQUIRE(run.status == 0);
    return std::stod(rows_of(run.out).at(1).at(1));
  };
  CHECK(phi("punch") == Approx(0.39269908169872414).epsilon(1e-15));
  CHECK(phi("uniform") == phi("pressure:0"));
  CHECK(phi("pressure:0.5") == Approx(phi("exact")).epsilon(1e-15));
  CHECK(phi("pressure:-0.9999999999") == Approx(phi("ring")).epsilon(1e-8));
  CHECK(phi(scratch.file("flat.csv")) == Approx(phi("uniform")).epsilon(1e-15));
  CHECK(json_of("law --k 1 --law pressure:1.5 --format json").at("law") == "pressure:1.5");
}

TEST_CASE("an exponent or a name that is no law", "[cli]") {
  for (const auto& [law, complaint] :
       {std::pair{"pressure:x", "'x'"}, {"pressure:-1", "ring"}, {"uniforn", "uniform"}, {"pressure", "pressure:P"}}) {
    check_rejected(std::string("law --k 1 --law ") + law, complaint);
    check_rejected(std::string("law --k 1 --law ") + law, law);
  }
}

TEST_CASE("a table that is no pressure", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string path = scratch.file("bad.csv");
  const std::pair<const char*, const char*> tables[] = {{"rho,pressure\n0.1,1\n1,1\n", ":2: "},
                                                        {"rho,pressure\n0,1\n0,1\n1,1\n", ":3: "},
                                                        {"rho,pressure\n0,1\n0.9,1\n", ":3: "},
                                                        {"rho,pressure\n0,1\n1.5,1\n", ":3: "},
                                                        {"rho,pressure\n0,1\n1,-1\n", ":3: "},
                                                        {"rho,pressure\n0,inf\n1,1\n", ":2: "},
                                                        {"rho,pressure\n0,0\n1,0\n", ":3: "},
                                                        {"rho,pressure\n0,1\n", ":1: "},
                                                        {"rho,p\n0,1\n1,1\n", ":1: "},
                                                        {"rho,pressure\n0,1\n1\n", ":3: "},
                                                        {"rho,pressure\n0,1\nnan,1\n", ":3: "},
                                                        {"", ":1: "},
                                                        {"rho,pressure\n0,1\n0.5,1\n0.4,1\n1,1\n", ":4: "},
                                                        {"rho,pressure\n0,1\n0.5,1\n0.5,2\n0.5,3\n1,1\n", ":5: "}};
  for (const auto& [text, line] : tables) {
    write_file(path, text);
    CAPTURE(text);
    check_rejected("stop --mu 0.1 --u0 1 --v0 1 --law " + path, path + line);
  }
  CHECK(run_program("law --k 1 --law " + scratch.file("missing.csv")).status == 4);
}

TEST_CASE("every verb takes every law", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("hat.csv"), "rho,pressure\n0,1\n0.3,4\n0.7,2\n1,0\n");
  for (const std::string& law :
       {std::string("uniform"), std::string("punch"), std::string("ring"), std::string("pressure:-0.3"),
        std::string("elliptic"), scratch.file("hat.csv"), std::string("phi=k/hypot(0.8,k);psi=0.64/hypot(0.8,k)")}) {
    const std::string start = " --mu 0.2 --u0 1 --v0 1 --law " + law;
    for (const std::string verb : {"stop", "check", "orbit"}) {
      const Run run = run_program(verb + start);
      INFO(verb << start << "\n" << run.out << run.err);
      CHECK(run.status == 0);
    }
    CHECK(run_program("portrait --mu 0.2 --law " + law + " -o " + scratch.file("p.json")).status == 0);
    CHECK(run_program("law --law " + law + " -o " + scratch.file("f.gp")).status == 0);
  }
}

TEST_CASE("a picture of a law shows that law; the paper's two are compared", "[cli]") {
  const auto curves = [](const std::string& arguments) {
    const std::string script = run_program("law " + arguments + " -o - --format gp").out;
    std::vector<std::string> shown;
    for (const std::string law : {"exact", "pade", "punch", "uniform", "ring"}) {
      if (script.find(law + "}' at") != std::string::npos) shown.push_back(law);
    }
    return shown;
  };
  CHECK(curves("") == std::vector<std::string>{"exact", "pade"});
  CHECK(curves("--law pade") == std::vector<std::string>{"exact", "pade"});
  CHECK(curves("--law punch") == std::vector<std::string>{"punch"});
  CHECK(curves("--law punch --surface") == std::vector<std::string>{"exact", "pade", "punch", "uniform", "ring"});
  CHECK_THAT(run_program("law --law punch -o - --format gp").out, !Contains("Zh98"));
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
