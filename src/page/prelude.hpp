// Forced into every file that is compiled for the page: what keeps the page small, and what the C++ library of Debian
// 12's emscripten (LLVM 14) lacks of C++20 and this library uses.
#pragma once

// Nothing of streams and locales, a tenth of the page, nor of long doubles, which WebAssembly computes in software.
#define FMT_HEADER_ONLY
#define FMT_STATIC_THOUSANDS_SEPARATOR ','
#define FMT_USE_FLOAT 0
#define FMT_USE_LONG_DOUBLE 0
#define FMT_USE_INT128 0
#define BOOST_EXCEPTION_DISABLE
#define BOOST_MATH_PROMOTE_DOUBLE_POLICY false

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <boost/math/policies/error_handling.hpp>
#include <range/v3/algorithm.hpp>

/// A number in a message of Boost's, which would write it to a stream.
template <>
inline std::string boost::math::policies::detail::prec_format(const double& value) {
  return fmt::format("{}", value);
}
template <>
inline std::string boost::math::policies::detail::prec_format(const long double& value) {
  return fmt::format("{}", static_cast<double>(value));
}

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

/// The locale is that of C.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string text(first, find_if(first, last, [](char letter) { return letter == 'x' || letter == 'X'; }));
  char* end = nullptr;
  const double number = strtod(text.c_str(), &end);
  if (end == text.c_str() || text[0] == '+' || isspace(text[0])) return {first, errc::invalid_argument};
  const bool too_large = isinf(number) && isdigit(*(end - 1));
  if (!too_large) value = number;
  return {first + (end - text.c_str()), too_large ? errc::result_out_of_range : errc()};
}

/// The algorithms of std::ranges are modelled on those of range-v3.
namespace ranges {
using namespace ::ranges;
}

}  // namespace std
