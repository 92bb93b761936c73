#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "run_program.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string shortest(double value) { return fmt::format("{}", value); }

}  // namespace

TEST_CASE("a filter: rows leave while the input pauses, and up to the first bad one", "[cli]") {
  const TemporaryDirectory scratch;
  for (const char* threads : {"1", "2", "7"}) {
    // The script sends each row after the answer to the previous row. A program that waits for more rows would hang.
    const std::string script = fmt::format(
        "set -e; cd '{}'; rm -f in out; mkfifo in out\n"
        "'{}' stop --law pade --batch - --threads {} <in >out 2>err & exec 3>in 4<out\n"
        "printf 'mu,u0,v0\\n1,0,0\\n' >&3; read -r header <&4; read -r first <&4\n"
        "for i in 1 2 3 4 5 6 7 8 9; do printf \"0.$i,0,0\\n\" >&3; read -r row <&4; test $row = 0.$i,0,0,0; done\n"
        "printf '1,0,0\\n1,0' >&3; read -r last <&4; printf ',x\\n' >&3\n"
        "! read -r more <&4; wait $! && status=0 || status=$?; echo $header $first $last $status >answer\n",
        scratch.path().string(), CONTENSOU_PROGRAM, threads);
    write_file(scratch.file("script"), script);
    INFO("threads " << threads);
    // The limit is so long that only a program that hangs reaches it.
    REQUIRE(std::system(("timeout 600 sh '" + scratch.file("script") + "'").c_str()) == 0);
    CHECK(read_file(scratch.file("answer")) == "mu,u0,v0,tau_stop 1,0,0,0 1,0,0,0 2\n");
    CHECK(read_file(scratch.file("err")) == "<stdin>:13: v0: 'x' is not a number; write it like 0.1, -5 or 1e-3\n");
  }
}

TEST_CASE("a table of another kind is named, with a way out", "[cli]") {
  const auto utf16 = [](const std::string& text, bool low_first) {
    std::string wide;
    for (char letter : text) wide += low_first ? std::string{letter, '\0'} : std::string{'\0', letter};
    return wide;
  };
  const std::string table = "mu,u0,v0\n0.1,1,1\n";
  const std::pair<std::string, const char*> others[] = {
      {"\xFF\xFE" + utf16(table, true), "<stdin>:1: the text is in UTF-16, UTF-8 is needed: iconv -f UTF-16 -t UTF-8"},
      {"\xFE\xFF" + utf16(table, false), "iconv -f UTF-16 -t UTF-8"},
      {utf16(table, true), "iconv -f UTF-16LE -t UTF-8"},
      {utf16(table, false), "iconv -f UTF-16BE -t UTF-8"},
      {"mu;u0;v0\n0,1;1;1\n", "semicolons separate the columns here, commas are needed: sed 's/,/./g; s/;/,/g'"},
      {"mu\tu0\tv0\n0.1\t1\t1\n", "tabs separate the columns here, commas are needed: sed 's/,/./g; s/\\t/,/g'"},
      {"mu,u0,v0\n0,1,1,0,1,0\n", "<stdin>:2: 6 fields where the header has 3: decimals take a point"},
      {"mu,u0,v0\n\"0,1\",1,1\n", "<stdin>:2: mu: '0,1' is not a number; write it like 0.1, -5 or 1e-3: decimals"},
  };
  for (const auto& [input, words] : others) {
    for (const std::string verb : {"stop --law pade --batch -", "law --batch -", "orbit --ball pool --at -"}) {
      check_rejected(verb, verb.starts_with("stop") ? words : "", input);
    }
  }
  // A file with semicolons, as Excel writes it, is converted as the message recommends.
  const TemporaryDirectory scratch;
  write_file(scratch.file("excel.csv"), "\xEF\xBB\xBFmu;u0;v0\r\n0,5;0;0\r\n");
  const std::string converted = "sed 's/,/./g; s/;/,/g' " + scratch.file("excel.csv") + " | '" + CONTENSOU_PROGRAM +
                                "' stop --law pade --batch - -o " + scratch.file("out.csv");
  CHECK(std::system(converted.c_str()) == 0);
  CHECK(read_file(scratch.file("out.csv")) == "mu,u0,v0,tau_stop\n0.5,0,0,0\n");
}

namespace {

/// A table of random starts. Each mu occurs in many rows.
struct RandomTable {
  explicit RandomTable(int rows) {
    std::mt19937_64 random(20);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < rows; ++i) {
      mu.push_back(std::pow(10, -std::floor(5 * unit(random)) / 2));
      starts.push_back({10 * unit(random) - 5, std::pow(10, 6 * unit(random) - 3)});
      csv += fmt::format("{},row {},{},{}\n", mu.back(), i, starts.back().u, starts.back().v);
    }
  }

  std::vector<double> mu;
  std::vector<State> starts;
  std::string csv = "mu,name,u0,v0\n";
};

}  // namespace

