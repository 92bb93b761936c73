#include "answers/equation/equation.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

namespace contensou::answers {

namespace antiderivatives {

using E = Expression;
using Kind = E::Kind;
using Maybe = std::optional<Expression>;
using Polynomial = std::vector<Number>;  ///< the coefficient of x^0 first; the last is not 0

E root_of(const E& x) { return power(x, Number(1, 2)); }
/// Returns ln |x| up to a constant.
E ln(const E& x) { return E::function("ln", term_of(E::function("abs", x)).rest); }

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == Number(0)) p.pop_back();
}

Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial all(a.empty() || b.empty() ? 0 : a.size() + b.size() - 1, 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) all[i + j] = all[i + j] + a[i] * b[j];
  }
  return all;
}

/// Returns quotient and remainder.
std::pair<Polynomial, Polynomial> divided(Polynomial a, const Polynomial& b) {
  Polynomial quotient(a.size() >= b.size() ? a.size() - b.size() + 1 : 0, 0);
  while (a.size() >= b.size()) {
    const std::size_t place = a.size() - b.size();
    const Number factor = a.back() / b.back();
    quotient[place] = factor;
    for (std::size_t i = 0; i < b.size(); ++i) a[place + i] = a[place + i] - factor * b[i];
    a.pop_back();  // exactly 0, also where rounding leaves a rest
    trim(a);
  }
  return {quotient, a};
}

E formula_of(const Polynomial& p, const E& x) {
  std::vector<E> terms;
  for (std::size_t i = 0; i < p.size(); ++i) terms.push_back(p[i] * power(x, static_cast<int>(i)));
  return E::sum(terms);
}

std::optional<Polynomial> polynomial_of(const E& e, std::size_t x) {
  const auto all = coefficients(e, x);
  if (!all) return std::nullopt;
  Polynomial p;
  for (const E& each : *all) {
    if (!each.is(Kind::number)) return std::nullopt;
    p.push_back(each.number());
  }
  trim(p);
  return p;
}

/// Returns p with whole coefficients; empty if a coefficient is not rational or too large.
std::optional<std::vector<long long>> whole_coefficients(const Polynomial& p) {
  long long below = 1, common = 0;
  for (const Number& each : p) {
    if (!each.is_exact() || std::abs(each.value()) > 1e9 || below > 1'000'000) return std::nullopt;
    below = std::lcm(below, each.below());
  }
  std::vector<long long> all;
  for (const Number& each : p) all.push_back((each * Number(below)).above());
  for (const long long each : all) common = std::gcd(common, each);
  for (long long& each : all) each /= common;
  return all;
}

/// Returns a factor of degree 1, or else 2, of a polynomial of a degree above 2 with rational coefficients.
std::optional<Polynomial> factor_of(const Polynomial& p) {
  const auto whole = whole_coefficients(p);
  if (!whole) return std::nullopt;
  constexpr long long most = 200;
  const auto is_factor = [&](const Polynomial& by) { return divided(p, by).second.empty(); };
  for (long long below = 1; below <= std::min(std::abs(whole->back()), most); ++below) {
    if (whole->back() % below != 0) continue;
    for (long long above = 0; above <= std::min(std::abs(whole->front()), most); ++above) {
      if (above == 0 ? whole->front() != 0 : whole->front() % above != 0) continue;
      for (const long long sign : {1, -1}) {
        if (Polynomial by{Number(sign * above, below), 1}; is_factor(by)) return by;
      }
    }
  }
  constexpr long long largest = 12;
  for (long long a = 0; a <= largest && p.size() > 3; ++a) {
    for (long long b = -largest; b <= largest; ++b) {
      for (const long long sign : {1, -1}) {
        if (Polynomial by{b, sign * a, 1}; b != 0 && is_factor(by)) return by;
      }
    }
  }
  return std::nullopt;
}

