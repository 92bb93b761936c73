#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace {

using Names = std::set<std::string>;

/// The names in the help of a verb.
struct Listed {
  Names json, csv, any;  ///< names after the word JSON or CSV; `any`: names without such a word
  Names parts;           ///< members of objects without such a word; they are columns of CSV
  Names words;           ///< all words of the list
};

/// Adds the names of an entry, such as: bounds [lower, upper]; CSV lower, upper
void add_names(Listed& listed, const std::string& names) {
  Names* to = &listed.any;
  int depth = 0;
  std::string word;
  for (const char letter : names + " ") {
    if (letter == '{' || letter == '[') ++depth;
    if (std::string(" ,;{}[]").find(letter) == std::string::npos) {
      word += letter;
    } else if (!word.empty() && (letter == '}' || letter == ']' || depth > 0)) {
      if (to == &listed.any) listed.parts.insert(word);
      word.clear();
    } else if (!word.empty()) {
      if (word == "in:") return;
      if (word == "JSON") to = &listed.json;
      if (word == "CSV" || word == "out:") to = &listed.csv;
      if (word != "JSON" && word != "CSV" && word != "out:" && word != "or" && word != "every") to->insert(word);
      word.clear();
    }
    if (letter == '}' || letter == ']') --depth;
  }
}

/// Returns the lists of `help fields`, by the verb and its option.
std::map<std::string, Listed> lists_of_help() {
  const std::string heading = "Columns and fields of ";
  std::map<std::string, Listed> lists;
  Listed* list = nullptr;
  std::string names;
  std::istringstream lines(run_program("help fields").out);
  for (std::string line; std::getline(lines, line);) {
    constexpr std::size_t meaning = 22;
    if (line.starts_with(heading)) list = &lists[line.substr(heading.size(), line.size() - heading.size() - 1)];
    if (list == nullptr || !line.starts_with("  ")) continue;
    const std::regex letters("[A-Za-z_][A-Za-z_0-9]*");
    for (auto word = std::sregex_iterator(line.begin(), line.end(), letters); word != std::sregex_iterator(); ++word)
      list->words.insert(word->str());
    if (line.find_first_not_of(' ') < meaning) names += line.substr(0, line.find("  ", line.find_first_not_of(' ')));
    if (line.size() > meaning && line[meaning] != ' ' && line[meaning - 1] == ' ' && line[meaning - 2] == ' ') {
      add_names(*list, names);
      names.clear();
    }
  }
  return lists;
}

/// The names in the output of a verb.
struct Written {
  Names members, nested, columns;
};

/// Adds the names of all members. The parameters of an engine are left out, because the engine names them.
void add_members(Names& all, const nlohmann::json& json) {
  for (const auto& [name, value] : json.items()) {
    if (json.is_object()) all.insert(name);
    if (name == "parameters") {
      for (const auto& parameter : value) add_members(all, parameter);
    } else if (value.is_structured()) {
      add_members(all, value);
    }
  }
}

Written written_by(const std::vector<std::vector<std::string>>& runs, const std::string& input) {
  Written names;
  for (const std::vector<std::string>& run : runs) {
    for (const char* format : {"json", "csv"}) {
      const bool is_batch = std::ranges::find(run, "--batch") != run.end() || run.front() == "sweep";
      if (is_batch && std::string(format) == "json") continue;
      std::vector<std::string> arguments = run;
      arguments.insert(arguments.end(), {"--format", format});
      const Run result = run_program(arguments, input);
      INFO(fmt::format("{}", fmt::join(arguments, " ")) << "\n" << result.err);
      REQUIRE((result.status == 0 || result.status == 1));
      if (std::string(format) == "csv") {
        std::istringstream lines(result.out);
        std::string header;
        while (std::getline(lines, header) && header.starts_with('#')) continue;
        std::istringstream columns(header);
        for (std::string column; std::getline(columns, column, ',');) names.columns.insert(column);
        continue;
      }
      const auto document = nlohmann::json::parse(result.out);
      for (const auto& [name, value] : document.items()) {
        if (name == "schema" || name == "version") continue;
        names.members.insert(name);
        if (value.is_structured()) add_members(names.nested, value);
      }
    }
  }
  return names;
}

/// Returns true if a name is listed; a * in the list stands for any text.
bool has(const Names& listed, const std::string& name) {
  return std::ranges::any_of(listed, [&](const std::string& pattern) {
    return std::regex_match(name, std::regex(std::regex_replace(pattern, std::regex("\\*|LAW"), ".*")));
  });
}

