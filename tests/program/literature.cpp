#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("literature: published numbers with their sources, and the one that differs", "[cli]") {
  const Run run = run_program("literature");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK_THAT(run.out, Contains("10.1103/PhysRevLett.90.248302") && Contains("14 numbers: 13 agree, 1 differ.") &&
                          !Contains("FAIL") && !Contains("nan"));

  int differing = 0;
  const auto rows = json_of("literature --format json").at("rows");
  CHECK(rows.size() == 14);
  for (const auto& row : rows) {
    CAPTURE(row.at("name"));
    CHECK(row.at("verdict") == row.at("recorded"));
    CHECK(!row.at("source").get<std::string>().empty());
    differing += row.at("verdict") == "differs";
    // Nothing is off by more than a stone's scatter.
    CHECK(row.at("computed").get<double>() == Approx(row.at("published").get<double>()).epsilon(0.15).margin(1e-12));
  }
  CHECK(differing == 1);
}
