#include "contensou/portraits/figure.hpp"

#include <algorithm>
#include <cstddef>

namespace contensou::portraits {

namespace {

/// Whether the byte is inside a UTF-8 character, not its first.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

double text_width(std::string_view text) {
  constexpr double small = 0.8;  // of an index or a power
  double width = 0;
  int depth = 0, raised = -1;  // the depth of braces at which a small text began
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '^' || c == '_') {
      raised = depth;
      continue;
    }
    if (c == '{') {
      ++depth;
      if (text.substr(i).starts_with("{/")) i = std::min(text.find(' ', i), text.size());  // a font or a size
      continue;
    }
    if (c == '}') {
      if (--depth <= raised) raised = -1;
      continue;
    }
    if (continues(c)) continue;
    if (c == '\\' && i + 1 < text.size()) c = text[++i];
    const bool narrow = std::string_view(" .,;:|'!()[]/ijlftr").find(c) != std::string_view::npos;
    width += (narrow                 ? 0.36
              : c == 'm' || c == 'w' ? 0.95
              : c >= 'A' && c <= 'Z' ? 0.7
                                     : 0.62) *
             (raised >= 0 ? small : 1);
    if (raised == depth) raised = -1;
  }
  return width;
}

std::string with_minus_signs(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto is_word = [](char c) {
      return static_cast<signed char>(c) < 0 || std::string_view("._-").find(c) != std::string_view::npos ||
             (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    const bool minus = text[i] == '-' && i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9' &&
                       (i == 0 || !is_word(text[i - 1]));
    if (minus)
      result += "−";
    else
      result += text[i];
  }
  return result;
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
