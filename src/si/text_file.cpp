#include "contensou/si/text_file.hpp"

#include <cerrno>
#include <memory>
#include <system_error>

namespace contensou::si {

namespace {

[[noreturn]] void fail(const std::string& name) {
  throw std::system_error(errno, std::generic_category(), "cannot read " + name);
}

}  // namespace

std::string read_text_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(path);
  return read_text(file.get(), path);
}

std::string read_text(std::FILE* file, const std::string& name) {
  std::string text;
  char block[65536];
  while (const std::size_t size = std::fread(block, 1, sizeof block, file)) text.append(block, size);
  if (std::ferror(file) != 0) fail(name);
  return text;
}

}  // namespace contensou::si
