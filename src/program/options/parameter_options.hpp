#pragma once

#include <map>
#include <string>
#include <utility>

#include "options/argument.hpp"

namespace contensou::program {

/// --param: numbers for the letters of formulas.
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
