#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "answers/verbs/fields.hpp"
#include "contensou/reduction/laws.hpp"
#include "output/formula.hpp"
#include "run_program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::vector<std::string> topics{"laws", "views", "units", "files", "theory"};

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
    CHECK(run.out.find("\nColumns and fields:\n") == run.out.rfind("\nColumns and fields:\n"));
    CHECK(run_program("help " + verb).out == run.out);
    CHECK_THAT(run_program("--help").out, Contains("\n  " + verb + " ") && Contains("contensou " + verb));
  }
  CHECK(run_program("help").out == run_program("--help").out);
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
    CHECK(laws[laws.find_first_not_of(' ', name + law.name().size() + 3)] != '\n');  // it has a meaning
  }
  for (const auto& family : contensou::reduction::law_families()) {
    CHECK_THAT(laws, Contains(fmt::format("\n  {}:{} ", family.name, family.letter)));
  }
  CHECK(names_in_help("views").size() >= 8);
  CHECK_THAT(run_program("help units").out, Contains("m, cm, mm, in or ft") && Contains("rev/s or rpm"));
  CHECK_THAT(run_program("help files").out, Contains("spin_deceleration") && Contains("[contact.hertz]"));
  CHECK_THAT(run_program("help roll").out, Contains("slip_length") && Contains("rolling-friction"));
  CHECK_THAT(run_program("help roll").out, Contains("squirt") && Contains("by the same threshold"));
  check_rejected("help unit",
                 "no such topic (did you mean 'units'?); topics: laws, views, units, files, theory, aim, bounce");
  check_rejected("help stop law", "unexpected argument 'law'");
}

TEST_CASE("the table of fields in src/README.md is that of the answers", "[table]") {
  std::string table = "| verb | field | unit | |\n|---|---|---|---|\n";
  for (const auto& [verb, fields] : contensou::answers::field_table()) {
    std::string first = verb == "all" ? verb : fmt::format("`{}`", verb);
    for (const auto& [names, unit, meaning] : fields) {
      const std::string cell = std::exchange(first, "");
      table += fmt::format("|{}{} | {} |{}{} | {} |\n", cell.empty() ? "" : " ", cell, names, unit.empty() ? "" : " ",
                           unit, meaning);
    }
  }
  const auto path = std::filesystem::path(CONTENSOU_README).parent_path() / "src/README.md";
  std::stringstream readme;
  readme << std::ifstream(path).rdbuf();
  INFO("It has to hold this:\n" << table);
  CHECK(readme.str().find("\n\n" + table + "\n") != std::string::npos);
}

TEST_CASE("formulas of TeX as plain text", "[table]") {
  using contensou::program::plain_formula;
  const std::vector<std::pair<std::string, std::string>> formulas{
      {R"(\frac{d \ln w}{d \ln k} = \frac{r k \Psi}{D})", "d ln w/d ln k = r k Psi/D"},
      {R"(-\frac{7 v}{8 \mu |u| + 3\pi v})", "-7 v/(8 mu |u| + 3 pi v)"},
      {R"(J \dot{\omega}_z, \ddot{x})", "J domega_z/dt, d2x/dt2"},
      {R"(\frac{\partial s_\ast}{\partial v} = \frac{w - r \Psi s_\ast}{w D})", "ds*/dv = (w - r Psi s*)/(w D)"},
      {R"(\frac12 \int_{k_\ast}^k g\, d\tau)", "1/2 Int(k*, k) g dtau"},
      {R"(c_\infty = \frac{K}{\Psi(0)}, \quad m_0 \le k^{1/a})", "c_inf = K/Psi(0),   m0 <= k^(1/a)"},
      {R"(\sqrt{v_x^2 + v_y^2} \ge 0)", "sqrt(v_x^2 + v_y^2) >= 0"},
      {R"(r_\text{low} \to 2\chi/(3\pi))", "r_low -> 2 chi/(3 pi)"},
  };
  for (const auto& [tex, text] : formulas) CHECK(plain_formula(tex) == text);
  std::string number;
  CHECK(plain_formula(R"(a = b \tag{R4})", &number) == "a = b ");
  CHECK(number == "R4");
  for (const char* wrong : {R"(\Omega)", "{a", "a}", R"(\frac{a})", "a_"}) {
    CHECK_THROWS_AS(plain_formula(wrong), std::logic_error);
  }
}

