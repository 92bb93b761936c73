#pragma once

#include <string>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/body.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// --law.
class LawOption {
 public:
  void add(CLI::App& app);

  /// Under another name, for a second law.
  void add(CLI::App& app, const std::string& name, const std::string& value_name, const std::string& help);
  bool given() const { return law_.given(); }
  const Argument& argument() const { return law_; }

  /// The law of that name, of that exponent (pressure:P), or of the table in that file (with a / or ending in .csv);
  /// the standard one if none was given: of a start StartOptions::standard_law().
  /// @throws BadInput           for an unknown name or an exponent out of range; BadLine for a bad line of the file
  /// @throws std::system_error  if the file cannot be read
  reduction::Law read(const std::string& standard) const;

  /// The laws of several names between commas. Throws as read.
  std::vector<reduction::Law> read_several(const std::string& standard) const;

 private:
  reduction::Law read_one(const std::string& typed) const;

  Argument law_;
};

}  // namespace contensou::program
