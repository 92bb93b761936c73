// The kinds of equation, each decided by its own definition: an expression in derivatives that vanishes, or that is a
// constant, at random points.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include "answers/equation/equation.hpp"

namespace contensou::answers {

namespace kinds_of_equation {

using E = Expression;
constexpr std::size_t enough = 100;

/// Returns the sum of the sizes of the terms of a formula, which cancel in its value.
double size_at(const E& e, const std::array<double, 2>& x) {
  double total = 0;
  for (const E& term : terms_of(e)) total += std::abs(term(x));
  return total;
}

}  // namespace kinds_of_equation

std::vector<Eigen::Vector2d> Equation::points(const std::vector<Expression>& formulas, bool quadrant) const {
  using namespace kinds_of_equation;
  std::mt19937 random(7);
  constexpr double least = 0.2, most = 2.6;
  std::uniform_real_distribution<double> size(std::log(least), std::log(most));
  std::vector<Eigen::Vector2d> all;
  constexpr int tries = 1500;
  // Next to the origin and far from it one term hides all others: half of the points are of size 1 there.
  constexpr double usual = 30;
  const auto is_usual = [](double value) {
    return value == 0 || (std::abs(value) > 1 / usual && std::abs(value) < usual);
  };
  const bool of_two_sizes = !is_usual(start[0]) || !is_usual(start[1]);
  for (int i = 0; i < tries && all.size() < enough; ++i) {
    Eigen::Vector2d x;
    for (const Eigen::Index k : {0, 1}) {
      const bool minus = quadrant ? start[k] < 0 : random() % 2 == 0;
      const double unit = start[k] == 0 || (of_two_sizes && i % 2 == 1) ? 1 : std::abs(start[k]);
      x[k] = (minus ? -unit : unit) * std::exp(size(random));
    }
    const auto has_value = [&](const E& e) { return std::isfinite(e({x[0], x[1]})); };
    if (std::ranges::all_of(formulas, has_value)) all.push_back(x);
  }
  return all;
}

bool Equation::vanishes(const Expression& formula, double error) const {
  using namespace kinds_of_equation;
  if (formula.is_zero()) return true;
  const auto at = points({slope, formula});
  constexpr std::size_t fewest = 20;
  return at.size() >= fewest && std::ranges::all_of(at, [&](const Eigen::Vector2d& x) {
           // Numbers that are not exact leave their rounding as a term of its own.
           constexpr double rounding = 1e-3;
           const double size = std::max(size_at(formula, {x[0], x[1]}), rounding * std::abs(slope({x[0], x[1]})));
           return std::abs(formula({x[0], x[1]})) <= error * size;
         });
}

bool Equation::is_free_of(const Expression& formula, std::size_t variable) const {
  return vanishes(formula.derivative(variable)) && vanishes(formula - formula.with(variable, Number(13, 10)));
}

std::vector<Expression> signs_in(const Expression& e) {
  std::vector<Expression> all;
  e.replaced([&](const Expression& part) -> std::optional<Expression> {
    if (is_function(part, "sign") && std::ranges::count(all, part.parts()[0]) == 0) all.push_back(part.parts()[0]);
    return std::nullopt;
  });
  return all;
}

bool jumps_at(const Expression& e, const Expression& z) {
  const auto side = [&](int sign) {
    return e.replaced([&](const Expression& part) {
      return is_function(part, "sign") && part.parts()[0] == z ? std::optional(Expression(sign)) : std::nullopt;
    });
  };
  const Expression above = side(1), below = side(-1), by_x = z.derivative(0), by_y = z.derivative(1);
  // Newton's method goes along the gradient of z to a zero.
  for (Eigen::Vector2d x : {Eigen::Vector2d(0.37, 0.81), {-0.53, 0.29}, {1.31, -0.7}, {-2.1, -1.7}}) {
    constexpr int steps = 20;
    constexpr double zero = 1e-12, error = 1e-9;
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d slope(by_x({x[0], x[1]}), by_y({x[0], x[1]}));
      x -= z({x[0], x[1]}) / slope.squaredNorm() * slope;
    }
    const double here = above({x[0], x[1]}), there = below({x[0], x[1]});
    if (std::abs(z({x[0], x[1]})) <= zero && std::abs(here - there) > error * (std::abs(here) + std::abs(there)))
      return true;
  }
  return false;
}

