#pragma once

#include <string>
#include <string_view>

namespace contensou::program {

/// Input as a message shows it: quotes, backslashes, control characters and bytes that are not UTF-8 as in a string of
/// C (\", \\, \x1b).
std::string escaped(std::string_view input);

/// Input as a message quotes it: escaped, in single quotes, and cut after 80 bytes with an ellipsis.
std::string quotation(std::string_view input);

}  // namespace contensou::program
