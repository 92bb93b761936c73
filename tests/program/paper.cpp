#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("paper: a table of every statement with its verdict", "[cli]") {
  const Run run = run_program("paper");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  for (const char* equation : {"(1.1)", "(1.2)", "(1.3)", "(1.4)", "M^h", "(1.5)", "(1.6)", "(2.1)", "(2.2)", "(2.3)",
                               "(2.4)", "(2.5)", "(2.6)", "(2.7)", "(2.8)"}) {
    CHECK_THAT(run.out, Contains(std::string("\n") + equation));
  }
  CHECK_THAT(run.out,
             Contains("6 are errata, 3 are false; 0 not as recorded") && !Contains("FAIL") && !Contains("nan"));

  const auto claims = json_of("paper --format json").at("claims");
  CHECK(claims.size() > 70);
  for (const auto& claim : claims) CHECK(claim.at("verdict") == claim.at("recorded"));
  CHECK(run_program("paper --format csv").out.substr(0, 26) == "equation,statement,printed");
}

TEST_CASE("paper --out: the four figures, each twice", "[cli][gnuplot]") {
  const TemporaryDirectory scratch;
  const std::string folder = scratch.file("new/folder");
  const Run run = run_program(std::vector<std::string>{"paper", "--size", "single", "--out", folder});
  REQUIRE(run.status == 0);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string content = read_file(entry.path());
    INFO(entry.path().string());
    const bool svg = entry.path().extension() == ".svg";
    CHECK_THAT(content, StartsWith(svg ? "<?xml" : "%PDF"));
    if (svg) CHECK_THAT(content, Contains("</svg>") && Contains("Zh98, Fig. ") && Contains("width=\"85mm\""));
    if (!svg) CHECK_THAT(content, Contains("%%EOF"));
    CHECK_THAT(entry.path().stem().string(), StartsWith("fig"));
    ++files;
  }
  CHECK(files == 8);
  CHECK(run.out == run_program("paper").out);
}

TEST_CASE("paper --out: a folder that cannot be is status 4, and nothing is written", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("taken"), "x");
  for (const std::string& folder : {scratch.file("taken"), scratch.file("taken/inside"), std::string("/proc/none")}) {
    const Run run = run_program(std::vector<std::string>{"paper", "--out", folder});
    CAPTURE(folder, run.err);
    CHECK(run.status == 4);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Contains(folder));
  }
  CHECK(scratch.names().size() == 1);
}

TEST_CASE("paper: bad options", "[cli]") {
  for (const char* options : {"paper --out", "paper --out= ", "paper --mu 0.1", "paper figures", "paper --format svg",
                              "paper --out a --out b", "paper --size single"}) {
    const Run run = run_program(options);
    CAPTURE(options, run.err);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_FALSE(run.err.empty());
  }
}
