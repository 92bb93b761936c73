#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// The option --law, and --param for the parameters of its formulas.
class LawOption {
 public:
  /// @param note  sentence that is added to the help
  void add(CLI::App& app, const std::string& note = "");

  /// Adds an option for several laws. The function read_several reads this option.
  void add_several(CLI::App& app, const std::string& value_name, const std::string& help);

  /// Adds an option under another name, for a second law. Formulas of this law have no parameters.
  void add_second(CLI::App& app, const std::string& name, const std::string& value_name, const std::string& help);
  bool given() const { return law_.given(); }
  const Argument& argument() const { return law_; }

  /// Returns the values of --param.
  /// @throws BadInput  for a name that is given twice
  std::map<std::string, double> parameters() const;

  /// Returns the law with a name, with an exponent (pressure:P), with formulas (phi = F; psi = G), or with the
  /// pressures in a file (the name of the file contains / or ends in .csv). Without the option it returns the law
  /// `standard`; for a start, `standard` is StartOptions::standard_law().
  /// @throws BadInput           for an unknown name, an exponent out of range, or formulas that are no law; BadLine for
  ///                            a bad line of the file
  /// @throws std::system_error  if the file cannot be read
  reduction::Law read(const std::string& standard) const;

  /// Returns the laws with several names, separated by commas, or the single law of the formulas. Throws as read.
  std::vector<reduction::Law> read_several(const std::string& standard) const;

 private:
  reduction::Law read_one(const std::string& typed) const;

  void require_no_parameters() const;

  Argument law_;
  ArgumentOf<std::pair<std::string, double>> parameters_;
};

}  // namespace contensou::program
