#pragma once

#include <exception>
#include <string>

namespace contensou::answers {

/// Returns whether an exception is a fault of ours, such as an index out of range: its message says nothing to a
/// reader. Bad input is a std::domain_error, and a failure of the numbers or of a file a std::runtime_error, in our own
/// words.
bool is_fault(const std::exception& error);

/// Returns a message of the library without the names of its classes and functions, such as "ReducedSystem: ".
std::string words_of(std::string message);

/// Returns the message of an exception for a reader: of a fault, that it is ours and must be reported.
/// @param asked  the question in words that the reader can repeat, for a fault
std::string message_of(const std::exception& error, const std::string& asked);

}  // namespace contensou::answers
