#pragma once

#include <string>
#include <utility>
#include <vector>

namespace contensou::answers {

/// Words for the error of the paper's Pade law, for any body.
inline constexpr const char* cost_of_pade =
    "whose force is up to 39 % too small and whose stop times are up to 44 % too long ('contensou help laws')";

/// The forms of --law, each with its meaning.
std::vector<std::pair<std::string, std::string>> law_forms();

}  // namespace contensou::answers
