#include "answers/input/expression.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace contensou::answers {

namespace expression_parts {

using Whole = long long;
using E = Expression;

/// Functions of one argument, with their derivatives. Parity: 1 even, -1 odd, 0 neither.
struct Row {
  std::string_view name;
  double (*value)(double);
  E (*slope)(const E& x);
  int parity = 0;
};
E f(std::string_view name, const E& x) { return E::function(name, x); }
E root(const E& x) { return power(x, Number(1, 2)); }
E square(const E& x) { return power(x, 2); }
const Row rows[] = {
    {"abs", std::fabs, [](const E& x) { return f("sign", x); }, 1},
    {"sign", [](double x) { return x > 0   ? 1
                                   : x < 0 ? -1
                                           : x; }, [](const E&) { return E(0); }, -1},
    {"sin", std::sin, [](const E& x) { return f("cos", x); }, -1},
    {"cos", std::cos, [](const E& x) { return -f("sin", x); }, 1},
    {"tan", std::tan, [](const E& x) { return 1 + square(f("tan", x)); }, -1},
    {"asin", std::asin, [](const E& x) { return 1 / root(1 - square(x)); }, -1},
    {"acos", std::acos, [](const E& x) { return -1 / root(1 - square(x)); }},
    {"atan", std::atan, [](const E& x) { return 1 / (1 + square(x)); }, -1},
    {"sinh", std::sinh, [](const E& x) { return f("cosh", x); }, -1},
    {"cosh", std::cosh, [](const E& x) { return f("sinh", x); }, 1},
    {"tanh", std::tanh, [](const E& x) { return 1 - square(f("tanh", x)); }, -1},
    {"asinh", std::asinh, [](const E& x) { return 1 / root(1 + square(x)); }, -1},
    {"acosh", std::acosh, [](const E& x) { return 1 / root(square(x) - 1); }},
    {"atanh", std::atanh, [](const E& x) { return 1 / (1 - square(x)); }, -1},
    {"exp", std::exp, [](const E& x) { return f("exp", x); }},
    {"ln", std::log, [](const E& x) { return 1 / x; }},
};

std::optional<std::size_t> row_of(std::string_view name) {
  const auto* const found = std::ranges::find(rows, name, &Row::name);
  if (found == std::end(rows)) return std::nullopt;
  return static_cast<std::size_t>(found - rows);
}

bool is_even(const E& e) { return is_whole(e) && e.number().above() % 2 == 0; }

/// Returns true if the formula has no negative value.
bool is_positive(const E& e) {
  if (e.is(E::Kind::number)) return e.number().value() >= 0;
  if (is_function(e, "exp") || is_function(e, "abs") || is_function(e, "cosh")) return true;
  if (e.is(E::Kind::power)) return is_even(e.parts()[1]) || !is_whole(e.parts()[1]);
  return (e.is(E::Kind::product) || e.is(E::Kind::sum)) && std::ranges::all_of(e.parts(), is_positive);
}

/// Returns the number with which a sum must be multiplied so that its coefficients are whole and have no common factor.
Number content(const E& sum) {
  Whole above = 0, below = 1;
  for (const E& part : sum.parts()) {
    const Number factor = term_of(part).factor;
    if (!factor.is_exact() || below > 1'000'000'000) return 1;
    above = std::gcd(above, factor.above());
    below = std::lcm(below, factor.below());
  }
  return Number(above, below);
}

/// Returns true if the first number of the formula is negative; exactly one of e and -e is so, except 0.
bool is_negative(const E& e) { return term_of(terms_of(e).front()).factor.value() < 0; }

std::optional<Whole> exact_root(Whole x, Whole degree) {
  const auto guess =
      static_cast<Whole>(std::llrint(std::pow(static_cast<double>(x), 1. / static_cast<double>(degree))));
  Number raised = 1;
  for (Whole i = 0; i < degree; ++i) raised = raised * guess;
  return raised == Number(x) ? std::optional(guess) : std::nullopt;
}

/// Returns the largest number whose square divides x.
Whole square_in(Whole x) {
  Whole root = 1;
  for (Whole i = 2; i * i <= x && i < 1000; ++i) {
    for (; x % (i * i) == 0; x /= i * i) root *= i;
  }
  return root;
}

std::optional<E> power_of_number(const Number& base, const Number& exponent) {
  if (!base.is_exact() || !exponent.is_exact()) {
    const double value = std::pow(base.value(), exponent.value());
    return std::isfinite(value) ? std::optional<E>(Number::inexact(value)) : std::nullopt;
  }
  if (exponent.is_whole() && std::abs(exponent.above()) <= 64) {
    if (base == Number(0) && exponent.value() < 0) return std::nullopt;
    Number raised = 1;
    for (Whole i = 0; i < std::abs(exponent.above()); ++i) raised = raised * base;
    return exponent.value() < 0 ? raised.inverse() : raised;
  }
  if (base == Number(0) && exponent.value() > 0) return Number(0);
  if (base.value() <= 0 || exponent.below() > 12) return std::nullopt;
  const auto above = exact_root(base.above(), exponent.below()), below = exact_root(base.below(), exponent.below());
  if (above && below) return power(Number(*above, *below), Number(exponent.above()));
  if (exponent.below() != 2) return std::nullopt;
  if (exponent.above() != 1) {  // x^(3/2) = x sqrt(x), x^(-1/2) = sqrt(x)/x
    const Whole whole = (exponent.above() - 1) / 2 - (exponent.above() < 0 ? 1 : 0);
    return E::product({power(base, Number(whole)), power(base, exponent - whole)});
  }
  const Whole radicand = (base * Number(base.below()) * Number(base.below())).above(), out = square_in(radicand);
  if (out == 1 && base.below() == 1) return std::nullopt;
  return E::product({Number(out, base.below()), power(Number(radicand / (out * out)), Number(1, 2))});
}

std::string text_of(const Number& x, int digits) {
  if (x.is_exact()) return x.is_whole() ? fmt::to_string(x.above()) : fmt::format("{}/{}", x.above(), x.below());
  if (x.value() == std::numbers::pi) return "pi";
  return digits > 0 ? fmt::format("{:.{}g}", x.value(), digits) : fmt::to_string(x.value());
}

/// Total degree of a term, by which sums are printed: functions and roots come before powers of the same degree.
double degree(const E& e) {
  double total = 0;
  for (const E& factor : factors_of(e)) {
    const auto [base, exponent] = base_and_exponent(factor);
    if (base.is_constant()) continue;
    const double by = exponent.is(E::Kind::number) ? exponent.number().value() : 1;
    total += by * (base.is(E::Kind::sum) ? degree(base.parts().front()) : 1);
  }
  return total;
}

}  // namespace expression_parts

Number::Number(long long above, long long below) {
  using namespace expression_parts;
  if (below < 0) above = -above, below = -below;
  const Whole common = std::gcd(above, below);
  above_ = above / common;
  below_ = below / common;
  value_ = static_cast<double>(above_) / static_cast<double>(below_);
}

Number::Number(double value) : value_(value) {
  using namespace expression_parts;
  constexpr double largest = 1e12;
  constexpr Whole most_below = 1'000'000;
  if (!(std::abs(value) < largest)) return;
  Whole above[2] = {1, 0}, below[2] = {0, 1};  // the last two convergents of the continued fraction
  double rest = value;
  for (int i = 0; i < 40; ++i) {
    const double whole = std::floor(rest);
    if (!(std::abs(whole) < largest)) return;
    const auto next = [whole = static_cast<Whole>(whole)](Whole(&pair)[2]) {
      pair[1] = std::exchange(pair[0], whole * pair[0] + pair[1]);
    };
    next(above);
    next(below);
    if (below[0] > most_below || std::abs(static_cast<double>(above[0])) > largest) return;
    if (static_cast<double>(above[0]) / static_cast<double>(below[0]) == value) {
      above_ = above[0];
      below_ = below[0];
      return;
    }
    rest = 1 / (rest - whole);
  }
}

Number operator+(const Number& a, const Number& b) {
  using namespace expression_parts;
  Whole left = 0, right = 0, above = 0, below = 0;
  if (a.is_exact() && b.is_exact() && !__builtin_mul_overflow(a.above_, b.below_, &left) &&
      !__builtin_mul_overflow(b.above_, a.below_, &right) && !__builtin_add_overflow(left, right, &above) &&
      !__builtin_mul_overflow(a.below_, b.below_, &below)) {
    return Number(above, below);
  }
  return Number::inexact(a.value_ + b.value_);
}

Number operator*(const Number& a, const Number& b) {
  if (a == Number(0) || b == Number(0)) return 0;
  using namespace expression_parts;
  if (a.is_exact() && b.is_exact()) {
    const Whole one = std::max<Whole>(std::gcd(a.above_, b.below_), 1),
                other = std::max<Whole>(std::gcd(b.above_, a.below_), 1);
    Whole above = 0, below = 0;
    if (!__builtin_mul_overflow(a.above_ / one, b.above_ / other, &above) &&
        !__builtin_mul_overflow(a.below_ / other, b.below_ / one, &below)) {
      return Number(above, below);
    }
  }
  return Number::inexact(a.value_ * b.value_);
}

Number Number::operator-() const { return *this * Number(-1); }
Number Number::inverse() const { return is_exact() && above_ != 0 ? Number(below_, above_) : inexact(1 / value_); }
Number Number::inexact(double value) { return value == 0 ? Number(0) : Number(value, 0, 0); }

struct Expression::Node {
  Kind kind;
  Number number = 0;
  std::size_t index = 0;  ///< of a variable, or of a row of functions
  std::vector<Expression> parts = {};
  std::size_t size = 1;
  unsigned variables = 0;
};

Expression::Expression(const Number& number) : node_(std::make_shared<Node>(Node{Kind::number, number})) {}

Expression Expression::variable(std::size_t index) {
  Node node{Kind::variable, 0, index};
  node.variables = 1U << index;
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::made(Kind kind, std::vector<Expression> parts, std::size_t index) {
  Node node{kind, 0, index, std::move(parts)};
  for (const Expression& part : node.parts) {
    node.size += part.size();
    node.variables |= part.node_->variables;
  }
  if (node.size > most) throw std::length_error("a formula became too long");
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression::Kind Expression::kind() const { return node_->kind; }
const Number& Expression::number() const { return node_->number; }
std::size_t Expression::index() const { return node_->index; }
std::string_view Expression::name() const { return expression_parts::rows[node_->index].name; }
std::span<const Expression> Expression::parts() const { return node_->parts; }
std::size_t Expression::size() const { return node_->size; }
bool Expression::has(std::size_t variable) const { return (node_->variables >> variable & 1U) != 0; }
bool Expression::is_constant() const { return node_->variables == 0; }

std::weak_ordering operator<=>(const Expression& a, const Expression& b) {
  if (a.node_ == b.node_) return std::weak_ordering::equivalent;
  if (const auto kinds = a.kind() <=> b.kind(); std::is_neq(kinds)) return kinds;
  if (a.is(Expression::Kind::number)) {
    if (a.number() == b.number()) return std::weak_ordering::equivalent;
    const double x = a.number().value(), y = b.number().value();
    if (x != y && !std::isnan(x) && !std::isnan(y))
      return x < y ? std::weak_ordering::less : std::weak_ordering::greater;
    return std::pair(a.number().above(), a.number().below()) <=> std::pair(b.number().above(), b.number().below());
  }
  if (const auto indices = a.index() <=> b.index(); std::is_neq(indices)) return indices;
  if (const auto counts = a.parts().size() <=> b.parts().size(); std::is_neq(counts)) return counts;
  for (std::size_t i = 0; i < a.parts().size(); ++i) {
    if (const auto parts = a.parts()[i] <=> b.parts()[i]; std::is_neq(parts)) return parts;
  }
  return std::weak_ordering::equivalent;
}

Term term_of(const Expression& e) {
  if (e.is(Expression::Kind::number)) return {e.number(), 1};
  if (!e.is(Expression::Kind::product) || !e.parts()[0].is(Expression::Kind::number)) return {1, e};
  const auto others = e.parts().subspan(1);
  return {e.parts()[0].number(), Expression::product({others.begin(), others.end()})};
}

std::pair<Expression, Expression> base_and_exponent(const Expression& factor) {
  if (factor.is(Expression::Kind::power)) return {factor.parts()[0], factor.parts()[1]};
  return {factor, 1};
}

std::span<const Expression> factors_of(const Expression& e) {
  return e.is(Expression::Kind::product) ? e.parts() : std::span(&e, 1);
}

std::span<const Expression> terms_of(const Expression& e) {
  return e.is(Expression::Kind::sum) ? e.parts() : std::span(&e, 1);
}

Expression Expression::sum(const std::vector<Expression>& terms) {
  using namespace expression_parts;
  std::map<Expression, Number> all;
  for (const Expression& each : terms) {
    for (const Expression& term : terms_of(each)) {
      const auto [factor, rest] = term_of(term);
      // A number times a sum is a sum, so only a sum within a product can be left.
      const auto [at, is_new] = all.try_emplace(rest, factor);
      if (!is_new) at->second = at->second + factor;
    }
  }
  std::vector<Expression> kept;
  for (const auto& [rest, factor] : all) {
    if (factor == Number(0)) continue;
    kept.push_back(rest.is_one() ? Expression(factor) : product({factor, rest}));
  }
  if (kept.empty()) return 0;
  if (kept.size() == 2) {  // c + c tan^2 = c/cos^2
    const auto [c, one] = term_of(kept[0]);
    const auto [d, square] = term_of(kept[1]);
    const auto [base, exponent] = base_and_exponent(square);
    if (one.is_one() && c == d && is_function(base, "tan") && exponent == Expression(2)) {
      return product({c, power(function("cos", base.parts()[0]), -2)});
    }
  }
  return kept.size() == 1 ? kept[0] : made(Kind::sum, std::move(kept));
}

Expression Expression::product(const std::vector<Expression>& factors) {
  using namespace expression_parts;
  Number number = 1;
  std::map<Expression, Expression> powers;
  std::vector<Expression> exponents;  // of exp
  const auto add = [&](const Expression& factor, const auto& itself) -> void {
    if (factor.is(Kind::number)) {
      number = number * factor.number();
    } else if (factor.is(Kind::product)) {
      for (const Expression& part : factor.parts()) itself(part, itself);
    } else if (is_function(factor, "exp")) {
      exponents.push_back(factor.parts()[0]);
    } else {
      auto [base, exponent] = base_and_exponent(factor);
      if (base.is(Kind::sum) && exponent.is_one()) {
        Number common = content(base);
        if (is_negative(base)) common = -common;
        number = number * common;
        if (!(common == Number(1))) {
          std::vector<Expression> terms;
          for (const Expression& term : base.parts()) {
            const auto [by, rest] = term_of(term);
            terms.push_back(product({by / common, rest}));
          }
          base = sum(terms);
        }
      }
      const auto [at, is_new] = powers.try_emplace(base, exponent);
      if (!is_new) at->second = at->second + exponent;
    }
  };
  for (const Expression& factor : factors) add(factor, add);
  if (number == Number(0)) return 0;
  std::vector<Expression> kept;
  bool again = false;
  for (const auto& [base, exponent] : powers) {
    if (exponent.is_zero()) continue;
    const Expression raised = power(base, exponent);
    again |= raised.is(Kind::number) || raised.is(Kind::product) || !(base_and_exponent(raised).first == base);
    kept.push_back(raised);
  }
  if (!exponents.empty()) {
    const Expression raised = function("exp", sum(exponents));
    again |= !is_function(raised, "exp") && !raised.is_one();
    if (!raised.is_one()) kept.push_back(raised);
  }
  if (again) {
    kept.emplace_back(number);
    return product(kept);
  }
  if (kept.empty()) return number;
  if (number == Number(1) && kept.size() == 1) return kept[0];
  if (kept.size() == 1 && kept[0].is(Kind::sum)) {
    std::vector<Expression> terms;
    for (const Expression& term : kept[0].parts()) terms.push_back(product({number, term}));
    return made(Kind::sum, std::move(terms));
  }
  std::ranges::sort(kept);
  if (!(number == Number(1))) kept.insert(kept.begin(), number);
  return made(Kind::product, std::move(kept));
}

Expression power(const Expression& base, const Expression& exponent) {
  using namespace expression_parts;
  using Kind = Expression::Kind;
  if (exponent.is_zero() || base.is_one()) return 1;
  if (exponent.is_one()) return base;
  const bool whole = is_whole(exponent);
  if (exponent.is(Kind::number)) {
    if (base.is(Kind::number)) {
      if (const auto raised = power_of_number(base.number(), exponent.number())) return *raised;
    } else if (is_function(base, "exp")) {
      return Expression::function("exp", base.parts()[0] * exponent);
    } else if (is_function(base, "abs") && is_even(exponent)) {
      return power(base.parts()[0], exponent);
    } else if (is_function(base, "sign") && whole && !is_even(exponent)) {
      return base;  // also 1/sign(x), which has no value at x = 0
    } else if (base.is(Kind::power)) {
      const auto [inner, first] = base_and_exponent(base);
      if (whole) return power(inner, first * exponent);
      if (is_even(first)) return power(Expression::function("abs", inner), first * exponent);
      if (first.is(Kind::number)) return power(inner, first * exponent);
    } else if (base.is(Kind::product)) {
      std::vector<Expression> outside, inside;
      for (const Expression& factor : base.parts()) {
        if (whole || is_positive(factor)) {
          outside.push_back(power(factor, exponent));
        } else if (factor.is(Kind::number) && !(factor.number() == Number(-1))) {
          outside.push_back(power(-factor, exponent));
          inside.emplace_back(-1);
        } else {
          inside.push_back(factor);
        }
      }
      if (!outside.empty()) {
        if (!inside.empty()) outside.push_back(power(Expression::product(inside), exponent));
        return Expression::product(outside);
      }
    } else if (base.is(Kind::sum)) {
      Number common = content(base);
      if (whole && is_negative(base)) common = -common;
      if (!(common == Number(1))) {
        return Expression::product({power(common, exponent), power(base * common.inverse(), exponent)});
      }
    }
  }
  return Expression::made(Kind::power, {base, exponent});
}

Expression operator/(const Expression& a, const Expression& b) { return Expression::product({a, power(b, -1)}); }

Expression Expression::function(std::string_view name, const Expression& x) {
  using namespace expression_parts;
  if (name == "sqrt") return power(x, Number(1, 2));
  if (name == "log") name = "ln";
  if (name == "log2") return function("ln", x) / function("ln", 2);
  if (name == "log10") return function("ln", x) / function("ln", 10);
  const auto row = row_of(name);
  if (!row) throw std::domain_error(fmt::format("Expression::function: {} is no function of one argument", name));
  if (x.is(Kind::number)) {
    const double value = rows[*row].value(x.number().value());
    const bool known =
        x.is_zero() || (x.is_one() && (name == "ln" || name == "acosh")) || name == "abs" || name == "sign";
    if (std::isfinite(value) && !x.number().is_exact()) return Number::inexact(value);
    if (std::isfinite(value) && known) return Number(value);
  }
  if (rows[*row].parity != 0 && is_negative(x)) {
    const Expression turned = function(name, -x);
    return rows[*row].parity < 0 ? -turned : turned;
  }
  if ((name == "abs" || name == "sign") && x.is(Kind::product)) {
    std::vector<Expression> each;
    for (const Expression& factor : x.parts()) each.push_back(function(name, factor));
    return product(each);
  }
  if (name == "sign" && x.is(Kind::power) && is_whole(x.parts()[1]) && !is_even(x.parts()[1]))
    return function("sign", x.parts()[0]);
  if (name == "abs") {
    if (is_positive(x)) return x;
    if (x.is(Kind::power)) return power(function("abs", x.parts()[0]), x.parts()[1]);
    if (x.is(Kind::sum) && !(content(x) == Number(1))) return content(x) * function("abs", x * content(x).inverse());
  }
  if (name == "exp") {
    std::vector<Expression> outside, inside;
    for (const Expression& term : terms_of(x)) {
      const auto [factor, rest] = term_of(term);
      if (is_function(rest, "ln")) {
        outside.push_back(power(rest.parts()[0], factor));
      } else {
        inside.push_back(term);
      }
    }
    if (!outside.empty()) {
      if (!inside.empty()) outside.push_back(function("exp", sum(inside)));
      return product(outside);
    }
  }
  constexpr std::pair<std::string_view, std::string_view> inverses[]{
      {"ln", "exp"}, {"sin", "asin"}, {"cos", "acos"}, {"tan", "atan"}, {"sinh", "asinh"}, {"tanh", "atanh"}};
  for (const auto& [outer, inner] : inverses) {
    if (name == outer && is_function(x, inner)) return x.parts()[0];
  }
  return made(Kind::function, {x}, *row);
}

double Expression::operator()(std::span<const double> values) const {
  using namespace expression_parts;
  const auto at = [&](std::size_t i) { return parts()[i](values); };
  switch (kind()) {
    case Kind::number:
      return number().value();
    case Kind::variable:
      return values[index()];
    case Kind::function:
      return rows[index()].value(at(0));
    case Kind::power: {
      const double base = at(0), exponent = at(1);
      return exponent == 0.5 ? std::sqrt(base) : exponent == 2 ? base * base : std::pow(base, exponent);
    }
    default: {
      double total = at(0);
      for (std::size_t i = 1; i < parts().size(); ++i) total = is(Kind::sum) ? total + at(i) : total * at(i);
      return total;
    }
  }
}

Expression Expression::derivative(std::size_t variable) const {
  using namespace expression_parts;
  if (!has(variable)) return 0;
  const auto slope = [&](std::size_t i) { return parts()[i].derivative(variable); };
  switch (kind()) {
    case Kind::number:
    case Kind::variable:
      return 1;
    case Kind::function:
      // The slope of ln |x| is 1/x, without sign and absolute value.
      if (name() == "ln" && is_function(parts()[0], "abs")) {
        return parts()[0].parts()[0].derivative(variable) / parts()[0].parts()[0];
      }
      return rows[index()].slope(parts()[0]) * slope(0);
    case Kind::power: {
      const Expression &base = parts()[0], &exponent = parts()[1];
      if (is_function(base, "abs") && !exponent.has(variable)) {
        return exponent * *this / base.parts()[0] * base.parts()[0].derivative(variable);
      }
      if (!exponent.has(variable)) return exponent * power(base, exponent - 1) * slope(0);
      return *this * (slope(1) * function("ln", base) + exponent * slope(0) / base);
    }
    case Kind::sum: {
      std::vector<Expression> terms;
      for (std::size_t i = 0; i < parts().size(); ++i) terms.push_back(slope(i));
      return sum(terms);
    }
    default: {
      std::vector<Expression> terms;
      for (std::size_t i = 0; i < parts().size(); ++i) {
        if (!parts()[i].has(variable)) continue;
        std::vector<Expression> factors(parts().begin(), parts().end());
        factors[i] = slope(i);
        terms.push_back(product(factors));
      }
      return sum(terms);
    }
  }
}

Expression Expression::replaced(const std::function<std::optional<Expression>(const Expression&)>& by) const {
  if (const auto other = by(*this)) return *other;
  if (parts().empty()) return *this;
  std::vector<Expression> others;
  for (const Expression& part : parts()) others.push_back(part.replaced(by));
  switch (kind()) {
    case Kind::function:
      return function(name(), others[0]);
    case Kind::power:
      return power(others[0], others[1]);
    case Kind::sum:
      return sum(others);
    default:
      return product(others);
  }
}

Expression Expression::with(std::size_t variable, const Expression& by) const {
  return replaced([&](const Expression& part) -> std::optional<Expression> {
    if (!part.has(variable)) return part;
    if (part.is(Kind::variable)) return by;
    return std::nullopt;
  });
}

Expression Expression::expanded() const {
  using namespace expression_parts;
  const auto times = [](const Expression& a, const Expression& b) {
    std::vector<Expression> terms;
    if (terms_of(a).size() * terms_of(b).size() > most / 4) throw std::length_error("a product has too many terms");
    for (const Expression& left : terms_of(a)) {
      for (const Expression& right : terms_of(b)) terms.push_back(left * right);
    }
    return sum(terms);
  };
  return replaced([&](const Expression& part) -> std::optional<Expression> {
    if (part.is(Kind::product)) {
      Expression all = 1;
      for (const Expression& factor : part.parts()) all = times(all, factor.expanded());
      return all;
    }
    constexpr Whole highest = 12;
    if (part.is(Kind::power) && is_whole(part.parts()[1]) && part.parts()[1].number().above() <= highest &&
        part.parts()[1].number().above() > 0) {
      const Expression base = part.parts()[0].expanded();
      if (!base.is(Kind::sum)) return power(base, part.parts()[1]);
      Expression all = base;
      for (Whole i = 1; i < part.parts()[1].number().above(); ++i) all = times(all, base);
      return all;
    }
    return std::nullopt;
  });
}

Fraction fraction_of(const Expression& e) {
  using namespace expression_parts;
  using Kind = Expression::Kind;
  if (e.is(Kind::power)) {
    const auto [base, exponent] = base_and_exponent(e);
    if (!exponent.is(Kind::number)) return {e, 1};
    const bool below = exponent.number().value() < 0;
    if (!is_whole(exponent)) return below ? Fraction{1, power(base, -exponent)} : Fraction{e, 1};
    const auto [above, under] = fraction_of(base);
    if (below) return {power(under, -exponent), power(above, -exponent)};
    return {power(above, exponent), power(under, exponent)};
  }
  if (e.is(Kind::product)) {
    std::vector<Expression> above, below;
    for (const Expression& factor : e.parts()) {
      const auto [over, under] = fraction_of(factor);
      above.push_back(over);
      below.push_back(under);
    }
    const Expression all = Expression::product(above) / Expression::product(below);
    if (!all.is(Kind::product) && !all.is(Kind::power)) return {all, 1};
    std::vector<Expression> over, under;  // common factors have cancelled
    for (const Expression& factor : factors_of(all)) {
      const auto [base, exponent] = base_and_exponent(factor);
      const bool is_below = exponent.is(Kind::number) && exponent.number().value() < 0;
      (is_below ? under : over).push_back(is_below ? power(base, -exponent) : factor);
    }
    return {Expression::product(over), Expression::product(under)};
  }
  if (!e.is(Kind::sum)) return {e, 1};
  std::vector<Fraction> all;
  std::map<Expression, Expression> common;
  for (const Expression& term : e.parts()) {
    all.push_back(fraction_of(term));
    for (const Expression& factor : factors_of(all.back().below)) {
      const auto [base, exponent] = base_and_exponent(factor);
      if (base.is(Kind::number)) continue;
      const auto [at, is_new] = common.try_emplace(base, exponent);
      if (!is_new && at->second < exponent) at->second = exponent;
    }
  }
  std::vector<Expression> factors, terms;
  for (const auto& [base, exponent] : common) factors.push_back(power(base, exponent));
  const Expression below = Expression::product(factors);
  for (const auto& [above, under] : all) terms.push_back((above * (below / under)).expanded());
  return {Expression::sum(terms), below};
}

std::optional<std::vector<Expression>> coefficients(const Expression& e, std::size_t variable, std::size_t degree) {
  using namespace expression_parts;
  std::vector<std::vector<Expression>> all(1);
  const Expression sum = e.expanded();
  for (const Expression& term : terms_of(sum)) {
    Whole power_of_it = 0;
    std::vector<Expression> others;
    for (const Expression& factor : factors_of(term)) {
      const auto [base, exponent] = base_and_exponent(factor);
      if (!factor.has(variable)) {
        others.push_back(factor);
      } else if (base.is(Expression::Kind::variable) && is_whole(exponent) && exponent.number().above() > 0) {
        power_of_it += exponent.number().above();
      } else {
        return std::nullopt;
      }
    }
    const auto place = static_cast<std::size_t>(power_of_it);
    if (place > degree) return std::nullopt;
    if (place >= all.size()) all.resize(place + 1);
    all[place].push_back(Expression::product(others));
  }
  std::vector<Expression> sums;
  for (const auto& terms : all) sums.push_back(Expression::sum(terms));
  return sums;
}

std::string Expression::text(std::span<const std::string> names, int digits) const {
  using namespace expression_parts;
  const auto bracketed = [&](const Expression& e, bool brackets) {
    const std::string inner = e.text(names, digits);
    return brackets ? "(" + inner + ")" : inner;
  };
  switch (kind()) {
    case Kind::number:
      return text_of(number(), digits);
    case Kind::variable:
      return names[index()];
    case Kind::function:
      return fmt::format("{}({})", name(), parts()[0].text(names, digits));
    case Kind::power: {
      const Expression &base = parts()[0], &exponent = parts()[1];
      if (exponent == Expression(Number(1, 2))) return fmt::format("sqrt({})", base.text(names, digits));
      if (exponent.is(Kind::number) && exponent.number().value() < 0) {
        const Expression below = power(base, -exponent);
        return "1/" + bracketed(below, below.is(Kind::product) || below.is(Kind::sum));
      }
      const bool bare_base =
          base.is(Kind::variable) || base.is(Kind::function) || (is_whole(base) && base.number().value() >= 0);
      const bool bare_exponent = exponent.is(Kind::variable) || exponent.is(Kind::function) || (is_whole(exponent));
      return bracketed(base, !bare_base) + "^" + bracketed(exponent, !bare_exponent);
    }
    case Kind::sum: {
      std::vector<Expression> sorted(parts().begin(), parts().end());
      std::ranges::stable_sort(sorted, std::ranges::greater{}, degree);
      const auto is_minus = [](const Expression& term) { return term_of(term).factor.value() < 0; };
      const auto first = std::ranges::find_if_not(sorted, is_minus);
      if (first != sorted.end()) std::rotate(sorted.begin(), first, first + 1);
      std::string all;
      for (const Expression& term : sorted) {
        const std::string each = term.text(names, digits);
        all += all.empty() ? each : each.starts_with('-') ? " - " + each.substr(1) : " + " + each;
      }
      return all;
    }
    default: {
      Number front = 1;
      std::string above, below;
      int below_count = 0;
      const auto put = [&](std::string& to, const std::string& factor) { to += (to.empty() ? "" : "*") + factor; };
      std::vector<Expression> sorted(parts().begin(), parts().end());
      std::ranges::stable_sort(sorted, std::ranges::greater{}, &Expression::is_constant);
      for (const Expression& factor : sorted) {
        if (factor.is(Kind::number)) {
          front = factor.number();
          continue;
        }
        const auto [base, exponent] = base_and_exponent(factor);
        const bool is_below = exponent.is(Kind::number) && exponent.number().value() < 0;
        const Expression shown = is_below ? power(base, -exponent) : factor;
        put(is_below ? below : above, bracketed(shown, shown.is(Kind::sum) || shown.is(Kind::product)));
        below_count += is_below;
      }
      std::string sign;
      if (front.value() < 0) sign = "-", front = -front;
      if (front.is_exact()) {
        if (front.above() != 1) above = fmt::to_string(front.above()) + (above.empty() ? "" : "*") + above;
        if (front.below() != 1) {
          below = fmt::to_string(front.below()) + (below.empty() ? "" : "*") + below;
          ++below_count;
        }
      } else {
        above = text_of(front, digits) + (above.empty() ? "" : "*") + above;
      }
      if (above.empty()) above = "1";
      if (below.empty()) return sign + above;
      return fmt::format("{}{}/{}", sign, above, below_count > 1 ? "(" + below + ")" : below);
    }
  }
}

}  // namespace contensou::answers
