#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::portraits {

/// Words of one look, UTF-8.
struct Run {
  std::string words;
  bool italic = false;
  int level = 0;  ///< 1: a power, -1: an index, both of them smaller; 0: on the line

  bool operator==(const Run&) const = default;
};

/// What is written in a figure. A string is a text of just its characters, whatever they are.
///
///     const Text name = "the ray " + math("k = v/(μ|u|)") + ",  " + math("r = γμ") + sup("2") + math("/χ");
class Text {
 public:
  Text() = default;
  explicit Text(Run run);
  // Words are a text as they stand.
  // NOLINTBEGIN(google-explicit-constructor)
  Text(std::string_view words);
  Text(const std::string& words) : Text(std::string_view(words)) {}
  Text(const char* words) : Text(std::string_view(words)) {}
  // NOLINTEND(google-explicit-constructor)

  /// Neighbours differ in their look, and none is empty.
  const std::vector<Run>& runs() const { return runs_; }
  bool empty() const { return runs_.empty(); }
  /// The words alone.
  std::string words() const;

  Text& operator+=(const Text& text);
  friend Text operator+(Text text, const Text& more);
  bool operator==(const Text&) const = default;

 private:
  void append(Run run);

  std::vector<Run> runs_;
};

/// A formula on one line, unbroken: Latin and Greek letters are in italics, with the spaces of a product such as N f;
/// what else there is stands upright.
Text math(std::string_view formula);

/// The text as an index, or as a power.
Text sub(const Text& text);
Text sup(const Text& text);

/// Words that no line is broken in: their spaces become no-break spaces (U+00A0), which look like others.
std::string unbroken(std::string_view words);

/// About how wide a text is, in sizes of letters.
double text_width(const Text& text);

/// The words with a minus sign for each hyphen that is one: before a digit, and not within a word.
std::string with_minus_signs(std::string_view words);

/// Words of somebody else's, such as a name, cut with an ellipsis after that number of characters.
std::string shortened(std::string_view words, std::size_t longest = 60);

/// The title of a picture of one body, its mu and its law.
Text title_of(const Text& body, const Text& mu, const Text& law);

}  // namespace contensou::portraits
