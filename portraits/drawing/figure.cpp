#include "contensou/portraits/figure.hpp"

#include <algorithm>

namespace contensou::portraits {

namespace {

/// Whether the byte is inside a UTF-8 character, not its first.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

std::size_t shown_length(std::string_view text) {
  std::size_t shown = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '{' && text.substr(i).starts_with("{/")) {  // the name of a font or a size, up to a space
      i = std::min(text.find(' ', i), text.size());
    } else if (c == '\\') {
      ++i;
      ++shown;
    } else if (c != '{' && c != '}' && c != '^' && c != '_' && !continues(c)) {
      ++shown;
    }
  }
  return shown;
}

std::string literal(std::string_view text, std::size_t longest) {
  constexpr std::string_view markup = "\\^_{}@&~";
  std::string result;
  std::size_t shown = 0;
  for (char c : text) {
    if (!continues(c) && shown++ == longest) return result + "…";
    if (markup.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

}  // namespace contensou::portraits
