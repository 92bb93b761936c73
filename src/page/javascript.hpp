// Values of the library as values of JavaScript.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <emscripten/val.h>
#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"

namespace contensou::page {

using emscripten::val;

/// Float64Array.
val column(const double* data, std::size_t size);
val column(const Eigen::ArrayXd& values);
val column(const std::vector<double>& values);
/// Of lines one after the other, NaN between them: x0, y0, x1, y1, ...
val column(const std::vector<portraits::Polyline>& lines);

/// An array of what the function makes of each entry.
template <class Range, class Function>
val list(const Range& range, Function value) {
  val result = val::array();
  int index = 0;
  for (const auto& entry : range) result.set(index++, value(entry));
  return result;
}

inline void set_fields(val&) {}
template <class Value, class... Rest>
void set_fields(val& object, const char* key, const Value& value, const Rest&... rest) {
  if constexpr (std::is_convertible_v<Value, std::string_view>) {
    object.set(key, std::string(std::string_view(value)));
  } else if constexpr (std::is_same_v<Value, val> || std::is_arithmetic_v<Value>) {
    object.set(key, value);
  } else {
    object.set(key, column(value));
  }
  set_fields(object, rest...);
}

/// An object from keys and values in turn; texts, numbers, columns and values of JavaScript.
template <class... KeysAndValues>
val object(const KeysAndValues&... keys_and_values) {
  val result = val::object();
  set_fields(result, keys_and_values...);
  return result;
}

/// The fields of figure.hpp by their names, colours as in a style sheet; lines only where they are seen, as columns.
val figure_value(const portraits::Figure& figure);

}  // namespace contensou::page
