#pragma once

#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contensou/si/experiment.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/spreads.hpp"

namespace contensou::si {

/// The place at which a value of an experiment was given. Messages quote this place.
struct Source {
  std::string place;    ///< FILE:LINE:COLUMN; empty outside of files
  std::string name;     ///< name of the value at this place, such as 'mass' in quotes, or --mass
  std::string section;  ///< section such as [ball]; empty if there are none

  /// Throws an error about this value.
  /// @throws RunFileError       beginning with the place, if there is one
  /// @throws std::domain_error  otherwise
  [[noreturn]] void fail(const std::string& message) const;
};

/// An error in a run file; the message begins with FILE:LINE:COLUMN.
struct RunFileError : std::domain_error {
  using std::domain_error::domain_error;
};

/// The values that are given for an experiment, all or some of them, each with its place.
/// A built-in ball, a run file, options of the program, a Ball of Python and the fields of the page each make a
/// Description. under() combines two, experiment_of() makes the experiment, and law_of() returns the name of its law.
class Description {
 public:
  struct Values {
    std::vector<double> numbers;  ///< one number for each component of the quantity
    Source source;
  };

  Description() = default;

  /// Makes the description of a run file.
  /// @param places  file:line of each section, quoted when a value is missing
  explicit Description(std::map<std::string, std::string, std::less<>> places)
      : places_(std::move(places)), in_file_(true) {}

  /// Sets a value, which replaces an earlier one.
  /// @throws std::domain_error  or RunFileError, with the name of the quantity, if it cannot have these values
  void set(const Quantity& quantity, std::vector<double> numbers, Source source);
  void set_name(std::string name) { name_ = std::move(name); }
  void set_body(const Body& body) { body_ = body; }

  /// Sets the body with that name.
  /// @throws std::domain_error  or RunFileError, with a list of the names, if there is no such body
  void set_body(const std::string& name, const Source& source);

  /// Sets the law, by its name or by formulas.
  void set_law(std::string text) { law_ = std::move(text); }

  /// Sets the standard deviation of one number.
  /// @throws std::domain_error  or RunFileError, for a standard deviation below 0
  void add_spread(const Component& of, double standard, const Source& source);

  /// Sets the correlation of the errors of two numbers.
  /// @throws std::domain_error  or RunFileError, if one of the numbers has no spread, if the correlation is set twice,
  ///                            or outside [-1, 1]
  void correlate(const Component& one, const Component& other, double correlation, const Source& source);

  /// Tests that a number with a spread is given.
  /// @throws std::domain_error  or RunFileError, if it is not
  void require_given(const Component& of, const Source& source) const;
  void set_spreads(Spreads spreads) { spreads_ = std::move(spreads); }

  /// Returns the values of a quantity; null if it is not given.
  const Values* find(const Quantity& quantity) const;
  const std::string& name() const { return name_; }
  const std::optional<Body>& body() const { return body_; }
  const std::string& law() const { return law_; }
  const Spreads& spreads() const { return spreads_; }
  bool empty() const { return values_.empty(); }

  /// Returns this description with the values of `above` in place of its own.
  ///
  /// A value in `above` removes the values that determine the same in another way (alternatives): a patch radius
  /// removes moduli, a load removes gravity, and slip with spin removes velocities. A velocity replaces the slip, an
  /// angular velocity the spin; the other of slip and spin stays. A slip or a spin replaces velocities by a slip along
  /// x and a spin; if `above` lacks one of these, the velocities determine it. A replaced number loses its standard
  /// deviation; the correlations of the other numbers stay.
  Description under(const Description& above) const;

  /// Tests that no value is given in two ways, and that numbers with the given correlations exist.
  /// @throws std::domain_error  or RunFileError, with the names of the values and their places
  void require_no_contradiction() const;

  /// Returns the place of a value; if the value is not given, the result of home_of.
  Source source_of(const Quantity& quantity) const;

  /// Returns the place, in the section of a quantity, at which its value would stand.
  Source home_of(const Quantity& quantity) const;

  /// Returns true if all values stand in one file.
  bool in_one_file() const;

 private:
  /// Replaces velocities by a slip along x and a spin.
  void start_along_x(const Values* other_radius);

  std::string name_, law_;  ///< empty if not given
  std::optional<Body> body_;
  std::map<const Quantity*, Values> values_;
  Spreads spreads_;
  std::map<std::string, std::string, std::less<>> places_;
  bool in_file_ = false;
};

/// Returns the values by which an experiment was given, as a description.
Description describe(const Experiment& experiment);

/// Makes the experiment that a description contains.
/// @throws std::domain_error  or RunFileError, with the names and places of the missing value or of the values that
///                            exclude each other; as require_experiment
Experiment experiment_of(const Description& described);

/// Returns the name of the described law, or else of the law of the body's pressure, even if values are missing.
std::string law_of(const Description& described);

}  // namespace contensou::si
