// Conversion of the library's values to JavaScript and back.
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <emscripten/val.h>

#include "answers/input/errors.hpp"
#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::page {

using emscripten::val;

/// Returns the result of a call. An exception becomes an Error with its message, because JavaScript cannot read C++
/// exceptions. A fault of the library becomes an Error with the name Fault, to which the page adds the request.
template <class Call>
auto answer(Call call) {
  std::string problem;
  bool is_fault = false;
  try {
    return call();
  } catch (const std::exception& error) {
    problem = answers::message_of(error, "");
    is_fault = answers::is_fault(error);
  }
  val error = val::global("Error").new_(problem);
  if (is_fault) error.set("name", "Fault");
  error.throw_();
}

/// Wraps a function, or a method, so that the page calls it through `answer`.
template <auto function>
inline constexpr auto answering = nullptr;

template <class Result, class... Given, Result (*function)(Given...)>
inline constexpr auto answering<function> = +[](Given... given) { return answer([&] { return function(given...); }); };

template <class Class, class Result, class... Given, Result (Class::*method)(Given...)>
inline constexpr auto answering<method> = +[](Class& self, Given... given) {
  return answer([&] { return (self.*method)(given...); });
};

template <class Class, class Result, class... Given, Result (Class::*method)(Given...) const>
inline constexpr auto answering<method> = +[](const Class& self, Given... given) {
  return answer([&] { return (self.*method)(given...); });
};

/// Returns the law of that name. Laws are kept, because the tables of some laws take time.
/// @throws std::domain_error  if there is no such law
reduction::Law law_of(const std::string& name);

/// Returns the experiment that has the given fields: a body, and quantities (si/quantity.hpp) by name, in SI units.
si::Experiment experiment_of(const val& fields);

/// Returns the start of an experiment: {slip, spin, along, across}, the latter the velocity of the centre along the
/// slip and to the left of it.
val start_value(const si::Experiment& experiment);

/// Returns numbers as a Float64Array.
template <class Numbers>
val column(const Numbers& values) {
  return val(emscripten::typed_memory_view(static_cast<std::size_t>(values.size()), values.data())).call<val>("slice");
}

/// Returns the points of all lines in one column, with NaN between lines: x0, y0, x1, y1, ...
val column(const std::vector<portraits::Polyline>& lines);

/// Returns an array with the value of the function for each entry of a range.
template <class Range, class Function>
val list(const Range& range, Function value) {
  val result = val::array();
  int index = 0;
  for (const auto& entry : range) result.set(index++, value(entry));
  return result;
}

/// Returns for each run of a text {words, italic, level}.
val text_value(const portraits::Text& text);

inline void set_fields(val&) {}
template <class Value, class... Rest>
void set_fields(val& object, const char* key, const Value& value, const Rest&... rest) {
  if constexpr (std::is_same_v<Value, portraits::Text>) {
    object.set(key, text_value(value));
  } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
    object.set(key, std::string(std::string_view(value)));
  } else if constexpr (std::is_same_v<Value, val> || std::is_arithmetic_v<Value>) {
    object.set(key, value);
  } else {
    object.set(key, column(value));
  }
  set_fields(object, rest...);
}

/// Returns an object from keys and values that alternate. Values are texts, strings, numbers, columns or vals.
template <class... KeysAndValues>
val object(const KeysAndValues&... keys_and_values) {
  val result = val::object();
  set_fields(result, keys_and_values...);
  return result;
}

/// Returns an object with the fields of portraits/figure.hpp. Colours are as in CSS, visible parts of lines as columns.
val figure_value(const portraits::Figure& figure);

/// Returns the number of rows of panels in a figure (figure_value) that has the given width in pixels.
int rows_of(const val& figure, double width);

/// Returns the layout of a figure (figure_value) in pixels: {texts: {x, y, text, size, align, turned, bold}, panels:
/// {box, x, y: ticks}, legend: {legend, x, y, width}, colours: boxes from the bottom up}.
/// @param letter  size of letters, pixels
val layout_value(const val& figure, double width, double height, double letter);

}  // namespace contensou::page