/// Returns the solution of a linear system by elimination.
std::optional<std::vector<Number>> solved(std::vector<std::vector<Number>> rows) {
  const std::size_t n = rows.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto size = [&](const std::vector<Number>& row) { return std::abs(row[i].value()); };
    const auto pivot = std::ranges::max_element(rows.begin() + static_cast<std::ptrdiff_t>(i), rows.end(), {}, size);
    if ((*pivot)[i] == Number(0)) return std::nullopt;
    std::swap(rows[i], *pivot);
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i || rows[k][i] == Number(0)) continue;
      const Number by = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j <= n; ++j) rows[k][j] = rows[k][j] - by * rows[i][j];
    }
  }
  std::vector<Number> all;
  for (std::size_t i = 0; i < n; ++i) all.push_back(rows[i][n] / rows[i][i]);
  return all;
}

/// Returns the integral of (a + b x)/q^k for a quadratic q = s + p x + x^2.
E over_quadratic(const Number& a, const Number& b, const Number& s, const Number& p, int k, const E& x) {
  const E q = s + p * x + x * x, slope = p + 2 * x;
  const Number rest = a - b * p / 2, D = Number(4) * s - p * p;
  E all = k == 1 ? b / Number(2) * ln(q) : b / Number(2) * power(q, 1 - k) / (1 - k);
  if (rest == Number(0)) return all;
  E factor = rest;
  for (; k > 1; --k) {
    all = all + factor * slope / (Number(k - 1) * D * power(q, k - 1));
    factor = factor * (Number(2 * (2 * k - 3)) / (Number(k - 1) * D));
  }
  if (D.value() > 0) return all + factor * 2 / root_of(D) * E::function("atan", slope / root_of(D));
  const E root = root_of(-D);
  return all + factor / root * (ln(slope - root) - ln(slope + root));
}

Maybe of_rational(const E& f, std::size_t variable) {
  const E x = E::variable(variable);
  const auto [over, under] = fraction_of(f);
  const auto above = polynomial_of(over, variable), below = polynomial_of(under, variable);
  if (!above || !below || below->empty()) return std::nullopt;
  Polynomial numerator = *above, denominator = *below;
  Polynomial a = numerator, b = denominator;  // Euclid
  while (!b.empty()) a = std::exchange(b, divided(a, b).second);
  if (a.size() > 1 && whole_coefficients(a)) {
    numerator = divided(numerator, a).first;
    denominator = divided(denominator, a).first;
  }
  const Number lead = denominator.back();
  for (Number& each : denominator) each = each / lead;
  for (Number& each : numerator) each = each / lead;
  auto [whole, rest] = divided(numerator, denominator);
  std::vector<E> terms;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    terms.push_back(whole[i] / Number(static_cast<int>(i) + 1) * power(x, static_cast<int>(i) + 1));
  }
  std::vector<std::pair<Polynomial, int>> factors;
  Polynomial left = denominator;
  while (left.size() > 1) {
    Polynomial next = left;
    if (left.size() > 2) {
      if (const auto found = factor_of(left)) next = *found;
    }
    for (Number& each : next) each = each / next.back();
    left = divided(left, next).first;
    const auto known = std::ranges::find(factors, next, &std::pair<Polynomial, int>::first);
    known == factors.end() ? void(factors.emplace_back(next, 1)) : void(++known->second);
  }
  // Partial fractions: each unknown has a column, denominator divided by factor^k, perhaps times x.
  struct Part {
    const Polynomial* factor;
    int power, shift;
    Polynomial column;
  };
  std::vector<Part> parts;
  for (const auto& [factor, times_] : factors) {
    Polynomial column = denominator;
    for (int k = 1; k <= times_; ++k) {
      column = divided(column, factor).first;
      for (int shift = 0; shift + 2 <= static_cast<int>(factor.size()); ++shift) {
        Polynomial shifted = column;
        shifted.insert(shifted.begin(), static_cast<std::size_t>(shift), 0);
        parts.push_back({&factor, k, shift, shifted});
      }
    }
  }
  std::vector<std::vector<Number>> rows(parts.size(), std::vector<Number>(parts.size() + 1, 0));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (i < parts[j].column.size()) rows[i][j] = parts[j].column[i];
    }
    if (i < rest.size()) rows[i].back() = rest[i];
  }
  const auto found = solved(std::move(rows));
  if (!found) return std::nullopt;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& [factor, k, shift, column] = parts[i];
    if (factor->size() > 3) {  // only a multiple of the derivative of the factor has a simple integral
      if (shift > 0) continue;
      const Number multiple = (*found)[i + factor->size() - 2] / Number(static_cast<int>(factor->size()) - 1);
      for (std::size_t n = 1; n < factor->size(); ++n) {
        const Number expected = multiple * Number(static_cast<int>(n)) * (*factor)[n];
        if (k > 1 || !((*found)[i + n - 1] == expected)) return std::nullopt;
      }
      terms.push_back(multiple * ln(formula_of(*factor, x)));
    } else if (factor->size() == 2) {
      const E base = (*factor)[0] + x;
      terms.push_back(k == 1 ? (*found)[i] * ln(base) : (*found)[i] * power(base, 1 - k) / (1 - k));
    } else if (shift == 1 && !((*found)[i] == Number(0) && (*found)[i - 1] == Number(0))) {
      terms.push_back(over_quadratic((*found)[i - 1], (*found)[i], (*factor)[0], (*factor)[1], k, x));
    }
  }
  return E::sum(terms);
}

