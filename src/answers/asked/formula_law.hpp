#pragma once

#include <map>
#include <optional>
#include <string>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::answers {

/// Returns true if the text of a law consists of formulas instead of a name or a file.
bool is_formula_law(const std::string& text);

/// Returns the law of "phi = F; psi = G". F and G are formulas in k = v/(mu |u|) and parameters
/// (answers/input/formulas.hpp). Phi is the force divided by f N. Psi is the moment divided by f N and the patch
/// radius. The name of the law is the text with the parameters.
///
/// Below k = 2^-90 and above 2^90 limits continue the formulas: Phi proportional to k and Psi constant below; 1 - Phi
/// and Psi proportional to 1/k above. reduction::Law checks these limits.
///
/// @throws BadInput  for a mistake in a formula, with its character; for a law that does not resist or has no limits,
///                   with the measured values
reduction::Law parse_formula_law(const std::string& text, const std::map<std::string, double>& parameters = {});

/// Returns the law that a text names or gives by formulas, as the `law` of a run file; nothing for an unknown name.
/// @throws std::domain_error  as reduction::find_law and parse_formula_law
std::optional<reduction::Law> find_law_or_formulas(const std::string& text);

}  // namespace contensou::answers
