#include "answers/asked/law_forms.hpp"

#include <map>
#include <string_view>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"

namespace contensou::answers {

std::vector<std::pair<std::string, std::string>> law_forms() {
  // Remarks of the program on laws, such as their use as a default.
  const std::map<std::string_view, std::string_view> notes{
      {"exact", "default of a ball; also called hertz"},
      {"pade", "too large in the slip length that spin adds: 5 times (pool), 129 times (steel), 470 times (bowling)"},
      {"uniform", "default of --body disc"},
      {"ring", "default of --body ring"},
  };
  std::vector<std::pair<std::string, std::string>> forms;
  for (const std::string_view name : reduction::names_of_laws()) {
    std::string meaning(reduction::meaning_of_law(name));
    if (const auto note = notes.find(name); note != notes.end()) meaning += fmt::format(", {}", note->second);
    forms.emplace_back(name, meaning);
  }
  for (const auto& family : reduction::law_families()) {
    forms.emplace_back(fmt::format("{}:{}", family.name, family.letter),
                       fmt::format("{}, {}", family.meaning, family.allowed));
  }
  forms.emplace_back("\"phi = F; psi = G\"",
                     "own force and moment as formulas in k = v/(mu |u|); parameters by --param NAME=VALUE or by "
                     "\"; NAME = VALUE\" at the end");
  forms.emplace_back("FILE.csv", "own pressure, as a table with columns rho,pressure; rho from 0 to 1");
  return forms;
}

}  // namespace contensou::answers
