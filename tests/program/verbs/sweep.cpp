#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
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

/// A NumPy file, read by the description of its format: magic, version, length of dictionary, dictionary, data.
struct NumpyFile {
  explicit NumpyFile(const std::string& bytes) {
    REQUIRE(bytes.starts_with(std::string("\x93NUMPY\x01\x00", 8)));
    const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])); };
    const std::size_t length = byte(8) + 256 * byte(9);
    REQUIRE((10 + length) % 64 == 0);
    dictionary = bytes.substr(10, length);
    REQUIRE(dictionary.ends_with('\n'));
    REQUIRE((bytes.size() - 10 - length) % sizeof(double) == 0);
    values.resize((bytes.size() - 10 - length) / sizeof(double));
    std::memcpy(values.data(), bytes.data() + 10 + length, values.size() * sizeof(double));
  }

  std::string dictionary;
  std::vector<double> values;
};

}  // namespace

TEST_CASE("a sweep as csv: u0 runs fastest, then v0, then mu", "[cli]") {
  const Run run = run_program("sweep --law pade --mu 0.1:0.3:2 --u0 -1:1:3 --v0 0:0.5:2");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  std::string expected = "mu,u0,v0,tau_stop\n";
  for (double mu : {0.1, 0.3}) {
    for (double v0 : {0.0, 0.5}) {
      for (double u0 : {-1.0, 0.0, 1.0}) {
        expected += fmt::format("{},{},{},{}\n", mu, u0, v0, Flow(PadeLaw{}, mu).stop_time({u0, v0}).tau);
      }
    }
  }
  CHECK(run.out == expected);
  CHECK(run_program("sweep --law pade --mu 0.1:0.3:2 --u0 -1:1:3 --v0 0:0.5:2 -o - --format csv").out == expected);
}

TEST_CASE("a sweep of a ball is in SI", "[cli]") {
  const std::string sweep = "sweep --ball pool --friction 0.3 --spin -100:100:3 --slip 0:2:2";
  const auto rows = rows_of(run_program(sweep).out);
  REQUIRE(rows.size() == 7);
  CHECK(rows[0] == std::vector<std::string>{"spin", "slip", "t_stop"});
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto one = json_of(
        fmt::format("stop --ball pool --friction 0.3 --spin {} --slip {} --format json", rows[i][0], rows[i][1]));
    CHECK(std::stod(rows[i][2]) == Approx(one.at("t_stop").get<double>()).epsilon(1e-14));
  }
  CHECK(run_program(sweep + " --format npy").out.size() == 128 + 6 * sizeof(double));
}

TEST_CASE("a sweep as npy is a C array of doubles", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string axes = " --u0 0:2:5 --v0 0.5:1.5:3 --law exact -o " + scratch.file("map.npy");
  REQUIRE(run_program("sweep --mu 0.1" + axes).status == 0);
  const NumpyFile map(read_file(scratch.file("map.npy")));
  CHECK_THAT(map.dictionary, StartsWith("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 5), }"));
  REQUIRE(map.values.size() == 15);
  for (std::size_t i = 0; i < 15; ++i) {
    const State start{0.5 * static_cast<double>(i % 5), 0.5 + 0.5 * static_cast<double>(i / 5)};
    CHECK(map.values[i] == Approx(Flow(HertzLaw{}, 0.1).stop_time(start).tau).epsilon(1e-14));
  }

  REQUIRE(run_program("sweep --mu 0.1:0.2:2" + axes).status == 0);
  const NumpyFile cube(read_file(scratch.file("map.npy")));
  CHECK_THAT(cube.dictionary, Contains("'shape': (2, 3, 5), }"));
  REQUIRE(cube.values.size() == 30);
  CHECK(std::vector<double>(cube.values.begin(), cube.values.begin() + 15) == map.values);
  CHECK(cube.values[29] == Approx(Flow(HertzLaw{}, 0.2).stop_time({2, 1.5}).tau).epsilon(1e-14));
  // A range of one number gives the array an axis. --format sets the format of a file without an ending.
  CHECK_THAT(NumpyFile(run_program("sweep --mu 1:1:1 --u0 1 --v0 0:1:2 -o - --format npy").out).dictionary,
             Contains("'shape': (1, 2, 1), }"));
  CHECK(scratch.names() == std::vector<std::string>{"map.npy"});
}

TEST_CASE("ends are exact and steps are rounded once", "[limit]") {
  const auto column = [](const std::string& arguments) {
    std::vector<std::string> values;
    for (const auto& row : rows_of(run_program("sweep --mu 0.1 --v0 1 --u0 " + arguments).out))
      values.push_back(row[1]);
    values.erase(values.begin());
    return values;
  };
  using Values = std::vector<std::string>;
  CHECK(column("0:1:11") == Values{"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"});
  CHECK(column("1e-3:1e3:7 --log") == Values{"0.001", "0.01", "0.1", "1", "10", "100", "1000"});
  CHECK(column("-1.6e308:1.6e308:5") == Values{"-1.6e+308", "-8e+307", "0", "8e+307", "1.6e+308"});
  CHECK(column("5e-324:1e308:2 --log") == Values{"5e-324", "1e+308"});
  CHECK(column("7") == Values{"7"});
  CHECK(column("7:7:1") == Values{"7"});
}

TEST_CASE("a stop time that overflows is inf in a sweep", "[limit]") {
  CHECK_THAT(run_program("sweep --mu 1e-100 --u0 1e300 --v0 0:1:2").out, Contains(",inf\n"));
}

