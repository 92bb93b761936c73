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

/// Where a value of an experiment was given, as messages name it.
struct Source {
  std::string place;    ///< FILE:LINE:COLUMN; empty for what is in no file
  std::string name;     ///< of the value there, such as 'mass' in quotes, or --mass
  std::string section;  ///< [ball], say; empty where there are none

  /// @throws RunFileError       beginning with the place, if there is one
  /// @throws std::domain_error  otherwise
  [[noreturn]] void fail(const std::string& message) const;
};

/// What is wrong with a run file; the message begins with FILE:LINE:COLUMN.
struct RunFileError : std::domain_error {
  using std::domain_error::domain_error;
};

/// What is said of an experiment, whole or in part, each value with where it was given. A built-in ball, a run file, options
/// of the program, a Ball of Python and the fields of the page each fill one; over() lays one over another; experiment_of()
/// makes the experiment, and law_of() says its law.
class Description {
 public:
  struct Values {
    std::vector<double> numbers;  ///< as many as the quantity has components
    Source source;
  };

  Description() = default;

  /// What a run file says.
  /// @param places  of its sections, where a message says that something is missing
  explicit Description(std::map<std::string, std::string, std::less<>> places)
      : places_(std::move(places)), in_file_(true) {}

  /// Gives a value; one that was given before goes.
  /// @throws std::domain_error  naming the quantity, or RunFileError, if it cannot have these values
  void set(const Quantity& quantity, std::vector<double> numbers, Source source);
  void set_name(std::string name) { name_ = std::move(name); }
  void set_body(const Body& body) { body_ = body; }

  /// @throws std::domain_error  or RunFileError, listing the names, if there is no such body
  void set_body(const std::string& name, const Source& source);

  /// By its name, or by formulas.
  void set_law(std::string text) { law_ = std::move(text); }

  /// Says what a number is known to.
  /// @throws std::domain_error  or RunFileError for a standard deviation below 0
  void add_spread(const Component& of, double standard, const Source& source);

  /// Says how the errors of two numbers go together.
  /// @throws std::domain_error  or RunFileError, if one of them has no spread, if it is said twice, and outside [-1, 1]
  void correlate(const Component& one, const Component& other, double correlation, const Source& source);

  /// Rejects a spread of what is not given.
  /// @throws std::domain_error  or RunFileError
  void require_given(const Component& of, const Source& source) const;
  void set_spreads(Spreads spreads) { spreads_ = std::move(spreads); }

  /// Null if it is not given.
  const Values* find(const Quantity& quantity) const;
  const std::string& name() const { return name_; }
  const std::optional<Body>& body() const { return body_; }
  const std::string& law() const { return law_; }
  const Spreads& spreads() const { return spreads_; }

  /// Whether none of the values is given.
  bool empty() const { return values_.empty(); }

  /// This one with what is said above it in place of its own. What is given in another way (alternatives) goes: a patch
  /// radius replaces moduli, a load gravity, slip with spin velocities. A velocity replaces its part of a slip with a spin,
  /// and the other part stays. A slip or a spin replaces velocities: a slip along x and a spin, of which the one that is not
  /// said above is that of these velocities. What a number was known to goes with it, and the correlations of the rest stay.
  Description under(const Description& above) const;

  /// Rejects two ways to give one thing, and correlations that no numbers have.
  /// @throws std::domain_error  or RunFileError, naming the values and where they are
  void require_no_contradiction() const;

  /// Where a value stands; if it is not given, where it would.
  Source source_of(const Quantity& quantity) const;

  /// Where a value would stand, with the place of its section.
  Source home_of(const Quantity& quantity) const;

  /// Whether all values stand in one file.
  bool in_one_file() const;

 private:
  /// Turns velocities into a slip along x and a spin.
  void start_along_x(const Values* other_radius);

  std::string name_, law_;  ///< empty if not given
  std::optional<Body> body_;
  std::map<const Quantity*, Values> values_;
  Spreads spreads_;
  std::map<std::string, std::string, std::less<>> places_;
  bool in_file_ = false;
};

/// What an experiment is given by.
Description describe(const Experiment& experiment);

/// The experiment that is described.
/// @throws std::domain_error  or RunFileError, naming what is missing or excludes what and where it was given; as
///                            require_experiment
Experiment experiment_of(const Description& described);

/// The name of the law of what is described, also where values are still missing: its own, or that of its body's pressure.
std::string law_of(const Description& described);

}  // namespace contensou::si
