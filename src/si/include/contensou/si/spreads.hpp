#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace contensou::si {

struct Quantity;

/// A number of an experiment that may be known to so much: a quantity, or a component of one that is a vector.
struct Component {
  const Quantity* quantity;
  std::size_t index;

  /// As a run file and the command line have it: friction, of a velocity vx.
  std::string name() const;

  bool operator==(const Component&) const = default;
};

/// All of them, in the order of quantities(): not the moduli of a patch, nor inertia, which the body says.
const std::vector<Component>& uncertain_components();

/// Their names.
const std::vector<std::string>& uncertain_names();

/// None for a name that is none of theirs.
std::optional<Component> find_component(std::string_view name);

/// A standard deviation as it is typed, such as "2 mm" or "5%", in the unit of the number; nothing for a plain number and
/// for any other text.
/// @param unit   as of a Quantity
/// @param value  what a % is of
/// @throws std::domain_error  for a % of 0
std::optional<double> parse_spread(std::string_view text, std::string_view unit, double value);

/// What numbers of an experiment are known to: normal, with these standard deviations and correlations.
struct Spreads {
  struct Number {
    Component of;
    double standard;  ///< in the unit of the quantity
  };
  std::vector<Number> numbers = {};
  Eigen::MatrixXd correlation = {};  ///< symmetric, 1 on the diagonal

  bool empty() const { return numbers.empty(); }

  /// Its place among the numbers; none for one that has no spread.
  std::optional<Eigen::Index> place(const Component& of) const;

  /// Adds a number that is independent of the others.
  void add(const Component& of, double standard);

  /// Of some of them alone, whatever the others are.
  Spreads of(const std::function<bool(const Component&)>& kept) const;

  Eigen::MatrixXd covariance() const;
};

/// Those of a covariance.
/// @param named  what its rows are of; a row that does not vary is left out
Spreads spreads_of(const Eigen::MatrixXd& covariance, const std::vector<Component>& named);

/// The least eigenvalue of a matrix of correlations: below 0 no numbers can have them.
double least_eigenvalue(const Eigen::MatrixXd& correlation);

/// An eigenvalue that stands for 0: correlations are written with some digits, and those of numbers that go together
/// have one.
inline constexpr double eigenvalue_rounding = 1e-6;

}  // namespace contensou::si