TEST_CASE("help theory has every equation of reduction/README.md's chapter, in words and as TeX", "[cli]") {
  std::ifstream file(CONTENSOU_THEORY);
  std::string readme{std::istreambuf_iterator<char>(file), {}};
  const auto begin = readme.find("\n## Theory\n"), end = readme.find("\n## Proofs\n");
  REQUIRE(begin < end);
  const std::string chapter = readme.substr(begin, end - begin);
  const std::string text = run_program("help theory").out;
  const std::string tex = run_program("help theory --format tex").out;
  CHECK_THAT(tex, StartsWith("\\documentclass") && Catch::Matchers::EndsWith("\\end{document}\n"));

  int equations = 0;
  const std::string open = "```math\n", close = "```\n";
  for (std::size_t at = chapter.find(open); at != std::string::npos; at = chapter.find(open, at + 1), ++equations) {
    const std::size_t first = at + open.size();
    const std::string formula = chapter.substr(first, chapter.find(close, first) - first);
    CHECK_THAT(tex, Contains("\\begin{equation*}\n" + formula + "\\end{equation*}\n"));
    std::string number;
    std::istringstream parts(contensou::program::plain_formula(formula, &number));
    std::string part;
    std::getline(parts, part);
    CHECK_THAT(text, Contains("\n    " + part.substr(0, part.find(" = "))));
    if (!number.empty()) CHECK_THAT(text, Contains(fmt::format(" ({})\n", number)));
  }
  CHECK(equations == 28);
  CHECK_THAT(text, Contains("\n    double stop_time(double k, double r) {\n"));
  for (int i = 1; i <= 8; ++i) CHECK_THAT(text, Contains(fmt::format(" (2.{})\n", i)));
  CHECK_THAT(text, Contains("dp/dq = Phi/(q D)") && Contains("X2 = tau d_tau + u d_u + v d_v"));
  CHECK(text.find_first_of("\\$`") == std::string::npos);

  // What `check` measures: a row each, of every law and start.
  const auto checks = nlohmann::json::parse(run_program("check --format json").out)["checks"];
  REQUIRE(checks.size() > 20);
  for (const auto& check : checks) {
    const std::string name = check["check"];
    CHECK_THAT(text, Contains("\n  " + name.substr(0, name.find(", with a drive"))));
  }
  CHECK_THAT(text, Contains("with a drive"));

  check_rejected("help laws --format tex", "--format tex: is for the theory: contensou help theory --format tex");
  check_rejected("help theory --format html", "no such format");
}

TEST_CASE("a section of the theory alone, by a word of its heading or of its text", "[cli]") {
  const std::string whole = run_program("help theory").out;
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  for (const auto& [word, heading] :
       std::vector<std::pair<std::string, std::string>>{{"equations", "The paper's equations:"},
                                                        {"symmetry", "Symmetry and reduction:"},
                                                        {"Reduction", "Symmetry and reduction:"},
                                                        {"theorem", "The theorem:"},
                                                        {"canonical", "Symmetry and reduction:"},
                                                        {"hypotheses", "Any law, any body:"}}) {
    INFO(word);
    const Run run = run_program("help theory " + word);
    CHECK(run.status == 0);
    CHECK(first_line(run.out) == heading);
    CHECK_THAT(whole, Contains("\n" + run.out) || StartsWith(run.out));
    CHECK(run.out.size() < whole.size() / 2);
    CHECK(run_program("help " + word).out == run.out);
  }
  CHECK(first_line(run_program("help theory check").out) == "What check measures:");
  CHECK(first_line(run_program({"help", "theory", "small mu"}).out) == "Small mu:");
  check_rejected("help theory nonsense", "SECTION nonsense: no such section");
  check_rejected("help nonsense", "no such topic; topics: laws");
  check_rejected("help theory symmetry --format tex", "--format tex: is for the theory");
}

