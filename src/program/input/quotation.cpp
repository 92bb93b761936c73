#include "input/quotation.hpp"

#include <iterator>

#include <fmt/format.h>

namespace contensou::program {

std::string quotation(std::string_view typed) {
  constexpr std::size_t longest = 80;
  std::string quoted = "'";
  for (char letter : typed.substr(0, longest)) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < ' ' || code == 0x7F) {
      fmt::format_to(std::back_inserter(quoted), "\\x{:02x}", code);
    } else {
      quoted += letter;
    }
  }
  return quoted + (typed.size() > longest ? "...'" : "'");
}

}  // namespace contensou::program
