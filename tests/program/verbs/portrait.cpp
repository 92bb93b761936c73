#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("terminal prints the answer of portrait --facts", "[cli]") {
  for (const std::string format : {"text", "json"}) {
    const std::string start = " --ball pool --law exact --friction 0.3 --format " + format;
    CHECK(run_program("terminal" + start).out == run_program("portrait --facts" + start).out);
  }
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

TEST_CASE("portrait draws a pendulum with one energy on each orbit, that of the saddles on separatrices", "[cli]") {
  const auto drawn = nlohmann::json::parse(
      run_program({"portrait", "--system", "x'' = -sin(x)", "--window", "4,3", "--format", "json", "-o", "-"}).out);
  REQUIRE(drawn["separatrices"].size() >= 4);
  for (const char* kind : {"separatrices", "orbits"}) {
    for (const nlohmann::json& orbit : drawn[kind]) {
      const auto energy = [&](std::size_t i) {
        return std::pow(orbit["v"][i].get<double>(), 2) / 2 - std::cos(orbit["u"][i].get<double>());
      };
      const double wanted = *kind == 's' ? 1 : energy(1);
      for (std::size_t i = 1; i + 1 < orbit["u"].size(); i += 7) CHECK(energy(i) == Approx(wanted).epsilon(1e-9));
    }
  }
}
