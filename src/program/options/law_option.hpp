#pragma once

#include <string>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/body.hpp"
#include "options/argument.hpp"
#include "options/parameter_options.hpp"

namespace contensou::program {

/// --law, and --param for its formulas.
class LawOption {
 public:
  /// @param note  sentence that the help adds
  void add(CLI::App& app, const std::string& note = "");

  /// Several laws, as read_several takes them.
  void add_several(CLI::App& app, const std::string& value_name, const std::string& help);

  /// Under another name, for a second law, whose formulas have no parameters.
  void add_second(CLI::App& app, const std::string& name, const std::string& value_name, const std::string& help);
  bool given() const { return law_.given(); }
  const Argument& argument() const { return law_; }

  const ParameterOptions& parameters() const { return parameters_; }

  /// The law of that name, of that exponent (pressure:P), of these formulas (phi = F; psi = G), or of the table in that
  /// file (with a / or ending in .csv); the standard one if none was given: of a start StartOptions::standard_law().
  /// @throws BadInput           for an unknown name or an exponent out of range, formulas that are no law; BadLine for
  /// a bad line of the file
  /// @throws std::system_error  if the file cannot be read
  reduction::Law read(const std::string& standard) const;

  /// The laws of several names between commas, or the one of formulas. Throws as read.
  std::vector<reduction::Law> read_several(const std::string& standard) const;

 private:
  reduction::Law read_one(const std::string& typed) const;

  void require_no_parameters() const;

  Argument law_;
  ParameterOptions parameters_;
};

}  // namespace contensou::program
