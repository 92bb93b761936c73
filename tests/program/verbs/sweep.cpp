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
