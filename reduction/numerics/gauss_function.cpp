// Notation: F(x) = 2F1(a, b; c; x), y = 1 - x. F satisfies an equation that has the same form in y if c is replaced by
// a + b + 1 - c:   x (1 - x) F'' + [c - (a + b + 1) x] F' - a b F = 0
// Taylor coefficients f_n about a point x, starting with f_0 = F, f_1 = F':
//   x (1 - x) (n + 1)(n + 2) f_(n+2) = (n + a)(n + b) f_n - (n + 1) [n (1 - 2 x) + c - (a + b + 1) x] f_(n+1)
// The half width of panel j, 2^-(j+2) to 2^-(j+1), is a third of the distance from its centre to the singular point.
#include "numerics/gauss_function.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace contensou::reduction {

namespace {

/// A solution F of the equation, given by its value and slope at one point.
struct Continuation {
  static constexpr int terms = 48;

  Wide a;
  Wide b;
  Wide c;
  Wide x;
  Wide value;
  Wide slope;

  /// Returns the Taylor coefficients in powers of (distance/unit).
  std::array<Wide, terms> series(Wide unit) const {
    std::array<Wide, terms> f{value, slope * unit};
    for (int i = 0; i + 2 < terms; ++i) {
      const auto n = static_cast<Wide>(i);
      const Wide damping = n * (1 - 2 * x) + c - (a + b + 1) * x;
      f[i + 2] =
          unit * ((n + a) * (n + b) * unit * f[i] - (n + 1) * damping * f[i + 1]) / (x * (1 - x) * (n + 1) * (n + 2));
    }
    return f;
  }

  void move_to(Wide target) {
    const Wide unit = target - x;
    const auto f = series(unit);
    Wide sum = 0;
    Wide weighted = 0;
    for (int n = terms - 1; n > 0; --n) {
      sum += f[n];
      weighted += static_cast<Wide>(n) * f[n];
    }
    value += sum;
    slope = weighted / unit;
    x = target;
  }

  /// Returns the series of the panel from this point to `end`, in powers of the panel's half width, and moves to `end`.
  GaussFunction::Panel cross_to(Wide end) {
    const Wide half = std::abs(end - x) / 2;
    move_to((x + end) / 2);
    const auto f = series(half);
    GaussFunction::Panel panel{};
    std::transform(f.begin(), f.begin() + panel.size(), panel.begin(),
                   [](Wide term) { return static_cast<double>(term); });
    move_to(end);
    return panel;
  }
};

double polynomial(std::span<const double> coefficients, double t) {
  double sum = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) sum = sum * t + *c;
  return sum;
}

/// Returns the value at x by the panel that contains x, or by the nearest panel outside [2^-(panels + 1), 1/2].
double on_panel(std::span<const GaussFunction::Panel> panels, double x) {
  const int last = static_cast<int>(panels.size()) - 1;
  const int panel = x > 0 ? std::clamp(-std::ilogb(x) - 2, 0, last) : last;
  const double right = std::ldexp(1.0, -(panel + 1));
  return polynomial(panels[static_cast<std::size_t>(panel)], std::max((x - 0.75 * right) / (0.25 * right), -1.0));
}

}  // namespace

GaussFunction::GaussFunction(Wide a, Wide b, Wide c) {
  // The terms grow with n if (|a| + n)(|b| + n) x exceeds (c + n)(1 + n).
  while (std::max(std::abs(a), std::abs(b)) > std::ldexp(2 * std::max(c, Wide{1}), near_exponent_)) ++near_exponent_;

  Continuation at{a, b, c, std::ldexp(Wide{1}, -near_exponent_), 0, 0};
  constexpr int many = 160;  // number of terms of the series at 0, for the first value
  Wide coefficient = 1;
  Wide power = 1;  // x^n
  for (int i = 0; i < many; ++i) {
    const auto n = static_cast<Wide>(i);
    if (i < near_terms) near_[static_cast<std::size_t>(i)] = static_cast<double>(coefficient);
    at.value += coefficient * power;
    at.slope += n * coefficient * power / at.x;
    coefficient *= (a + n) * (b + n) / ((c + n) * (1 + n));
    power *= at.x;
  }
  while (at.x < 0.5) middle_.insert(middle_.begin(), at.cross_to(2 * at.x));

  at = {a, b, a + b + 1 - c, 0.5, at.value, -at.slope};
  while (far_.size() < far_panels) far_.push_back(at.cross_to(at.x / 2));
}

double GaussFunction::operator()(double x, double y) const {
  if (x <= std::ldexp(1.0, -near_exponent_)) return polynomial(near_, x);
  return x <= 0.5 ? on_panel(middle_, x) : on_panel(far_, y);
}

double GaussFunction::deficit(double x, double y) const {
  if (x <= std::ldexp(1.0, -near_exponent_)) return -polynomial(std::span(near_).subspan(1), x);
  return (1 - (*this)(x, y)) / x;
}

}  // namespace contensou::reduction
