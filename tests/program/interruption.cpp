#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

namespace {

/// The program, started and left to itself; what is written to it by its standard input never ends.
class RunningProgram {
 public:
  RunningProgram(std::vector<std::string> words, const std::string& input) {
    int pipe[2];
    REQUIRE(::pipe2(pipe, O_CLOEXEC) == 0);
    input_ = pipe[1];
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, pipe[0], STDIN_FILENO);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, scratch_.file("out").c_str(), O_WRONLY | O_CREAT, 0600);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, scratch_.file("err").c_str(), O_WRONLY | O_CREAT, 0600);
    // Not ignored, as it is for tests that a shell runs in the background.
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    sigset_t usual;
    ::sigemptyset(&usual);
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&usual, signal);
    ::posix_spawnattr_setsigdefault(&attributes, &usual);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);

    words.insert(words.begin(), CONTENSOU_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int failure = ::posix_spawn(&child_, CONTENSOU_PROGRAM, &actions, &attributes, argv.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(pipe[0]);
    REQUIRE(failure == 0);
    REQUIRE(::write(input_, input.data(), input.size()) == static_cast<ssize_t>(input.size()));
  }
  ~RunningProgram() {
    ::close(input_);
    if (child_ != 0) ::kill(child_, SIGKILL), ::waitpid(child_, nullptr, 0);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Sends a signal and waits for the end; the signal that ended it, or 0.
  int end_by(int signal) {
    ::kill(child_, signal);
    int ended = 0;
    ::waitpid(child_, &ended, 0);
    child_ = 0;
    return WIFSIGNALED(ended) ? WTERMSIG(ended) : 0;
  }

  std::string out() const { return read_file(scratch_.file("out")); }
  std::string err() const { return read_file(scratch_.file("err")); }

 private:
  TemporaryDirectory scratch_;
  int input_ = -1;
  pid_t child_ = 0;
};

/// Waits for a file to appear in a folder.
bool appears(const TemporaryDirectory& folder) {
  for (int i = 0; i < 1000 && folder.names().empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !folder.names().empty();
}

}  // namespace

TEST_CASE("Ctrl-C leaves no half file and says so", "[cli]") {
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryDirectory scratch;
    RunningProgram program({"stop", "--batch", "-", "-o", scratch.file("table.csv")}, "mu,u0,v0\n1,0,0\n");
    REQUIRE(appears(scratch));
    CHECK(program.end_by(signal) == signal);
    CHECK(scratch.names().empty());
    CHECK(program.err() ==
          "contensou: interrupted: " + scratch.file("table.csv") + " was not written, nothing is left of it\n");
  }
}

TEST_CASE("Ctrl-C in a sweep leaves no half file and says so", "[cli]") {
  for (const std::string format : {"npy", "csv"}) {
    const TemporaryDirectory scratch;
    write_file(scratch.file("map." + format), "old");
    const std::vector<std::string> before = scratch.names();
    RunningProgram program({"sweep", "--mu", "0.1", "--u0", "0:1:1000000", "--v0", "0:1:100", "--threads", "2", "-o",
                            scratch.file("map." + format)},
                           "");
    for (int i = 0; i < 1000 && scratch.names() == before; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(program.end_by(SIGINT) == SIGINT);
    CHECK(scratch.names() == before);
    CHECK(read_file(scratch.file("map." + format)) == "old");
    CHECK(program.err() ==
          "contensou: interrupted: " + scratch.file("map." + format) + " was not written, nothing is left of it\n");
  }
}

TEST_CASE("nothing is left in the temporary folder when the program is killed while gnuplot runs", "[cli]") {
  const TemporaryDirectory scratch;
  for (const char* folder : {"bin", "tmp"}) std::filesystem::create_directory(scratch.file(folder));
  const std::string gnuplot = scratch.file("bin/gnuplot");
  write_file(gnuplot, "#!/bin/sh\ntouch '" + scratch.file("ran") + "'\nkill -KILL $PPID\n");
  std::filesystem::permissions(gnuplot, std::filesystem::perms::owner_all);
  const std::string command = "PATH='" + scratch.file("bin") + "':\"$PATH\" TMPDIR='" + scratch.file("tmp") + "' '" +
                              CONTENSOU_PROGRAM + "' portrait --mu 0.3 -o '" + scratch.file("picture.svg") + "'";
  CHECK(std::system(command.c_str()) != 0);
  CHECK(scratch.names() == std::vector<std::string>{"bin", "ran", "tmp"});
  CHECK(std::filesystem::is_empty(scratch.file("tmp")));
}
