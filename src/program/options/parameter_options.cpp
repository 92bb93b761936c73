#include "options/parameter_options.hpp"

#include <string_view>

namespace contensou::program {

namespace {

std::pair<std::string, double> parse_parameter(const std::string& typed) {
  const std::size_t equals = typed.find('=');
  if (equals == std::string::npos) throw NotAllowed("a parameter is NAME=VALUE");
  return {typed.substr(0, equals), parse_number(std::string_view(typed).substr(equals + 1))};
}

}  // namespace

void ParameterOptions::add(CLI::App& app) {
  parameters_.add(app, "--param", "NAME=VALUE", "value of a parameter in typed formulas; may be repeated",
                  parse_parameter, true);
}

std::map<std::string, double> ParameterOptions::read() const {
  std::map<std::string, double> parameters;
  for (const auto& [name, value] : parameters_.all()) {
    if (!parameters.emplace(name, value).second) throw BadInput("--param: {} is given twice", quotation(name));
  }
  return parameters;
}

}  // namespace contensou::program