bool any_matches(const Names& names, const std::string& pattern) {
  return std::ranges::any_of(names, [&](const std::string& name) { return has({pattern}, name); });
}

/// Splits a command line at blanks. Text between ' is one word.
std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> all{""};
  bool quoted = false;
  for (const char letter : line) {
    if (letter == '\'') {
      quoted = !quoted;
    } else if (letter == ' ' && !quoted) {
      all.emplace_back();
    } else {
      all.back() += letter;
    }
  }
  return all;
}

}  // namespace

TEST_CASE("help lists the fields of each verb that JSON and CSV contain, and no others", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string load = scratch.file("load.csv"), film = scratch.file("film.csv"), spins = scratch.file("spins.csv");
  write_file(load, "t,load\n0,2\n1,4\n1.2,1\n");
  write_file(film, run_program("roll --ball pool --rolling-friction 0.01 --until 0.6 --samples 60 --format csv").out);
  // A film of the spin alone determines only a combination of two numbers.
  std::string spin_alone = "t,spin,angle\n";
  for (int i = 0; i < 40; ++i) {
    const double t = 0.1 * i;
    spin_alone += fmt::format("{},{},{}\n", t, 100 - 10 * t + 0.01 * (i % 3 - 1), 100 * t - 5 * t * t);
  }
  write_file(spins, spin_alone);
  // Neighbouring errors of a camera depend on each other.
  std::string dependent = "t,slip\n";
  for (int i = 0; i < 112; ++i) {
    const double t = 0.25 * i / 111;
    dependent += fmt::format("{},{}\n", t, 1 - 1.96 * t + 0.003 * std::sin(50 * t) + 5e-4 * (i * 7 % 5 - 2));
  }
  const std::string camera = scratch.file("camera.csv");
  write_file(camera, dependent);
  const std::string against = "check --ball pool --rolling-friction 0.01 --against " + film;
  const std::string y_up = "check --ball puck --against " + scratch.file("y_up.csv");
  write_file(scratch.file("y_up.csv"), "t,vx,vy,vz,wx,wy,wz\n0,1,0,1,0,1,0\n0.1,0.93,0,0.93,0,0.93,0\n");
  const std::string start = " --mu 0.3 --u0 1 --v0 1", system = " --u0 1 --v0 1 --system ";
  // For each title of a list in the help: commands whose output together contains all names of the list.
  const std::vector<std::pair<std::string, std::vector<std::string>>> commands{
      {"stop",
       {"stop --ball pool --gradient --uncertainty slip=1%", "stop --estimate" + start,
        "stop --ball pool --rolling-friction 0.01", "stop --law soft:1" + start, "stop --drive 0.1" + start,
        "stop --ball puck --load " + load}},
      {"stop --batch",
       {"stop --batch -", "stop --batch - --ball pool", "stop --batch - --law exact,pade",
        "stop --batch - --ball pool --law exact,pade"}},
      {"orbit",
       {"orbit --estimate --reduction" + start, "orbit --ball puck --load " + load, "orbit --time-left 0.1" + start}},
      {"orbit --system", {"orbit --at 0,1" + system + "'x\\' = -x; y\\' = -2*y'"}},
      {"law", {"law --k 0,1"}},
      {"law --ball", {"law --ball puck --load 2"}},
      {"roll",
       {"roll --ball pool --samples 3 --gradient --uncertainty slip=1% --route integrated",
        "roll --ball pool --samples 3 --rolling-friction 0.01 --slope -1",
        "roll --ball puck --samples 3 --load " + load}},
      {"roll --batch", {"roll --batch - --ball pool --rolling-friction 0.01"}},
      {"bounce", {"bounce --ball steel --drop 0.1 --restitution 0.8"}},
      {"portrait",
       {"portrait --orbits 2 -o - --ball pool --view regularised --through 10,0.1 --slip 1 --spin 100",
        "portrait --orbits 2 -o - --against pade --law exact --drive 0.1" + start,
        "portrait --orbits 2 -o - --against uncoupled" + start, "portrait --orbits 2 -o - --mu 0.1,0.3",
        "portrait --orbits 2 -o - --through 0.5,0.5" + system + "'u\\' = -u; v\\' = -2*v'",
        "portrait --orbits 2 -o -" + system + "'u\\' = v; v\\' = u - u^3'",
        "portrait --orbits 2 -o - --window 0:2,0:2" + system + "'u\\' = u*(1-v); v\\' = v*(u-1)'",
        "portrait --orbits 2 -o - --view disc" + system + "'u\\' = u^2; v\\' = v'",
        "portrait --orbits 2 -o - --nullclines" + system + "'u\\' = v; v\\' = (1-u^2)*v - u'",
        "portrait --orbits 2 -o -" + system + "'u\\' = -u*v; v\\' = u*v - 0.2*v'"}},
      {"portrait --facts", {"portrait --facts --mu 0.3", "portrait --facts --mu 0.3 --drive 0.1"}},
      {"sweep", {"sweep --mu 0.1 --u0 0:1:2 --v0 1", "sweep --ball pool --slip 0:1:2 --spin 1"}},
      {"check", {"check --mu 0.1 --u0 1 --v0 1", against, y_up}},
      {"terminal", {"terminal --law uniform --body disc", "terminal --mu 0.1 --drive 0.1"}},
      {"reduce", {"reduce --drive 0.1" + start, "reduce" + start}},
      {"reduce --system",
       {"reduce --x0 1 --y0 1 --system 'y\\' = y'", "reduce" + system + "'u\\' = -u; v\\' = -2*v'",
        "reduce --until 2" + system + "'u\\' = v; v\\' = -sin(u)'", "reduce" + system + "'u\\' = -u-v; v\\' = u-v'",
        "reduce" + system + "'u\\' = exp(u); v\\' = exp(v)'",
        "reduce" + system + "'u\\' = v; v\\' = -sign(u) - 0.5*sign(v)'",
        "reduce" + system + "'u\\' = v; v\\' = (1-u^2)*v - u'"}},
      {"fit",
       {"fit " + film + " --ball pool --rolling-friction 0.01", "fit " + spins + " --ball pool --noise spin=1,angle=1",
        "fit " + camera + " --ball puck"}},
      {"balls", {"balls"}},
      {"aim",
       {"aim --ball pool --distance 1 --turns 3", "aim --ball pool --distance 1 --turns 3 --rolling-friction 0.01"}},
      {"engine", {"engine --ball pool"}},
      {"paper", {"paper"}},
      {"literature", {"literature"}},
  };
  auto lists = lists_of_help();
  const std::vector<std::string> names_of_files = names_in_help("files");  // the names of a ball's run file
  CHECK(lists.size() == commands.size());
  for (const auto& [title, lines] : commands) {
    INFO(title);
    REQUIRE(lists.contains(title));
    const auto& [json, csv, any, parts, own_words] = lists.at(title);
    Names all_words = own_words;
    for (const std::string& other : {std::string("stop"), std::string("terminal")}) {
      if (own_words.contains("as") && own_words.contains(other)) all_words.merge(Names(lists.at(other).words));
    }
    all_words.insert(names_of_files.begin(), names_of_files.end());
    std::vector<std::vector<std::string>> runs;
    for (const std::string& line : lines) {
      runs.push_back(words(std::regex_replace(line, std::regex("\\\\'"), "\x01")));
      for (std::string& word : runs.back()) std::ranges::replace(word, '\x01', '\'');
    }
    const std::string table = title == "roll --batch" || lines.size() > 1 ? "mu,u0,v0,slip,spin\n0.3,1,1,1,1\n" : "";
    const auto& [members, nested, columns] = written_by(runs, table);
    // These columns of the input are copied to the output.
    const Names inputs = title.ends_with("--batch") ? Names{"mu", "u0", "v0", "slip", "spin"} : Names{};
    for (const std::string& name : members) {
      INFO("JSON member that help does not list: " << name);
      CHECK((has(json, name) || has(any, name)));
    }
    for (const std::string& name : columns) {
      INFO("column of CSV that help does not list: " << name);
      CHECK((has(csv, name) || has(any, name) || parts.contains(name) || inputs.contains(name)));
    }
    for (const std::string& name : json) {
      INFO("listed as JSON alone: " << name);
      CHECK((members.contains(name) || nested.contains(name)));
      CHECK((csv.contains(name) || any.contains(name) || !columns.contains(name)));
    }
    for (const std::string& name : csv) {
      INFO("listed as CSV: " << name);
      CHECK(any_matches(columns, name));
      CHECK((json.contains(name) || any.contains(name) || !members.contains(name)));
    }
    for (const std::string& name : any) {
      INFO("listed and not written: " << name);
      CHECK((members.contains(name) || nested.contains(name) || columns.contains(name)));
    }
    for (const std::string& name : nested) {
      INFO("nested in JSON, and no word of help: " << name);
      CHECK(all_words.contains(name));
    }
  }
}