TEST_CASE("a sweep has the same bytes for any number of threads", "[route]") {
  for (const std::string format : {"npy", "csv"}) {
    // Rows are shorter or longer than the part that one thread computes at once.
    for (const std::string axes :
         {"--mu 0.1:0.5:3 --u0 -1:1:701 --v0 0:3:101", "--mu 0.1 --u0 0:2:100001 --v0 0:3:2"}) {
      const std::string command = "sweep " + axes + " -o - --format " + format + " --threads ";
      const Run one = run_program(command + "1");
      REQUIRE(one.status == 0);
      CHECK(run_program(command + "2").out == one.out);
      CHECK(run_program(command + "13").out == one.out);
    }
  }
}

TEST_CASE("a sweep of a body other than the ball", "[cli]") {
  const auto rows = rows_of(run_program("sweep --body disc --law uniform --u0 0:1:2 --v0 0:1:2").out);
  REQUIRE(rows.size() == 5);
  const ReducedSystem disc(PressureLaw(0), 1, {.chi = 1, .gamma = 2});
  for (std::size_t i = 1; i < 5; ++i) {
    CHECK(rows[i][0] == "1");
    const double tau = Flow(disc).stop_time({std::stod(rows[i][1]), std::stod(rows[i][2])}).tau;
    CHECK(std::stod(rows[i][3]) == Approx(tau).epsilon(1e-12));
  }
}

TEST_CASE("a sweep that fails at its first start leaves standard output empty", "[cli]") {
  for (const std::string format : {"csv", "npy"}) {
    const Run run = run_program("sweep --law uniform --body 1,1 --mu 1e200 --u0 0:1:2 --v0 0:1:2 --format " + format);
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Contains("r = gamma mu^2/chi must be positive and finite"));
  }
}

TEST_CASE("a sweep without room on the disk is status 4 and leaves nothing", "[cli]") {
  const TemporaryDirectory scratch;
  // The array would have 8 PB.
  const Run huge = run_program("sweep --mu 0.1 --u0 0:1:1000000000 --v0 0:1:1000000 -o " + scratch.file("map.npy"));
  CHECK(huge.status == 4);
  CHECK_THAT(huge.err, Contains("cannot write " + scratch.file("map.npy") + ": "));
  CHECK(scratch.names().empty());
}

TEST_CASE("a sweep of any size takes constant memory", "[limit][memory]") {
  const TemporaryDirectory scratch;
  const std::string command =
      fmt::format("ulimit -v 120000; exec '{}' sweep --threads 1 --mu 0.3 --u0 0:1:20000000 --v0 1 -o '{}'",
                  CONTENSOU_PROGRAM, scratch.file("map.npy"));
  CHECK(std::system(command.c_str()) == 0);
  CHECK(std::filesystem::file_size(scratch.file("map.npy")) == 128 + 20000000 * sizeof(double));
}

TEST_CASE("a sweep says once that its tables are not whole, and has the numbers all the same", "[cli]") {
  const TemporaryDirectory scratch;
  // The mean of the pressures of two discs gives a law with a kink at k = 0.6.
  write_file(scratch.file("two.csv"), "rho,pressure\n0,2\n0.6,2\n0.61,1\n1,1\n");
  const std::string law = " --law " + scratch.file("two.csv");
  const Run run = run_program("sweep --mu 0.3:0.4:2 --u0 1:2:182 --v0 0.1:0.3:182 --threads 2" + law);
  CHECK(run.status == 0);
  CHECK_THAT(run.err, StartsWith("contensou: the table of stop times misses 4 eps in ") &&
                          Contains(" % of its panels (law " + scratch.file("two.csv") + ", mu = 0."));
  CHECK(std::ranges::count(run.err, '\n') == 1);
  const auto rows = rows_of(run.out);
  REQUIRE(rows.size() == 2 * 182 * 182 + 1);
  for (std::size_t i = 1; i < 182 * 182; i += 5003) {
    const auto one = rows_of(
        run_program(fmt::format("stop --mu 0.3 --u0 {} --v0 {} --format csv", rows[i][1], rows[i][2]) + law).out);
    const auto column = std::ranges::find(one[0], "tau_stop") - one[0].begin();
    CHECK(std::stod(rows[i][3]) == Approx(std::stod(one[1][static_cast<std::size_t>(column)])).epsilon(1e-14));
  }
  CHECK_THAT(run_program("sweep --mu 0.3 --u0 1:2:182 --v0 0.1:0.3:182 -o " + scratch.file("map.gp") + law).err,
             Contains("misses 4 eps"));
}

TEST_CASE("a sweep as a picture", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string command = "sweep --mu 0.3 --u0 -1:1:21 --v0 0:1:21 -o ";
  REQUIRE(run_program(command + scratch.file("map.gp")).status == 0);
  CHECK_THAT(read_file(scratch.file("map.gp")), Contains("with image") && Contains("law: exact"));
  REQUIRE(run_program(command + scratch.file("map.svg")).status == 0);
  CHECK_THAT(read_file(scratch.file("map.svg")), StartsWith("<?xml") && Contains("<image"));
  CHECK(scratch.names() == std::vector<std::string>{"map.gp", "map.svg"});
  const Run ball =
      run_program("sweep --ball pool --spin 0:200:21 --slip 0:2:21 --size single --font Serif --format gp");
  CHECK_THAT(ball.out, Contains("rad/s") && Contains("m/s") && Contains("pool ball on cloth") &&
                           Contains("size 425,") && Contains("font 'Serif,") && Contains("set xrange [0:200]"));
}
