#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// The two laws of Zh98: the exact one of Hertz's pressure, (1.3) and (1.5), and its Pade pair, (1.4) and (1.6).
const std::vector<Law>& paper_laws();

/// The name of every law that has one, in the order in which they are shown: those of the paper first.
std::vector<std::string_view> names_of_laws();

/// The laws of these names, all of them made: some have tables. Where one is asked for, find_law makes that one.
const std::vector<Law>& named_laws();

/// What the law of that name is, in a few words; empty if no law has it.
std::string_view meaning_of_law(std::string_view name);

/// Laws that a number tells apart, named as in "pressure:0.5".
struct LawFamily {
  std::string_view name;     ///< before the colon
  std::string_view letter;   ///< of the number, such as P
  std::string_view meaning;  ///< what the number decides
  std::string_view allowed;  ///< min and max, for messages
  double example;
  double min, max;  ///< both allowed
  Law (*law)(double number);
};
const std::vector<LawFamily>& law_families();

/// The law of that name, or of that family and number; empty if there is no such law.
/// @throws std::domain_error  after a family's colon, for what is no number or none of the family; names neither law
///                            nor function: the caller does
std::optional<Law> find_law(std::string_view name);

}  // namespace contensou::reduction
