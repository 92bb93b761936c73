// Runs the sessions in transcripts/*.txt and in the blocks of console in documents. Each command must print the text
// that is shown below it.
//
//   $ COMMAND          is run by sh, where `contensou` is the program. Each file of sessions has a new folder. The
//                      folder contains the run files and tables that lie
//                      beside the file
//   $ COMMAND ! WORDS  is refused as bad input: status 2, these words on standard error, nothing on standard output
//   ! LINE             a line of standard error; these lines stand below the lines of standard output
//   [STATUS]           the exit status, if it is not 0
//   # TEXT             stands first or after an empty line, and says what follows
//   ...                a line of dots stands for any number of lines; dots within a line stand for any text
//
// Dots replace last digits that depend on the compiler. If CONTENSOU_UPDATE is set in the environment, the files are
// written again with the printed text in place of different text.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "run_program.hpp"

namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Returns true if two lines are equal. Dots in the shown line stand for any text.
bool same_line(std::string_view shown, std::string_view printed) {
  const std::size_t dots = shown.find("...");
  if (dots == shown.npos) return shown == printed;
  if (!printed.starts_with(shown.substr(0, dots))) return false;
  for (std::size_t at = dots; at <= printed.size(); ++at) {
    if (same_line(shown.substr(dots + 3), printed.substr(at))) return true;
  }
  return false;
}

/// Returns true if two lists of lines are equal. A shown line of dots stands for any number of lines.
bool same(const Lines& shown, const Lines& printed, std::size_t i = 0, std::size_t j = 0) {
  for (; i < shown.size(); ++i, ++j) {
    if (shown[i] == "...") {
      for (; j <= printed.size(); ++j) {
        if (same(shown, printed, i + 1, j)) return true;
      }
      return false;
    }
    if (j == printed.size() || !same_line(shown[i], printed[j])) return false;
  }
  return j == printed.size();
}

/// Returns the lines that must stand below a command.
Lines session(const std::string& command, const std::filesystem::path& folder, bool with_notes) {
  const std::string path = std::filesystem::path(CONTENSOU_PROGRAM).parent_path().string() + ":" + std::getenv("PATH");
  const Run run = run_command({"/bin/sh", "-c", command}, {}, [&] {
    const bool ready = ::chdir(folder.c_str()) == 0 && ::setenv("PATH", path.c_str(), 1) == 0;
    if (!ready || ::setenv("LC_ALL", "C", 1) != 0) ::_exit(98);
  });
  Lines lines = lines_of(run.out);
  for (const std::string& line : lines_of(with_notes || run.status != 0 ? run.err : "")) {
    if (!line.starts_with("Try 'contensou ")) lines.push_back("! " + line);
  }
  if (run.status != 0) lines.push_back("[" + std::to_string(run.status) + "]");
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

/// Checks the commands of a file and returns how many there are.
int check_file(const std::filesystem::path& file) {
  const bool has_blocks = file.extension() == ".md";
  const TemporaryDirectory folder;
  for (const auto& beside : std::filesystem::directory_iterator(file.parent_path())) {
    const std::string ending = beside.path().extension();
    if (ending == ".toml" || ending == ".csv") {
      std::filesystem::copy_file(beside.path(), folder.path() / beside.path().filename());
    }
  }
  const Lines lines = lines_of(read_file(file));
  const auto ends_output = [&](std::size_t at) {
    return at == lines.size() || lines[at].starts_with("$ ") ||
           (has_blocks ? lines[at] == "```" : lines[at].starts_with("# ") && lines[at - 1].empty());
  };
  std::string updated;
  int count = 0;
  bool inside = !has_blocks;
  for (std::size_t i = 0; i < lines.size();) {
    const std::string line = lines[i++];
    updated += line + "\n";
    if (has_blocks && line.starts_with("```")) inside = line == "```console";
    if (!inside || !line.starts_with("$ ")) continue;
    ++count;
    Lines shown;
    while (!ends_output(i)) shown.push_back(lines[i++]);
    std::string gap;
    for (; !shown.empty() && shown.back().empty(); shown.pop_back()) gap += "\n";
    INFO(file.filename().string() << ":" << i << ": " << line);
    const auto refusal = line.find(" ! ", 2);
    const Lines printed = session(line.substr(2, refusal - 2), folder.path(), !has_blocks);
    if (refusal != std::string::npos) {
      INFO(text_of(printed));
      CHECK(text_of(printed).starts_with("! "));
      const bool is_same = same({"...", "! ..." + line.substr(refusal + 3) + "...", "...", "[2]"}, printed);
      CHECK(is_same);
      if (!is_same) {
        const std::string message = printed.front().substr(2), sender = "contensou: ";
        updated.replace(
            updated.size() - line.size() - 1, line.size(),
            line.substr(0, refusal + 3) + (message.starts_with(sender) ? message.substr(sender.size()) : message));
      }
    } else if (!same(shown, printed)) {
      CHECK(text_of(shown) == text_of(printed));
      shown = printed;
    }
    updated += text_of(shown) + gap;
  }
  if (std::getenv("CONTENSOU_UPDATE") != nullptr) write_file(file, updated);
  return count;
}

}  // namespace

TEST_CASE("the commands of the transcripts print what is shown", "[cli]") {
  for (const auto& entry : std::filesystem::directory_iterator(CONTENSOU_TRANSCRIPTS))
    CHECK(check_file(entry.path()) >= 1);
}

TEST_CASE("the commands of the documents print what is shown", "[cli]") {
  const auto top = std::filesystem::path(CONTENSOU_README).parent_path();
  CHECK(check_file(CONTENSOU_README) >= 3);
  CHECK(check_file(top / "src/program/README.md") >= 50);
  CHECK(check_file(top / "src/si/README.md") >= 4);
  CHECK(check_file(top / "src/fit/README.md") >= 7);
  CHECK(check_file(top / "src/site/cases/README.md") >= 3);
}
