#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "answers/input/errors.hpp"
#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("messages are without names of the library", "[cli]") {
  using contensou::answers::words_of;
  CHECK(words_of("Flow::orbit: gamma: 1") == "gamma: 1");
  CHECK(words_of("ReducedSystem: mu = 2") == "mu = 2");
  CHECK(words_of("Flow: a solution") == "a solution");
  CHECK(words_of("slip_of_ratio: no k") == "no k");
  CHECK(words_of("row 3: SimilarityCurve: no k") == "row 3: no k");
  for (const std::string words :
       {"--mu 2: no", "f.csv:3: slip_sd: 'x'", "f.csv:3: Slip: 'x'", "law Mine: no", "fit: no", "a"})
    CHECK(words_of(words) == words);
  CHECK_THAT(run_program("orbit --mu 1e-160 --u0 1 --v0 1").err, StartsWith("contensou: gamma mu^2/chi = "));
  CHECK_THAT(run_program("stop --mu 0.1 --u0 1 --v0 1 --estimate --body 2,1000").err, StartsWith("contensou: r = "));
  CHECK_THAT(run_program("check --mu 1e-300 --u0 1 --v0 1").err, StartsWith("contensou: mu = 1e-300 is too small"));
  const TemporaryDirectory scratch;
  const std::string table = scratch.file("p.csv");
  write_file(table, "rho,pressure\n0,1\n1e-12,0\n1,0\n");
  CHECK_THAT(run_program("stop --mu 0.1 --u0 1 --v0 1 --law " + table).err,
             StartsWith("contensou: " + table + ": rows within rho = 1e-11"));
}

TEST_CASE("messages quote what they can show", "[cli]") {
  const std::string long_text(20000, 'x');
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{long_text},
                                             {"stop", "--" + long_text},
                                             {"stop", long_text},
                                             {"stop", "--mu", long_text},
                                             {"stop", "--ball", "pool", "--law", long_text},
                                             {"stop", "--ball", long_text},
                                             {"stop", "--ball", "pool", "--format", long_text},
                                             {"stop", "--ball", "pool", "--body", long_text},
                                             {"stop", "--ball", "pool", "-o", "a." + long_text},
                                             {"sweep", "--u0", "0:" + long_text + ":3"},
                                             {"portrait", "--mu", "0.1", "--size", "1x" + long_text},
                                             {"portrait", "--mu", "0.1", "--view", "a\nb\x1b[2Jc\x7f"},
                                             {"stop", "--mu", "\n\a"}}) {
    const Run run = run_program(arguments);
    INFO(run.err.substr(0, 1000));
    CHECK(run.status == 2);
    CHECK(run.err.size() < 600);
    CHECK(std::ranges::count(run.err, '\n') == 2);
    CHECK(std::ranges::none_of(run.err, [](char c) { return c != '\n' && static_cast<unsigned char>(c) < ' '; }));
  }
}

TEST_CASE("what cannot be computed is status 3", "[cli]") {
  const Run run = run_program("orbit --mu 1e-100 --u0 1e300 --v0 1");
  CHECK(run.status == 3);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Contains("exceeds the largest double"));
}
