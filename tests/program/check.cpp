#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace {

/// Rows of the table: the lines whose last word is a verdict.
int count_rows(const std::string& text, const std::string& verdict) {
  int rows = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) rows += line.ends_with(" " + verdict) ? 1 : 0;
  return rows;
}

int count_words(const std::string& text, const std::string& word) {
  int count = 0;
  std::istringstream words(text);
  for (std::string next; words >> next;) count += next == word ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("check of one start, by one law and by both", "[cli]") {
  for (const std::string start : {"--mu 0.1 --u0 1 --v0 1", "--ball gel", "--mu 1 --u0 -1 --v0 1e-3",
                                  "--mu 0.1 --u0 0 --v0 1", "--mu 0.1 --u0 1 --v0 0"}) {
    const Run both = run_program("check " + start);
    INFO(start << "\n" << both.out << both.err);
    CHECK(both.status == 0);
    CHECK(count_rows(both.out, "FAIL") == 0);
    CHECK(count_words(both.out, "ok") == count_rows(both.out, "ok"));
    const int pade = count_rows(run_program("check --law pade " + start).out, "ok");
    const int exact = count_rows(run_program("check --law exact " + start).out, "ok");
    CHECK(pade >= 8);
    CHECK(exact >= 8);
    CHECK(count_rows(both.out, "ok") == pade + exact);
  }
}

TEST_CASE("check without a start", "[cli]") {
  const Run run = run_program("check");
  INFO(run.out);
  CHECK(run.status == 0);
  CHECK(count_rows(run.out, "ok") >= 16);
}

TEST_CASE("check as JSON and CSV", "[cli]") {
  const auto document = json_of("check --mu 0.1 --u0 1 --v0 1 --format json");
  CHECK(document.at("schema") == 1);
  REQUIRE(document.at("checks").size() >= 16);
  for (const auto& check : document.at("checks")) {
    CHECK(check.at("passed") == (check.at("measured").get<double>() <= check.at("allowed").get<double>()));
  }
  const Run csv = run_program("check --mu 0.1 --u0 1 --v0 1 --format csv");
  CHECK(csv.out.starts_with("law,check,measured,allowed,verdict\n"));
}

TEST_CASE("rest cannot be checked", "[cli]") {
  const Run run = run_program("check --mu 0.1 --u0 0 --v0 0");
  CHECK(run.status == 2);
  CHECK(run.out.empty());
}

TEST_CASE("check --certify encloses the stop time of one start", "[cli][certify]") {
  const Run first = run_program("check --certify --mu 0.1 --u0 1 --v0 1 --format json");
  if (first.status == 4) {  // built without Arb: it says so and how to get it
    CHECK(first.out.empty());
    CHECK_THAT(first.err, Catch::Matchers::Contains("Arb") && Catch::Matchers::Contains("libflint-arb-dev"));
    return;
  }
  for (const std::string start : {"--mu 0.1 --u0 1 --v0 1", "--ball pool", "--mu 1 --u0 -1e-9 --v0 3e7",
                                  "--mu 0.3 --u0 0 --v0 1", "--mu 1e-10 --u0 1 --v0 1"}) {
    const auto document = json_of("check --certify " + start + " --format json");
    INFO(start << document.dump(1));
    const double tau = document.at("tau_stop");
    CHECK(document.at("schema") == 1);
    REQUIRE(document.at("enclosure").size() == 2);
    const auto lower = std::stold(document.at("enclosure")[0].get<std::string>());
    const auto upper = std::stold(document.at("enclosure")[1].get<std::string>());
    CHECK(lower <= upper);
    CHECK(upper / lower - 1 < 1e-18L);
    CHECK(static_cast<double>(lower) == Approx(tau).epsilon(1e-15));
    CHECK(document.at("error_ulp") <= 4);
    CHECK(document.at("tau_stop") == json_of("stop " + start + " --format json").at("tau_stop"));
  }
  const Run row = run_program("check --certify --mu 0.1 --u0 1 --v0 1 --format csv");
  CHECK(row.out.starts_with("law,mu,u0,v0,tau_stop,lower,upper,error_ulp\npade,0.1,1,1,33.58"));
  CHECK(count_rows(run_program("check --certify --mu 0.1 --u0 1 --v0 1").out, "ok") == 1);
}

TEST_CASE("check --certify says what it needs", "[cli][certify]") {
  const Run without_start = run_program("check --certify");
  CHECK(without_start.status == 2);
  CHECK_THAT(without_start.err, Catch::Matchers::Contains("--mu"));
  const Run exact = run_program("check --certify --mu 0.1 --u0 1 --v0 1 --law exact");
  CHECK(exact.status == 2);
  CHECK(exact.out.empty());
  CHECK_THAT(exact.err, Catch::Matchers::Contains("exact") && Catch::Matchers::Contains("--law pade"));
}