TEST_CASE("values in other units", "[cli]") {
  using std::numbers::pi;
  struct Typed {
    std::vector<std::string> arguments;
    std::string field;
    double value;
  };
  const auto pool = [](std::vector<std::string> more) {
    std::vector<std::string> all{"stop", "--ball", "pool", "--format", "json"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  constexpr double radius = 0.028575;
  const std::vector<Typed> all{
      {pool({"--slip", "2 m/s"}), "v0", 2},
      {pool({"--slip", "7.2km/h"}), "v0", 2},
      {pool({"--slip", "1e1 mph"}), "v0", 4.4704},
      {pool({"--slip", " 10 ft/s "}), "v0", 3.048},
      {pool({"--spin", "300 rpm"}), "u0", 10 * pi * radius},
      {pool({"--spin", "-5 rev/s"}), "u0", -10 * pi * radius},
      {pool({"--spin", "90 deg/s"}), "u0", pi / 2 * radius},
      {pool({"--radius", "2.25 in", "--spin", "1"}), "u0", 0.05715},
      {pool({"--radius", "28.575 mm", "--spin", "1"}), "u0", radius},
      {pool({"--patch-radius", "0.28575 cm"}), "mu", 0.1},
      {{"roll", "--ball", "pool", "--format", "json", "--velocity", "3.6,7.2 km/h"}, "velocity", 1},
      {{"roll", "--ball", "pool", "--format", "json", "--angular-velocity", "1 rev/s, 0 rpm, 0"}, "", 0},
      {{"roll", "--ball", "pool", "--format", "json", "--angular-velocity", "60,0,0 rpm"}, "angular_velocity", 2 * pi},
      {{"roll", "--ball", "pool", "--format", "json", "--at", "100,200 ms"}, "t", 0.1},
      {{"roll", "--ball", "pool", "--format", "json", "--samples", "2", "--until", "0.5 min"}, "t", 0},
  };
  for (const auto& [arguments, field, value] : all) {
    const Run run = run_program(arguments);
    INFO(Catch::Detail::stringify(arguments) << run.err);
    CHECK(run.status == (field.empty() ? 2 : 0));
    if (run.status != 0) continue;
    const auto found = nlohmann::json::parse(run.out)[field];
    CHECK((found.is_array() ? found[0] : found).get<double>() == Approx(value).epsilon(1e-15).margin(0));
  }
  const Run refused = run_program(pool({"--slip", "2 furlongs"}));
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("--slip: '2 furlongs' has the unit 'furlongs', which is none of m/s, cm/s"));
  CHECK_THAT(run_program(pool({"--slip", "two"})).err,
             Contains("'two' is not a number") && Contains("in m/s, or with m/s, cm/s"));
  CHECK_THAT(run_program(pool({"--spin", "3 m/s"})).err, Contains("rad/s, deg/s, rev/s or rpm"));
  CHECK_THAT(run_program({"stop", "--mu", "1", "--u0", "1", "--v0", "1 m/s"}).err, Contains("'1 m/s' is not a number"));
  const std::vector<std::string> sweep{"sweep", "--ball", "pool", "--spin", "0:60 rpm:2", "--slip", "100:200 cm/s:2"};
  CHECK(std::stod(rows_of(run_program(sweep).out).back()[0]) == Approx(2 * pi).epsilon(1e-15));
  CHECK(rows_of(run_program(sweep).out).back()[1] == "2");
}

TEST_CASE("other names", "[cli]") {
  const auto same = [](const std::string& one, const std::string& other) {
    const Run run = run_program(one);
    CHECK(run.status == 0);
    CHECK(run.out == run_program(other).out);
  };
  same("stop --ball pool --law hertz", "stop --ball pool --law exact");
  same("stop --body puck --u0 1 --v0 1", "stop --body disc --u0 1 --v0 1");
  same("portrait --mu 1 --color none -o - --format gp", "portrait --mu 1 --colour none -o - --format gp");
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
  CHECK(completed("portrait --view s") == "similarity\n");
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
      if (example.ends_with(".svg") || example.ends_with(".html")) continue;  // needs gnuplot, or a page built in
      example.replace(file, 3, "-o " + scratch.path().string() + "/");
    }
    if (example.find("--out ") != std::string::npos) continue;  // needs gnuplot
    INFO(example);
    CHECK(run_program(example).status == 0);
    ++examples;
  }
  CHECK(examples >= 5);
}

TEST_CASE("the version", "[cli]") {
  const Run run = run_program("--version");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, StartsWith("contensou 0."));
}
