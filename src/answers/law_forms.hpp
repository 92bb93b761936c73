#pragma once

#include <string>
#include <utility>
#include <vector>

namespace contensou::answers {

/// What the Pade law of the paper costs: pool, steel and bowling ball of `balls`, by their length of slip.
inline constexpr const char* cost_of_pade =
    "in which the extra slip of a spinning ball is too long: pool 5, steel 129, bowling 470 times";

/// What --law takes, and what it means.
std::vector<std::pair<std::string, std::string>> law_forms();

}  // namespace contensou::answers