std::optional<Number> Equation::constant(const Expression& formula) const {
  if (formula.is(Expression::Kind::number)) return formula.number();
  const auto at = points({slope, formula});
  constexpr std::size_t fewest = 20;
  constexpr double error = 1e-9;
  if (at.size() < fewest) return std::nullopt;
  std::vector<double> values;
  for (const auto& x : at) values.push_back(formula({x[0], x[1]}));
  std::ranges::nth_element(values, values.begin() + std::ssize(values) / 2);
  const double value = values[values.size() / 2];
  for (const double each : values) {
    if (!(std::abs(each - value) <= error * std::max(1., std::abs(value)))) return std::nullopt;
  }
  return snapped(value, 10 * error);
}

Number snapped(double value, double error) {
  constexpr long long largest = 60;
  for (long long below = 1; below <= largest; ++below) {
    const double above = std::rint(value * static_cast<double>(below));
    if (std::abs(value * static_cast<double>(below) - above) <= error && std::abs(above) < 1e9) {
      return Number(static_cast<long long>(above), below);
    }
  }
  return Number(value);
}

bool Equation::is_integral(const Expression& H, bool quadrant) const {
  using namespace kinds_of_equation;
  const Expression by_x = H.derivative(0), by_y = H.derivative(1);
  const auto at = points({H, by_x, by_y, f[0], f[1]}, quadrant);
  constexpr double error = 1e-12;
  double largest = 0;
  for (const auto& x : at) {
    const std::array<double, 2> here{x[0], x[1]};
    const double first = f[0](here), second = f[1](here);
    const double size = std::abs(first) * size_at(by_x, here) + std::abs(second) * size_at(by_y, here);
    if (!(std::abs(first * by_x(here) + second * by_y(here)) <= error * size)) return false;
    largest = std::max(largest, std::abs(by_x(here)) + std::abs(by_y(here)));
  }
  return at.size() >= enough && largest > 0;
}

std::optional<Equation> equation_of(const FormulaField& system, const Eigen::Vector2d& start) {
  const auto typed = system.formulas.expressions();
  if (!typed) return std::nullopt;
  const auto& [first, second] = *typed;
  Equation equation{system.equations, {first, second}, 0, system.variables, start};
  if (system.equations == FormulaField::Equations::first) equation.f = {1, first};
  if (system.equations == FormulaField::Equations::second) equation.f = {Expression::variable(1), first};
  if (equation.f[0].is_zero()) return std::nullopt;
  try {
    equation.slope = equation.f[1] / equation.f[0];
  } catch (const std::length_error&) {
    return std::nullopt;
  }
  return equation;
}

std::string scaling_text(const std::string& x, const Number& k, const std::string& y, const Number& m) {
  const auto scaled = [](const std::string& name, const Number& by) {
    const std::string exponent = Expression(by).text({});
    const std::string_view open = by.is_whole() && by.value() > 0 ? "" : "(", close = open.empty() ? "" : ")";
    const std::string power = by == Number(1) ? "" : fmt::format("^{}{}{}", open, exponent, close);
    return by == Number(0) ? "" : fmt::format("{0} -> a{1}*{0}", name, power);
  };
  const std::string first = scaled(x, k), second = scaled(y, m);
  return first + (first.empty() || second.empty() ? "" : ", ") + second;
}

