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

Eigen::Vector2d Equation::quadrant() const {
  constexpr double soon = 1e-3;
  const auto rate = [&](const Eigen::Vector2d& x) { return Eigen::Vector2d(f[0]({x[0], x[1]}), f[1]({x[0], x[1]})); };
  const Eigen::Vector2d after = soon * rate(start + soon / 2 * rate(start));
  Eigen::Vector2d x = start;
  for (const Eigen::Index k : {0, 1}) {
    if (x[k] == 0 && std::isfinite(after[k])) x[k] = after[k];
  }
  return x;
}

std::optional<Sides> Equation::largest(const std::function<bool(const Sides&)>& holds) {
  for (const Sides& within : {Sides{false, false}, {true, false}, {false, true}, {true, true}}) {
    if (holds(within)) return within;
  }
  return std::nullopt;
}

std::string Equation::text_of(const Sides& within) const {
  const Eigen::Vector2d inside = quadrant();
  std::string text;
  for (const std::size_t k : {0U, 1U}) {
    if (!within[k]) continue;
    text += fmt::format("{}{} {} 0", text.empty() ? "" : ", ", names[k],
                        inside[static_cast<Eigen::Index>(k)] < 0 ? "<" : ">");
  }
  return text;
}

bool Equation::contains(const Sides& within, const Eigen::Vector2d& x) const {
  const Eigen::Vector2d inside = quadrant();
  return (!within[0] || x[0] * inside[0] > 0) && (!within[1] || x[1] * inside[1] > 0);
}

