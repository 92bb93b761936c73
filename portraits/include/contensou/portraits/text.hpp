#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::portraits {

/// Characters with the same look, in UTF-8.
struct Run {
  std::string words;
  bool italic = false;
  int level = 0;  ///< 1: a power; -1: an index; both are smaller; 0: on the line

  bool operator==(const Run&) const = default;
};

/// A text in a figure. A string converts to a text of the same characters.
///
///     const Text name = "the ray " + math("k = v/(μ|u|)") + ",  " + math("r = γμ") + sup("2") + math("/χ");
class Text {
 public:
  Text() = default;
  explicit Text(Run run);
  // Implicit: a plain string is a Text.
  // NOLINTBEGIN(google-explicit-constructor)
  Text(std::string_view words);
  Text(const std::string& words) : Text(std::string_view(words)) {}
  Text(const char* words) : Text(std::string_view(words)) {}
  // NOLINTEND(google-explicit-constructor)

  /// Returns the runs. Neighbouring runs differ in their look, and no run is empty.
  const std::vector<Run>& runs() const { return runs_; }
  bool empty() const { return runs_.empty(); }
  /// Returns the characters without their look.
  std::string words() const;

  Text& operator+=(const Text& text);
  friend Text operator+(Text text, const Text& more);
  bool operator==(const Text&) const = default;

 private:
  void append(Run run);

  std::vector<Run> runs_;
};

/// Returns a formula on one line that is never broken. Latin and Greek letters are italic, and the spaces of a product
/// such as N f are kept. Other characters are upright.
Text math(std::string_view formula);

/// Returns the text as an index (sub) or as a power (sup).
/// @throws std::logic_error  if the text has an index or a power itself: give such a number a name
Text sub(const Text& text);
Text sup(const Text& text);

/// Returns words between which no line is broken. Their spaces become no-break spaces (U+00A0), which look the same.
std::string unbroken(std::string_view words);

/// Returns the approximate width of a text, in sizes of letters.
double text_width(const Text& text);

/// Returns the words with a minus sign in place of each hyphen before a digit, except within words.
std::string with_minus_signs(std::string_view words);

/// Returns a text of the user, such as a name, cut after a number of characters, with an ellipsis.
std::string shortened(std::string_view words, std::size_t longest = 60);

/// Returns the title of a picture of one body: its name, its mu and its law.
Text title_of(const Text& body, const Text& mu, const Text& law);

}  // namespace contensou::portraits
