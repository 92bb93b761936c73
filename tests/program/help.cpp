#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "answers/verbs/plane_answers.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> topics{"ball",  "laws",  "picture", "output", "views",
                                      "units", "files", "fields",  "theory"};

/// Returns the options that stand at the beginning of a text's lines.
std::set<std::string> options_of(const std::string& help) {
  std::set<std::string> options;
  const std::regex lines("\n +(-[^\n]*)"), names("--[a-z][a-z0-9-]*");
  for (std::sregex_iterator line(help.begin(), help.end(), lines), none; line != none; ++line) {
    const std::string text = line->str(1);
    for (std::sregex_iterator name(text.begin(), text.end(), names); name != none; ++name) options.insert(name->str());
  }
  return options;
}

}  // namespace

TEST_CASE("every verb has help with an example", "[cli]") {
  const std::vector<std::string> verbs = names_in_help("");
  REQUIRE(verbs.size() >= 12);
  for (const std::string& verb : verbs) {
    const Run run = run_program(verb + " --help");
    INFO(verb);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK_THAT(run.out, Contains("Example:") && Contains("contensou " + verb));
    const std::string heading = "\nColumns and fields of " + verb + ":\n";
    CHECK(run.out.find(heading) == run.out.rfind(heading));
    CHECK(run_program("help " + verb).out == run.out);
    CHECK_THAT(run_program("--help").out, Contains("\n  " + verb + " ") && Contains("contensou " + verb));
  }
  CHECK(run_program("help").out == run_program("--help").out);
}

TEST_CASE("the help of a verb is short: topics explain the options that verbs share", "[cli]") {
  for (const std::string& verb : names_in_help("")) {
    const std::string help = run_program(verb + " --help").out;
    INFO(verb);
    CHECK(std::ranges::count(help, '\n') <= 110);
    const std::regex shared("\n[^\n]* \\('contensou help ([a-z]+)'\\):\n((  [^\n]*\n)+)");
    for (std::sregex_iterator group(help.begin(), help.end(), shared), none; group != none; ++group) {
      if (group->str(1) == "fields") continue;
      const std::set<std::string> named = options_of("\n" + group->str(2));
      const std::set<std::string> explained = options_of(run_program("help " + group->str(1)).out);
      INFO(group->str());
      CHECK(!named.empty());
      CHECK(std::ranges::includes(explained, named));
    }
  }
  CHECK(options_of(run_program("stop --help").out).contains("--patch-radius"));
}

TEST_CASE("no line of help is longer than 80 columns", "[cli]") {
  std::string text = run_program("--help").out;
  for (const auto& names : {names_in_help(""), topics}) {
    for (const std::string& name : names) text += run_program("help " + name).out;
  }
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK(std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }) <= 80);
  }
}

TEST_CASE("topics of help", "[cli]") {
  const std::string laws = run_program("help laws").out;
  for (const auto& law : contensou::reduction::named_laws()) {
    const auto name = laws.find("\n  " + law.name() + " ");
    REQUIRE(name != std::string::npos);
    INFO(law.name());
    CHECK(laws[laws.find_first_not_of(' ', name + law.name().size() + 3)] != '\n');  // text follows the name
  }
  for (const auto& family : contensou::reduction::law_families()) {
    CHECK_THAT(laws, Contains(fmt::format("\n  {}:{} ", family.name, family.letter)));
  }
  CHECK(names_in_help("views").size() >= 8);
  CHECK_THAT(run_program("help units").out, Contains("m, cm, mm, in or ft") && Contains("rev/s or rpm"));
  CHECK_THAT(run_program("help files").out, Contains("spin_deceleration") && Contains("[contact.hertz]"));
  CHECK_THAT(run_program("help roll").out, Contains("slip_length") && Contains("rolling-friction"));
  CHECK_THAT(run_program("help roll").out, Contains("miscues") && Contains("uncoupled model"));
}

TEST_CASE("every kind and every end that reduce prints stands in the help on fields", "[cli]") {
  // Take the part of the help about columns, with each run of blanks as one blank.
  std::string help = run_program("help fields").out;
  help = std::regex_replace(help.substr(help.find("Columns and fields of reduce --system:")), std::regex("\\s+"), " ");
  const auto listed = [&](const std::string& field) {
    const std::size_t begin = help.find("every " + field + " ") + field.size() + 7, end = help.find(';', begin);
    REQUIRE(end < help.size());
    return ", " + help.substr(begin, end - begin) + ",";
  };
  const std::string kinds = listed("kind"), ends = listed("end");
  for (const std::string_view kind : contensou::reduction::planar_kinds) {
    CHECK_THAT(kinds, Contains(fmt::format(", {},", kind)));
  }
  CHECK(std::ranges::count(kinds, ',') == std::ssize(contensou::reduction::planar_kinds) + 1);
  for (const std::string_view end : contensou::answers::named_ends()) {
    CHECK_THAT(ends, Contains(fmt::format(", {},", end)));
  }
  CHECK(contensou::answers::named_ends().size() == 6);
}

