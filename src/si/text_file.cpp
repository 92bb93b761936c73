#include "contensou/si/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace contensou::si {

std::string read_text_file(const std::string& path) {
  const auto fail = [&path] { throw std::system_error(errno, std::generic_category(), "cannot read " + path); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail();
  std::string text;
  char block[65536];
  while (const std::size_t size = std::fread(block, 1, sizeof block, file.get())) text.append(block, size);
  if (std::ferror(file.get()) != 0) fail();
  return text;
}

}  // namespace contensou::si
