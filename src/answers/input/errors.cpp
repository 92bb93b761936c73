#include "answers/input/errors.hpp"

#include <algorithm>
#include <new>
#include <string_view>

namespace contensou::answers {

namespace {

template <class... Kinds>
bool is_one_of(const std::exception& error) {
  return (... || (dynamic_cast<const Kinds*>(&error) != nullptr));
}

/// Returns true if a word before a colon is the name of a class or function of the library.
/// @param first  true: the word begins the message; false: a single word in lower case may be a column, so it is kept
bool is_internal(std::string_view word, bool first) {
  const auto count = [&](auto kind) { return std::ranges::count_if(word, kind); };
  const auto is_upper = [](char letter) { return letter >= 'A' && letter <= 'Z'; };
  const auto is_lower = [](char letter) { return letter >= 'a' && letter <= 'z'; };
  const auto uppers = count(is_upper), lowers = count(is_lower);
  const auto others = std::ssize(word) - uppers - lowers - std::ranges::count(word, '_');
  const bool scoped = word.find("::") != std::string::npos;
  if (word.empty() || others != (scoped ? 2 : 0) || lowers == 0) return false;
  if (scoped || (is_upper(word[0]) && uppers > 1)) return true;
  return first && (is_upper(word[0]) || word == "verify" || (uppers == 0 && word.find('_') != std::string::npos));
}

}  // namespace

std::string words_of(std::string message) {
  constexpr std::string_view colon = ": ";
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = message.find(colon, begin)) != std::string::npos;) {
    if (is_internal(std::string_view(message).substr(begin, end - begin), begin == 0))
      message.erase(begin, end + colon.size() - begin);
    else
      begin = end + colon.size();
  }
  return message;
}

bool is_fault(const std::exception& error) {
  if (is_one_of<std::domain_error, std::bad_alloc>(error)) return false;
  // Three classes of the standard library derive from std::runtime_error, too, but mean faults of the program.
  return !is_one_of<std::runtime_error>(error) ||
         is_one_of<std::overflow_error, std::range_error, std::underflow_error>(error);
}

std::string message_of(const std::exception& error, const std::string& asked) {
  if (is_one_of<std::bad_alloc>(error)) return "out of memory: ask for less at once";
  if (!is_fault(error)) return words_of(error.what());
  return fmt::format("a fault of contensou, not of the input; please report it with what was asked: {}", asked);
}

}  // namespace contensou::answers
