#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

/// The first line that a command of the shell says before it ends with status 4.
std::string failure_of(const std::string& command) {
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  char said[200] = "";
  CHECK(std::fgets(said, sizeof said, pipe) != nullptr);
  CHECK(WEXITSTATUS(::pclose(pipe)) == 4);
  return said;
}

}  // namespace

TEST_CASE("-o writes what standard output would get", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string orbit = "orbit --mu 0.1 --u0 1 --v0 1";
  const Run run = run_program(orbit + " -o " + scratch.file("orbit.csv"));
  CHECK(run.status == 0);
  CHECK(run.out.empty());
  CHECK(read_file(scratch.file("orbit.csv")) == run_program(orbit).out);
  CHECK(run_program(orbit + " -o -").out == run_program(orbit).out);
  CHECK(scratch.names() == std::vector<std::string>{"orbit.csv"});
}

TEST_CASE("a table in TeX has the columns of CSV and the digits of text", "[cli]") {
  const auto cells_of = [](std::string line, const std::string& mark) {
    std::vector<std::string> cells;
    for (std::size_t end; (end = line.find(mark)) != line.npos; line.erase(0, end + mark.size()))
      cells.push_back(line.substr(0, end));
    cells.push_back(line);
    return cells;
  };
  const auto value = [](std::string cell) {
    for (const auto& [tex, plain] : {std::pair{"\\cdot10^{", "e"}, {"10^{", "1e"}, {"\\infty", "inf"}}) {
      if (const std::size_t at = cell.find(tex); at != cell.npos) cell.replace(at, std::string(tex).size(), plain);
    }
    REQUIRE(cell.starts_with('$'));
    return std::stod(cell.substr(1));
  };
  const std::string orbit = "orbit --mu 0.3 --u0 1 --v0 1 --samples 9 ";
  std::istringstream tex(run_program(orbit + "--format tex --digits 4").out), csv(run_program(orbit).out);
  const auto next = [](std::istringstream& from) {
    std::string line;
    do std::getline(from, line);
    while (line.starts_with('#') || line.starts_with('%') || line.starts_with("\\begin") || line == "\\hline");
    return line;
  };
  CHECK(next(tex) ==
        "\\texttt{tau} & \\texttt{u} & \\texttt{v} & \\texttt{ln\\_v} & \\texttt{k} & \\texttt{beta} \\\\");
  CHECK(next(csv) == "tau,u,v,ln_v,k,beta");
  for (int row = 0; row < 9; ++row) {
    const auto shown = cells_of(next(tex), " & "), all = cells_of(next(csv), ",");
    REQUIRE(shown.size() == all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      CHECK(value(shown[i]) == std::stod(fmt::format("{:.4g}", std::stod(all[i]))));
  }
  CHECK(next(tex) == "\\end{tabular}");
  // Of fewer rows than columns it is turned.
  CHECK_THAT(run_program("stop --mu 0.3 --u0 1 --v0 1 --format tex").out,
             Contains("\\begin{tabular}{ll}") && Contains("\n\\texttt{mu} & $0.3$ \\\\\n"));
  CHECK_THAT(run_program("check --mu 0.3 --u0 1 --v0 1 --law exact --format tex").out,
             Contains("{llrrl}") && Contains("first integral along (2.7) & $"));
  CHECK_THAT(run_program("law --format tex --digits 3").err, Contains("a picture has no digits"));
}

TEST_CASE("-o leaves the old file when there is nothing new to write", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("old"), "old");
  CHECK(run_program("stop --mu 7 --u0 1 --v0 1 -o " + scratch.file("old")).status == 2);
  CHECK(read_file(scratch.file("old")) == "old");
  CHECK(run_program("stop --mu 0.7 --u0 1 --v0 1 -o " + scratch.file("old")).status == 0);
  CHECK(read_file(scratch.file("old")) != "old");
  CHECK(scratch.names() == std::vector<std::string>{"old"});
}

TEST_CASE("-o through a link replaces the file and keeps the link", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("file"), "old");
  fs::create_symlink("file", scratch.file("link"));
  CHECK(run_program("balls pool -o " + scratch.file("link")).status == 0);
  CHECK(fs::is_symlink(scratch.file("link")));
  CHECK(read_file(scratch.file("file")) == run_program("balls pool").out);
  // Also to a file that is not there yet.
  fs::create_symlink("later.csv", scratch.file("link.csv"));
  CHECK(run_program("stop --mu 1 --u0 1 --v0 1 --format csv -o " + scratch.file("link.csv")).status == 0);
  CHECK(fs::is_symlink(scratch.file("link.csv")));
  CHECK(read_file(scratch.file("later.csv")).starts_with("law,route"));
}