const std::vector<EquationKind>& equation_kinds() {
  static const std::vector<EquationKind> all{
      {"separable", "y' = f(x) g(y)"},
      {"linear", "y' = a(x) y + b(x)"},
      {"Bernoulli", "y' = a(x) y + b(x) y^n with a number n other than 0 and 1"},
      {"Riccati", "y' = a(x) + b(x) y + c(x) y^2, c not 0"},
      {"homogeneous", "y' = f(y/x)"},
      {"isobaric", "the equation stays the same if x is multiplied by a and y by a^m"},
      {"shift along a direction", "y' = f(y - c x) with a number c"},
      {"exact", "dM/dy = dN/dx, where y' = -M/N is one fraction"},
      {"integrating factor of x", "M dx + N dy = 0 becomes exact if it is multiplied by a function of x alone"},
      {"integrating factor of y", "M dx + N dy = 0 becomes exact if it is multiplied by a function of y alone"},
      {"autonomous", "the right side does not contain x; for x'' = f(x, x') it does not contain the time"},
      {"conservative", "x'' = f(x): the energy is constant"},
      {"linear of the second order", "x'' = a x + b x' + c with numbers a, b and c"},
      {"linear system", "x' and y' are linear functions of x and y"},
      {"Hamiltonian", "x' = dH/dy and y' = -dH/dx: the divergence is 0"},
      {"gradient", "x' = dP/dx and y' = dP/dy: the curl is 0"},
      {"rotation", "the equation stays the same if the plane is turned about the origin"},
      {"Darboux", "the inverse integrating factor V is a product of curves that consist of orbits"},
  };
  return all;
}

