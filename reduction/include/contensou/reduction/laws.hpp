#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Returns the two laws of V. F. Zhuravlev, 1998 (Zh98): exact, (1.3) and (1.5), and Pade, (1.4) and (1.6).
const std::vector<Law>& paper_laws();

/// Returns the names of all named laws; the two laws of the paper come first.
std::vector<std::string_view> names_of_laws();

/// Returns all named laws, in the order of names_of_laws. The call makes all tables of laws; find_law makes one law.
const std::vector<Law>& named_laws();

/// Returns a description of the law with that name, in a few words; empty if there is none.
std::string_view meaning_of_law(std::string_view name);

/// A family of laws that differ by one number, such as "pressure:0.5".
struct LawFamily {
  std::string_view name;     ///< name before the colon
  std::string_view letter;   ///< letter of the number in messages, such as P
  std::string_view meaning;  ///< meaning of the number
  std::string_view allowed;  ///< min and max as text, for messages
  double example;
  double min, max;  ///< least and largest number, both allowed
  Law (*law)(double number);
};
const std::vector<LawFamily>& law_families();

/// Returns the law with that name, or with that family and number; empty if there is no such law.
/// @throws std::domain_error  if the text after a family's colon is no number or a number outside the family's range;
///                            the message does not contain the law's name, because the caller adds it
std::optional<Law> find_law(std::string_view name);

}  // namespace contensou::reduction
