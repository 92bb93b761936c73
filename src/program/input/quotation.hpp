#pragma once

#include <string>
#include <string_view>

namespace contensou::program {

/// Somebody's text as a message quotes it: between single quotes, control characters as \xNN so that nothing is hidden
/// or cut off by them, and a long text cut with an ellipsis.
std::string quotation(std::string_view typed);

}  // namespace contensou::program
