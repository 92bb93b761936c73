#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace contensou::platform {

/// Convert a path from UTF-8 and to UTF-8. In Windows, std::filesystem expects another encoding in a plain string.
inline std::filesystem::path path_of(const std::string& text) { return std::u8string(text.begin(), text.end()); }

inline std::string text_of(const std::filesystem::path& path) {
  const std::u8string text = path.u8string();
  return {text.begin(), text.end()};
}

/// Creates and opens the unfinished file, which no other user can read. At most one such file exists at a time.
///
/// @param folder  folder of the file
/// @param target  path of the finished file, as the user wrote it
/// @param path    receives the path of the unfinished file
/// @return  descriptor of the unfinished file, or -1 with errno
int open_unfinished(const std::string& folder, const std::string& target, std::string& path);

/// Must be called when the unfinished file is renamed or removed.
void forget_unfinished();

/// Removes the unfinished file. Async-signal-safe.
/// @return  message about the file; null if there is none
const char* remove_unfinished();

/// Thrown if a file cannot be read or written, or gnuplot is missing or fails. The message contains name and reason.
struct FileFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file for results. Either the whole file appears or nothing: the file is written under another name in the same
/// folder, then renamed. A link stays and leads to the new file, which has the permissions of the old one. Standard
/// output, devices and pipes are written directly.
class OutputFile {
 public:
  /// @param path  "-" is standard output
  /// @throws FileFailure  with file name and reason; no file is left behind. The other functions throw FileFailure, too
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
  std::string target_;      ///< file at the end of the links; this file is replaced, and the links stay
  std::string unfinished_;  ///< name of the file until it is renamed; empty if the file is written directly
  unsigned mode_ = 0;       ///< permissions
  int file_ = -1;
};

/// Writes a file as OutputFile does.
void write_output(const std::string& path, std::string_view content);

}  // namespace contensou::platform
