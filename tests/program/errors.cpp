#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

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
