#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// The two laws of the paper: the exact one of Hertz's pressure, and the Pade pair that approximates it.
const std::vector<Law>& paper_laws();

/// Every law that has a name, in the order in which it is shown: those of the paper first.
const std::vector<Law>& named_laws();

/// The law of that name, or of the exponent P in "pressure:P" (PressureLaw::name); empty if there is no such law.
/// @throws std::domain_error  after "pressure:", for what is no number or no exponent of PressureLaw; names neither law
///                            nor function: the caller does
std::optional<Law> find_law(std::string_view name);

}  // namespace contensou::reduction
