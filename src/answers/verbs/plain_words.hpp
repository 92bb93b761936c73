#pragma once

#include <string>

namespace contensou::answers {

/// Returns a number >= 0 rounded to two digits. From 1e-5 to 1e6 it has no exponent.
std::string to_two_digits(double number);

/// Returns a length in mm, cm, m or km, to two digits.
/// @param metres  >= 0
std::string length_in_words(double metres);

/// Returns a time to two digits, with its unit.
/// @param seconds  >= 0
std::string time_in_words(double seconds);

}  // namespace contensou::answers
