#pragma once

#include <string_view>
#include <vector>

namespace contensou::program {

enum class Infinity { forbidden, allowed };

/// Whether parse_number finds a number, of whatever size.
bool is_number(std::string_view text);

/// The number that a whole text spells, spaces around it aside.
/// @throws BadInput  quoting the text, if it is not a number, does not fit a double, or is not finite where it must be
double parse_number(std::string_view text, Infinity infinity = Infinity::forbidden);

/// Numbers between commas.
/// @throws BadInput  as parse_number
std::vector<double> parse_numbers(std::string_view text, Infinity infinity = Infinity::forbidden);

/// The whole number that a text spells.
/// @throws BadInput  quoting the text, unless it is one and lies in [lowest, highest]
long parse_integer(std::string_view text, long lowest, long highest);

}  // namespace contensou::program
