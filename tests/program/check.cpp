#include <algorithm>
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

TEST_CASE("a law's name cannot break the table of check", "[cli]") {
  const TemporaryDirectory scratch;
  for (const std::string name : {"FAIL ok.csv", "two\nlines ok.csv", "FAILURE.csv", "ok", "a book on ok-FAIL.csv"}) {
    const std::string file = scratch.file(name);
    write_file(file, "rho,pressure\n0,1\n0.5,0.8\n1,0.1\n");
    const Run run =
        run_program(std::vector<std::string>{"check", "--mu", "0.3", "--u0", "1", "--v0", "1", "--law", file});
    INFO(run.out << run.err);
    CHECK(run.status == 0);
    CHECK(count_rows(run.out, "ok") >= 8);
    CHECK(count_words(run.out, "ok") == count_rows(run.out, "ok"));
    CHECK(run.out.find("FAIL") == std::string::npos);
    CHECK(count_rows(run.out, "ok") + 1 == std::ranges::count(run.out, '\n'));
    // Columns do not touch.
    std::istringstream lines(run.out);
    std::string heading, row;
    std::getline(lines, heading);
    const std::size_t column = heading.find("check");
    while (std::getline(lines, row)) CHECK(row.substr(column - 2, 2) == "  ");
  }
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