TEST_CASE("a long batch has the stop times of single calls, and one set of bits however many threads there are",
          "[route]") {
  const RandomTable table(100000);
  const Run one = run_program("stop --law pade --batch - --threads 1", table.csv);
  REQUIRE(one.status == 0);
  const auto rows = rows_of(one.out);
  REQUIRE(rows.size() == table.mu.size() + 1);
  std::size_t misplaced = 0, different = 0;
  for (std::size_t i = 0; i < table.mu.size(); ++i) {
    const double tau = Flow(PadeLaw{}, table.mu[i]).stop_time(table.starts[i]).tau;
    const bool single = i < 1000;  // rows after these use the solution for every mu
    misplaced += rows[i + 1][1] != fmt::format("row {}", i);
    if (single ? rows[i + 1].back() != shortest(tau) : !(std::abs(std::stod(rows[i + 1].back()) / tau - 1) < 2e-15)) {
      ++different;
    }
  }
  CHECK(misplaced == 0);
  CHECK(different == 0);
  for (const std::string threads : {"2", "3", "16"}) {
    CHECK(run_program("stop --law pade --batch - --threads " + threads, table.csv).out == one.out);
  }
  const std::string few = RandomTable(20000).csv;
  CHECK(run_program("stop --law exact --batch - --threads 7", few).out ==
        run_program("stop --law exact --batch - --threads 1", few).out);
}

// Rows before the 1000th use one curve for each mu. Later rows use the solution for every mu.
TEST_CASE("rows that each have a mu of their own are those of its flow", "[route]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit;
  std::string csv = "mu,u0,v0\n";
  for (int i = 0; i < 1300; ++i) csv += fmt::format("{},{},{}\n", unit(random), unit(random), unit(random));
  const auto rows = rows_of(run_program("stop --batch -", csv).out);
  REQUIRE(rows.size() == 1301);
  for (std::size_t i = 1; i < rows.size(); i += i < 900 ? 100 : 10) {
    const auto& row = rows[i];
    const Flow flow(ReducedSystem(HertzLaw{}, std::stod(row[0])));
    CAPTURE(i);
    CHECK(std::stod(row[3]) == Approx(flow.stop_time({std::stod(row[1]), std::stod(row[2])}).tau).epsilon(2e-15));
  }
}

TEST_CASE("the first bad row of a long batch is the one that is named", "[cli]") {
  std::string csv = RandomTable(60000).csv;
  const std::string good = run_program("stop --law pade --batch -", csv).out;
  csv += "9,bad,1,1\n" + RandomTable(30000).csv.substr(14) + "8,worse,1,1\n";
  for (const std::string threads : {"1", "8"}) {
    const Run run = run_program("stop --law pade --batch - --threads " + threads, csv);
    CHECK(run.status == 2);
    CHECK(std::ranges::count(run.out, '\n') == 60001);
    CHECK(run.out == good.substr(0, run.out.size()));
    CHECK_THAT(run.err, StartsWith("<stdin>:60002: mu: 0 < mu <= 1 is required, got 9"));
    const Run kept = run_program("stop --law pade --keep-going --batch - --threads " + threads, csv);
    CHECK(kept.status == 2);
    CHECK(kept.out.starts_with(run.out));
    CHECK_THAT(kept.out, Contains("\n9,bad,1,1,\n") && Contains("\n8,worse,1,1,\n"));
    CHECK_THAT(kept.err, StartsWith("<stdin>:60002: ") && Contains("\n<stdin>:90003: "));
  }
}

TEST_CASE("a record without an end is refused before it fills the memory", "[limit]") {
  const Run open = run_program("stop --law pade --batch -", "mu,u0,v0\n0.1,1,1\n0.1,1,\"" + std::string(70 << 20, '1'));
  CHECK(open.status == 2);
  CHECK_THAT(open.err, StartsWith("<stdin>:3: ") && Contains("longer than 64 MiB"));
  CHECK(std::ranges::count(open.out, '\n') == 2);
  CHECK_THAT(open.out, StartsWith("mu,u0,v0,tau_stop\n0.1,1,1,"));
}

TEST_CASE("a batch of any length takes constant memory", "[limit][memory]") {
  const TemporaryDirectory scratch;
  const std::string row = "0.1,1,1," + std::string(1000, 'x');
  const std::string command = fmt::format(
      "(echo mu,u0,v0,note; yes {} | head -n 200000) | (ulimit -v 120000; exec '{}' stop --law pade --batch - "
      "--threads 1 -o '{}')",
      row, CONTENSOU_PROGRAM, scratch.file("out.csv"));
  CHECK(std::system(command.c_str()) == 0);
  const std::string tau = shortest(Flow(PadeLaw{}, 0.1).stop_time({1, 1}).tau);
  CHECK(std::filesystem::file_size(scratch.file("out.csv")) ==
        200000 * (row.size() + 1 + tau.size() + 1) + std::string("mu,u0,v0,note,tau_stop\n").size());
}
