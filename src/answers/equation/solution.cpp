#include "answers/equation/equation.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/LU>

namespace contensou::answers {

namespace solution_formulas {

using E = Expression;
using Kind = E::Kind;
using Maybe = std::optional<Expression>;

const E x = E::variable(0), y = E::variable(1), q = E::variable(2), p = E::variable(3);

E ln(const E& e) { return E::function("ln", E::function("abs", e)); }

/// Returns the formula with each |z|^n, n whole, replaced by z^n. Both differ by a sign between the zeros of z.
E without_sizes(const E& e) {
  return e.replaced([](const E& part) -> Maybe {
    const auto [base, exponent] = base_and_exponent(part);
    if (!is_function(base, "abs") || !is_whole(exponent)) return std::nullopt;
    return power(base.parts()[0], exponent);
  });
}

/// Returns the formula with each |z| replaced by z or -z, as at a point. They are equal up to the next zero of z.
E with_signs_at(const E& e, const Eigen::Vector2d& point) {
  return e.replaced([&](const E& part) -> Maybe {
    if (!is_function(part, "abs")) return std::nullopt;
    const E& inner = part.parts()[0];
    return inner({point[0], point[1]}) < 0 ? -inner : inner;
  });
}

/// Joins the factors a^k b^k with the same fraction k.
E joined(const E& e) {
  std::vector<E> factors(factors_of(e).begin(), factors_of(e).end());
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto [base, exponent] = base_and_exponent(factors[i]);
    if (!exponent.is(Kind::number) || exponent.number().is_whole()) continue;
    for (std::size_t k = factors.size(); --k > i;) {
      const auto [other, same] = base_and_exponent(factors[k]);
      if (!(same == exponent)) continue;
      factors[i] = power((base_and_exponent(factors[i]).first * other).expanded(), exponent);
      factors.erase(factors.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  return E::product(factors);
}

/// Returns the formula with the logarithms of products, powers and fractions as sums.
E with_sums_of_logarithms(const E& e) {
  return e.replaced([](const E& part) -> Maybe {
    if (!is_function(part, "ln")) return std::nullopt;
    const E& z = part.parts()[0];
    const E inner = is_function(z, "abs") ? z.parts()[0] : z;
    const auto [above, below] = fraction_of(inner);
    std::vector<E> terms;
    for (const auto& [side, sign] : {std::pair(above, 1), std::pair(below, -1)}) {
      for (const E& factor : factors_of(side)) {
        if (factor.is_constant()) continue;
        const auto [base, exponent] = base_and_exponent(factor);
        if (exponent.is(Kind::number)) {
          terms.push_back(sign * exponent * ln(base));
        } else {
          terms.push_back(sign * ln(factor));
        }
      }
    }
    return E::sum(terms);
  });
}

/// Splits R = X(x) Y(y) into its factors.
std::optional<std::array<E, 2>> separated(const Equation& equation) {
  for (const E& R : {equation.slope, tidied(equation.slope)}) {
    std::vector<E> factors, of_x, of_y;
    for (const E& each : factors_of(R)) {
      if (is_function(each, "exp")) {
        const E exponent = each.parts()[0].expanded();
        for (const E& term : terms_of(exponent)) factors.push_back(E::function("exp", term));
      } else {
        factors.push_back(each);
      }
    }
    for (const E& each : factors) (each.has(1) ? of_y : of_x).push_back(each);
    const bool mixed = std::ranges::any_of(of_y, [](const E& each) { return each.has(0); });
    if (!mixed) return {{E::product(of_x), E::product(of_y)}};
  }
  const E& R = equation.slope;
  if (!equation.is_separable()) return std::nullopt;
  for (const Number& a : {Number(0), Number(1), Number(2), Number(1, 2), Number(-1)}) {
    for (const Number& b : {Number(0), Number(1), Number(2), Number(1, 2), Number(-1)}) {
      const E corner = R.with(0, a).with(1, b);
      const double value = corner({});
      if (!std::isfinite(value) || value == 0) continue;
      return {{tidied(R.with(1, b) / corner), tidied(R.with(0, a))}};
    }
  }
  return std::nullopt;
}

/// Returns H of a separable equation.
Maybe of_separable(const Equation& equation) {
  const auto parts = separated(equation);
  if (!parts) return std::nullopt;
  const Maybe of_y = antiderivative(tidied(1 / (*parts)[1]), 1);
  const Maybe of_x = of_y ? antiderivative(tidied((*parts)[0]), 0) : of_y;
  return of_x ? Maybe(*of_y - *of_x) : of_x;
}

/// The integrating factor m of a linear equation z' = a z + b, and m b: (m z)' = m b.
struct Multiplied {
  E factor, rest;
};
std::optional<Multiplied> multiplied(const Equation& equation, const E& a, const E& b, std::size_t variable) {
  const Maybe A = antiderivative(tidied(a), variable);
  if (!A) return std::nullopt;
  const E sized = E::function("exp", -*A), m = without_sizes(sized);
  if (b.is_zero() || antiderivative(tidied(b * m), variable)) return {{m, tidied(b * m)}};
  // |x - 1|^(1/2) |x + 1|^(1/2) is the root of a quadratic, with the sign that it has next to the start
  const E root = joined(with_signs_at(sized, equation.start));
  return {{root, tidied(joined(b * root))}};
}

Maybe of_linear(const Equation& equation, const E& a, const E& b, const E& z, std::size_t variable) {
  const auto found = multiplied(equation, a, b, variable);
  if (!found) return std::nullopt;
  const Maybe rest = antiderivative(found->rest, variable);
  return rest ? Maybe(z * found->factor - *rest) : rest;
}

/// A linear equation dz/ds = a z + b that an equation of y becomes with z = y^k.
struct Linear {
  E a, b, k;
};
/// Returns the linear equation of an equation dz/ds = R that is linear in z or of Bernoulli's kind.
std::optional<Linear> linear_form(const Equation& equation, const E& R, std::size_t z) {
  const E at = E::variable(z), by = R.derivative(z);
  const auto along = [&](const E& rate) { return std::array<E, 2>{z == 0 ? rate : E(0), z == 1 ? rate : E(0)}; };
  if (equation.vanishes(by.derivative(z))) {
    if (!keeps_jumps(R, along(1)) || !keeps_jumps(by, along(1))) return std::nullopt;
    const E a = tidied(by.with(z, 0)), b = tidied(R.with(z, 0));
    // A formula without a value at z = 0 is expanded first.
    if (std::isfinite(a({0.37, 0.59})) && !a.has(z)) return {{a, b, 1}};
    const auto all = coefficients(R, z, 1);
    if (!all || all->size() != 2) return std::nullopt;
    return {{(*all)[1], (*all)[0], 1}};
  }
  const E W = at * by - R;
  const auto n = equation.constant(at * W.derivative(z) / W);
  if (!n || *n == Number(1) || *n == Number(0) || !keeps_jumps(R, along(at)) || !keeps_jumps(by, along(at)))
    return std::nullopt;
  // z = 1 or -1, on the side of the start; |z|^n of other n is that of z = 1
  const bool minus = n->is_whole() && equation.quadrant()[static_cast<Eigen::Index>(z)] < 0;
  const E one = minus ? -1 : 1, raised = minus ? power(one, *n) : 1;
  const E b = tidied(W.with(z, one) / (raised * (E(*n) - 1))), a = tidied((R.with(z, one) - b * raised) / one);
  const E k = 1 - E(*n);
  return {{k * a, k * b, k}};
}

/// Returns H of an equation dz/ds = R that is linear in z or of Bernoulli's kind; s and z are the variables' indices.
Maybe of_bernoulli(const Equation& equation, const E& R, std::size_t s, std::size_t z) {
  const auto form = linear_form(equation, R, z);
  return form ? of_linear(equation, form->a, form->b, power(E::variable(z), form->k), s) : std::nullopt;
}

/// Returns H of an equation that is separable after y = x^m z.
Maybe of_powers(const Equation& equation, const Number& m) {
  const E raised = power(x, m);
  const E T = tidied((equation.slope.with(1, raised * y) / raised - m * y / x).expanded());
  const Equation other{FormulaField::Equations::first,
                       {1, T},
                       T,
                       equation.names,
                       {equation.start[0], equation.start[1] / raised({equation.start[0]})}};
  const Maybe H = of_separable(other);
  return H ? Maybe(H->with(1, y / raised)) : H;
}

/// Returns H of an equation that is linear or of Bernoulli's kind in z = tan(y), exp(y) or ln(y).
Maybe of_function(const Equation& equation, std::string_view name) {
  bool occurs = false;
  const bool of_tan = name == "tan";
  const auto is_at = [](const E& part, std::string_view of) { return is_function(part, of) && part.parts()[0] == y; };
  const E marked = equation.slope.replaced([&](const E& part) -> Maybe {
    occurs |= is_at(part, name) || (of_tan && (is_at(part, "sin") || is_at(part, "cos")));
    if (is_at(part, "sin") && of_tan) return E::function("tan", y) * E::function("cos", y);
    return std::nullopt;
  });
  if (!occurs) return std::nullopt;
  const E z = E::function(name, y);
  E T = of_tan ? (marked / power(E::function("cos", y), 2)).expanded() : marked * z.derivative(1);
  T = T.replaced([&](const E& part) -> Maybe {
    const auto [base, exponent] = base_and_exponent(part);
    if (is_at(part, name)) return y;
    if (of_tan && is_at(base, "cos") && is_whole(exponent / 2)) {
      return power(1 + y * y, -exponent / 2);
    }
    if (part == y && !of_tan) return name == "exp" ? E::function("ln", y) : E::function("exp", y);
    return std::nullopt;
  });
  T = tidied(T);
  const Equation other{
      FormulaField::Equations::first, {1, T}, T, equation.names, {equation.start[0], z({0, equation.start[1]})}};
  const Maybe H = of_bernoulli(other, T, 0, 1);
  return H ? Maybe(H->with(1, z)) : H;
}

/// Returns H with dH = (M dx + N dy), a closed form.
Maybe of_closed(const E& M, const E& N) {
  const auto attempt = [](const E& first, std::size_t a, const E& second, std::size_t b) -> Maybe {
    const Maybe part = antiderivative(first, a);
    if (!part) return part;
    const E rest = tidied(second - part->derivative(b));
    if (rest.has(a)) return std::nullopt;
    const Maybe other = antiderivative(rest, b);
    return other ? Maybe(*part + *other) : other;
  };
  if (Maybe found = attempt(M, 0, N, 1)) return found;
  return attempt(N, 1, M, 0);
}

/// Returns H of Riccati's equation y' = a + b y + c y^2, of which y = u(x) is a solution: with y = u + 1/z, z is
/// linear.
Maybe of_riccati(const Equation& equation, const E& b, const E& c, const E& u) {
  return of_linear(equation, -(2 * c * u + b), -c, 1 / (y - u), 0);
}

/// Returns functions that are tried as solutions of Riccati's equation, without their factor.
std::vector<E> candidates(const std::vector<E>& coefficients_) {
  std::vector<E> all{1};
  for (const Number& k : {Number(1), Number(-1), Number(2), Number(-2), Number(1, 2), Number(-1, 2), Number(3)}) {
    all.push_back(power(x, k));
  }
  for (const E& each : coefficients_) {
    if (each.is_zero() || !each.has(0)) continue;
    for (const E& term : terms_of(each)) all.push_back(term_of(term).rest);
  }
  for (const auto* name : {"exp", "sin", "cos", "tan", "ln"}) {
    const bool occurs = std::ranges::any_of(coefficients_, [&](const E& each) {
      bool found = false;
      each.replaced([&](const E& part) -> Maybe {
        found |= part.is(Kind::function) && (part.name() == name || part.name() == "sin" || part.name() == "cos");
        return std::nullopt;
      });
      return found;
    });
    if (!occurs) continue;
    all.push_back(E::function(name, x));
    all.push_back(1 / E::function(name, x));
  }
  return all;
}

/// Returns Riccati solutions u = r g(x) + s h(x) with numbers r and s and functions g, h.
Maybe particular(const Equation& equation, const std::array<E, 3>& of) {
  const E &a = of[0], &b = of[1], &c = of[2];
  std::vector<E> all = candidates({a, b, c});
  constexpr std::size_t most = 16;
  if (all.size() > most) all.erase(all.begin() + most, all.end());
  const auto is_solution = [&](const E& u) {
    return equation.vanishes(u.derivative(0) - a - b * u - c * u * u, 1e-11);
  };
  constexpr double at[]{0.83, 1.31};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const E& g = all[i];
    // c g^2 r^2 + (b g - g') r + a = 0 at one x
    const double here[]{at[0], 0};
    const double two = (c * g * g)(here), one = (b * g - g.derivative(0))(here), none = a(here);
    const double D = one * one - 4 * two * none;
    if (!(D >= 0) || two == 0) continue;
    for (const double sign : {1., -1.}) {
      const double r = (-one + sign * std::sqrt(D)) / (2 * two), next[]{at[1], 0};
      if (std::abs((a + (b * g - g.derivative(0)) * E(Number(r)) + c * g * g * E(Number(r * r)))(next)) > 1e-9)
        continue;
      const Number factor = snapped(r);
      if (is_solution(factor * g)) return factor * g;
    }
  }
  // Two functions: Newton's method for r and s at two x, from a few starts.
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i + 1; k < all.size(); ++k) {
      const E &g = all[i], &h = all[k];
      for (const double start : {1., -1., 2.5}) {
        Eigen::Vector2d r(start, -0.7 * start + 0.4);
        bool converged = false;
        for (int step = 0; step < 25 && r.allFinite(); ++step) {
          Eigen::Vector2d misfit;
          Eigen::Matrix2d slopes;
          for (int row = 0; row < 2; ++row) {
            const double here[]{at[row], 0};
            const double gv = g(here), hv = h(here), u = r[0] * gv + r[1] * hv, B = b(here), C = c(here);
            const double dg = g.derivative(0)(here), dh = h.derivative(0)(here);
            misfit[row] = a(here) + B * u + C * u * u - r[0] * dg - r[1] * dh;
            slopes.row(row) << (B + 2 * C * u) * gv - dg, (B + 2 * C * u) * hv - dh;
          }
          if (misfit.norm() < 1e-13) {
            converged = true;
            break;
          }
          r -= slopes.inverse() * misfit;
        }
        if (!converged) continue;
        const Eigen::Vector2d twelfths = (r * 12).array().rint();
        if (!((r * 12 - twelfths).norm() < 1e-9) || r.norm() > 100) continue;
        const E u =
            Number(static_cast<long long>(twelfths[0]), 12) * g + Number(static_cast<long long>(twelfths[1]), 12) * h;
        if (is_solution(u)) return u;
      }
    }
  }
  return std::nullopt;
}

/// Returns the generator as text, such as "x d/dx + 2 y d/dy".
std::string field_text(const std::array<E, 2>& X, const std::vector<std::string>& names) {
  std::string text;
  for (const std::size_t i : {0U, 1U}) {
    if (X[i].is_zero()) continue;
    std::string factor = X[i].text(names);
    if (X[i].is(Kind::sum)) factor = fmt::format("({})", factor);
    const bool minus = factor.starts_with('-');
    if (minus) factor.erase(0, 1);
    text += text.empty() ? (minus ? "-" : "") : minus ? " - " : " + ";
    text += (factor == "1" ? "" : factor + " ") + "d/d" + names[i];
  }
  return text;
}

/// Returns true if a formula in q, after q is replaced, equals dq/dp along orbits in a part of the plane.
bool agrees(const Equation& equation, const Coordinates& c, const Sides& within) {
  const auto rate = [&](const E& e) { return e.derivative(0) + equation.slope * e.derivative(1); };
  const E of_q = rate(c.q), of_p = rate(c.p);
  const E& left = c.dq_dp ? c.q : c.p;
  const E right = c.dq_dp ? c.dq_dp->with(2, c.q) * of_p : c.dp_dq->with(2, c.q) * of_q;
  const E by_x = left.derivative(0), by_y = equation.slope * left.derivative(1), difference = by_x + by_y - right;
  const auto at = equation.points({equation.slope, of_q, of_p, difference}, within);
  constexpr std::size_t fewest = 20;
  return at.size() >= fewest && std::ranges::all_of(at, [&](const Eigen::Vector2d& point) {
           const double here[]{point[0], point[1]};
           const double size = std::abs(by_x(here)) + std::abs(by_y(here)) + std::abs(right(here));
           return std::abs(difference(here)) <= 1e-9 * size;
         });
}

/// Returns H as a sum of logarithms of the curves of V, arcs of tangents and a rational function whose denominator
/// consists of multiple curves. The numbers in the sum are those of a null vector of f . grad H, snapped to fractions.
Maybe of_curves(const Equation& equation, const E& V) {
  const auto& f = equation.f;
  std::vector<E> functions;
  E outside = 1;
  const E above = fraction_of(V).above;
  for (const E& factor : factors_of(above)) {
    const auto [curve, times] = base_and_exponent(factor);
    if (curve.is_constant()) continue;
    const auto by_x = coefficients(curve, 0, 2), by_y = coefficients(curve, 1);
    if (!by_y || !coefficients(curve, 0) || !times.is(Kind::number)) return std::nullopt;
    functions.push_back(ln(curve));
    outside = outside * power(curve, times - 1);
    if (!by_x || by_x->size() != 3) continue;
    // a x^2 + b x + c with b^2 < 4 a c is not zero, and has an angle
    const E a = (*by_x)[2], b = (*by_x)[1], D = tidied((4 * a * (*by_x)[0] - b * b) / (y * y));
    if (D.is(Kind::number) && D.number().value() > 0) {
      const E root = power(D, Number(1, 2));
      functions.push_back(E::function("atan", (2 * a * x + b) / (root * y)) / root);
    }
  }
  constexpr int degree = 3;
  for (int i = 0; i <= degree; ++i) {
    for (int k = i == 0 && outside.is_one() ? 1 : 0; i + k <= degree; ++k) {
      functions.push_back(power(x, i) * power(y, k) / outside);
    }
  }
  std::vector<E> rates;
  for (const E& each : functions) rates.push_back(f[0] * each.derivative(0) + f[1] * each.derivative(1));
  const auto at = equation.points(rates);
  if (at.size() < rates.size() + 10) return std::nullopt;
  Eigen::MatrixXd rows(std::ssize(at), std::ssize(rates));
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::Vector2d& here = at[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < rows.cols(); ++k) rows(i, k) = rates[static_cast<std::size_t>(k)]({here[0], here[1]});
    rows.row(i) /= rows.row(i).lpNorm<Eigen::Infinity>();
  }
  Eigen::FullPivLU<Eigen::MatrixXd> elimination(rows);
  elimination.setThreshold(1e-11);
  if (elimination.dimensionOfKernel() == 0) return std::nullopt;
  const Eigen::VectorXd null = elimination.kernel().col(0);
  Eigen::Index largest = 0;
  null.cwiseAbs().maxCoeff(&largest);
  std::vector<E> terms;
  for (Eigen::Index k = 0; k < null.size(); ++k) {
    terms.push_back(snapped(null[k] / null[largest]) * functions[static_cast<std::size_t>(k)]);
  }
  return E::sum(terms);
}

