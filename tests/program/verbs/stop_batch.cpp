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

TEST_CASE("a batch keeps columns and rows and adds tau_stop", "[cli]") {
  const Run run = run_program("stop --law pade --batch -", "v0,note,mu,u0\n1,b,0.1,1\n 0.5 ,a,0.2,-3\n0,c,1,0\n");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK(run.out == "v0,note,mu,u0,tau_stop\n1,b,0.1,1," + shortest(Flow(PadeLaw{}, 0.1).stop_time({1, 1}).tau) +
                       "\n 0.5 ,a,0.2,-3," + shortest(Flow(PadeLaw{}, 0.2).stop_time({-3, 0.5}).tau) +
                       "\n0,c,1,0,0\n");
}

TEST_CASE("a batch by another law and every route", "[route]") {
  for (const std::string route : {"quadrature", "regularised", "direct"}) {
    const auto rows = rows_of(
        run_program("stop --batch - --law exact --route " + route, "mu,u0,v0\n0.1,1,1\n0.2,1,1\n0.1,2,1\n").out);
    INFO(route);
    REQUIRE(rows.size() == 4);
    CHECK(std::stod(rows[1][3]) == Approx(Flow(HertzLaw{}, 0.1).stop_time({1, 1}).tau).epsilon(1e-10));
    CHECK(std::stod(rows[2][3]) == Approx(Flow(HertzLaw{}, 0.2).stop_time({1, 1}).tau).epsilon(1e-10));
    CHECK(std::stod(rows[3][3]) == Approx(Flow(HertzLaw{}, 0.1).stop_time({2, 1}).tau).epsilon(1e-10));
  }
}

TEST_CASE("a batch of a ball has SI columns", "[cli]") {
  const Run run = run_program("stop --ball pool --batch -", "slip,note,spin\n1,a,100\n0,b,-50\n2,c,0\n");
  CHECK(run.status == 0);
  const auto rows = rows_of(run.out);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0] == std::vector<std::string>{"slip", "note", "spin", "t_stop"});
  CHECK(std::stod(rows[1][3]) == Approx(10.10502826).epsilon(1e-9));
  CHECK(std::stod(rows[2][3]) == Approx(5).epsilon(1e-14));
  CHECK(std::stod(rows[3][3]) == Approx(4 / (7 * 0.2 * 9.80665)).epsilon(1e-14));
  CHECK_THAT(run_program("stop --ball pool --batch -", "mu,u0,v0\n1,1,1\n").err, Contains("are starts without --ball"));
  CHECK_THAT(run_program("stop --ball pool --batch -", "slip\n1\n").err, Contains("no column is called 'spin'"));
  CHECK_THAT(run_program("stop --ball pool --batch -", "slip,spin\n-1,1\n").err,
             Contains("<stdin>:2: slip: slip >= 0"));
  check_rejected("stop --ball pool --slip 1 --batch -", "--batch and --slip exclude each other: the starts are in");
  check_rejected("stop --ball pool --mu 0.1 --batch -", "--ball and --mu exclude each other");
}

TEST_CASE("a column that is a quantity and is not read is told", "[cli]") {
  const Run run = run_program("stop --ball pool --batch -", "slip,spin,friction,shot\n1,100,0.4,a\n");
  CHECK(run.status == 0);
  CHECK(run.out.starts_with("slip,spin,friction,shot,t_stop\n1,100,0.4,a,"));
  CHECK(run.err == "note: the column friction is handed on and not read: all rows have one friction\n");
}

TEST_CASE("quoted fields pass through", "[cli]") {
  const Run run = run_program("stop --law pade --batch -",
                              "note,mu,u0,v0\n\"a,\"\"b\"\"\nc\",1,0,0\n\"#d\",1,0,0\n\"plain\",1,0,0\n");
  CHECK(run.status == 0);
  CHECK(run.out == "note,mu,u0,v0,tau_stop\n\"a,\"\"b\"\"\nc\",1,0,0,0\n\"#d\",1,0,0,0\n\"plain\",1,0,0,0\n");
}

