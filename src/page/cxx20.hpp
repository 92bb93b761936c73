// Forced into every file that is compiled for the page, and precompiled: what the C++ library of Debian 12's emscripten
// (LLVM 14) lacks of C++20 and this library uses.
#pragma once

#include <algorithm>
#include <bit>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>
#include <range/v3/algorithm.hpp>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

/// The algorithms of std::ranges are modelled on those of range-v3.
namespace ranges {
using namespace ::ranges;
}

}  // namespace std
