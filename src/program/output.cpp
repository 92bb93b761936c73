#include "output.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "exit_status.hpp"

namespace contensou::program {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(std::string_view name, int error) {
  throw FileFailure(fmt::format("cannot write {}: {}", name, std::strerror(error)));
}

/// Keeps signals that end a program waiting while it lives, so that a file is written whole or not at all; and lets a
/// file-size limit be an error of write() instead of a signal.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t ending;
    sigemptyset(&ending);
    for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) sigaddset(&ending, signal);
    sigprocmask(SIG_BLOCK, &ending, &before_);
    std::signal(SIGXFSZ, SIG_IGN);
  }
  ~SignalsWait() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

/// Where a link leads, also if nothing is there yet; a path that is no link is itself.
fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links) {
    const fs::path target = fs::read_symlink(path, error);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

/// 0, or the error number of the first write that failed.
int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Opens, writes and closes; 0, or the error number of what failed.
int write_to(const std::string& path, int flags, std::string_view content) {
  const int file = ::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  const int error = write_all(file, content);
  return ::close(file) != 0 && error == 0 ? errno : error;
}

}  // namespace

void write_output(const std::string& path, std::string_view content) {
  if (path == "-") {
    if (const int error = write_all(STDOUT_FILENO, content)) fail("standard output", error);
    return;
  }
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    if (const int error = write_to(path, 0, content)) fail(path, error);
    return;
  }
  // Through links, so that the file they lead to is replaced and they stay.
  const std::string target = followed(path).string();
  const std::string beside = fmt::format("{}.{}.part", target, ::getpid());
  const SignalsWait wait;
  int error = write_to(beside, O_CREAT | O_EXCL, content);
  if (const auto old = fs::status(target, ignored); error == 0 && fs::exists(old)) {
    fs::permissions(beside, old.permissions(), ignored);
  }
  if (error == 0 && std::rename(beside.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(beside.c_str());
    fail(path, error);
  }
}

}  // namespace contensou::program