// csv.cpp tests all combinations of line ends and ends of blocks.
TEST_CASE("line ends of Windows and of old, comments, blank lines and a byte order mark", "[cli]") {
  const Run run = run_program("stop --law pade --batch -",
                              "\xEF\xBB\xBF# made by hand\r\nmu,u0,v0\r\n\r\n1,0,0\r\n# more\r\n0.5,0,0");
  CHECK(run.status == 0);
  CHECK(run.out == "mu,u0,v0,tau_stop\n1,0,0,0\n0.5,0,0,0\n");
  CHECK(run_program("stop --law pade --batch -", "mu,u0,v0\r1,0,0\n0.5,0,0\r").out == run.out);
  CHECK(run_program("law --batch -", "k\rinf\r\rinf").out == "k,phi,psi\ninf,1,0\ninf,1,0\n");
}

TEST_CASE("a tau_stop that overflows is inf, and said to be", "[limit]") {
  const Run run = run_program("stop --law pade --batch -", "mu,u0,v0\n1,0,0\n1e-100,1e300,1\n1,0,0\n1e-100,1e300,2\n");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("\n1e-100,1e300,1,inf\n") && Contains("\n1e-100,1e300,2,inf\n"));
  CHECK(run.err == "<stdin>:3: tau_stop exceeds the largest double and is written as inf (2 rows in all)\n");
}

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

TEST_CASE("a header of many or long names is not shown whole", "[cli]") {
  std::string names;
  for (int i = 0; i < 100000; ++i) names += "x,";
  for (const std::string& header : {names, std::string(100000, 'x')}) {
    const Run run = run_program("stop --law pade --batch -", header + "\n");
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("no column is called 'mu'"));
    CHECK(run.err.size() < 300);
  }
}

TEST_CASE("progress of a batch", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("table.csv"), "mu,u0,v0\n0.1,1,1\nx,1,1\n");
  const std::string always = "stop --keep-going --progress always --batch ";
  const Run run = run_program(always + scratch.file("table.csv") + " -o " + scratch.file("out.csv"));
  CHECK_THAT(run.err, Contains(":3: mu: 'x' is not a number"));
  CHECK_THAT(run.err, Contains("\r2 rows in "));
  CHECK(run_program(always + "- --progress soon").status == 2);
  check_rejected("stop --ball pool --progress always", "--progress is for many starts");
}

TEST_CASE("a bad table is refused with its line", "[cli]") {
  struct Fault {
    std::string input;
    std::string place;
    std::string word;
    std::string out = {};  ///< rows of the output before the bad row
  };
  const std::string one_row =
      "mu,u0,v0,tau_stop\n0.1,1,1," + shortest(Flow(PadeLaw{}, 0.1).stop_time({1, 1}).tau) + "\n";
  const std::vector<Fault> faults{
      {"", "<stdin>:1: ", "empty input"},
      {"\n\n# nothing\n", "<stdin>:1: ", "empty input"},
      {"mu,u0\n1,1\n", "<stdin>:1: ", "no column is called 'v0'"},
      {"# c\nmu,mu,u0,v0\n", "<stdin>:2: ", "2 columns are called 'mu'"},
      {"mu,u0,v0,tau_stop\n1,1,1,1\n", "<stdin>:1: ", "already has a column 'tau_stop'"},
      {"mu,u0,v0\n0.1,1,1\n0.1,1\n", "<stdin>:3: ", "2 fields where the header has 3", one_row},
      {"mu,u0,v0\n\n0.1,x,1\n", "<stdin>:3: ", "u0: 'x' is not a number"},
      {"note,mu,u0,v0\n\"two\nlines\",1,0,0\nz,0.1,,1\n", "<stdin>:4: ", "u0: '' is not a number",
       "note,mu,u0,v0,tau_stop\n\"two\nlines\",1,0,0,0\n"},
      {"mu,u0,v0\n0.1,1e999,1\n", "<stdin>:2: ", "'1e999' does not fit"},
      {"mu,u0,v0\n0.1,inf,1\n", "<stdin>:2: ", "'inf' is not a finite number"},
      {"mu,u0,v0\n0,1,1\n", "<stdin>:2: ", "0 < mu <= 1"},
      {"mu,u0,v0\n0.1,1,-1\n", "<stdin>:2: ", "v0 >= 0"},
      {"mu,u0,v0\n0.1,\"1,1\n", "<stdin>:2: ", "never closed"},
      {std::string("mu,u0,v0\n0.1,1\0002,1\n", 18), "<stdin>:2: ", "u0: '1\\x002' is not a number; write it"},
      {"mu,u0,v0\n0.1," + std::string(1000, 'x') + ",1\n", "<stdin>:2: ", "x...' is not a number"},
  };
  for (const auto& [input, place, word, out] : faults) {
    const Run run = run_program("stop --law pade --batch -", input);
    INFO(input);
    CHECK(run.status == 2);
    CHECK(run.out == out);
    CHECK_THAT(run.err, StartsWith(place) && Contains(word));
  }
  const TemporaryDirectory scratch;
  write_file(scratch.file("bad.csv"), "mu,u0,v0\n0.1,1,x\n");
  CHECK_THAT(run_program("stop --batch " + scratch.file("bad.csv")).err, StartsWith(scratch.file("bad.csv") + ":2: "));
}