std::vector<std::string> kinds_of(const Equation& equation) {
  using namespace kinds_of_equation;
  using Type = FormulaField::Equations;
  const Type type = equation.type;
  const auto& f = equation.f;
  const auto& names = equation.names;
  const E& R = equation.slope;
  const E x = E::variable(0), y = E::variable(1);
  std::vector<std::string> kinds;
  // A formula that becomes too long leaves its kind undecided, so the kind is not listed.
  const auto holds = [](const std::function<bool()>& condition) {
    try {
      return condition();
    } catch (const std::length_error&) {
      return false;
    }
  };
  const auto add = [&](const std::string& name, const std::function<bool()>& condition) {
    const bool found = holds(condition);
    if (found) kinds.push_back(name);
    return found;
  };
  const auto vanishes = [&](const E& e) { return equation.vanishes(e); };
  const bool first = type == Type::first, second = type == Type::second;
  // At a jump, the part of f across it must be continuous, or the part along it.
  const auto continues = [&](bool across) {
    for (const E& each : f) {
      for (const E& z : signs_in(each)) {
        const E by_u = z.derivative(0), by_v = z.derivative(1);
        if (jumps_at(across ? f[0] * by_u + f[1] * by_v : f[0] * by_v - f[1] * by_u, z)) return false;
      }
    }
    return true;
  };
  const auto is_linear = [&](const E& e) {
    const E at_origin = e.with(0, 0).with(1, 0), by_x = e.with(0, 1).with(1, 0), by_y = e.with(0, 0).with(1, 1);
    return vanishes(e - at_origin - (by_x - at_origin) * x - (by_y - at_origin) * y);
  };
  if (second) {
    kinds.emplace_back("autonomous");
    add("conservative", [&] { return equation.is_free_of(f[1], 1); });
    add("linear of the second order", [&] { return is_linear(f[1]); });
  }
  if (type == Type::system) {
    add("linear system", [&] { return is_linear(f[0]) && is_linear(f[1]); });
    add("conservative", [&] { return f[0] == y && equation.is_free_of(f[1], 1); });
    add("Hamiltonian", [&] { return vanishes(f[0].derivative(0) + f[1].derivative(1)) && continues(true); });
    add("gradient", [&] { return vanishes(f[0].derivative(1) - f[1].derivative(0)) && continues(false); });
  }
  if (second) add("Hamiltonian", [&] { return equation.is_free_of(f[1], 1); });
  // The equation of the orbits is not the typed one, except for y' = F(x, y). For a system its kinds are named as those
  // of the orbits; for x'' = F only its symmetries are listed.
  const std::string of = type == Type::system ? std::string(of_orbits) : "";
  const auto name_kind = [&](const std::string& name) { kinds.push_back(of + name); };
  const auto add_kind = [&](const std::string& name, const std::function<bool()>& condition) {
    return add(of + name, condition);
  };
  if (R.is_zero()) {
    for (const char* const name : {"separable", "linear"}) {
      if (!second) name_kind(name);
    }
    return kinds;
  }
  add_kind("rotation", [&] { return vanishes(x * R.derivative(1) - y * R.derivative(0) - 1 - R * R); });
  const E by_x = R.derivative(0), by_y = R.derivative(1);
  if (first) add("autonomous", [&] { return equation.is_free_of(R, 0); });
  if (!second) add_kind("separable", [&] { return vanishes(R * by_y.derivative(0) - by_x * by_y); });
  // A polynomial of a degree below n is determined by n values. Derivatives alone do not see kinks, as of |y|.
  const auto is_polynomial = [&](const std::vector<int>& at) {
    std::vector<E> terms{R};
    for (const int i : at) {
      E term = -R.with(1, i);
      for (const int k : at) term = k == i ? term : term * (y - k) / (i - k);
      terms.push_back(term);
    }
    return vanishes(E::sum(terms));
  };
  const bool linear = second || add_kind("linear", [&] {
                        return vanishes(by_y.derivative(1)) && is_polynomial({1, -2});
                      });
  if (!linear) {
    std::optional<Number> n;
    holds([&] {
      const E W = y * by_y - R;
      if (!vanishes(W)) n = equation.constant(y * W.derivative(1) / W);
      if (n && !(*n == Number(1))) {
        const E rest = (R - W / (E(*n) - 1)) / y;
        if (!vanishes(rest - rest.with(1, 1))) n.reset();
      }
      return true;
    });
    if (n && !(*n == Number(1)) && !(*n == Number(0))) name_kind(fmt::format("Bernoulli (n = {})", E(*n).text({}, 6)));
    add_kind("Riccati", [&] { return vanishes(by_y.derivative(1).derivative(1)) && is_polynomial({1, -1, 2}); });
  }
  // Derivatives do not see jumps, so that finite maps are tried, too.
  const auto maps = [&](const std::array<double, 2>& factors, const std::array<double, 2>& shifts, double factor) {
    constexpr double error = 1e-9;
    return std::ranges::all_of(equation.points({R}), [&](const Eigen::Vector2d& at) {
      const double here = R({at[0], at[1]}),
                   there = R({factors[0] * at[0] + shifts[0], factors[1] * at[1] + shifts[1]});
      return !std::isfinite(there) || std::abs(there - factor * here) <= error * (std::abs(there) + std::abs(here));
    });
  };
  const bool homogeneous = !second && add_kind("homogeneous", [&] {
    return vanishes(x * by_x + y * by_y) && maps({2, 2}, {0, 0}, 1);
  });
  if (!homogeneous) {
    std::optional<Number> m;
    holds([&] {
      const E below = R - y * by_y;
      if (!vanishes(below)) m = equation.constant((R + x * by_x) / below);
      return true;
    });
    if (m && maps({2, std::exp2(m->value())}, {0, 0}, std::exp2(m->value() - 1))) {
      name_kind(fmt::format("isobaric ({})", scaling_text(names[0], 1, names[1], *m)));
    }
  }
  std::optional<Number> c;
  holds([&] {
    if (!vanishes(by_y)) c = equation.constant(-by_x / by_y);
    return true;
  });
  if (c && !(*c == Number(0)) && maps({1, 1}, {1, c->value()}, 1)) {
    name_kind(fmt::format("shift along a direction (1, {})", E(*c).text({}, 6)));
  }
  if (second) return kinds;
  holds([&] {
    const auto [above, below] = fraction_of(R);
    const E M = first ? -above : f[1], N = first ? below : -f[0];
    const E curl = M.derivative(1) - N.derivative(0);
    if (vanishes(curl)) {
      const bool jumps = std::ranges::any_of(
          signs_in(R), [&](const E& z) { return jumps_at(M * z.derivative(1) - N * z.derivative(0), z); });
      if (first && !jumps) kinds.emplace_back("exact");
      return true;
    }
    const E of_x = curl / N, of_y = curl / M;
    if (equation.is_free_of(of_x, 1)) name_kind("integrating factor of " + names[0]);
    if (equation.is_free_of(of_y, 0)) name_kind("integrating factor of " + names[1]);
    return true;
  });
  return kinds;
}

}  // namespace contensou::answers
