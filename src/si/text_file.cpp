#include "contensou/si/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>

namespace contensou::si {

namespace {

[[noreturn]] void fail(const std::string& name) {
  throw std::system_error(errno, std::generic_category(), "cannot read " + name);
}

}  // namespace

std::string read_text_file(const std::string& path, std::size_t limit) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(path);
  return read_text(file.get(), path, limit);
}

std::string read_text(std::FILE* file, const std::string& name, std::size_t limit) {
  std::string text;
  char block[65536];
  while (const std::size_t size = std::fread(block, 1, std::min(sizeof block, limit - text.size()), file)) {
    text.append(block, size);
  }
  if (std::ferror(file) != 0) fail(name);
  return text;
}

}  // namespace contensou::si
