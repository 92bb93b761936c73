#pragma once

#include <string_view>
#include <vector>

namespace contensou::portraits {

/// The characters of a text in UTF-8, in turn; they point into it.
std::vector<std::string_view> characters(std::string_view text);

inline constexpr std::string_view no_break_space = "\u00A0";

}  // namespace contensou::portraits
