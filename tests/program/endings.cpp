#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

struct Output {
  std::string command;
  std::string noun;
  std::vector<std::string> endings;
};

const std::vector<std::string> of_answers{"txt", "csv", "json"};

/// Every verb, with every kind of output that it has.
const std::vector<Output> outputs{
    {"stop --ball pool", "a stop time", of_answers},
    {"stop --batch -", "a table of stop times", {"csv"}},
    {"orbit --ball pool --samples 3", "an orbit", of_answers},
    {"law --k 1", "a law", of_answers},
    {"check --mu 0.3 --u0 1 --v0 1", "a table of checks", {"txt", "csv", "json", "tex"}},
    {"terminal --mu 0.3", "a terminal ratio", {"txt", "csv", "json", "svg", "pdf", "png", "eps", "gp", "tex"}},
    {"reduce --mu 0.3 --u0 1 --v0 1", "a reduction", {"txt", "csv", "json", "svg", "pdf", "png", "eps", "gp", "tex"}},
    {"fit - --ball pool --noise slip=0.1,spin=1 --free slip,spin", "a fit", {"txt", "csv", "json", "toml"}},
    {"fit --plan --ball pool --fps 100 --until 0.5 --noise slip=0.01,spin=1", "a plan", of_answers},
    {"roll --ball pool --samples 3", "a motion", of_answers},
    {"roll --ball pool --batch -", "a table of motions", {"csv"}},
    {"balls", "a list of balls", of_answers},
    {"balls pool", "a run file", {"toml", "txt"}},
    {"engine mujoco --ball pool", "a table of engines", of_answers},
    {"bounce --ball steel --normal-speed 1 --restitution 0.5", "a bounce", of_answers},
    {"paper", "a table of statements", of_answers},
    {"literature", "a table of published numbers", {"txt", "csv", "json", "tex"}},
    {"sweep --mu 0.3 --u0 0:1:3 --v0 0:1:3", "a sweep", {"npy", "csv", "svg", "pdf", "png", "eps", "gp"}},
    {"portrait --mu 0.3", "a portrait", {"gp", "svg", "pdf", "png", "eps", "tex", "csv", "json"}},
    {"portrait --mu 0.3 --facts", "a table of facts", of_answers},
};

constexpr const char* start_table = "mu,u0,v0,slip,spin,t\n0.1,1,1,1,1,0\n";

}  // namespace

TEST_CASE("the ending decides the format, on every verb", "[cli]") {
  const TemporaryDirectory scratch;
  for (const auto& [command, noun, endings] : outputs) {
    for (const std::string& ending : endings) {
      const std::string file = scratch.file("result." + ending);
      const std::string format = ending == "txt" ? "text" : ending;
      INFO(command << " " << file);
      const Run written = run_program(command + " -o " + file, start_table);
      CHECK(written.status == 0);
      CHECK(written.out.empty());
      CHECK_FALSE(read_file(file).empty());
      CHECK(read_file(file) == run_program(command + " -o - --format " + format, start_table).out);
      if (CONTENSOU_FULL_TESTS)
        CHECK(run_program(command + " -o " + file + " --format " + format, start_table).status == 0);
      const Run contradicted =
          run_program(command + " -o " + file + " --format " + (ending == "csv" ? "json" : "csv"), start_table);
      CHECK(contradicted.status == 2);
      CHECK_THAT(contradicted.err, Contains("--format " + std::string(ending == "csv" ? "json" : "csv")));
    }
  }
}

TEST_CASE("law and roll draw where the ending is a picture's", "[cli]") {
  const TemporaryDirectory scratch;
  for (const std::string verb : {"law", "roll --ball pool"}) {
    for (const std::string ending : {"svg", "pdf", "png", "eps", "gp", "tex"}) {
      const std::string file = scratch.file("result." + ending);
      INFO(verb << " " << file);
      CHECK(run_program(verb + " -o " + file).status == 0);
      CHECK(read_file(file) == run_program(verb + " -o - --format " + ending).out);
      CHECK(read_file(file).size() > 4000);
    }
  }
}

