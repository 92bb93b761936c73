#include "answers/asked/law_forms.hpp"

#include <map>
#include <string_view>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"

namespace contensou::answers {

std::vector<std::pair<std::string, std::string>> law_forms() {
  // Remarks on laws for users of the program. One example: the law is the default of a kind of body.
  const std::map<std::string_view, std::string_view> notes{
      {"exact", "default of a ball; also called hertz"},
      {"pade",
       "which makes the sliding distance that spin adds 5 (ball pool), 129 (steel) or 470 (bowling) times too long"},
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
    forms.emplace_back(family.form(), fmt::format("{}, {}", family.meaning, family.allowed));
  }
  forms.emplace_back("\"phi = F; psi = G\"",
                     "your own Phi and Psi as formulas in k. Parameters are given by --param NAME=VALUE, or at the end "
                     "as \"; NAME = VALUE\"");
  forms.emplace_back("FILE.csv", "your own pressure as a table with columns rho,pressure; rho from 0 to 1");
  return forms;
}

}  // namespace contensou::answers
