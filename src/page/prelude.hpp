// Included in every file that is compiled for the page. It keeps the page small. It adds parts of C++20 that this
// library needs and that the C++ library of emscripten in Debian 12 (LLVM 14) lacks.
#pragma once

// Leave out streams and locales, a tenth of the page, and long doubles, which WebAssembly computes slowly in software.
#define FMT_HEADER_ONLY
#define FMT_STATIC_THOUSANDS_SEPARATOR ','
#define FMT_USE_FLOAT 0
#define FMT_USE_LONG_DOUBLE 0
#define FMT_USE_INT128 0
#define BOOST_EXCEPTION_DISABLE
#define BOOST_MATH_PROMOTE_DOUBLE_POLICY false

#include <string>

#include <fmt/format.h>
#include <boost/math/policies/error_handling.hpp>
#include <range/v3/algorithm.hpp>

#include "platform/charconv/from_chars.hpp"

/// Returns a number as text for a message of Boost. The original function would need a stream.
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

/// The algorithms of std::ranges, replaced by the algorithms of range-v3, the library on which std::ranges is modelled.
namespace ranges {
using namespace ::ranges;
}

}  // namespace std
