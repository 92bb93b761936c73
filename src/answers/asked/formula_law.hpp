#pragma once

#include <map>
#include <optional>
#include <string>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::answers {

/// Whether the text of a law is formulas, and no name and no file.
bool is_formula_law(const std::string& text);

/// The law of "phi = F; psi = G", formulas in k = v/(mu |u|) and parameters as answers/input/formulas.hpp has them: Phi, the
/// force over f N, and Psi, the moment over f N times the radius of the patch. Its name is the text with the parameters.
///
/// Where k is below 2^-90 or beyond 2^90 the formulas are continued by the limits that reduction::Law checks within: Phi in
/// proportion to k, Psi constant; 1 - Phi and Psi in proportion to 1/k.
///
/// @throws BadInput  for a mistake in a formula, at its character; for a law that does not resist, or has no limits,
///                   with what was measured
reduction::Law parse_formula_law(const std::string& text, const std::map<std::string, double>& parameters = {});

/// What the `law` of a run file says: a name, or formulas.
/// @throws std::domain_error  as reduction::find_law and parse_formula_law; none for a name that no law has
std::optional<reduction::Law> find_law_or_formulas(const std::string& text);

}  // namespace contensou::answers
