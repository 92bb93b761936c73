#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contensou::answers {

/// Input as a message shows it: quotes, backslashes, control characters and bytes that are not UTF-8 as in a string of
/// C (\", \\, \x1b).
std::string escaped(std::string_view input);

/// Input as a message quotes it: escaped, in single quotes, and cut after 80 bytes with an ellipsis.
std::string quotation(std::string_view input);

enum class Infinity { forbidden, allowed };

/// "" or, for a text with a comma, a sentence for a message that it is no number.
const char* decimal_hint(std::string_view text);

/// Whether parse_number finds a number, of whatever size.
bool is_number(std::string_view text);

/// The number that a whole text spells, spaces around it aside.
/// @throws BadInput  quoting the text, if it is not a number, does not fit a double, or is not finite where it must be
double parse_number(std::string_view text, Infinity infinity = Infinity::forbidden);

/// The parts of a text between these marks.
std::vector<std::string> split(std::string_view text, char mark);

/// Numbers between commas.
/// @throws BadInput  as parse_number
std::vector<double> parse_numbers(std::string_view text, Infinity infinity = Infinity::forbidden);

/// The whole number that a text spells.
/// @throws BadInput  quoting the text, unless it is one and lies in [lowest, highest]
long parse_integer(std::string_view text, long lowest, long highest);

}  // namespace contensou::answers
