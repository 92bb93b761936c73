#include "platform/output_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "platform/descriptor.hpp"
#include "platform/interruption.hpp"

namespace contensou::platform {

namespace {

/// The data that the signal handler reads. They are valid if there is an unfinished file.
std::atomic<bool> is_unfinished = false;
static_assert(decltype(is_unfinished)::is_always_lock_free);
std::array<char, PATH_MAX> unfinished{};
std::array<char, PATH_MAX + 100> message{};

}  // namespace

int open_unfinished(const std::string& folder, const std::string& target, std::string& path) {
  // A terminal may already show ^C or a progress bar on this line.
  const char* new_line = is_terminal(Stream::error) ? "\n" : "";
  std::snprintf(message.data(), message.size(), "%scontensou: interrupted: %s was not written, nothing is left of it\n",
                new_line, target.c_str());
  // The handler must have the name before the file exists. A signal right after the creation then removes the file.
  path = folder + "/.contensou-XXXXXX";
  if (path.size() >= unfinished.size()) return errno = ENAMETOOLONG, -1;
  unfinished[path.copy(unfinished.data(), path.size())] = '\0';
  is_unfinished = true;
  const int file = create_unfinished(unfinished.data());
  path = unfinished.data();
  if (file < 0) forget_unfinished();
  return file;
}

void forget_unfinished() { is_unfinished = false; }

const char* remove_unfinished() {
  if (!is_unfinished) return nullptr;
  remove_file(unfinished.data());
  return message.data();
}

namespace {

namespace fs = std::filesystem;

constexpr mode_t writable = S_IWUSR | S_IWGRP | S_IWOTH;

/// Returns the target of a link, even if the target does not exist. Any other path is returned unchanged.
fs::path followed(fs::path path) {
  std::error_code error;
  while (fs::is_symlink(path, error)) {
    const fs::path target = fs::read_symlink(path, error);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

/// Returns the permissions of a new file.
mode_t standard_mode() {
  const auto mask = ::umask(0);
  ::umask(mask);
  return static_cast<mode_t>(0666 & ~mask);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  struct stat there {};
  const bool is_there = path_ == "-" || ::stat(path_.c_str(), &there) == 0;
  if (!is_there && errno != ENOENT) fail(errno);
  if (is_there && !S_ISREG(there.st_mode)) {
    file_ = path_ == "-" ? duplicate(STDOUT_FILENO) : open_to_write(path_.c_str());
    if (file_ < 0) fail(errno);
    return;
  }
  // A read-only file is never replaced, although its folder or the rights of root would allow this.
  if (is_there && ((there.st_mode & writable) == 0 || ::access(path_.c_str(), W_OK) != 0)) fail(EACCES);
  mode_ = is_there ? there.st_mode : standard_mode();
  target_ = text_of(followed(path_of(path_)));
  const std::string folder = text_of(path_of(target_).parent_path());
  file_ = open_unfinished(folder.empty() ? "." : folder, path_, unfinished_);
  if (file_ < 0) fail(errno);
}

OutputFile::~OutputFile() {
  if (!unfinished_.empty()) {
    remove_file(unfinished_.c_str());
    forget_unfinished();
  }
  if (file_ >= 0) ::close(file_);
}

void OutputFile::fail(int error) const {
  const char* way_out = error == EACCES  ? "; choose another name, or allow it with chmod"
                        : error == EFBIG ? "; raise the limit on the size of files (ulimit -f)"
                                         : "";
  throw FileFailure(
      fmt::format("cannot write {}: {}{}", path_ == "-" ? "standard output" : path_, std::strerror(error), way_out));
}

void OutputFile::reserve(std::uintmax_t bytes) {
  if (!unfinished_.empty() && platform::reserve(file_, bytes) != 0) fail(errno);
}

void OutputFile::write(std::string_view content) {
  while (!content.empty()) {
    constexpr std::size_t most = 1 << 30;  // in Windows the size is an unsigned int
    const auto written = ::write(file_, content.data(), static_cast<unsigned>(std::min(content.size(), most)));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::finish() {
  const BlockedSignals wait;
  if (!unfinished_.empty()) set_permissions(file_, mode_);
  if (::close(std::exchange(file_, -1)) != 0) fail(errno);
  if (unfinished_.empty()) return;
  if (replace_file(unfinished_.c_str(), target_.c_str()) != 0) fail(errno);
  unfinished_.clear();
  forget_unfinished();
  std::fputs(fmt::format("wrote {}\n", path_).c_str(), stderr);
}

void write_output(const std::string& path, std::string_view content) {
  OutputFile file(path);
  file.write(content);
  file.finish();
}

}  // namespace contensou::platform