/// Returns the coefficients of a polynomial in one variable, the lowest first, if all are fractions; else nothing.
std::vector<Number> polynomial_in(const E& e, std::size_t variable) {
  const auto all = coefficients(e, variable);
  std::vector<Number> numbers;
  for (const E& each : all.value_or(std::vector<E>{})) {
    if (!each.is(Kind::number) || !each.number().is_exact()) return {};
    numbers.push_back(each.number());
  }
  while (!numbers.empty() && numbers.back() == Number(0)) numbers.pop_back();
  return numbers;
}

/// Divides polynomials. Returns the quotient; the first becomes the remainder.
std::vector<Number> divided(std::vector<Number>& rest, const std::vector<Number>& by) {
  std::vector<Number> quotient(rest.size() < by.size() ? 0 : rest.size() - by.size() + 1, Number(0));
  while (rest.size() >= by.size()) {
    const std::size_t at = rest.size() - by.size();
    quotient[at] = rest.back() / by.back();
    for (std::size_t i = 0; i < by.size(); ++i) rest[at + i] = rest[at + i] - quotient[at] * by[i];
    rest.pop_back();
    while (!rest.empty() && rest.back() == Number(0)) rest.pop_back();
  }
  return quotient;
}

/// Returns a quotient of polynomials in one variable without their common factor; the formula itself if there is none.
E cancelled(const E& e) {
  const auto [above, below] = fraction_of(e);
  for (const std::size_t variable : {0U, 1U, 2U}) {
    if (!below.has(variable)) continue;
    std::vector<Number> a = polynomial_in(above, variable), b = polynomial_in(below, variable);
    if (a.empty() || b.empty()) return e;
    std::vector<Number> common = a, rest = b;
    while (!rest.empty()) {
      divided(common, rest);
      std::swap(common, rest);
    }
    if (common.size() < 2) return e;
    const auto quotient = [&](std::vector<Number>& of) {
      std::vector<E> terms;
      const std::vector<Number> result = divided(of, common);
      for (std::size_t i = 0; i < result.size(); ++i) {
        terms.push_back(E(result[i]) * power(E::variable(variable), E(static_cast<int>(i))));
      }
      return E::sum(terms);
    };
    const E shorter = quotient(a) / quotient(b);
    return a.empty() && b.empty() ? shorter : e;  // rounding of long fractions leaves a remainder
  }
  return e;
}

}  // namespace solution_formulas

