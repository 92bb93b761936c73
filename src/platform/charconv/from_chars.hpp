// std::from_chars for doubles, for a libc++ older than LLVM 20, which lacks this function (macOS, the page). A build
// with such a libc++ includes this header in every file.
#pragma once

#include <algorithm>
#include <cctype>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

#ifdef __APPLE__
#include <xlocale.h>
#endif

namespace std {

/// Reads a number as std::from_chars does, by strtod in the locale C. A number of base 16 ends before its letter x.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const string text(first, find_if(first, last, [](char letter) { return letter == 'x' || letter == 'X'; }));
  char* end = nullptr;
  const double number = ::strtod_l(text.c_str(), &end, plain);
  if (end == text.c_str() || text[0] == '+' || isspace(static_cast<unsigned char>(text[0]))) {
    return {first, errc::invalid_argument};
  }
  const bool too_large = isinf(number) && isdigit(static_cast<unsigned char>(*(end - 1)));
  if (!too_large) value = number;
  return {first + (end - text.c_str()), too_large ? errc::result_out_of_range : errc()};
}

}  // namespace std