/// Returns a and b of a linear function a x + b.
std::optional<std::array<E, 2>> linear(const E& e, std::size_t x) {
  const auto all = coefficients(e, x, 1);
  if (!all || all->size() != 2 || all->at(1).is_zero()) return std::nullopt;
  return {{all->at(1), all->at(0)}};
}

class Search {
 public:
  Maybe operator()(const E& f, std::size_t x, int depth = 0);

 private:
  Maybe factor(const E& f, std::size_t x, int depth);
  Maybe table(const E& f, std::size_t x);
  Maybe by_parts(const E& f, std::size_t x, int depth);
  Maybe of_roots(const E& f, std::size_t x, int depth);
  Maybe by_trigonometry(const E& f, std::size_t x, int depth);
  Maybe by_substitution(const E& f, std::size_t x, int depth);

  int left_ = 160;  ///< number of integrals that the search may still try
};

Maybe Search::operator()(const E& f, std::size_t x, int depth) {
  constexpr int deepest = 7;
  if (--left_ < 0 || depth > deepest) return std::nullopt;
  if (!f.has(x)) return f * E::variable(x);
  if (f.is(Kind::sum)) {
    std::vector<E> all;
    for (const E& term : f.parts()) {
      const Maybe each = (*this)(term, x, depth + 1);
      if (!each) break;
      all.push_back(*each);
    }
    if (all.size() == f.parts().size()) return E::sum(all);
    if (Maybe found = of_rational(f, x)) return found;
    return by_substitution(f, x, depth);
  }
  std::vector<E> constants, others;
  for (const E& each : factors_of(f)) (each.has(x) ? others : constants).push_back(each);
  const Maybe found = factor(E::product(others), x, depth);
  if (!found) return found;
  return E::product(constants) * *found;
}

Maybe Search::factor(const E& f, std::size_t x, int depth) {
  if (Maybe found = table(f, x)) return found;
  if (Maybe found = of_rational(f, x)) return found;
  if (Maybe found = by_trigonometry(f, x, depth)) return found;
  if (Maybe found = by_parts(f, x, depth)) return found;
  if (Maybe found = of_roots(f, x, depth)) return found;
  if (Maybe found = by_substitution(f, x, depth)) return found;
  const E other = f.expanded();
  return other.is(Kind::sum) ? (*this)(other, x, depth + 1) : std::nullopt;
}