TEST_CASE("-o keeps the permissions of the file that it replaces", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("private"), "old");
  fs::permissions(scratch.file("private"), fs::perms::owner_read | fs::perms::owner_write);
  CHECK(run_program("balls pool -o " + scratch.file("private")).status == 0);
  CHECK(fs::status(scratch.file("private")).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("what cannot be written is status 4 and leaves nothing", "[cli]") {
  const TemporaryDirectory scratch;
  fs::create_directory(scratch.file("folder"));
  for (const std::string& path :
       {scratch.file("no/such/file"), scratch.file("folder"), std::string("/dev/full"), scratch.file("folder/")}) {
    const Run run = run_program("stop --ball pool -o " + path);
    INFO(path);
    CHECK(run.status == 4);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Contains("cannot write " + path + ": "));
  }
  CHECK(scratch.names() == std::vector<std::string>{"folder"});
  CHECK(fs::is_empty(scratch.file("folder")));
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("a limit on the size of files is named as the cause", "[limit]") {
  const TemporaryDirectory scratch;
  const std::string command =
      fmt::format("ulimit -f 8; '{}' portrait --mu 0.3 -o '{}' 2>&1", CONTENSOU_PROGRAM, scratch.file("p.svg"));
  CHECK_THAT(failure_of(command), Contains("File too large"));
  CHECK(scratch.names().empty());
}

TEST_CASE("a font that is not installed is told with the one that is drawn", "[cli]") {
  const TemporaryDirectory scratch;
  const auto said = [&](const std::string& font, const std::string& file) {
    return run_program({"law", "--font", font, "-o", scratch.file(file)}).err;
  };
  const std::string words = "--font 'No Such Font': no such font is installed; drawn in ";
  for (const char* file : {"a.pdf", "a.png", "a.eps"}) CHECK_THAT(said("No Such Font", file), Contains(words));
  const std::string told = said("No Such Font", "a.pdf");
  const std::size_t name = told.find(words) + words.size();
  const std::string installed = told.substr(name, told.find('\n') - name);
  for (const std::string& font : {std::string("sans"), std::string("serif"), installed, installed + " bold"}) {
    CAPTURE(font);
    CHECK_THAT(said(font, "a.pdf"), !Contains("installed"));
  }
  CHECK_THAT(said("No Such Font", "a.svg"), !Contains("installed"));  // whoever shows it may have it
}

TEST_CASE("a full standard output is status 4", "[cli]") {
  const char* const command = "'" CONTENSOU_PROGRAM "' stop --ball pool >/dev/full 2>/dev/null";
  const int ended = std::system(command);
  CHECK(WEXITSTATUS(ended) == 4);
}

TEST_CASE("a link that leads to itself is refused and stays", "[cli]") {
  const TemporaryDirectory scratch;
  fs::create_symlink("there", scratch.file("here"));
  fs::create_symlink("here", scratch.file("there"));
  const Run run = run_program("balls pool -o " + scratch.file("here"));
  CHECK(run.status == 4);
  CHECK_THAT(run.err, Contains("cannot write " + scratch.file("here") + ": Too many levels of symbolic links"));
  CHECK(fs::is_symlink(scratch.file("here")));
}

TEST_CASE("a read-only file is refused, with a way out", "[cli]") {
  const TemporaryDirectory scratch;
  write_file(scratch.file("old"), "old");
  fs::permissions(scratch.file("old"), fs::perms::owner_read | fs::perms::others_read);
  const Run run = run_program("balls pool -o " + scratch.file("old"));
  CHECK(run.status == 4);
  CHECK_THAT(run.err, Contains(scratch.file("old") + ": Permission denied") && Contains("chmod"));
  CHECK(read_file(scratch.file("old")) == "old");
  CHECK(scratch.names() == std::vector<std::string>{"old"});
}

TEST_CASE("a name may be as long as the file system allows", "[cli]") {
  const TemporaryDirectory scratch;
  const std::string name = std::string(251, 'n') + ".csv";
  CHECK(run_program("orbit --ball pool -o " + scratch.file(name)).status == 0);
  CHECK(scratch.names() == std::vector<std::string>{name});
}

#if !defined(__SANITIZE_ADDRESS__)  // which reserves more address space than the limit
TEST_CASE("out of memory is status 4, with a way out", "[limit]") {
  const std::string command = fmt::format(
      "ulimit -v 300000; '{}' orbit --mu 0.1 --u0 1 --v0 1 --samples 9000000 2>&1 >/dev/null", CONTENSOU_PROGRAM);
  CHECK_THAT(failure_of(command), Contains("contensou: out of memory") && Contains("ulimit -v"));
}
#endif