Expression tidied(const Expression& e) {
  using namespace solution_formulas;
  E best = e;
  const auto offer = [&](const std::function<E()>& other) {
    try {
      const E each = other();
      if (each.size() < best.size()) best = each;
    } catch (const std::length_error&) {
      // too long a form is not offered
    }
  };
  offer([&] { return e.expanded(); });
  offer([&] { return cancelled(e); });
  offer([&] {
    const auto [above, below] = fraction_of(e);
    return above.expanded() / below;
  });
  offer([&] {
    const auto [above, below] = fraction_of(e);
    return above.expanded() / below.expanded();
  });
  offer([&] {
    const E sum = best.expanded();
    if (!sum.is(Kind::sum)) return sum;
    std::vector<E> common(factors_of(sum.parts()[0]).begin(), factors_of(sum.parts()[0]).end()), terms;
    std::erase_if(common, [&](const E& factor) {
      return factor.is(Kind::number) || !std::ranges::all_of(sum.parts(), [&](const E& term) {
               return std::ranges::count(factors_of(term), factor) > 0;
             });
    });
    const E outside = E::product(common);
    for (const E& term : sum.parts()) terms.push_back(term / outside);
    return outside * E::sum(terms);
  });
  return best;
}

std::optional<Coordinates> coordinates_of(const Equation& equation, const reduction::PlanarSymmetries& found) {
  using namespace solution_formulas;
  const auto& f = equation.f;
  const auto& names = equation.names;
  const E& R = equation.slope;
  const E by_x = R.derivative(0), by_y = R.derivative(1);
  const bool has_time = equation.type != FormulaField::Equations::first;
  /// @param place  x and y as formulas in q and p
  const auto accepted = [&](Coordinates c, const std::array<E, 2>& X, const std::string& map,
                            const std::array<E, 2>& place) -> std::optional<Coordinates> {
    if (c.dq_dp) c.dq_dp = tidied(*c.dq_dp);
    if (c.dp_dq) c.dp_dq = tidied(*c.dp_dq);
    const auto within = Equation::largest([&](const Sides& part) { return agrees(equation, c, part); });
    if (!within || !keeps_jumps(R, X)) return std::nullopt;
    c.within = *within;
    c.symmetry = map + ";  X = " + field_text(X, names);
    Eigen::Matrix2d turn;
    turn << 0, -1, 1, 0;
    if (X[0].is(Kind::number) && X[1].is(Kind::number)) {
      c.motion = {0, Eigen::Matrix2d::Zero(), {X[0].number().value(), X[1].number().value()}};
    } else if (X[0] == -y && X[1] == x) {
      c.motion = {0, turn, Eigen::Vector2d::Zero()};
    }
    if (!has_time || (place[0].is_zero() && !c.dt_dp)) return c;
    const E rate = f[0] * c.p.derivative(0) + f[1] * c.p.derivative(1);
    if (!c.dt_dp) c.dt_dp = 1 / tidied(rate.with(0, place[0]).with(1, place[1]));
    c.dt_dp = tidied(*c.dt_dp);
    const E error = c.dt_dp->with(2, c.q).with(3, c.p) * rate - 1;
    const auto at = equation.points({equation.slope, error}, c.within);
    const auto vanishes = [&](const Eigen::Vector2d& here) { return std::abs(error({here[0], here[1]})) < 1e-9; };
    if (at.empty() || !std::ranges::all_of(at, vanishes)) c.dt_dp.reset();
    return c;
  };
  const auto of_scaling = [&](const Number& m, const Number& x0, const Number& y0) -> std::optional<Coordinates> {
    const E dx = x - x0, dy = y - y0;
    if (!equation.vanishes(dx * by_x + m * dy * by_y - (m - Number(1)) * R)) return std::nullopt;
    const bool whole = m.is_whole();
    const Number side = equation.start[0] < x0.value() ? -1 : 1;
    const E s = side, raised = whole ? power(s, m) : E(1);
    const E at = R.with(0, s + x0).with(1, q * raised + y0);
    Coordinates c{"", dy / power(whole ? dx : E::function("abs", dx), m), ln(dx), s * at / raised - m * q, {}, {}};
    if (has_time) {
      // dt/dp = x/x'; x' = x^(1 - c) f(1, q) with the time's weight c
      const E first = f[0].with(0, s + x0).with(1, q * raised + y0);
      const E rate = (dx * f[0].derivative(0) + m * dy * f[0].derivative(1)) / f[0];
      if (const auto weight = equation.constant(rate); weight && std::isfinite(first({0, 0, 0.713}))) {
        c.dt_dp = E::function("exp", (Number(1) - *weight) * p) * s / first;
      }
    }
    const auto shown = [&](const E& e) { return e.is(Kind::sum) ? "(" + e.text(names) + ")" : e.text(names); };
    c.motion = {0, Eigen::Vector2d(1, m.value()).asDiagonal(), {-x0.value(), -(m * y0).value()}};
    return accepted(c, {dx, m * dy}, scaling_text(shown(dx), 1, shown(dy), m), {0, 0});
  };
  std::vector<std::array<Number, 3>> scalings;  // m and the centre
  scalings.push_back({1, 0, 0});
  const E below = R - y * by_y;
  if (!equation.vanishes(below)) {
    if (const auto m = equation.constant((R + x * by_x) / below)) scalings.push_back({*m, 0, 0});
  }
  if (found.scaling) {
    const auto& [time, A, b, everywhere] = *found.scaling;
    const double size = A.lpNorm<Eigen::Infinity>();
    if (std::abs(A(0, 1)) + std::abs(A(1, 0)) < 1e-9 * size && A(0, 0) != 0) {
      const Eigen::Vector2d centre = found.scaling->centre();
      scalings.push_back({snapped(A(1, 1) / A(0, 0)), snapped(centre[0]), snapped(centre[1])});
    }
  }
  if (equation.is_free_of(R, 0)) {
    return accepted({"", y, x, R.with(1, q), {}, {}}, {1, 0}, fmt::format("{0} -> {0} + a", names[0]), {p, q});
  }
  if (equation.is_free_of(R, 1)) {
    return accepted({"", x, y, {}, R.with(0, q), {}, false}, {0, 1}, fmt::format("{0} -> {0} + a", names[1]), {q, p});
  }
  for (const auto& [m, x0, y0] : scalings) {
    if (auto c = of_scaling(m, x0, y0)) return c;
  }
  if (equation.vanishes(below)) {
    return accepted({"", x, ln(y), {}, (R / y).with(1, 1).with(0, q), {}, false}, {0, y},
                    scaling_text("", 0, names[1], 1), {q, (equation.start[1] < 0 ? -1 : 1) * E::function("exp", p)});
  }
  if (const auto c = equation.constant(-by_x / by_y)) {
    const E slope = E(*c);
    return accepted({"", y - slope * x, x, R.with(0, 0).with(1, q) - slope, {}, {}}, {1, slope},
                    fmt::format("{0} -> {0} + a, {1} -> {2}", names[0], names[1],
                                (y + slope * q).text(std::array{names[0], names[1], std::string("a")})),
                    {p, q + slope * p});
  }
  const E r = power(x * x + y * y, Number(1, 2)), angle = E::function("atan", y / x);
  if (equation.vanishes(x * by_y - y * by_x - 1 - R * R)) {
    // at (q, 0) the angle changes by y'/q, and r by x'
    Coordinates c{"", r, angle, {}, tidied(f[1] / f[0] / x).with(1, 0).with(0, q), {}};
    return accepted(c, {-y, x}, "turns of the plane about the origin", {q, 0});
  }
  for (const reduction::Generator& X : found.generators) {
    const auto& A = X.matrix;
    const double s = A(0, 0), w = A(1, 0), error = 1e-9 * A.lpNorm<Eigen::Infinity>();
    if (s == 0 || w == 0 || std::abs(A(1, 1) - s) > error || std::abs(A(0, 1) + w) > error || X.shift.norm() > error)
      continue;
    const E k = snapped(w / s), cos = E::function("cos", q), sin = E::function("sin", q);
    const E F = f[0].with(0, cos).with(1, sin), G = f[1].with(0, cos).with(1, sin);
    Coordinates c{"", angle - k * ln(r), ln(r), (G * cos - F * sin) / (F * cos + G * sin) - k, {}, {}};
    if (auto spiral = accepted(c, {x - k * y, k * x + y}, "spirals: the plane is turned and magnified", {cos, sin}))
      return spiral;
  }
  const std::array letters{std::string("a"), names[1], names[0]};
  if (const auto parts = separated(equation)) {
    const Maybe P = antiderivative(tidied(1 / (*parts)[1]), 1);
    if (!P) return std::nullopt;
    Coordinates c{"", x, *P, {}, (*parts)[0].with(0, q), {}, false};
    return accepted(c, {0, (*parts)[1]}, fmt::format("{0} -> {0} + a", P->text(names)), {0, 0});
  }
  // (m z)' = m b with z = y^k
  const auto form = linear_form(equation, R, 1);
  const auto found_m = form ? multiplied(equation, form->a, form->b, 0) : std::nullopt;
  if (!found_m) return std::nullopt;
  const E z = power(y, form->k), step = tidied(1 / found_m->factor);
  Coordinates c{"", x, z * found_m->factor, {}, found_m->rest.with(0, q), {}, false};
  return accepted(c, {0, tidied(step / z.derivative(1))},
                  fmt::format("{} -> {}", z.text(names), (z + x * step.with(0, q)).text(letters)), {0, 0});
}

