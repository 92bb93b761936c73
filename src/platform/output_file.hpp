#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contensou::platform {

/// A file for results. Either the whole file appears or nothing: it is written under another name in the same folder,
/// then renamed. Links are kept and lead to the new file, which has the old permissions. Standard output, devices and
/// pipes are written directly.
class OutputFile {
 public:
  /// @param path  "-" is standard output
  /// @throws FileFailure  with file name and reason; no file is left behind. The other functions throw it, too
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Reserves room on the disk, if the file system supports it.
  void reserve(std::uintmax_t bytes);

  void write(std::string_view content);

  /// Renames the file to its final name, and reports this on standard error.
  void finish();

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string target_;      ///< file to which links lead, so that this file is replaced and the links stay
  std::string unfinished_;  ///< name until the file is renamed; empty if it is written directly
  unsigned mode_ = 0;       ///< permissions
  int file_ = -1;
};

/// Writes a file as OutputFile does.
void write_output(const std::string& path, std::string_view content);

}  // namespace contensou::platform
