#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contensou::answers {

/// Returns input as messages show it: quotes, backslashes, control characters and bytes that are not UTF-8 are escaped
/// as in a string of C (\", \\, \x1b).
std::string escaped(std::string_view input);

/// Returns input as messages quote it: escaped, in single quotes, and cut after 80 bytes with an ellipsis.
std::string quotation(std::string_view input);

enum class Infinity { forbidden, allowed };

/// Returns a sentence on the decimal point for a text with a comma, to end the message that it is no number; else "".
const char* decimal_hint(std::string_view text);

/// Returns true if parse_number finds a number, of any size.
bool is_number(std::string_view text);

/// Returns the number in a text that contains nothing else but spaces around it.
/// @throws BadInput  quoting the text, if it is not a number, does not fit a double, or is not finite where it must be
double parse_number(std::string_view text, Infinity infinity = Infinity::forbidden);

/// Splits a text at a mark.
std::vector<std::string> split(std::string_view text, char mark);

/// Returns the numbers in a list with commas.
/// @throws BadInput  as parse_number
std::vector<double> parse_numbers(std::string_view text, Infinity infinity = Infinity::forbidden);

/// Returns the whole number in a text.
/// @throws BadInput  quoting the text, unless it is one and lies in [lowest, highest]
long parse_integer(std::string_view text, long lowest, long highest);

}  // namespace contensou::answers
