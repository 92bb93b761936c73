#include "law_option.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/nearest_name.hpp"

namespace contensou::program {

namespace {

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const reduction::Law& law : reduction::named_laws()) names.push_back(law.name());
  return names;
}

}  // namespace

void LawOption::add(CLI::App& app) {
  law_.add(app, "--law", "LAW",
           fmt::format("friction law: {} (default {})", fmt::join(law_names(), ", "), law_names().front()));
}

reduction::Law LawOption::read() const {
  if (!law_.given()) return reduction::named_laws().front();
  if (auto law = reduction::find_law(law_.text())) return *law;
  const auto names = law_names();
  law_.reject(fmt::format("no such law{}; laws: {}", si::suggestion(law_.text(), names), fmt::join(names, ", ")));
}

}  // namespace contensou::program
