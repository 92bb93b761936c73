#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contensou::platform {

/// Where results go, piece by piece. A file appears whole or not at all: it is written under another name in the same
/// folder, then renamed; links stay and lead to the new file, which has the permissions of the old one. Standard
/// output, devices and pipes are written to directly.
class OutputFile {
 public:
  /// @param path  "-" is standard output
  /// @throws FileFailure  for every function: naming the file and the reason; nothing is left behind
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Makes sure of the room on the disk, where the file system can.
  void reserve(std::uintmax_t bytes);

  void write(std::string_view content);

  /// The file is there from now on, and standard error says so.
  void finish();

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string target_;      ///< the file that links lead to, so that it is replaced and they stay
  std::string unfinished_;  ///< its name until it is renamed; empty: written to directly
  unsigned mode_ = 0;       ///< permissions
  int file_ = -1;
};

/// Writes all of it as an OutputFile.
void write_output(const std::string& path, std::string_view content);

}  // namespace contensou::platform
