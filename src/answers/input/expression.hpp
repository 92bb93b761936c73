#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::answers {

/// A rational number, or a double where numerator or denominator would leave 64 bits.
class Number {
 public:
  Number(long long whole) : Number(whole, 1) {}  // NOLINT(google-explicit-constructor): whole numbers are numbers
  Number(int whole) : Number(whole, 1) {}        // NOLINT(google-explicit-constructor)
  /// @param below  other than 0
  Number(long long above, long long below);
  /// Takes the fraction with a denominator of at most a million that rounds to the value; else the value itself.
  Number(double value);  // NOLINT(google-explicit-constructor)

  /// Takes the value itself, as a number that is not exact.
  static Number inexact(double value);

  double value() const { return value_; }
  bool is_exact() const { return below_ != 0; }
  bool is_whole() const { return below_ == 1; }
  long long above() const { return above_; }  ///< only for an exact number
  long long below() const { return below_; }  ///< positive; 0 for a number that is not exact

  friend Number operator+(const Number& a, const Number& b);
  friend Number operator*(const Number& a, const Number& b);
  friend bool operator==(const Number& a, const Number& b) = default;
  friend bool operator<(const Number& a, const Number& b) { return a.value_ < b.value_; }
  Number operator-() const;
  Number inverse() const;

 private:
  Number(double value, long long above, long long below) : value_(value), above_(above), below_(below) {}

  double value_;
  long long above_ = 0, below_ = 0;
};
inline Number operator-(const Number& a, const Number& b) { return a + -b; }
inline Number operator/(const Number& a, const Number& b) { return a * b.inverse(); }

/// A formula as a value: a number, a variable, a sum, a product, a power or a function of one argument. Sums, products
/// and powers are simplified when they are made: equal terms and factors are collected, and the order is fixed. The
/// simplified formula has the same values wherever the formula had one, except for rounding.
///
/// Copies share their parts. Operations throw std::length_error for a formula of more than `most` parts.
class Expression {
 public:
  enum class Kind : unsigned char { number, variable, power, function, product, sum };
  static constexpr std::size_t most = 3000;

  Expression(const Number& number);                     // NOLINT(google-explicit-constructor): numbers are formulas
  Expression(int whole) : Expression(Number(whole)) {}  // NOLINT(google-explicit-constructor)
  static Expression variable(std::size_t index);
  /// @param name  a function of one argument that has a derivative, such as sin; also abs, sign, sqrt, log2 and log10
  /// @throws std::domain_error  for another name
  static Expression function(std::string_view name, const Expression& x);
  static Expression sum(const std::vector<Expression>& terms);
  static Expression product(const std::vector<Expression>& factors);

  Kind kind() const;
  bool is(Kind kind_) const { return kind() == kind_; }
  const Number& number() const;               ///< value of a number
  std::size_t index() const;                  ///< index of a variable
  std::string_view name() const;              ///< name of a function
  std::span<const Expression> parts() const;  ///< terms, factors, base and exponent, or argument
  std::size_t size() const;                   ///< number of parts of all levels
  bool has(std::size_t variable) const;
  bool is_constant() const;  ///< true without variables
  bool is_zero() const { return is(Kind::number) && number() == Number(0); }
  bool is_one() const { return is(Kind::number) && number() == Number(1); }

  /// @param values  values of the variables
  double operator()(std::span<const double> values) const;
  double operator()(std::initializer_list<double> values) const {
    return (*this)(std::span(values.begin(), values.size()));
  }

  Expression derivative(std::size_t variable) const;
  Expression with(std::size_t variable, const Expression& by) const;
  /// Returns the formula with each part for which `by` returns a formula replaced by it, from the outermost part on.
  Expression replaced(const std::function<std::optional<Expression>(const Expression&)>& by) const;
  /// Returns the formula with products and whole powers of sums multiplied out, outside functions.
  Expression expanded() const;

  /// Returns the formula as Formulas read it.
  /// @param names  names of the variables
  /// @param digits  significant digits of numbers that are not exact; 0: as many as are needed
  std::string text(std::span<const std::string> names, int digits = 0) const;

  friend std::weak_ordering operator<=>(const Expression& a, const Expression& b);
  friend bool operator==(const Expression& a, const Expression& b) {
    return (a <=> b) == std::weak_ordering::equivalent;
  }

  friend Expression operator+(const Expression& a, const Expression& b) { return sum({a, b}); }
  friend Expression operator-(const Expression& a) { return product({-1, a}); }
  friend Expression operator-(const Expression& a, const Expression& b) { return sum({a, -b}); }
  friend Expression operator*(const Expression& a, const Expression& b) { return product({a, b}); }
  friend Expression operator/(const Expression& a, const Expression& b);
  friend Expression power(const Expression& base, const Expression& exponent);

 private:
  struct Node;
  explicit Expression(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  static Expression made(Kind kind, std::vector<Expression> parts, std::size_t index = 0);

  std::shared_ptr<const Node> node_;
};

Expression power(const Expression& base, const Expression& exponent);

/// Returns true for a call of the function with this name.
inline bool is_function(const Expression& e, std::string_view name) {
  return e.is(Expression::Kind::function) && e.name() == name;
}

/// Returns true for a whole number.
inline bool is_whole(const Expression& e) { return e.is(Expression::Kind::number) && e.number().is_whole(); }

/// Splits a term into its number and the product of its other factors.
struct Term {
  Number factor;
  Expression rest;
};
Term term_of(const Expression& e);

/// Returns base and exponent of a factor; the exponent is 1 unless the factor is a power.
std::pair<Expression, Expression> base_and_exponent(const Expression& factor);

/// Returns the factors of a product, or the formula itself.
std::span<const Expression> factors_of(const Expression& e);
/// Returns the terms of a sum, or the formula itself.
std::span<const Expression> terms_of(const Expression& e);

/// Numerator and denominator: a / b without negative exponents and, at the outer levels, without fractions in sums.
struct Fraction {
  Expression above, below;
};
Fraction fraction_of(const Expression& e);

/// Returns the coefficients of a polynomial in a variable, the lowest first; empty if the formula is no polynomial
/// of at most this degree.
std::optional<std::vector<Expression>> coefficients(const Expression& e, std::size_t variable, std::size_t degree = 24);

}  // namespace contensou::answers
