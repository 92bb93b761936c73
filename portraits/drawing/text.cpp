#include "contensou/portraits/text.hpp"

#include <stdexcept>
#include <utility>

#include "drawing/characters.hpp"

namespace contensou::portraits {

namespace {

bool is_letter(std::string_view character) {
  const auto first = static_cast<unsigned char>(character.front());
  const bool greek = first == 0xCE || first == 0xCF;
  return greek || (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
}

Text at_level(const Text& text, int level) {
  Text result;
  for (Run run : text.runs()) {
    if (run.level != 0) throw std::logic_error("an index or a power has no power of its own: " + text.words());
    run.level = level;
    result += Text(run);
  }
  return result;
}

}  // namespace

std::vector<std::string_view> characters(std::string_view text) {
  std::vector<std::string_view> result;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    do ++end;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);
    result.push_back(text.substr(begin, end - begin));
  }
  return result;
}

std::string Text::words() const {
  std::string all;
  for (const Run& run : runs_) all += run.words;
  return all;
}

void Text::append(Run run) {
  if (run.words.empty()) return;
  if (!runs_.empty() && runs_.back().italic == run.italic && runs_.back().level == run.level) {
    runs_.back().words += run.words;
  } else {
    runs_.push_back(std::move(run));
  }
}

Text::Text(Run run) { append(std::move(run)); }

Text::Text(std::string_view words) : Text(Run{std::string(words)}) {}

Text operator+(Text text, const Text& more) {
  text += more;
  return text;
}

Text& Text::operator+=(const Text& text) {
  const std::vector<Run> more = text.runs_;  // a copy, because `text` may be *this
  for (const Run& run : more) append(run);
  return *this;
}

Text math(std::string_view formula) {
  const std::vector<std::string_view> all = characters(formula);
  Text result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool space = all[i] == " ";
    const bool in_product = space && i > 0 && i + 1 < all.size() && is_letter(all[i - 1]) && is_letter(all[i + 1]);
    result += Text(Run{std::string(space ? no_break_space : all[i]), in_product || is_letter(all[i])});
  }
  return result;
}

std::string unbroken(std::string_view words) {
  std::string result;
  for (const std::string_view character : characters(words)) result += character == " " ? no_break_space : character;
  return result;
}

Text sub(const Text& text) { return at_level(text, -1); }
Text sup(const Text& text) { return at_level(text, 1); }

double text_width(const Text& text) {
  constexpr double small = 0.8;  // size of an index or a power
  double width = 0;
  for (const Run& run : text.runs()) {
    const std::string words = with_minus_signs(run.words);
    for (const std::string_view character : characters(words)) {
      const char c = character == no_break_space ? ' ' : character.front();
      const bool narrow = std::string_view(" .,;:|'!()[]/ijlftr").find(c) != std::string_view::npos;
      width += (narrow                 ? 0.36
                : c == 'm' || c == 'w' ? 0.95
                : character == "−"     ? 0.84
                : c >= 'A' && c <= 'Z' ? 0.7
                                       : 0.62) *
               (run.level == 0 ? 1 : small);
    }
  }
  return width;
}

Text title_of(const Text& body, const Text& mu, const Text& law) {
  return body + ",  " + math("μ = ") + mu + ",  law: " + law;
}

std::string with_minus_signs(std::string_view words) {
  std::string result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto is_word = [](char c) {
      return static_cast<signed char>(c) < 0 || std::string_view("._-").find(c) != std::string_view::npos ||
             (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    const bool minus = words[i] == '-' && i + 1 < words.size() && words[i + 1] >= '0' && words[i + 1] <= '9' &&
                       (i == 0 || !is_word(words[i - 1]));
    if (minus)
      result += "−";
    else
      result += words[i];
  }
  return result;
}

std::string shortened(std::string_view words, std::size_t longest) {
  std::string result;
  for (const std::string_view character : characters(words)) {
    if (longest-- == 0) return result + "…";
    result += character;
  }
  return result;
}

}  // namespace contensou::portraits