std::optional<IntegralFormula> integral_of(const Equation& equation, const std::optional<Coordinates>& coordinates,
                                           const std::optional<Expression>& factor) {
  using namespace solution_formulas;
  const auto& f = equation.f;
  const auto& names = equation.names;
  const E& R = equation.slope;
  std::optional<IntegralFormula> result;
  const auto attempt = [&](const std::function<Maybe()>& way) {
    if (result) return;
    try {
      const Maybe H = way();
      if (!H || !(H->has(0) || H->has(1))) return;
      const auto within = Equation::largest([&](const Sides& part) { return equation.is_integral(*H, part); });
      if (within) result = {*H, *H, {}, *within};
    } catch (const std::exception&) {
      // a formula became too long, or has no value
    }
  };
  attempt([&] { return of_separable(equation); });
  attempt([&]() -> Maybe {
    const auto [above, below] = fraction_of(R);
    for (const auto& [M, N] : {std::pair(-f[1], f[0]), std::pair(-above, below)}) {
      if (!equation.vanishes(M.derivative(1) - N.derivative(0))) continue;
      if (const Maybe found = of_closed(M, N)) return found;
    }
    return std::nullopt;
  });
  attempt([&] { return of_bernoulli(equation, R, 0, 1); });
  attempt([&]() -> Maybe {
    if (!coordinates) return std::nullopt;
    const auto& c = *coordinates;
    if (c.dq_dp && c.dq_dp->is_zero()) return c.q;
    const E rate = c.dp_dq ? *c.dp_dq : tidied(1 / *c.dq_dp);
    const Maybe found = antiderivative(rate, 2);
    return found ? Maybe(c.p - found->with(2, c.q)) : found;
  });
  attempt([&] { return of_bernoulli(equation, 1 / R, 1, 0); });
  attempt([&]() -> Maybe {
    const auto [above, below] = fraction_of(R);
    for (const auto& [M, N] : {std::pair(-above, below), std::pair(-f[1], f[0])}) {
      const E curl = M.derivative(1) - N.derivative(0);
      if (equation.vanishes(curl)) return of_closed(M, N);
      const E of_x = curl / N, of_y = -curl / M;
      Maybe exponent;
      if (equation.vanishes(of_x.derivative(1)))
        exponent = antiderivative(tidied(of_x.with(1, Number(13, 10))), 0);
      else if (equation.vanishes(of_y.derivative(0)))
        exponent = antiderivative(tidied(of_y.with(0, Number(13, 10))), 1);
      if (!exponent) continue;
      const E m = E::function("exp", *exponent);
      if (Maybe found = of_closed((M * m).expanded(), (N * m).expanded())) return found;
    }
    return std::nullopt;
  });
  attempt([&]() -> Maybe {
    const auto all = coefficients(R, 1, 2);
    if (!all || all->size() != 3) return std::nullopt;
    const Maybe u = particular(equation, {(*all)[0], (*all)[1], (*all)[2]});
    return u ? of_riccati(equation, (*all)[1], (*all)[2], *u) : u;
  });
  constexpr std::size_t long_formula = 150;
  const bool is_short = R.size() < long_formula;
  for (const Number& m :
       {Number(1), Number(-1), Number(2), Number(-2), Number(1, 2), Number(3), Number(-1, 2), Number(3, 2)}) {
    if (!is_short || result) break;
    attempt([&] { return of_powers(equation, m); });
    if (result) result->after = fmt::format("separable after q = {}", (y / power(x, m)).text(equation.names));
  }
  for (const auto* name : {"tan", "exp", "ln"}) {
    if (is_short) attempt([&] { return of_function(equation, name); });
  }
  attempt([&]() -> Maybe {
    if (!factor) return std::nullopt;
    if (const Maybe found = of_curves(equation, *factor)) return found;
    return of_closed(-f[1] / *factor, f[0] / *factor);
  });
  if (!result) return result;
  if (result->H.text(names).starts_with('-')) result->H = -result->H;
  if (result->H.is(Kind::sum)) {  // the whole numbers in H have no common factor
    const Number common = term_of(power(result->H, -1)).factor.inverse();
    if (common.is_exact() && std::abs(common.above()) > 1) {
      result->H = result->H * Number(common.value() < 0 ? -common.below() : common.below(), common.above());
    }
  }
  constexpr std::size_t longest = 250;
  if (result->H.size() > longest) return std::nullopt;
  const E summed = with_sums_of_logarithms(result->H);
  result->solvable = result->H;
  for (E other : {summed, tidied(summed), tidied(result->H)}) {
    if (other.text(names).starts_with('-')) other = -other;
    if (other.size() < result->H.size() && equation.is_integral(other, result->within)) result->H = other;
  }
  return result;
}

