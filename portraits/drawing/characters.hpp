#pragma once

#include <string_view>
#include <vector>

namespace contensou::portraits {

/// Returns the characters of a UTF-8 text, as views into it.
std::vector<std::string_view> characters(std::string_view text);

inline constexpr std::string_view no_break_space = "\u00A0";

}  // namespace contensou::portraits
