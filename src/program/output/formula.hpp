#pragma once

#include <string>
#include <string_view>

namespace contensou::program {

/// A formula of TeX as a line of plain text: \frac{r k \Psi}{D} becomes r k Psi/D. Knows what the texts that the program
/// shows use; \qquad and \\ become line breaks.
///
/// @param tag  if given, takes the argument of \tag
/// @throws std::logic_error  for another command, or braces that do not match
std::string plain_formula(std::string_view tex, std::string* tag = nullptr);

}  // namespace contensou::program
