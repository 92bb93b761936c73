#include "platform/descriptor.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace contensou::platform {

int open_to_read(const char* path) { return ::open(path, O_RDONLY | O_CLOEXEC); }

int open_to_write(const char* path) { return ::open(path, O_WRONLY | O_CLOEXEC); }

int duplicate(int file) { return ::fcntl(file, F_DUPFD_CLOEXEC, 0); }

int create_unfinished(char* name) { return ::mkostemp(name, O_CLOEXEC); }

void remove_file(const char* path) { ::unlink(path); }

int replace_file(const char* path, const char* target) { return std::rename(path, target); }

bool is_ready(int file) {
  pollfd polled{.fd = file, .events = POLLIN, .revents = 0};
  return ::poll(&polled, 1, 0) > 0;
}

#ifdef __linux__
int reserve(int file, std::uintmax_t bytes) {
  const int result = ::fallocate(file, 0, 0, static_cast<off_t>(bytes));
  return result != 0 && errno == EOPNOTSUPP ? 0 : result;
}
#else
int reserve(int, std::uintmax_t) { return 0; }
#endif

void set_permissions(int file, unsigned mode) {
  if (::fchmod(file, static_cast<mode_t>(mode)) != 0) errno = 0;
}

#ifndef O_PATH  // Linux alone has O_PATH, which opens a file for neither reading nor writing
#define O_PATH O_RDONLY
#endif
bool is_terminal(Stream stream) { return ::isatty(stream == Stream::error ? STDERR_FILENO : STDOUT_FILENO) != 0; }

void prepare_standard_streams() {
  int file = 0;
  while (file >= 0 && file <= STDERR_FILENO) file = ::open("/dev/null", O_PATH);
  ::close(file);
}

}  // namespace contensou::platform
