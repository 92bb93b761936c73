#pragma once

#include <string>
#include <utility>
#include <vector>

namespace contensou::answers {

/// Words for the error of the paper's Pade law in the slip length of the balls pool, steel and bowling.
inline constexpr const char* cost_of_pade =
    "in which the length that spin adds to the slip is too long: 5 times (pool), 129 (steel), 470 (bowling)";

/// The forms of --law, each with its meaning.
std::vector<std::pair<std::string, std::string>> law_forms();

}  // namespace contensou::answers
