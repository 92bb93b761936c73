#pragma once

#include <cstddef>
#include <string>

namespace contensou::platform {

/// A file that is read from its beginning, or standard input.
class InputFile {
 public:
  /// @param path  "-" is standard input
  /// @param name  what messages call it
  /// @throws std::system_error  for every function: if it cannot be read
  InputFile(const std::string& path, std::string name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Its bytes; NaN for a pipe or a device.
  double size() const;

  /// Appends what one read gives, so many bytes at most; false at the end.
  bool read(std::string& buffer, std::size_t most);

  /// Whether read does not have to wait.
  bool ready() const;

 private:
  [[noreturn]] void fail() const;

  std::string name_;
  int file_;
};

}  // namespace contensou::platform
