#pragma once

#include <cstddef>
#include <string>

namespace contensou::platform {

/// A file that is read from its beginning, or standard input.
class InputFile {
 public:
  /// @param path  "-" is standard input
  /// @param name  name of the file in messages
  /// @throws std::system_error  if the file cannot be read; the other functions throw it, too
  InputFile(const std::string& path, std::string name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Returns the number of bytes; NaN for a pipe or a device.
  double size() const;

  /// Appends the bytes of one read, at most `most` bytes. Returns false at the end of the file.
  bool read(std::string& buffer, std::size_t most);

  /// Returns true if the next read does not wait.
  bool ready() const;

 private:
  [[noreturn]] void fail() const;

  std::string name_;
  int file_;
};

}  // namespace contensou::platform
