#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace contensou::answers {

/// A value and behind it its slopes, the derivatives with respect to N variables.
template <std::size_t N>
using Dual = std::array<double, N + 1>;

/// The form of a pair of formulas, or of one.
struct FormulaShape {
  /// Before the equals signs; the second is empty where one is due, both for one formula without an equals sign.
  std::array<std::string, 2> left;
  std::vector<std::string> variables;               ///< variables of the formulas
  std::string sentence;                             ///< sentence for messages, such as: a system is "u' = F; v' = G"
  std::map<std::string, std::string> refused = {};  ///< names that are no parameters, with the reason
};

/// Returns the names before the equals signs of a text, without blanks.
std::vector<std::string> left_sides(const std::string& text);

/// Two formulas, "u' = F; v' = G" in any order, of some variables and parameters. Behind them the text may give
/// parameters, "; a = 2". From the loosest binding to the tightest a formula has
///
///     c ? a : b    ||    &&    < > <= >= == !=    + -    * /    - + ! before a value    ^, also typed **
///
/// and brackets, |x|, numbers, pi and functions: sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp sqrt,
/// ln and log (both natural), log2 log10 abs sign (sign(0) = 0), rint (halves to even); of two numbers atan2 hypot; of
/// any number min max sum avg. a^b^c is a^(b^c), -u^2 is -(u^2), and x^2 is x*x to the last bit. A comparison is 1 or
/// 0, and a condition holds unless it is 0. A bar opens |x| where a value is due and closes it where an operator is
/// due, so || is "or" except directly within |x|.
///
/// A value: copies share what was compiled, and several threads may call it at once.
class Formulas {
 public:
  /// @param text  formulas of at most 20000 characters, nested at most 250 deep
  /// @param parameters  values that replace those of the text
  /// @throws BadInput  quoting the mistake and saying at which character; for a parameter that is a name of another
  ///                   kind or that no formula has
  Formulas(const FormulaShape& shape, const std::string& text, std::map<std::string, double> parameters);

  /// @param values  values of the variables
  /// @return the values of the formulas; 0 for one that is not due
  std::array<double, 2> operator()(std::initializer_list<double> values) const;

  /// Returns the same values with their slopes by the chain rule, exact except for rounding. N is 1 or 2.
  ///
  /// At a kink of abs, min, max or a choice the slopes are those of the branch that gives the value, for |x| at 0 those
  /// of x; sign, rint and comparisons have slope 0. Slopes are infinite or NaN where there are none, as those of
  /// sqrt(u*u) at 0. A part of a formula without u adds exactly 0 to the slope by u.
  template <std::size_t N>
  std::array<Dual<N>, 2> with_slopes(const std::array<double, N>& values) const;

  /// Returns the common denominator of the formulas, as the first of a pair: the product of the divisors that depend on
  /// variables, each to its highest power, outside of functions. None if there is no such divisor.
  std::optional<Formulas> denominator() const;

 private:
  struct Compiled;
  explicit Formulas(std::shared_ptr<const Compiled> compiled) : compiled_(std::move(compiled)) {}

  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace contensou::answers
