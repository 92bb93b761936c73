#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Every law that has a name, in the order in which it is shown: the paper's Pade pair first.
const std::vector<Law>& named_laws();

/// The law of that name, if there is one.
std::optional<Law> find_law(std::string_view name);

}  // namespace contensou::reduction
