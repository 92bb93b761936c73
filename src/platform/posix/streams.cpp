#include "platform/streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#ifndef O_PATH  // Linux alone has O_PATH, which opens a file for neither reading nor writing
#define O_PATH O_RDONLY
#endif

namespace contensou::platform {

bool is_terminal(Stream stream) { return ::isatty(stream == Stream::error ? STDERR_FILENO : STDOUT_FILENO) != 0; }

void prepare_standard_streams() {
  int file = 0;
  while (file >= 0 && file <= STDERR_FILENO) file = ::open("/dev/null", O_PATH);
  ::close(file);
}

}  // namespace contensou::platform
