#pragma once

#include <span>
#include <string>
#include <string_view>

namespace contensou {

/// The name that was probably meant: the one that the fewest edits (insert, delete, replace, swap neighbours) lead to.
/// Empty if even that one needs edits for more than half of its letters.
std::string nearest_name(std::string_view typed, std::span<const std::string> names);

/// The same as the end of a message: " (did you mean 'NAME'?)", or nothing.
std::string suggestion(std::string_view typed, std::span<const std::string> names);

}  // namespace contensou
