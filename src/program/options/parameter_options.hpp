#pragma once

#include <map>
#include <string>
#include <utility>

#include "options/argument.hpp"

namespace contensou::program {

/// The option --param, which sets the parameters of formulas.
class ParameterOptions {
 public:
  void add(CLI::App& app);
  bool given() const { return parameters_.given(); }

  /// @throws BadInput  for a name that is given twice
  std::map<std::string, double> read() const;

 private:
  ArgumentOf<std::pair<std::string, double>> parameters_;
};

}  // namespace contensou::program
