#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "run_program.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string shortest(double value) { return fmt::format("{}", value); }

}  // namespace

TEST_CASE("a batch keeps columns and rows and adds tau_stop", "[cli]") {
  const Run run = run_program("stop --batch -", "v0,note,mu,u0\n1,b,0.1,1\n 0.5 ,a,0.2,-3\n0,c,1,0\n");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK(run.out == "v0,note,mu,u0,tau_stop\n1,b,0.1,1," + shortest(stop_time({PadeLaw{}, 0.1}, {1, 1}).tau) +
                       "\n 0.5 ,a,0.2,-3," + shortest(stop_time({PadeLaw{}, 0.2}, {-3, 0.5}).tau) + "\n0,c,1,0,0\n");
}

TEST_CASE("a batch by another law and every route", "[route]") {
  for (const std::string route : {"quadrature", "regularised", "direct"}) {
    const auto rows = rows_of(
        run_program("stop --batch - --law exact --route " + route, "mu,u0,v0\n0.1,1,1\n0.2,1,1\n0.1,2,1\n").out);
    INFO(route);
    REQUIRE(rows.size() == 4);
    CHECK(std::stod(rows[1][3]) == Approx(stop_time({HertzLaw{}, 0.1}, {1, 1}).tau).epsilon(1e-10));
    CHECK(std::stod(rows[2][3]) == Approx(stop_time({HertzLaw{}, 0.2}, {1, 1}).tau).epsilon(1e-10));
    CHECK(std::stod(rows[3][3]) == Approx(stop_time({HertzLaw{}, 0.1}, {2, 1}).tau).epsilon(1e-10));
  }
}

TEST_CASE("quoted fields pass through", "[cli]") {
  const Run run =
      run_program("stop --batch -", "note,mu,u0,v0\n\"a,\"\"b\"\"\nc\",1,0,0\n\"#d\",1,0,0\n\"plain\",1,0,0\n");
  CHECK(run.status == 0);
  CHECK(run.out == "note,mu,u0,v0,tau_stop\n\"a,\"\"b\"\"\nc\",1,0,0,0\n\"#d\",1,0,0,0\nplain,1,0,0,0\n");
}

TEST_CASE("line ends of Windows, comments, blank lines and a byte order mark", "[cli]") {
  const Run run =
      run_program("stop --batch -", "\xEF\xBB\xBF# made by hand\r\nmu,u0,v0\r\n\r\n1,0,0\r\n# more\r\n0.5,0,0");
  CHECK(run.status == 0);
  CHECK(run.out == "mu,u0,v0,tau_stop\n1,0,0,0\n0.5,0,0,0\n");
}

TEST_CASE("a tau_stop that overflows", "[limit]") {
  CHECK_THAT(run_program("stop --batch -", "mu,u0,v0\n1e-100,1e300,1\n").out, Contains(",inf\n"));
}

TEST_CASE("a bad table is refused with its line", "[cli]") {
  struct Fault {
    std::string input;
    std::string place;
    std::string word;
  };
  const std::vector<Fault> faults{
      {"", "<stdin>:1: ", "empty input"},
      {"\n\n# nothing\n", "<stdin>:1: ", "empty input"},
      {"mu,u0\n1,1\n", "<stdin>:1: ", "no column is called 'v0'"},
      {"# c\nmu,mu,u0,v0\n", "<stdin>:2: ", "2 columns are called 'mu'"},
      {"mu,u0,v0,tau_stop\n1,1,1,1\n", "<stdin>:1: ", "already has a column 'tau_stop'"},
      {"mu,u0,v0\n0.1,1,1\n0.1,1\n", "<stdin>:3: ", "2 fields where the header has 3"},
      {"mu,u0,v0\n0.1,1,1,1\n", "<stdin>:2: ", "4 fields where the header has 3"},
      {"mu,u0,v0\n\n0.1,x,1\n", "<stdin>:3: ", "u0: 'x' is not a number"},
      {"note,mu,u0,v0\n\"two\nlines\",1,0,0\nz,0.1,,1\n", "<stdin>:4: ", "u0: '' is not a number"},
      {"mu,u0,v0\n0.1,1e999,1\n", "<stdin>:2: ", "'1e999' does not fit"},
      {"mu,u0,v0\n0.1,inf,1\n", "<stdin>:2: ", "'inf' is not a finite number"},
      {"mu,u0,v0\n0,1,1\n", "<stdin>:2: ", "0 < mu <= 1"},
      {"mu,u0,v0\n1.5,1,1\n", "<stdin>:2: ", "0 < mu <= 1"},
      {"mu,u0,v0\n0.1,1,-1\n", "<stdin>:2: ", "v0 >= 0"},
      {"mu,u0,v0\n0.1,\"1,1\n", "<stdin>:2: ", "never closed"},
      {"mu,u0,v0\n0.1,1\",1\n", "<stdin>:2: ", "a quote inside a field"},
  };
  for (const auto& [input, place, word] : faults) {
    const Run run = run_program("stop --batch -", input);
    INFO(input);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, StartsWith(place) && Contains(word));
  }
  const TemporaryDirectory scratch;
  write_file(scratch.file("bad.csv"), "mu,u0,v0\n0.1,1,x\n");
  CHECK_THAT(run_program("stop --batch " + scratch.file("bad.csv")).err, StartsWith(scratch.file("bad.csv") + ":2: "));
}

TEST_CASE("--keep-going leaves out what it cannot compute", "[cli]") {
  const Run run =
      run_program("stop --keep-going --batch -", "mu,u0,v0,id\n1,0,0,a\n0.1,x,1,b\n0.1,1\n5,1,1,d\n1,0,0,e\n");
  CHECK(run.status == 2);
  CHECK(run.out == "mu,u0,v0,id,tau_stop\n1,0,0,a,0\n0.1,x,1,b,\n0.1,1,,,\n5,1,1,d,\n1,0,0,e,0\n");
  for (const char* place : {"<stdin>:3: ", "<stdin>:4: ", "<stdin>:5: "}) CHECK_THAT(run.err, Contains(place));
}

TEST_CASE("a batch excludes what makes no sense with it", "[cli]") {
  for (const std::string other : {"--mu 0.1", "--ball pool", "--slip 1", "--format json", "--format text"}) {
    const Run run = run_program("stop --batch - " + other, "mu,u0,v0\n1,0,0\n");
    INFO(other);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
  }
  CHECK(run_program("stop --keep-going --ball pool").status == 2);
  const Run unknown = run_program("stop --keep-going --batch - --route quick", "mu,u0,v0\n1,0,0\n");
  CHECK(unknown.status == 2);
  CHECK(unknown.out.empty());
  CHECK_THAT(unknown.err, Contains("--route quick: no such route"));
  const Run missing = run_program("stop --batch - --law exact --route closed", "mu,u0,v0\n1,0,0\n");
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, StartsWith("<stdin>:2: ") && Contains("--route closed: law exact"));
  CHECK(run_program("stop --batch /no/such/file.csv").status == 4);
}
