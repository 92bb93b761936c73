#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

/// What a run of the program gave.
struct Run {
  int status;  ///< -1: by a signal
  std::string out, err;
  int signal;
};

/// Runs the program that was built.
/// @param prepare  is called in the program's process
Run run_program(
    const std::vector<std::string>& arguments, std::string_view input = {},
    const std::function<void()>& prepare = [] {});

/// The same of any program, whose path is the first word.
Run run_command(std::vector<std::string> words, std::string_view input, const std::function<void()>& prepare);

/// The same for arguments without spaces, written as on a command line.
Run run_program(const std::string& arguments, std::string_view input = {});

/// Checks that the program refuses the arguments as bad input: status 2, nothing on standard output, and these words on
/// standard error.
void check_rejected(const std::string& arguments, const std::string& words, std::string_view input = {});

/// What a successful run printed, as JSON; fails the test otherwise.
nlohmann::json json_of(const std::string& arguments);

/// The rows of a CSV without quotes, the header first.
std::vector<std::vector<std::string>> rows_of(const std::string& csv);

/// The names that a part of the help has entries of.
/// @param topic  "views" or "laws"; empty: the verbs
std::vector<std::string> names_in_help(const std::string& topic);

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, std::string_view text);

/// An empty directory that goes with the test.
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