TEST_CASE("an ending that a verb does not write is bad input", "[cli]") {
  const TemporaryDirectory scratch;
  for (const auto& [command, noun, endings] : outputs) {
    for (const std::string wrong : {"jpg", "JSON", "text", "npy", "toml", "html", "PNG"}) {
      if (std::ranges::find(endings, wrong) != endings.end()) continue;
      const std::string file = scratch.file("result." + wrong);
      const Run run = run_program(command + " -o " + file, start_table);
      INFO(command << " " << file << "\n" << run.err);
      CHECK(run.status == 2);
      CHECK(run.out.empty());
      CHECK_THAT(run.err,
                 Contains("-o ") && Contains(": " + noun + " is written as ") && Contains(", not as '" + wrong + "'"));
      for (const std::string& ending : endings) CHECK_THAT(run.err, Contains(ending));
    }
  }
  CHECK(run_program("sweep --mu 0.3 --u0 0:1:3 --v0 0:1:3 -o " + scratch.file("map.tex")).status == 2);
  CHECK(run_program("explore -o " + scratch.file("page.svg")).status == 2);
  CHECK(scratch.names().empty());
}

TEST_CASE("without an ending, what standard output would get", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string file = scratch.file("result");
  for (const auto& [command, noun, endings] : outputs) {
    const Run run = run_program(command + " -o " + file, start_table);
    INFO(command << "\n" << run.err);
    if (noun == "a sweep" || noun == "a portrait") {
      CHECK(run.status == 2);
      CHECK_THAT(run.err, Contains("-o " + file + ": " + noun + " is written as "));
      const std::string format = endings.front();
      CHECK(run_program(command + " -o " + file + " --format " + format).status == 0);
    } else {
      CHECK(run.status == 0);
      CHECK(read_file(file) == run_program(command, start_table).out);
    }
  }
}

TEST_CASE("without a file, numbers go to standard output and pictures to their default name", "[cli]") {
  for (const auto& [command, noun, endings] : outputs) {
    for (const std::string& ending : endings) {
      const TemporaryDirectory scratch;
      const std::string format = ending == "txt" ? "text" : ending;
      std::istringstream words(command + " --format " + format);
      const Run run = run_program({std::istream_iterator<std::string>(words), {}}, start_table,
                                  [&] { std::filesystem::current_path(scratch.path()); });
      INFO(command << " --format " << format << "\n" << run.err);
      CHECK(run.status == 0);
      const bool drawn = noun == "a portrait" && ending != "csv" && ending != "json";
      CHECK(scratch.names() == (drawn ? std::vector<std::string>{"portrait." + ending} : std::vector<std::string>{}));
      const std::string wanted = run_program(command + " -o - --format " + format, start_table).out;
      CHECK((drawn ? read_file(scratch.file("portrait." + ending)) : run.out) == wanted);
    }
  }
}

TEST_CASE("what is of a picture alone is refused with numbers", "[cli]") {
  for (const std::string numbers : {"roll --ball pool", "roll --ball pool --format text", "law --k 1",
                                    "portrait --mu 1 -o - --format csv", "sweep --mu 1 --u0 0:1:2 --v0 0:1:2"}) {
    for (const std::string option : {"--size single", "--title none", "--dpi 300", "--font Serif"}) {
      check_rejected(numbers + " " + option, option.substr(0, option.find(' ')) + ": ");
      check_rejected(numbers + " " + option, "is no picture; leave that out, or write one, as in -o figure.svg");
    }
  }
  for (const std::string option : {"--arrows one", "--field", "--axes off", "--colour none", "--style screen"}) {
    check_rejected("portrait --mu 1 -o - --format json " + option, "json is no picture");
  }
  check_rejected("law --k 1 --surface", "--surface: csv is no picture");
}
