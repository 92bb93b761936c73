#include "input/quotation.hpp"

#include <fmt/format.h>

namespace contensou::program {

std::string escaped(std::string_view input) {
  const std::string in_quotes = fmt::format("{:?}", input);
  return in_quotes.substr(1, in_quotes.size() - 2);
}

std::string quotation(std::string_view input) {
  constexpr std::size_t max_size = 80;
  if (input.size() <= max_size) return fmt::format("'{}'", escaped(input));
  std::size_t size = max_size;
  while (size > 0 && (static_cast<unsigned char>(input[size]) & 0xC0) == 0x80) --size;  // inside a character of UTF-8
  return fmt::format("'{}...'", escaped(input.substr(0, size)));
}

}  // namespace contensou::program