Maybe Search::table(const E& f, std::size_t x) {
  const auto [base, exponent] = base_and_exponent(f);
  if (!exponent.has(x)) {
    if (const auto line = linear(base, x)) {
      if (exponent == E(-1)) return ln(base) / (*line)[0];
      return power(base, exponent + 1) / ((exponent + 1) * (*line)[0]);
    }
  }
  const auto of_argument = [&](const E& argument, const E& integral) -> Maybe {
    const auto line = linear(argument, x);
    return line ? Maybe(integral / (*line)[0]) : std::nullopt;
  };
  const auto call = [](std::string_view name, const E& argument) { return E::function(name, argument); };
  if (!base.has(x) && f.is(Kind::power)) return of_argument(exponent, f / call("ln", base));
  if (is_function(base, "abs") && !exponent.has(x)) {
    if (exponent == E(-1)) return of_argument(base.parts()[0], call("sign", base.parts()[0]) * call("ln", base));
    return of_argument(base.parts()[0], base.parts()[0] * f / (exponent + 1));
  }
  if (base.is(Kind::function) && is_whole(exponent)) {
    const E& z = base.parts()[0];
    const auto n = exponent.number().above();
    const E self = base;
    if (n == 1) {
      if (base.name() == "exp") return of_argument(z, self);
      if (base.name() == "sin") return of_argument(z, -call("cos", z));
      if (base.name() == "cos") return of_argument(z, call("sin", z));
      if (base.name() == "tan") return of_argument(z, -ln(call("cos", z)));
      if (base.name() == "sinh") return of_argument(z, call("cosh", z));
      if (base.name() == "cosh") return of_argument(z, call("sinh", z));
      if (base.name() == "tanh") return of_argument(z, call("ln", call("cosh", z)));
      if (base.name() == "ln") return of_argument(z, z * self - z);
      if (base.name() == "atan") return of_argument(z, z * self - call("ln", 1 + z * z) / 2);
      if (base.name() == "asin") return of_argument(z, z * self + root_of(1 - z * z));
    }
    if (n == -1 && base.name() == "tan") return of_argument(z, ln(call("sin", z)));
    if (n == -1 && base.name() == "sin") return of_argument(z, ln(call("tan", z / 2)));
    if (n == -1 && base.name() == "cos") return of_argument(z, ln(call("tan", z) + 1 / self));
    if (n == 2 && base.name() == "tan") return of_argument(z, self - z);
    if (n == -2 && base.name() == "cos") return of_argument(z, call("tan", z));
    if (n == -2 && base.name() == "sin") return of_argument(z, -1 / call("tan", z));
  }
  return std::nullopt;
}

Maybe Search::by_parts(const E& f, std::size_t x, int depth) {
  const std::vector<E> factors(factors_of(f).begin(), factors_of(f).end());
  const auto is_wave = [](const E& e) { return is_function(e, "sin") || is_function(e, "cos"); };
  const auto without = [&](std::size_t i) {
    std::vector<E> others = factors;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    return E::product(others);
  };
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const E& h = factors[i];
    const bool is_exp = is_function(h, "exp"), grows = is_function(h, "sinh") || is_function(h, "cosh");
    if (!is_exp && !is_wave(h) && !grows) continue;
    const auto line = linear(h.parts()[0], x);
    if (!line) continue;
    E rest = without(i), integral = 0;
    // exp(a x) sin(b x + c) together
    const auto wave = std::ranges::find_if(factors, is_wave);
    const auto turning = is_exp && wave != factors.end() ? linear(wave->parts()[0], x) : std::nullopt;
    if (turning) {
      const E &a = (*line)[0], &b = (*turning)[0], &z = wave->parts()[0];
      const E sin = E::function("sin", z), cos = E::function("cos", z);
      const bool of_sin = wave->name() == "sin";
      integral = h * (of_sin ? a * sin - b * cos : a * cos + b * sin) / (a * a + b * b);
      rest = rest / *wave;
    } else {
      const Maybe known = table(h, x);
      if (!known) continue;
      integral = *known;
    }
    if (!coefficients(rest, x)) continue;
    if (!rest.has(x)) return rest * integral;
    const Maybe later = (*this)((rest.derivative(x) * integral).expanded(), x, depth + 1);
    if (later) return rest * integral - *later;
  }
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto [base, exponent] = base_and_exponent(factors[i]);
    const bool inverse = is_function(base, "ln") || is_function(base, "atan") || is_function(base, "asin") ||
                         is_function(base, "acos") || is_function(base, "atanh");
    if (!inverse || !is_whole(exponent) || exponent.number().above() < 0) continue;
    const Maybe integral = (*this)(without(i), x, depth + 1);
    if (!integral || !integral->has(x)) continue;
    if (const auto [by, rest] = term_of(*integral); is_function(base, "ln") && rest == ln(base.parts()[0])) {
      return by / (exponent.number() + Number(1)) * factors[i] * base;
    }
    const Maybe later = (*this)((*integral * factors[i].derivative(x)).expanded(), x, depth + 1);
    if (later) return factors[i] * *integral - *later;
  }
  return std::nullopt;
}

