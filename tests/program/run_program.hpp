#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

/// The result of a run of the program.
struct Run {
  int status;  ///< exit status; -1 if a signal ended the program
  std::string out, err;
  int signal;
};

/// Runs the program that was built.
/// @param prepare  function that is called in the program's process
Run run_program(
    const std::vector<std::string>& arguments, std::string_view input = {},
    const std::function<void()>& prepare = [] {});

/// Runs any program in the same way. The first word is its path.
Run run_command(std::vector<std::string> words, std::string_view input, const std::function<void()>& prepare);

/// Runs the program with arguments that contain no spaces, written as on a command line.
Run run_program(const std::string& arguments, std::string_view input = {});

/// Checks that the program refuses the arguments as bad input: status 2, nothing on standard output, and these words on
/// standard error.
void check_rejected(const std::string& arguments, const std::string& words, std::string_view input = {});

/// Returns the output of a successful run as JSON; fails the test otherwise.
nlohmann::json json_of(const std::string& arguments);

/// Returns the rows of a CSV without quotes. The header is the first row.
std::vector<std::vector<std::string>> rows_of(const std::string& csv);

/// Returns the names of the entries in a part of the help.
/// @param topic  "views" or "laws"; empty: the verbs
std::vector<std::string> names_in_help(const std::string& topic);

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, std::string_view text);

/// A new empty directory, which is removed at the end of the test.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};
