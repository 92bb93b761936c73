#pragma once

#include <exception>
#include <stdexcept>
#include <string>
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

/// Returns true if an exception is a fault of the program, such as an index out of range, whose message means nothing
/// to a user. Bad input is a std::domain_error, and a failure of the numerics or of a file a std::runtime_error; their
/// messages are written for users.
bool is_fault(const std::exception& error);

/// Returns a message of the library without the names of its classes and functions, such as "ReducedSystem: ".
std::string words_of(std::string message);

/// Returns the message of an exception for a user. For a fault it says that the program is wrong and asks for a report.
/// @param asked  the user's request in words; the message for a fault quotes it
std::string message_of(const std::exception& error, const std::string& asked);

}  // namespace contensou::answers
