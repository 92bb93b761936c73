#include "options/law_option.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "contensou/si/nearest_name.hpp"
#include "exit_status.hpp"
#include "input/number.hpp"
#include "options/pressure_profile.hpp"

namespace contensou::program {

namespace {

constexpr std::string_view family = "pressure:";

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const reduction::Law& law : reduction::named_laws()) names.push_back(law.name());
  return names;
}

/// The names, and what stands for more of them.
std::vector<std::string> law_forms() {
  std::vector<std::string> forms = law_names();
  forms.insert(forms.end(), {"pressure:P", "FILE.csv"});
  return forms;
}

bool names_a_file(const std::string& text) { return text.find('/') != std::string::npos || text.ends_with(".csv"); }

}  // namespace

void LawOption::add(CLI::App& app) {
  law_.add(app, "--law", "LAW",
           fmt::format("friction law: {} (default {}); P > -1: pressure (1 - rho^2)^P; FILE.csv: columns rho,pressure",
                       fmt::join(law_forms(), ", "), law_names().front()));
}

void LawOption::add(CLI::App& app, const std::string& name, const std::string& value_name, const std::string& help) {
  law_.add(app, name, value_name, help);
}

reduction::Law LawOption::read() const {
  if (!law_.given()) return reduction::named_laws().front();
  if (auto law = reduction::find_law(law_.text())) return *law;
  if (law_.text().starts_with(family)) return of_the_family();
  if (names_a_file(law_.text())) return read_pressure_profile(law_.text());
  const std::vector<std::string> forms = law_forms();
  law_.reject(fmt::format("no such law{}; laws: {}", si::suggestion(law_.text(), forms), fmt::join(forms, ", ")));
}

reduction::Law LawOption::of_the_family() const {
  const std::string_view exponent = std::string_view(law_.text()).substr(family.size());
  double p = 0;
  try {
    p = parse_number(exponent);
  } catch (const BadInput& error) {
    law_.reject(
        fmt::format("{}; the exponent P of the pressure (1 - rho^2)^P is needed, as in pressure:0.5", error.what()));
  }
  if (!(p > -1 && p <= reduction::PressureLaw::largest_p)) {
    law_.reject(fmt::format("-1 < P <= {} is required{}", reduction::PressureLaw::largest_p,
                            p == -1 ? "; the limit P -> -1 is the law ring" : ""));
  }
  return reduction::PressureLaw(p);
}

}  // namespace contensou::program
