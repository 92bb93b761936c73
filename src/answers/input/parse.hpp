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

/// Returns a sentence about the decimal point if a text contains a comma; else "". The sentence ends a message about a
/// wrong number.
const char* decimal_hint(std::string_view text);

/// Returns true if a text is written like the numbers that parse_number reads, no matter how large the number is.
bool is_number(std::string_view text);

/// Returns the number that a text consists of; spaces around it are allowed.
/// @throws BadInput  with the text, if it is not a number, does not fit a double, or is infinite although `infinity`
///                   forbids this
double parse_number(std::string_view text, Infinity infinity = Infinity::forbidden);

/// Splits a text at each occurrence of a mark.
std::vector<std::string> split(std::string_view text, char mark);

/// Returns the numbers of a list separated by commas.
/// @throws BadInput  as parse_number
std::vector<double> parse_numbers(std::string_view text, Infinity infinity = Infinity::forbidden);

/// Returns the whole number that a text consists of.
/// @throws BadInput  with the text, unless it is a whole number in [lowest, highest]
long parse_integer(std::string_view text, long lowest, long highest);

}  // namespace contensou::answers
