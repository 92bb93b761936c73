#include "options/law_option.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/reduction/laws.hpp"
#include "options/pressure_profile.hpp"
#include "text/nearest_name.hpp"

namespace contensou::program {

namespace {

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const reduction::Law& law : reduction::named_laws()) names.push_back(law.name());
  return names;
}

/// The names, and what stands for more of them.
std::vector<std::string> law_forms() {
  std::vector<std::string> forms = law_names();
  for (const auto& family : reduction::law_families())
    forms.push_back(fmt::format("{}:{}", family.name, family.letter));
  forms.push_back("FILE.csv");
  return forms;
}

}  // namespace

void LawOption::add(CLI::App& app) {
  law_.add(
      app, "--law", "LAW",
      fmt::format("friction law: {}. exact (default): Hertz's pressure; a --body disc: uniform, ring: ring. pade: the "
                  "paper's approximation, {}. P > -1: pressure (1 - rho^2)^P; FILE.csv: columns rho,pressure",
                  fmt::join(law_forms(), ", "), cost_of_pade));
}

void LawOption::add(CLI::App& app, const std::string& name, const std::string& value_name, const std::string& help) {
  law_.add(app, name, value_name, help);
}

reduction::Law LawOption::read(const Body& body) const {
  if (!law_.given()) return *reduction::find_law(body.law);
  try {
    if (auto law = reduction::find_law(law_.text())) return *law;
  } catch (const std::domain_error& error) {
    law_.reject(error.what());
  }
  if (names_a_file(law_.text(), {".csv"})) return read_pressure_profile(law_.text());
  const std::vector<std::string> forms = law_forms();
  law_.reject(fmt::format("no such law{}; laws: {}", suggestion(law_.text(), forms), fmt::join(forms, ", ")));
}

}  // namespace contensou::program