/// p(x) sqrt(q)^k with a quadratic q and k = 1 or -1: A(x) sqrt(q) + the integral of c/sqrt(q).
Maybe Search::of_roots(const E& f, std::size_t x, int) {
  E rest = f, q = 0;
  bool above = false;
  for (const E& each : factors_of(f)) {
    const auto [base, exponent] = base_and_exponent(each);
    if (!(exponent == E(Number(1, 2))) && !(exponent == E(Number(-1, 2)))) continue;
    if (!q.is_zero()) return std::nullopt;
    q = base;
    rest = f / each;
    above = exponent.number().value() > 0;
  }
  if (q.is_zero()) return std::nullopt;
  const auto quadratic = polynomial_of(q, x), factor = polynomial_of(above ? rest * q : rest, x);
  if (!quadratic || quadratic->size() != 3 || !factor) return std::nullopt;
  // (A sqrt(q))' = (A' q + A q'/2)/sqrt(q) = p/sqrt(q) - c/sqrt(q)
  const auto& [c0, c1, c2] = std::tie((*quadratic)[0], (*quadratic)[1], (*quadratic)[2]);
  Polynomial p = *factor, A(p.size() > 1 ? p.size() - 1 : 0, 0);
  for (std::size_t i = A.size(); i-- > 0;) {
    const Number n(static_cast<int>(i));
    A[i] = p[i + 1] / (c2 * (n + Number(1)));
    p[i + 1] = 0;
    p[i] = p[i] - A[i] * c1 * (n + Number(1, 2));
    if (i > 0) p[i - 1] = p[i - 1] - A[i] * c0 * n;
  }
  const E variable = E::variable(x), root = root_of(q), slope = c1 + 2 * c2 * variable;
  const E polynomial = formula_of(A, variable) * root;
  if (p.empty() || p[0] == Number(0)) return polynomial;
  if (c2.value() > 0) return polynomial + p[0] * ln(2 * root_of(c2) * root + slope) / root_of(c2);
  const Number D = c1 * c1 - Number(4) * c0 * c2;
  if (!(D.value() > 0)) return std::nullopt;
  return polynomial - p[0] * E::function("asin", slope / root_of(D)) / root_of(-c2);
}

Maybe Search::by_trigonometry(const E& f, std::size_t x, int depth) {
  std::vector<E> waves;
  E rest = f;
  for (const E& each : factors_of(f)) {
    const auto [base, exponent] = base_and_exponent(each);
    if ((is_function(base, "sin") || is_function(base, "cos")) && is_whole(exponent) && exponent.number().above() > 0) {
      for (long long i = 0; i < exponent.number().above(); ++i) waves.push_back(base);
      rest = rest / each;
    }
  }
  const bool beside = coefficients(rest, x) || is_function(rest, "exp");
  if (beside && waves.size() >= 2 && waves.size() <= 6) {  // a product of two is a sum
    const E &a = waves[0].parts()[0], &b = waves[1].parts()[0];
    const bool sine = is_function(waves[0], "sin"), other = is_function(waves[1], "sin");
    const auto wave = [&](const E& z) { return E::function(sine == other ? "cos" : "sin", z); };
    const E plus = wave(a + b), minus = wave(a - b);
    const E product = sine && other     ? minus - plus
                      : !sine && !other ? minus + plus
                      : sine            ? plus + minus
                                        : plus - minus;
    for (std::size_t i = 2; i < waves.size(); ++i) rest = rest * waves[i];
    return (*this)((rest * product / 2).expanded(), x, depth + 1);
  }
  // sin(2 z) and cos(2 z) next to a function of z
  const E doubled = f.replaced([&](const E& part) -> Maybe {
    const bool sine = is_function(part, "sin");
    if (!sine && !is_function(part, "cos")) return std::nullopt;
    const E half = part.parts()[0] / 2;
    bool next_to = false;
    f.replaced([&](const E& other) -> Maybe {
      next_to |= other.is(Kind::function) && other.parts()[0] == half;
      return std::nullopt;
    });
    if (!next_to) return std::nullopt;
    const E sin = E::function("sin", half), cos = E::function("cos", half);
    return sine ? 2 * sin * cos : 1 - 2 * sin * sin;
  });
  return doubled == f ? std::nullopt : (*this)(doubled, x, depth + 1);
}