TEST_CASE("help theory is one screen, whose equations are those of the program", "[cli]") {
  const std::string text = run_program("help theory").out;
  CHECK(std::ranges::count(text, '\n') <= 70);
  CHECK(std::ranges::all_of(text, [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
  // Convert the equations of `help` to the form that `reduce --system` reads: du/dtau = -5 mu^2 u/(...) becomes u' =
  // -5*mu^2*u/(...).
  const auto reduced = [&](const std::string& time) {
    std::smatch lines;
    REQUIRE(std::regex_search(text, lines, std::regex("du/d" + time + " = (.*)\n *dv/d" + time + " = (.*?) +\\(2")));
    std::string system = fmt::format("u' = {}; v' = {}", lines.str(1), lines.str(2));
    system = std::regex_replace(system, std::regex("\\|u\\|"), "abs(u)");
    system = std::regex_replace(system, std::regex("([a-z0-9)]) (?=[a-z(])"), "$1*");
    system = std::regex_replace(system, std::regex("pi\\*v"), "pi*abs(v)");  // `reduce` also evaluates v < 0
    const Run run =
        run_program({"reduce", "--system", system, "--param", "mu=0.3", "--u0", "2", "--v0", "1", "--format", "json"});
    INFO(system << run.err);
    REQUIRE(run.status == 0);
    return nlohmann::json::parse(run.out);
  };
  const auto in_tau = reduced("tau"), in_beta = reduced("beta");
  const auto stop = json_of("stop --mu 0.3 --u0 2 --v0 1 --law pade --format json");
  CHECK(in_tau["tau_stop"].get<double>() == Approx(stop["tau_stop"].get<double>()).epsilon(1e-9));
  CHECK_THAT(text, Contains("X = tau d/dtau + u d/du + v d/dv\n    X = -beta d/dbeta + u d/du + v d/dv\n"));
  CHECK(in_tau["generators"][0]["time"].get<double>() == Approx(1).epsilon(1e-9));
  CHECK(in_beta["generators"][0]["time"].get<double>() == Approx(-1).epsilon(1e-9));
  for (const char* word : {"symmetry", "equations", "generator", "reduction", "canonical", "integral", "theorem"}) {
    CHECK(run_program(std::string("help ") + word).out == text);
  }
}

TEST_CASE("the cookbook says what each row of check measures", "[cli]") {
  const std::string chapter =
      read_file(std::filesystem::path(CONTENSOU_README).parent_path() / "src/program/README.md");
  const auto checks = json_of("check --format json")["checks"];
  REQUIRE(checks.size() > 20);
  for (const auto& check : checks) {
    const std::string name = check["check"];
    CHECK_THAT(chapter, Contains("\n- `" + name.substr(0, name.find(", with a drive")) + "`: "));
  }
  CHECK_THAT(chapter, Contains("with a drive"));
}

TEST_CASE("completion", "[cli]") {
  const auto completed = [](const std::string& line) {
    const TemporaryDirectory scratch;
    const auto folder = std::filesystem::path(CONTENSOU_README).parent_path() / "src/program/manners";
    write_file(scratch.file("script"),
               "source " + (folder / "contensou").string() + "\nCOMP_WORDS=(" + CONTENSOU_PROGRAM + " " + line +
                   ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_contensou\necho ${COMPREPLY[@]} >" +
                   scratch.file("out"));
    REQUIRE(std::system(("bash '" + scratch.file("script") + "'").c_str()) == 0);
    return read_file(scratch.file("out"));
  };
  CHECK(completed("st") == "stop\n");
  CHECK(completed("roll --sp") == "--spin-deceleration --spin\n");
  CHECK(completed("stop --law p") == "pade punch paraboloid\n");
  CHECK(completed("portrait --view s") == "similarity story\n");
  CHECK(completed("stop --ball p") == "pool puck\n");
  CHECK(completed("engine p") == "physx pooltool\n");
  CHECK(completed("help un") == "units\n");
  CHECK(completed("stop --batch x") == "\n");
}

TEST_CASE("the examples of the help work", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string help = run_program("--help").out;
  std::size_t at = help.find("Examples:");
  REQUIRE(at != std::string::npos);
  int examples = 0;
  while ((at = help.find("\n  contensou ", at)) != std::string::npos) {
    at += std::string("\n  contensou ").size();
    std::string example = help.substr(at, help.find('\n', at) - at);
    if (const auto file = example.find("-o "); file != std::string::npos) {
      if (example.ends_with(".svg") || example.ends_with(".html")) continue;  // needs gnuplot, or a page in the program
      example.replace(file, 3, "-o " + scratch.path().string() + "/");
    }
    if (example.find("--out ") != std::string::npos) continue;  // this example needs gnuplot
    INFO(example);
    CHECK(run_program(example).status == 0);
    ++examples;
  }
  CHECK(examples >= 5);
}
