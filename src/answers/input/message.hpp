#pragma once

#include <exception>
#include <string>

namespace contensou::answers {

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
