#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include <unistd.h>

#include <sys/mman.h>

#include <fmt/format.h>

namespace contensou::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the fuzzer unless the condition holds. The fuzzer then saves the input.
inline void require(bool holds, std::string_view what) {
  if (holds) return;
  fmt::print(stderr, "FOUND: {}\n", what);
  std::abort();
}

/// Requires that a message can be shown on a terminal: it has no control characters and is not too long.
inline void require_readable(std::string_view message) {
  const auto is_control = [](char c) { return (static_cast<unsigned char>(c) < ' ' && c != '\n') || c == '\x7f'; };
  require(!message.empty() && message.size() < 8000, message);
  require(std::ranges::none_of(message, is_control), message);
}

/// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view text) : file_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    while (!text.empty()) {
      const ssize_t size = ::write(file_, text.data(), text.size());
      require(size > 0, "memfd_create, write");
      text.remove_prefix(static_cast<std::size_t>(size));
    }
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }

 private:
  int file_;
};

}  // namespace contensou::fuzz
