#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::answers {

/// Returns true if the text of a law consists of formulas instead of a name or a file.
bool is_formula_law(const std::string& text);

/// Returns the law "phi = F; psi = G", where F and G are formulas in k = v/(mu |u|) and parameters
/// (answers/input/formulas.hpp). Phi is the force divided by f N. Psi is the moment divided by f N and the patch
/// radius. The name of the law is the text with the parameters.
///
/// Below k = 2^-90 and above k = 2^90, limits replace the formulas. Below 2^-90, Phi is proportional to k, and Psi is
/// constant. Above 2^90, 1 - Phi and Psi are proportional to 1/k. reduction::Law checks that the law has such limits.
///
/// @throws BadInput  for a mistake in a formula, with the number of its character; for a law that does not resist the
///                   motion or has no limits, with the values that show this
reduction::Law parse_formula_law(const std::string& text, const std::map<std::string, double>& parameters = {});

/// Returns the law of a text (a name, or formulas), such as the text `law` in a run file; empty for an unknown name.
/// @throws std::domain_error  as reduction::find_law and parse_formula_law
std::optional<reduction::Law> find_law_or_formulas(const std::string& text);

/// Words for the error of the paper's Pade law, for any body.
inline constexpr const char* cost_of_pade =
    "whose force is up to 39 % too small and whose stop times are up to 44 % too long ('contensou help laws')";

/// The forms of --law, each with its meaning.
std::vector<std::pair<std::string, std::string>> law_forms();

}  // namespace contensou::answers
