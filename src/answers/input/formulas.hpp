#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "answers/input/expression.hpp"

namespace contensou::answers {

/// A value followed by its slopes, the derivatives by N variables.
template <std::size_t N>
using Dual = std::array<double, N + 1>;

/// A derivative as people write it: x', x'', dx/dt, d^2x/dt^2 or d2x/dt2.
struct TypedDerivative {
  std::string letter;      ///< x
  std::size_t order;       ///< number of primes, >= 1
  std::string by;          ///< t; empty for primes
  std::size_t characters;  ///< length of the text

  std::string name() const { return letter + std::string(order, '\''); }
};

/// The form that a pair of formulas, or a single formula, must have.
struct FormulaShape {
  /// Names before the equals signs. For a single formula the second name is empty; without an equals sign both are.
  std::array<std::string, 2> left;
  std::vector<std::string> variables;  ///< variables of the formulas
  std::string sentence;                ///< sentence for messages, such as: a law is "force = F; moment = M"
  std::map<std::string, std::string> refused = {};  ///< names that cannot be parameters, each with the reason
  /// For equations: their one or two derivatives, such as "x'" and "y'", instead of `left`. Each equation has one and
  /// is linear in it. The derivatives also stand in `variables`, behind the two variables.
  std::vector<std::string> derivatives = {};
  bool differentials = false;    ///< true: the derivatives are "dx" and "dy", in one equation; the formula is dy/dx
  std::string independent = {};  ///< for equations: x(t) is read as x, if this is "t"
  /// Reads a name and returns the length of its text: the function read_name_of_equation, or null for formulas, which
  /// contain no derivatives.
  std::size_t (*read_name)(const FormulaShape& shape, std::string_view text, std::size_t begin,
                           std::string& name) = nullptr;
};

/// Returns the derivative that begins at a place of a text.
std::optional<TypedDerivative> derivative_at(std::string_view text, std::size_t begin);

/// Reads the name that begins at a place, such as x' for dx/dt, and x for x(t). Returns the length of its text.
std::size_t read_name_of_equation(const FormulaShape& shape, std::string_view text, std::size_t begin,
                                  std::string& name);

/// Returns the end of the name, number or sign that begins at a place of a text.
std::size_t end_of_word(std::string_view text, std::size_t begin);

/// Throws BadInput for characters that are not ASCII. In a text that passes, bytes and characters have equal numbers.
void require_ascii(const std::string& text);

/// Returns true for the names of functions and of the number pi.
bool has_meaning(std::string_view name);

/// Throws BadInput. The message names a character of a text; advice follows.
[[noreturn]] void reject_at(std::size_t place, const std::string& text, const std::string& message,
                            std::string_view advice = "");

/// Two formulas, "u' = F; v' = G" in any order, that contain variables and parameters. Values of parameters may follow
/// in the text, "; a = 2". Formulas contain these operators, from the loosest binding to the tightest:
///
///     c ? a : b    ||    &&    < > <= >= == !=    + -    * /    - + ! before a value    ^, also typed **
///
/// A product may be typed without its sign before a name or a bracket, as in 2x, x y and x(1 - y), except after a
/// division: 1/2x has two meanings.
///
/// They may also contain brackets, |x|, numbers, pi and functions: sin cos tan asin acos atan sinh cosh tanh asinh
/// acosh atanh exp sqrt, ln and log (both natural), log2 log10 abs sign (sign(0) = 0), rint (halves to even); of two
/// numbers atan2 hypot; of any number of numbers min max sum avg. a^b^c is a^(b^c), -u^2 is -(u^2), and x^2 equals x*x
/// to the last bit. A comparison is 1 or 0, and a condition is true unless it is 0. A bar opens |x| where a value is
/// expected and closes it where an operator is expected. Therefore || means "or" except directly within |x|.
///
/// A value type: copies share the compiled formulas, and several threads may call the copies at once.
class Formulas {
 public:
  /// @param text  formulas of at most 20000 characters, nested at most 250 deep
  /// @param parameters  values of parameters, which replace values of the same parameters in the text
  /// @throws BadInput  with the mistake and its character; for a parameter whose name has another meaning, or that
  ///                   no formula contains
  Formulas(const FormulaShape& shape, const std::string& text, std::map<std::string, double> parameters);

  /// Returns the formulas of equations, solved for the derivatives of the shape. Throws as the constructor.
  static Formulas of_equations(const FormulaShape& shape, const std::string& text,
                               std::map<std::string, double> parameters);

  /// @param values  values of the variables
  /// @return the values of the formulas; 0 for a missing formula
  std::array<double, 2> operator()(std::initializer_list<double> values) const;

  /// Returns the values of operator() with their slopes by the chain rule, exact except for rounding. N is 1 or 2.
  ///
  /// At a kink of abs, min, max or a choice the slopes are those of the branch that gives the value; for |x| at 0 the
  /// slope of x is used. sign, rint and comparisons have slope 0. If a slope does not exist, such as the slope of
  /// sqrt(u*u) at 0, it is infinite or NaN. A part of a formula without u adds exactly 0 to the slope by u.
  template <std::size_t N>
  std::array<Dual<N>, 2> with_slopes(const std::array<double, N>& values) const;

  /// Returns the switching functions of both formulas, one row each: value, d/du, d/dv. Between their zeros the
  /// formulas are smooth. Their number is the same for all values, and a switching function depends on a variable.
  ///
  /// These functions are the arguments of abs, sign, min, max, comparisons and conditions, the edges of functions such
  /// as sqrt and ln, the bases of powers, and divisors. A product is replaced by its factors: sqrt(u*u) has the
  /// switching function u. For rint(x), cos(pi x) is used. For atan2(y, x), y is used where x <= 0.
  ///
  /// @return NaN where a switching function has no value. A change from NaN to a number is no change of sign.
  Eigen::MatrixX3d switches(const std::array<double, 2>& values) const;

  /// Returns the formulas that equal these about a point and continue them smoothly beyond the zeros of the switching
  /// functions: abs, sign, rint, min, max and comparisons keep the choice that they make at the point. A part within
  /// sqrt, a logarithm or the base of a power stays as it is, because it has no smooth continuation.
  Formulas branch(const std::array<double, 2>& values) const;

  /// Returns the common denominator as the first formula of the result. This denominator is the product of the
  /// divisors that depend on variables and stand outside functions, each to its highest power; empty without a divisor.
  std::optional<Formulas> denominator() const;

  /// Returns both formulas as Expressions, whose variables have the indices of FormulaShape::variables; 0 for a missing
  /// formula. Empty if a formula contains a comparison, a choice, rint, min, max or atan2.
  std::optional<std::array<Expression, 2>> expressions() const;

 private:
  struct Compiled;
  explicit Formulas(std::shared_ptr<const Compiled> compiled) : compiled_(std::move(compiled)) {}

  std::shared_ptr<const Compiled> compiled_;
};

/// Returns the value of a number, or of a formula of numbers and pi, such as pi/2.
/// @throws BadInput  as parse_number
double parse_constant(const std::string& text);
/// Returns true if a text is a number or such a formula, even one whose value is not finite.
bool is_constant(const std::string& text);

}  // namespace contensou::answers
