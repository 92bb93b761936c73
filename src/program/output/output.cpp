#include "output/output.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "exit_status.hpp"

namespace contensou::program {

namespace {

namespace fs = std::filesystem;

constexpr mode_t everybody = 0666;  // less the user's mask

/// Where a link leads, also if nothing is there yet; a path that is no link is itself.
fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links) {
    const fs::path target = fs::read_symlink(path, error);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

/// Whether something is there that is written to as it is: a device or a pipe; or a folder, which cannot be.
bool is_device(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
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

/// Writes what a file holds to another; 0, or an error number.
int copy_all(int from, int to) {
  if (::lseek(from, 0, SEEK_SET) < 0) return errno;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t size = ::read(from, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return size < 0 ? errno : 0;
    if (const int error = write_all(to, {buffer.data(), static_cast<std::size_t>(size)})) return error;
  }
}

[[noreturn]] void fail_spool(std::string_view reason) {
  throw FileFailure(
      fmt::format("cannot keep the output in a temporary file until it is whole: {}; set TMPDIR to a folder with room, "
                  "or write to a file with -o",
                  reason));
}

/// A file without a name, which goes when it is closed.
int open_spool() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (!error) {
    std::string pattern = (folder / "contensou-XXXXXX").string();
    const SignalsWait wait;
    const int file = ::mkostemp(pattern.data(), O_CLOEXEC);
    if (file >= 0) {
      ::unlink(pattern.c_str());
      return file;
    }
    error.assign(errno, std::generic_category());
  }
  fail_spool(error.message());
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error of write()
  if (path_ == "-" || is_device(path_)) {
    device_ = path_ == "-" ? ::dup(STDOUT_FILENO) : ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (device_ < 0) fail(errno);
    file_ = open_spool();
    interruption_ = std::make_unique<Interruption>("", "nothing was written");
    return;
  }
  target_ = followed(path_).string();
  beside_ = fmt::format("{}.{}.part", target_, ::getpid());
  const SignalsWait wait;
  file_ = ::open(beside_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, everybody);
  if (file_ < 0) fail(errno);
  interruption_ =
      std::make_unique<Interruption>(beside_, fmt::format("{} was not written, nothing is left of it", path_));
}

OutputFile::~OutputFile() {
  const SignalsWait wait;
  if (!beside_.empty()) ::unlink(beside_.c_str());
  interruption_.reset();
  if (file_ >= 0) ::close(file_);
  if (device_ >= 0) ::close(device_);
}

void OutputFile::fail(int error) const {
  throw FileFailure(fmt::format("cannot write {}: {}", path_ == "-" ? "standard output" : path_, std::strerror(error)));
}

void OutputFile::reserve(std::uintmax_t bytes) {
  if (::fallocate(file_, 0, 0, static_cast<off_t>(bytes)) != 0 && errno != EOPNOTSUPP) fail(errno);
}

void OutputFile::write(std::string_view content) {
  const int error = write_all(file_, content);
  if (error != 0 && !renamed()) fail_spool(std::strerror(error));
  if (error != 0) fail(error);
}

void OutputFile::finish() {
  if (!renamed()) {
    if (const int error = copy_all(file_, device_)) fail(error);
    return;
  }
  const SignalsWait wait;
  std::error_code ignored;
  if (const auto old = fs::status(target_, ignored); fs::exists(old)) {
    fs::permissions(beside_, old.permissions(), ignored);
  }
  if (::close(std::exchange(file_, -1)) != 0) fail(errno);
  if (std::rename(beside_.c_str(), target_.c_str()) != 0) fail(errno);
  beside_.clear();
  interruption_.reset();
}

void write_output(const std::string& path, std::string_view content) {
  if (path != "-" && !is_device(path)) {
    OutputFile file(path);
    file.write(content);
    return file.finish();
  }
  std::signal(SIGXFSZ, SIG_IGN);
  const int device = path == "-" ? ::dup(STDOUT_FILENO) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  int error = device < 0 ? errno : write_all(device, content);
  if (device >= 0 && ::close(device) != 0 && error == 0) error = errno;
  if (error != 0) {
    throw FileFailure(fmt::format("cannot write {}: {}", path == "-" ? "standard output" : path, std::strerror(error)));
  }
}

}  // namespace contensou::program
