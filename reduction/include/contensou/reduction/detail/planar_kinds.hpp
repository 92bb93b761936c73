#pragma once

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace contensou::reduction {

/// All kinds of singular points and equilibria that a planar system can have.
inline constexpr std::string_view planar_kinds[]{"stable node",  "unstable node",  "saddle",     "saddle-node",
                                                 "stable focus", "unstable focus", "center",     "center or focus",
                                                 "stable star",  "unstable star",  "cusp",       "regular point",
                                                 "bordered",     "mixed",          "degenerate", "not smooth"};

/// Returns its argument, which must be one of planar_kinds; another name does not compile.
consteval std::string_view planar_kind(std::string_view name) {
  const auto* const found = std::ranges::find(planar_kinds, name);
  if (found == std::end(planar_kinds)) throw std::logic_error("no kind of a planar system");
  return *found;
}

}  // namespace contensou::reduction
