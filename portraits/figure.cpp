#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

std::string literal(std::string_view text, std::size_t longest) {
  constexpr std::string_view markup = "\\^_{}@&~";
  std::string result;
  std::size_t shown = 0;
  for (char c : text) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0) == 0x80;  // inside a UTF-8 character
    if (!continues && shown++ == longest) return result + "…";
    if (markup.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

}  // namespace contensou::portraits
