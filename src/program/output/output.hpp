#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "output/interruption.hpp"

namespace contensou::program {

/// A file that is written piece by piece and appears whole or not at all: beside it first, then renamed. Standard
/// output, devices and pipes get everything at the end, from a temporary file without a name. Ctrl-C leaves nothing and
/// says so.
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

  /// The file is there from now on.
  void finish();

 private:
  [[noreturn]] void fail(int error) const;
  bool renamed() const { return device_ < 0; }

  std::string path_;
  std::string target_;  ///< the file that links lead to, so that it is replaced and they stay
  std::string beside_;  ///< exists until it is renamed or removed; empty: a file without a name
  int file_ = -1;
  int device_ = -1;  ///< standard output, a device or a pipe, open
  std::unique_ptr<Interruption> interruption_;
};

/// Writes a file whole or not at all. Devices and pipes are written directly.
///
/// @param path  "-" is standard output
/// @throws FileFailure  naming the file and the reason; nothing is left behind
void write_output(const std::string& path, std::string_view content);

}  // namespace contensou::program