/// Collects the parts of a formula that contain x, the smallest first.
void collect(const E& f, std::size_t x, std::set<E>& all) {
  for (const E& part : f.parts()) {
    if (!part.has(x)) continue;
    if (!part.is(Kind::variable)) all.insert(part);
    collect(part, x, all);
  }
}

/// Replaces g, and its powers, by w.
E replaced(const E& f, const E& g, const E& w) {
  const auto [base, exponent] = base_and_exponent(g);
  return f.replaced([&, base = base, exponent = exponent](const E& part) -> Maybe {
    if (part == g) return w;
    const auto [other, raised] = base_and_exponent(part);
    if (other == base && exponent.is(Kind::number) && raised.is(Kind::number)) {
      if (const E ratio = raised / exponent; is_whole(ratio)) return power(w, ratio);
    }
    if (is_function(g, "exp") && is_function(part, "exp")) {
      if (const E ratio = part.parts()[0] / g.parts()[0]; is_whole(ratio)) return power(w, ratio);
    }
    return std::nullopt;
  });
}

Maybe Search::by_substitution(const E& f, std::size_t x, int depth) {
  std::set<E> parts;
  collect(f, x, parts);
  if (f.is(Kind::function) || f.is(Kind::power)) parts.insert(f);
  const std::size_t next = std::max<std::size_t>(x, 3) + 1;
  const E w = E::variable(next);
  const auto attempt = [&](const E& in_w, const E& shown) -> Maybe {
    if (in_w.has(x)) return std::nullopt;
    const Maybe found = (*this)(in_w, next, depth + 1);
    return found ? Maybe(found->with(next, shown)) : std::nullopt;
  };
  std::vector<E> sorted(parts.begin(), parts.end());
  std::ranges::stable_sort(sorted, {}, &E::size);
  constexpr std::size_t most_parts = 14;
  if (sorted.size() > most_parts) sorted.erase(sorted.begin() + most_parts, sorted.end());
  for (const E& g : sorted) {
    if (left_ < 0) return std::nullopt;
    const auto [base, exponent] = base_and_exponent(g);
    // a root of a linear function: x is a function of w
    if (exponent.is(Kind::number) && exponent.number().is_exact() && !exponent.number().is_whole()) {
      if (const auto line = linear(base, x)) {
        long long degree = 1;
        for (const E& each : parts) {
          const auto [other, by] = base_and_exponent(each);
          if (other == base && by.is(Kind::number) && by.number().is_exact())
            degree = std::lcm(degree, by.number().below());
        }
        const E small = power(base, Number(1, degree));
        const E inverse = (power(w, Number(degree)) - (*line)[1]) / (*line)[0];
        const E in_w = replaced(f, small, w).with(x, inverse) * inverse.derivative(next);
        if (Maybe found = attempt(in_w, small)) return found;
        continue;
      }
    }
    if (is_function(g, "ln") && linear(g.parts()[0], x)) {
      const auto line = *linear(g.parts()[0], x);
      const E inverse = (E::function("exp", w) - line[1]) / line[0];
      if (Maybe found = attempt(replaced(f, g, w).with(x, inverse) * inverse.derivative(next), g)) return found;
      continue;
    }
    if (g.is(Kind::sum) && linear(g, x)) {
      const auto line = *linear(g, x);
      if (Maybe found = attempt(f.with(x, (w - line[1]) / line[0]) / line[0], g); found && depth == 0) return found;
      continue;
    }
    const E slope = g.derivative(x);
    if (slope.is_zero()) continue;
    E in_w = replaced(f / slope, g, w);
    if (in_w.has(x) && g.is(Kind::function)) {
      const E& z = g.parts()[0];
      const auto rewrite = [&](std::string_view name, const E& square) {
        in_w = in_w.replaced([&](const E& part) -> Maybe {
          const auto [inner, raised] = base_and_exponent(part);
          if (!is_function(inner, name) || !(inner.parts()[0] == z)) return std::nullopt;
          if (is_whole(raised) && raised.number().above() % 2 == 0) return power(square, raised / 2);
          return std::nullopt;
        });
      };
      if (g.name() == "sin") rewrite("cos", 1 - w * w);
      if (g.name() == "cos") rewrite("sin", 1 - w * w);
      if (g.name() == "tan") rewrite("cos", 1 / (1 + w * w));
    }
    if (Maybe found = attempt(in_w, g)) return found;
  }
  // tan of the angle, then of its half
  const auto angle =
      std::ranges::find_if(sorted, [](const E& e) { return is_function(e, "sin") || is_function(e, "cos"); });
  if (angle == sorted.end()) return std::nullopt;
  const E z = angle->parts()[0];
  const auto line = linear(z, x);
  if (!line) return std::nullopt;
  const E cos = E::function("cos", z);
  const auto is_at = [&](const E& part, std::string_view name) {
    return is_function(part, name) && part.parts()[0] == z;
  };
  E in_w = f.replaced([&](const E& part) -> Maybe {
    if (is_at(part, "sin")) return w * cos;
    if (is_at(part, "tan")) return w;
    return std::nullopt;
  });
  in_w = in_w.replaced([&](const E& part) -> Maybe {
    const auto [inner, raised] = base_and_exponent(part);
    if (is_at(inner, "cos") && is_whole(raised) && raised.number().above() % 2 == 0)
      return power(1 + w * w, -raised / 2);
    return std::nullopt;
  });
  if (Maybe found = attempt(in_w / ((*line)[0] * (1 + w * w)), E::function("tan", z))) return found;
  const E half = 1 + w * w;
  in_w = f.replaced([&](const E& part) -> Maybe {
    if (is_at(part, "sin")) return 2 * w / half;
    if (is_at(part, "cos")) return (1 - w * w) / half;
    if (is_at(part, "tan")) return 2 * w / (1 - w * w);
    return std::nullopt;
  });
  return attempt(2 * in_w / ((*line)[0] * half), E::function("tan", z / 2));
}

