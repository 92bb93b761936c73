#include "platform/input_file.hpp"

#include <cerrno>
#include <limits>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

#include "platform/descriptor.hpp"

namespace contensou::platform {

InputFile::InputFile(const std::string& path, std::string name)
    : name_(std::move(name)), file_(path == "-" ? duplicate(STDIN_FILENO) : open_to_read(path.c_str())) {
  if (file_ < 0) fail();
}

InputFile::~InputFile() { ::close(file_); }

double InputFile::size() const {
  struct stat status {};
  const bool known = ::fstat(file_, &status) == 0 && S_ISREG(status.st_mode);
  return known ? static_cast<double>(status.st_size) : std::numeric_limits<double>::quiet_NaN();
}

bool InputFile::read(std::string& buffer, std::size_t most) {
  const std::size_t before = buffer.size();
  buffer.resize(before + most);
  ssize_t size = 0;
  do size = ::read(file_, buffer.data() + before, static_cast<unsigned>(most));
  while (size < 0 && errno == EINTR);
  if (size < 0) fail();
  buffer.resize(before + static_cast<std::size_t>(size));
  return size > 0;
}

bool InputFile::ready() const { return is_ready(file_); }

void InputFile::fail() const { throw std::system_error(errno, std::generic_category(), "cannot read " + name_); }

}  // namespace contensou::platform