std::vector<Eigen::Vector2d> Equation::points(const std::vector<Expression>& formulas, const Sides& within) const {
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
  const Eigen::Vector2d inside = quadrant();
  const auto have_values = [&](const Eigen::Vector2d& x) {
    return std::ranges::all_of(formulas, [&](const E& e) { return std::isfinite(e({x[0], x[1]})); });
  };
  for (int i = 0; i < tries && all.size() < enough; ++i) {
    Eigen::Vector2d x;
    for (const Eigen::Index k : {0, 1}) {
      const bool minus = within[static_cast<std::size_t>(k)] ? inside[k] < 0 : random() % 2 == 0;
      const double unit = start[k] == 0 || (of_two_sizes && i % 2 == 1) ? 1 : std::abs(start[k]);
      x[k] = (minus ? -unit : unit) * std::exp(size(random));
    }
    if (have_values(x)) all.push_back(x);
  }
  for (const Eigen::Vector2d& x : beside_kinks) {
    if (contains(within, x) && have_values(x)) all.push_back(x);
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

namespace kinds_of_equation {

/// Returns the arguments of all parts of a formula that are one of the functions.
std::vector<Expression> arguments_in(const Expression& e, std::initializer_list<std::string_view> functions) {
  std::vector<Expression> all;
  e.replaced([&](const Expression& part) -> std::optional<Expression> {
    for (const std::string_view name : functions) {
      if (is_function(part, name) && std::ranges::count(all, part.parts()[0]) == 0) all.push_back(part.parts()[0]);
    }
    return std::nullopt;
  });
  return all;
}

}  // namespace kinds_of_equation

Continuations continuations_of(const Expression& e, const Expression& z) {
  const auto side = [&](int sign) {
    return e.replaced([&](const Expression& part) -> std::optional<Expression> {
      if (part.parts().empty() || !(part.parts()[0] == z)) return std::nullopt;
      if (is_function(part, "sign")) return Expression(sign);
      return is_function(part, "abs") ? std::optional(sign * z) : std::nullopt;
    });
  };
  return {side(1), side(-1)};
}

std::vector<Expression> borders_in(const Expression& e) { return kinds_of_equation::arguments_in(e, {"sign", "abs"}); }

std::vector<Expression> signs_in(const Expression& e) { return kinds_of_equation::arguments_in(e, {"sign"}); }

namespace kinds_of_equation {

/// Returns points with z = 0, found by Newton's method along the gradient of z.
std::vector<Eigen::Vector2d> zeros_of(const Expression& z) {
  const Expression by_x = z.derivative(0), by_y = z.derivative(1);
  std::vector<Eigen::Vector2d> all;
  for (Eigen::Vector2d x : {Eigen::Vector2d(0.37, 0.81), {-0.53, 0.29}, {1.31, -0.7}, {-2.1, -1.7}}) {
    constexpr int steps = 20;
    constexpr double zero = 1e-12;
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d slope(by_x({x[0], x[1]}), by_y({x[0], x[1]}));
      x -= z({x[0], x[1]}) / slope.squaredNorm() * slope;
    }
    const double size = 1 + std::abs(x[0] * by_x({x[0], x[1]})) + std::abs(x[1] * by_y({x[0], x[1]}));
    if (std::abs(z({x[0], x[1]})) <= zero * size) all.push_back(x);
  }
  return all;
}

/// Returns points on both sides of places where e jumps or has a kink.
std::vector<Eigen::Vector2d> beside_kinks_of(const Expression& e) {
  constexpr double near = 1e-3;
  std::vector<Eigen::Vector2d> all;
  for (const Expression& z : borders_in(e)) {
    const Expression by_x = z.derivative(0), by_y = z.derivative(1);
    for (const Eigen::Vector2d& x : zeros_of(z)) {
      const Eigen::Vector2d across = Eigen::Vector2d(by_x({x[0], x[1]}), by_y({x[0], x[1]})).stableNormalized();
      for (const double side : {-near, near}) all.emplace_back(x + side * (1 + x.stableNorm()) * across);
    }
  }
  return all;
}

}  // namespace kinds_of_equation

std::vector<Eigen::Vector2d> jumps_at(const Expression& e, const Expression& z) {
  const Continuations sides = continuations_of(e, z);
  std::vector<Eigen::Vector2d> all = kinds_of_equation::zeros_of(z);
  std::erase_if(all, [&](const Eigen::Vector2d& x) {
    constexpr double error = 1e-9;
    const double here = sides.above({x[0], x[1]}), there = sides.below({x[0], x[1]});
    return !(std::abs(here - there) > error * (std::abs(here) + std::abs(there)));
  });
  return all;
}

bool keeps_jumps(const Expression& e, const std::array<Expression, 2>& X) {
  constexpr double zero = 1e-9;
  return std::ranges::all_of(signs_in(e), [&](const Expression& z) {
    const Expression by_x = z.derivative(0), by_y = z.derivative(1);
    return std::ranges::all_of(jumps_at(e, z), [&](const Eigen::Vector2d& at) {
      const std::array<double, 2> x{at[0], at[1]};
      const double along_x = X[0](x) * by_x(x), along_y = X[1](x) * by_y(x);
      return std::abs(along_x + along_y) <= zero * (std::abs(along_x) + std::abs(along_y));
    });
  });
}

bool Equation::is_separable() const {
  using namespace kinds_of_equation;
  const Expression& R = slope;
  if (!vanishes(R * R.derivative(0).derivative(1) - R.derivative(0) * R.derivative(1))) return false;
  // On both sides of a jump or kink, R must be the same function of y times functions of x, or the reverse.
  return std::ranges::all_of(borders_in(R), [&](const Expression& z) {
    const auto [above, below] = continuations_of(R, z);
    if (vanishes(above - below)) return true;
    if (z.has(0) && z.has(1)) return false;
    const Expression ratio = above.is_zero() || below.is_zero() ? Expression(1) : above / below;
    return is_free_of(ratio, z.has(0) ? 1 : 0);
  });
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

Expression exact(double value) {
  const Number fraction = snapped(value, 1e-13 * (1 + std::abs(value)));
  if (fraction.is_exact()) return fraction;
  constexpr int most_below = 12, most_whole = 6;
  constexpr double most_square = 100, rounding = 4e-15;
  for (int below = 1; below <= most_below; ++below) {
    for (int i = 0; i <= 2 * most_whole; ++i) {
      const int whole = i % 2 == 0 ? -i / 2 : (i + 1) / 2;
      const double rest = value * below - whole, square = std::rint(rest * rest);
      if (square < 2 || square > most_square) continue;
      if (!(std::abs(rest * rest - square) <= rounding * (square + whole * whole + std::abs(rest)))) continue;
      const Expression root = power(Expression(Number(static_cast<long long>(square))), Number(1, 2));
      return (whole + (rest < 0 ? -root : root)) / below;
    }
  }
  return Number::inexact(value);
}

bool Equation::is_integral(const Expression& H, const Sides& within) const {
  using namespace kinds_of_equation;
  const Expression by_x = H.derivative(0), by_y = H.derivative(1);
  const auto at = points({H, by_x, by_y, f[0], f[1]}, within);
  constexpr double error = 1e-12, least = 1e-9;
  bool changes = false;  // rounding alone leaves a gradient
  for (const auto& x : at) {
    const std::array<double, 2> here{x[0], x[1]};
    const double first = f[0](here), second = f[1](here);
    const double size_x = size_at(by_x, here), size_y = size_at(by_y, here);
    const double size = std::abs(first) * size_x + std::abs(second) * size_y;
    if (!(std::abs(first * by_x(here) + second * by_y(here)) <= error * size)) return false;
    changes |= std::abs(by_x(here)) > least * size_x || std::abs(by_y(here)) > least * size_y;
  }
  return at.size() >= enough && changes && std::ranges::none_of(signs_in(H), [&](const Expression& z) {
           const Continuations rate = continuations_of(f[0] * z.derivative(0) + f[1] * z.derivative(1), z);
           return std::ranges::any_of(jumps_at(H, z), [&](const Eigen::Vector2d& x) {
             return contains(within, x) && rate.above({x[0], x[1]}) * rate.below({x[0], x[1]}) > 0;
           });
         });
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
  equation.beside_kinks = kinds_of_equation::beside_kinks_of(equation.slope);
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
        if (!jumps_at(across ? f[0] * by_u + f[1] * by_v : f[0] * by_v - f[1] * by_u, z).empty()) return false;
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
  // A turn of x and x' maps motions of x'' = F to motions only if x'' = -x.
  add_kind("rotation", [&] {
    if (second) return vanishes(f[1] + x);
    return vanishes(x * R.derivative(1) - y * R.derivative(0) - 1 - R * R) && keeps_jumps(R, {-y, x});
  });
  const E by_x = R.derivative(0), by_y = R.derivative(1);
  if (first) add("autonomous", [&] { return equation.is_free_of(R, 0); });
  if (!second) add_kind("separable", [&] { return equation.is_separable(); });
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
        // y = 0 separates equations with y^n
        if (!vanishes(rest - rest.with(1, 1)) || !keeps_jumps(W, {0, y})) n.reset();
      }
      return true;
    });
    if (n && !(*n == Number(1)) && !(*n == Number(0))) name_kind(fmt::format("Bernoulli (n = {})", E(*n).text({}, 6)));
    add_kind("Riccati", [&] { return vanishes(by_y.derivative(1).derivative(1)) && is_polynomial({1, -1, 2}); });
  }
  // Derivatives do not see jumps, so that finite maps are tried, too, also beside the jumps.
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
    // At a jump the part of (M, N) along it must be continuous. A factor of (M, N) may jump with the integrating
    // factor.
    const auto jumps = [&](const E& along_x, const E& along_y) {
      return std::ranges::any_of(signs_in(R), [&](const E& z) {
        return !jumps_at(along_x * z.derivative(1) - along_y * z.derivative(0), z).empty();
      });
    };
    if (vanishes(curl)) {
      if (first && !jumps(M, N)) kinds.emplace_back("exact");
      return true;
    }
    if (jumps(M, N) && jumps(-R, 1) && jumps(-1, 1 / R)) return false;
    const E of_x = curl / N, of_y = curl / M;
    if (equation.is_free_of(of_x, 1)) name_kind("integrating factor of " + names[0]);
    if (equation.is_free_of(of_y, 0)) name_kind("integrating factor of " + names[1]);
    return true;
  });
  return kinds;
}

}  // namespace contensou::answers