/// Returns an antiderivative that is continuous where a linear function z vanishes, and f jumps or has a kink.
Maybe across(const E& f, const E& z, std::size_t x) {
  const auto line = linear(z, x);
  if (!line || !(*line)[0].is_constant() || !(*line)[1].is_constant()) return std::nullopt;
  const E root = -(*line)[1] / (*line)[0], size = E::function("abs", z), sign = E::function("sign", z);
  const auto [above, below] = continuations_of(f, z);
  const auto from_root = [&](const E& side) {
    Maybe found = antiderivative(side, x);
    if (!found) return found;
    const E there = found->with(x, root);
    return std::isfinite(there({0.37, 0.59, 0.71, 0.83})) ? Maybe(*found - there) : found;
  };
  const Maybe after = from_root(above);
  if (!after) return after;
  // If f is even or odd about the root, |z| stands for z.
  const E mirrored = below.with(x, 2 * root - E::variable(x)), sized = after->with(x, (size - (*line)[1]) / (*line)[0]);
  if (tidied(mirrored - above).is_zero()) return sign * sized;
  if (tidied(mirrored + above).is_zero()) return sized;
  const Maybe before = from_root(below);
  if (!before) return before;
  const E &A = *after, &B = *before;
  const E half = tidied((A - B) / 2), times = tidied(half / z);
  return tidied((A + B) / 2) + (times.is_constant() ? times * size : sign * half);
}

}  // namespace antiderivatives

std::optional<Expression> antiderivative(const Expression& f, std::size_t variable) {
  using namespace antiderivatives;
  try {
    const auto depends = [&](const E& z) { return z.has(variable); };
    // The search takes sign(z) for a number.
    if (std::ranges::none_of(signs_in(f), depends)) {
      if (Maybe found = Search()(f, variable)) return found;
    }
    const std::vector<E> borders = borders_in(f);
    const auto border = std::ranges::find_if(borders, depends);
    return border == borders.end() ? std::nullopt : across(f, *border, variable);
  } catch (const std::exception&) {
    return std::nullopt;  // a formula became too long
  }
}

}  // namespace contensou::answers
