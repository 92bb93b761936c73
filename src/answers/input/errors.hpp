#pragma once

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace contensou::answers {

/// A mistake of the user. The message says which input is wrong, which input is allowed and how to correct it.
struct BadInput : std::domain_error {
  using std::domain_error::domain_error;

  /// @param message  text with braces for the values, as in fmt::format
  template <class Value, class... Values>
  BadInput(fmt::format_string<Value, Values...> message, Value&& value, Values&&... values)
      : domain_error(fmt::format(message, std::forward<Value>(value), std::forward<Values>(values)...)) {}
};

/// A mistake of the user in a file. The message begins with FILE:LINE.
struct BadLine : BadInput {
  using BadInput::BadInput;
};

}  // namespace contensou::answers
