#include "answers/verbs/plain_words.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace contensou::answers {

std::string to_two_digits(double number) {
  if (number == 0) return "0";
  if (!(number >= 1e-5 && number < 1e6)) return fmt::format("{:.1e}", number);
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(number)));
  return fmt::format("{:.{}f}", number, std::max(decimals, 0));
}

std::string length_in_words(double metres) {
  if (metres == 0 || (metres >= 1 && metres < 1e4)) return to_two_digits(metres) + " m";
  if (metres >= 1e4) return to_two_digits(metres / 1e3) + " km";
  return metres < 1e-2 ? to_two_digits(1e3 * metres) + " mm" : to_two_digits(1e2 * metres) + " cm";
}

std::string time_in_words(double seconds) { return to_two_digits(seconds) + " s"; }

}  // namespace contensou::answers