std::optional<Expression> solved_for_y(const Equation& equation, const Expression& H) {
  using namespace solution_formulas;
  const double x0 = equation.start[0], y0 = equation.start[1];
  const double C = H({x0, y0});
  if (!std::isfinite(C)) return std::nullopt;
  try {
    constexpr double exact = 1e-13;
    const Number simple = snapped(C);
    // A multiple of pi is exact, so that all compilers print the same.
    const double turns = std::round(C / std::numbers::pi) * std::numbers::pi;
    // On the side of the start, sign(z) is a number.
    E left = H.replaced([&](const E& part) -> Maybe {
      const double at = is_function(part, "sign") ? part.parts()[0]({x0, y0}) : 0;
      return at == 0 ? std::nullopt : Maybe(at < 0 ? -1 : 1);
    });
    E right = simple.below() > 0 && simple.below() <= 12 && std::abs(simple.value() - C) < exact ? simple
              : std::abs(turns - C) < exact * std::abs(C) ? Number::inexact(turns)
                                                          : Number::inexact(C);
    constexpr int most_steps = 30;
    for (int step = 0; step < most_steps && !(left == y); ++step) {
      if (!left.has(1)) return std::nullopt;
      if (left.is(Kind::sum)) {
        std::vector<E> with_y, others;
        for (const E& term : left.parts()) (term.has(1) ? with_y : others).push_back(term);
        right = right - E::sum(others);
        left = E::sum(with_y);
        if (with_y.size() == 1) continue;
        if (const auto all = coefficients(left, 1, 1); all && all->size() == 2) {
          right = (right - (*all)[0]) / (*all)[1];
          left = y;
          continue;
        }
        if (const auto all = coefficients(left, 1, 2); all && all->size() == 3) {
          const E &a = (*all)[2], &b = (*all)[1], c = (*all)[0] - right;
          const E root = power(tidied(b * b - 4 * a * c), Number(1, 2));
          const int side = (2 * a * y + b)({x0, y0}) < 0 ? -1 : 1;
          right = (side * root - b) / (2 * a);
          left = y;
          continue;
        }
        // c (ln |a| - ln |b|) is ln |a/b|; then (a y + b)/(c y + d) is solved
        if (with_y.size() != 2) return std::nullopt;
        const auto [c, first] = term_of(with_y[0]);
        const auto [d, second] = term_of(with_y[1]);
        if (!(c == -d) || !is_function(first, "ln") || !is_function(second, "ln")) return std::nullopt;
        const E a = first.parts()[0], b = second.parts()[0];
        const auto inner = [](const E& e) { return is_function(e, "abs") ? e.parts()[0] : e; };
        const auto above = coefficients(inner(a), 1, 1), below = coefficients(inner(b), 1, 1);
        if (!above || !below || above->size() != 2 || below->size() != 2) return std::nullopt;
        const int sign = (inner(a) / inner(b))({x0, y0}) < 0 ? -1 : 1;
        const E ratio = sign * E::function("exp", (right / E(c)).expanded());
        right = ((*below)[0] * ratio - (*above)[0]) / ((*above)[1] - (*below)[1] * ratio);
        left = y;
      } else if (left.is(Kind::product)) {
        std::vector<E> with_y, others;
        for (const E& each : left.parts()) (each.has(1) ? with_y : others).push_back(each);
        if (others.empty()) return std::nullopt;
        right = (right / E::product(others)).expanded();
        left = E::product(with_y);
      } else if (left.is(Kind::power)) {
        const auto [base, exponent] = base_and_exponent(left);
        if (!exponent.is(Kind::number)) return std::nullopt;
        const bool even = is_whole(exponent) && exponent.number().above() % 2 == 0;
        const bool minus = base({x0, y0}) < 0;
        if (minus && !even && !(exponent == E(-1))) return std::nullopt;
        right = power(right, 1 / exponent);
        if (minus && even) right = -right;
        left = base;
      } else {
        const E argument = left.parts()[0];
        const auto name = left.name();
        const double at = argument({x0, y0});
        if (name == "ln")
          right = E::function("exp", right.expanded());
        else if (name == "exp")
          right = E::function("ln", right);
        else if (name == "abs")
          right = at < 0 ? -right : right;
        else if (name == "atan")
          right = E::function("tan", right);
        else if (name == "asin")
          right = E::function("sin", right);
        else if (name == "sin" && std::abs(at) < std::acos(0.))
          right = E::function("asin", right);
        else if (name == "tan" && std::abs(at) < std::acos(0.))
          right = E::function("atan", right);
        else if (name == "sinh")
          right = E::function("asinh", right);
        else if (name == "asinh")
          right = E::function("sinh", right);
        else
          return std::nullopt;
        left = argument;
      }
    }
    if (!(left == y) || right.has(1)) return std::nullopt;
    const E solution = tidied(with_signs_at(right, equation.start));
    constexpr std::size_t longest = 80;
    if (solution.size() > longest) return std::nullopt;
    const E slope = solution.derivative(0);
    constexpr double step = 1e-3, error = 1e-9;
    for (const double at : {x0, x0 * (1 + step), x0 + step}) {
      const double value = solution({at});
      if (at == x0 && !(std::abs(value - y0) <= error * (1 + std::abs(y0)))) return std::nullopt;
      const double expected = equation.slope({at, value}), found = slope({at});
      if (!(std::abs(found - expected) <= 1e-8 * (1 + std::abs(expected)))) return std::nullopt;
    }
    return solution;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace contensou::answers
