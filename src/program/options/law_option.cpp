#include "options/law_option.hpp"

#include <stdexcept>

#include "answers/asked/formula_law.hpp"
#include "answers/input/tables.hpp"

namespace contensou::program {

namespace {

std::vector<std::string> names_of_forms() {
  std::vector<std::string> names;
  for (const auto& [name, meaning] : law_forms()) names.push_back(name);
  return names;
}

std::pair<std::string, double> parse_parameter(const std::string& typed) {
  const std::size_t equals = typed.find('=');
  if (equals == std::string::npos) throw NotAllowed("a parameter is NAME=VALUE");
  return {typed.substr(0, equals), number(typed.substr(equals + 1))};
}

}  // namespace

void LawOption::add(CLI::App& app, const std::string& note) {
  add_several(
      app, "LAW",
      "law of friction ('contensou help laws'): name, formulas or FILE.csv (default exact, or law of the body)" + note);
}

void LawOption::add_several(CLI::App& app, const std::string& value_name, const std::string& help) {
  app.option_defaults()->group("Law of friction");
  law_.add(app, "--law", value_name, help);
  parameters_.add(app, "--param", "NAME=VALUE", "value of a parameter in typed formulas; may be repeated",
                  parse_parameter, true);
}

void LawOption::add_second(CLI::App& app, const std::string& name, const std::string& value_name,
                           const std::string& help) {
  law_.add(app, name, value_name, help);
}

std::map<std::string, double> LawOption::parameters() const {
  std::map<std::string, double> values;
  for (const auto& [name, value] : parameters_.all()) {
    if (!values.emplace(name, value).second) throw BadInput("--param: {} is given twice", quotation(name));
  }
  return values;
}

reduction::Law LawOption::read(const std::string& standard) const {
  if (law_.given()) return read_one(law_.text());
  if (!is_formula_law(standard)) require_no_parameters();
  return parameters_.given() ? parse_formula_law(standard, parameters()) : *find_law_or_formulas(standard);
}

std::vector<reduction::Law> LawOption::read_several(const std::string& standard) const {
  if (!law_.given() || is_formula_law(law_.text())) return {read(standard)};
  std::vector<reduction::Law> laws;
  for (const std::string& name : split(law_.text(), ',')) laws.push_back(read_one(name));
  return laws;
}

void LawOption::require_no_parameters() const {
  if (parameters_.given()) {
    throw BadInput("--param is for formulas, such as --law \"phi = F; psi = G\": add them, or leave it out");
  }
}

reduction::Law LawOption::read_one(const std::string& typed) const {
  try {
    if (is_formula_law(typed)) return parse_formula_law(typed, parameters());
    require_no_parameters();
    if (auto law = find_law_or_formulas(typed == "hertz" ? "exact" : typed)) return *law;
  } catch (const std::domain_error& error) {
    law_.reject(error.what());
  }
  if (names_a_file(typed, {".csv"})) return read_pressure_profile(typed);
  law_.reject(no_such("law", typed, names_of_forms(), false));
}

}  // namespace contensou::program
