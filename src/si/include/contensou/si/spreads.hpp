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

/// A number of an experiment that may have a standard deviation: a quantity, or a component of a vector.
struct Component {
  const Quantity* quantity;
  std::size_t index;

  /// Returns the name of the number in run files and on the command line, such as friction or vx.
  std::string name() const;

  bool operator==(const Component&) const = default;
};

/// Returns all numbers that may have a standard deviation, in the order of quantities(). Moduli and the body's inertia
/// are not among them.
const std::vector<Component>& uncertain_components();

/// Returns the names of uncertain_components().
const std::vector<std::string>& uncertain_names();

/// Returns the number with that name; empty if there is none.
std::optional<Component> find_component(std::string_view name);

/// Returns a standard deviation from text such as "2 mm" or "5%", in the number's unit; empty for any other text.
/// @param unit   unit of the Quantity
/// @param value  value to which a percentage refers
/// @throws std::domain_error  for a percentage of the value 0
std::optional<double> parse_spread(std::string_view text, std::string_view unit, double value);

/// Standard deviations and correlations of numbers of an experiment. The numbers have a normal distribution.
struct Spreads {
  struct Number {
    Component of;
    double standard;  ///< standard deviation in the unit of the quantity
  };
  std::vector<Number> numbers = {};
  Eigen::MatrixXd correlation = {};  ///< symmetric, 1 on the diagonal

  bool empty() const { return numbers.empty(); }

  /// Returns the index of a number; empty if it has no spread.
  std::optional<Eigen::Index> place(const Component& of) const;

  /// Adds a number that is independent of the other numbers.
  void add(const Component& of, double standard);

  /// Returns the spreads of the numbers that satisfy a condition. The other numbers may have any value.
  Spreads of(const std::function<bool(const Component&)>& kept) const;

  Eigen::MatrixXd covariance() const;
};

/// Returns the standard deviations and correlations of a covariance matrix.
/// @param named  numbers that belong to its rows; a row without variance is left out
Spreads spreads_of(const Eigen::MatrixXd& covariance, const std::vector<Component>& named);

/// Returns the smallest eigenvalue of a correlation matrix. If it is negative, no numbers have these correlations.
double least_eigenvalue(const Eigen::MatrixXd& correlation);

/// An eigenvalue of this size or smaller counts as 0. Correlations are given with few digits, and complete correlations
/// have an eigenvalue 0.
inline constexpr double eigenvalue_rounding = 1e-6;

}  // namespace contensou::si