TEST_CASE("--keep-going leaves out what it cannot compute", "[cli]") {
  const Run run = run_program("stop --law pade --keep-going --batch -",
                              "mu,u0,v0,id\n1,0,0,a\n0.1,x,1,b\n0.1,1\n5,1,1,d\n1,0,0,e\n");
  CHECK(run.status == 2);
  CHECK(run.out == "mu,u0,v0,id,tau_stop\n1,0,0,a,0\n0.1,x,1,b,\n0.1,1,,,\n5,1,1,d,\n1,0,0,e,0\n");
  for (const char* place : {"<stdin>:3: ", "<stdin>:4: ", "<stdin>:5: "}) CHECK_THAT(run.err, Contains(place));
}

TEST_CASE("quotes that do not close where they should are named where they open", "[cli]") {
  std::string csv = "mu,u0,v0,id\n0.1,1,1,a\n0.1,1,1,\"b\n";
  for (int i = 0; i < 50; ++i) csv += "0.1,1,1,c\n";
  const Run run = run_program("stop --law pade --keep-going --batch -", csv + "0.1,1,1,\"d\"\n");
  CHECK(run.status == 2);
  CHECK_THAT(run.err, Contains("<stdin>:3: a quote inside a field, or one that closes on line 54 only"));
}

TEST_CASE("a batch excludes what makes no sense with it", "[cli]") {
  for (const std::string other : {"--mu 0.1", "--ball pool", "--slip 1", "--format json", "--format text",
                                  "--digits banana", "--digits 18", "--digits 5"}) {
    check_rejected("stop --law pade --batch - " + other, "", "mu,u0,v0\n1,0,0\n");
  }
  CHECK(run_program("stop --keep-going --ball pool").status == 2);
  const Run missing = run_program("stop --batch - --law exact --route closed", "mu,u0,v0\n1,0,0\n");
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, StartsWith("<stdin>:2: ") && Contains("--route closed: law exact"));
  CHECK(run_program("stop --batch /no/such/file.csv").status == 4);
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

TEST_CASE("--threads is a whole number, and for many starts", "[cli]") {
  for (const std::string threads : {"0", "-1", "1.5", "two", "1025"}) {
    check_rejected("stop --law pade --batch - --threads " + threads,
                   "--threads: '" + threads + "' is not a whole number from 1 to 1024", "mu,u0,v0\n1,0,0\n");
  }
  check_rejected("stop --ball pool --threads 2", "--threads is for many starts: add --batch FILE");
}

TEST_CASE("a batch is written to a file whole or not at all", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("table.csv"), "mu,u0,v0\n1,0,0\n");
  // The output may replace the input file.
  CHECK(run_program("stop --batch " + scratch.file("table.csv") + " -o " + scratch.file("table.csv")).status == 0);
  CHECK(read_file(scratch.file("table.csv")) == "mu,u0,v0,tau_stop\n1,0,0,0\n");
  CHECK(run_program("stop --law pade --batch - -o " + scratch.file("table.csv"), "mu,u0,v0\n1,0,0\n7,0,0\n").status ==
        2);
  CHECK(read_file(scratch.file("table.csv")) == "mu,u0,v0,tau_stop\n1,0,0,0\n");
  CHECK(scratch.names() == std::vector<std::string>{"table.csv"});
  CHECK(run_program("stop --batch " + scratch.path().string()).status == 4);
}
