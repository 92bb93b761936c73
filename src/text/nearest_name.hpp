#pragma once

#include <span>
#include <string>
#include <string_view>

namespace contensou {

/// Returns the name that is the fewest edits (insert, delete, replace, swap neighbours) away from a typed text. Empty
/// if the edits are more than half of its letters.
std::string nearest_name(std::string_view typed, std::span<const std::string> names);

/// Returns that name as the end of a message, " (did you mean 'NAME'?)"; empty if there is no such name.
std::string suggestion(std::string_view typed, std::span<const std::string> names);

/// Returns the message about an unknown name: "no such KIND 'TYPED' (did you mean 'NAME'?); KINDS: NAMES".
/// @param quoted  false: without TYPED, for a message that begins with the typed text
std::string no_such(std::string_view kind, std::string_view typed, std::span<const std::string> names,
                    bool quoted = true);

}  // namespace contensou
