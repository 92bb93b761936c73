#include "run_program.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (fs::temp_directory_path() / "contensou-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryDirectory::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> names_in_help(const std::string& topic) {
  const Run run = run_program("help " + topic);
  REQUIRE(run.status == 0);
  std::vector<std::string> names;
  std::istringstream lines(run.out);
  bool within = !topic.empty();
  for (std::string line; std::getline(lines, line);) {
    if (topic.empty() && (line.empty() || line.starts_with("Verbs"))) within = !line.empty();
    if (within && line.starts_with("  ") && line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const fs::path& path, std::string_view text) { std::ofstream(path, std::ios::binary) << text; }

Run run_program(const std::vector<std::string>& arguments, std::string_view input,
                const std::function<void()>& prepare) {
  std::vector<std::string> words{CONTENSOU_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_command(words, input, prepare);
}

Run run_command(std::vector<std::string> words, std::string_view input, const std::function<void()>& prepare) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::tmpfile(), std::fclose);
  int out[2], err[2];
  REQUIRE((in && ::pipe2(out, O_CLOEXEC) == 0 && ::pipe2(err, O_CLOEXEC) == 0));
  if (!input.empty()) std::fwrite(input.data(), 1, input.size(), in.get());  // an empty text may have a null address
  std::rewind(in.get());
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const bool ready = ::dup2(::fileno(in.get()), 0) == 0 && ::dup2(out[1], 1) == 1 && ::dup2(err[1], 2) == 2;
    prepare();
    if (ready) ::execv(argv[0], argv.data());
    ::_exit(99);
  }
  ::close(out[1]);
  ::close(err[1]);
  Run run{};
  pollfd ends[]{{out[0], POLLIN, 0}, {err[0], POLLIN, 0}};
  for (int open = 2; open > 0;) {
    ::poll(ends, 2, -1);
    for (pollfd& end : ends) {
      char text[4096];
      if (end.revents == 0) continue;
      const ssize_t count = ::read(end.fd, text, sizeof text);
      if (count > 0) (&end == ends ? run.out : run.err).append(text, static_cast<std::size_t>(count));
      if (count > 0) continue;
      ::close(std::exchange(end.fd, -1));
      --open;
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return run;
}

Run run_program(const std::string& arguments, std::string_view input) {
  std::istringstream words(arguments);
  return run_program(std::vector<std::string>(std::istream_iterator<std::string>(words), {}), input);
}

void check_rejected(const std::string& arguments, const std::string& words, std::string_view input) {
  const Run run = run_program(arguments, input);
  INFO(arguments << "\n" << run.err);
  CHECK(run.status == 2);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Catch::Matchers::Contains(words));
}

nlohmann::json json_of(const std::string& arguments) {
  const Run run = run_program(arguments);
  INFO(arguments << "\n" << run.err);
  REQUIRE(run.status == 0);
  REQUIRE((run.err.empty() || run.err.starts_with("note: ")));
  return nlohmann::json::parse(run.out);
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (line.ends_with(',')) row.emplace_back();
  }
  return rows;
}
