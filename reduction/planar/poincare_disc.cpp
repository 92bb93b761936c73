// The Poincaré disc of a polynomial field.
//
// On the disc, X = x/r (1 - |X|^2): with w = 1 - |X|^2 and rho = |X|, |x|/r = rho/(1 - rho^2) grows from 0 to infinity.
// Radial and angular parts of x' = f give rho' = w^2/(1 + rho^2) f_r/r and theta' = w/rho f_theta/r. The time s with
// ds = w^(1 - d) dt makes both finite, because g = w^d f(r X/w)/r is a polynomial in X:
//
//     dX/ds = g - 2 (X . g)/(1 + rho^2) X.    (R70)
//
// At rho = 1 the right side is g - (X . g) X, the tangential part of the terms of degree d. So the circle is an orbit,
// or consists of orbits and equilibria. The radial eigenvalue of an equilibrium there is -(X . g). Beyond the circle
// (R70) is the field at the opposite point, in reversed time for an even d, as on Poincaré's sphere.
//
// Equilibria on the circle are sought in Poincaré's charts, in which they are exact: x = 1/z, y = u/z gives, with
// ds' = z^(1 - d) dt and f* = z^d f(1/z, u/z), the polynomial field
//
//     u' = f*_2 - u f*_1,    z' = -z f*_1,
//
// and the chart y = 1/z, x = u/z is this one for exchanged axes. At the angle theta, with c = cos theta, the disc is
// dtheta = c^2 du, drho = -(c/2) dz, and ds'/ds = c^(d - 1).
// Source: L. Perko, Differential Equations and Dynamical Systems, section 3.10.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <Eigen/LU>

#include "contensou/reduction/planar_reduction.hpp"
#include "planar/degenerate_point.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;

namespace {

using Slopes = Eigen::Matrix<double, 2, 3>;

/// The homogeneous polynomials f*(u, v, w) = w^d f(u/w, v/w).
struct HomogeneousField {
  struct Term {
    int component, i, j, k;  ///< exponents of u, v and w
    double factor;
  };
  std::vector<Term> terms = {};
  int degree = 0;

  /// @param unit       unit of length; a negative one reverses both axes
  /// @param exchanged  true: u and v are exchanged
  HomogeneousField(const SmoothField& field, double unit, bool exchanged = false) {
    for (int c : {0, 1}) {
      const MatrixXd& all = field.polynomials[static_cast<std::size_t>(c)];
      for (int i = 0; i < all.rows(); ++i) {
        for (int j = 0; j < all.cols(); ++j) {
          if (all(i, j) == 0) continue;
          terms.push_back(
              {exchanged ? 1 - c : c, exchanged ? j : i, exchanged ? i : j, 0, all(i, j) * std::pow(unit, i + j - 1)});
          degree = std::max(degree, i + j);
        }
      }
    }
    for (Term& term : terms) term.k = degree - term.i - term.j;
  }

  /// @param slopes  if given, receives the derivatives by u, v and w
  Vector2d operator()(double u, double v, double w, Slopes* slopes = nullptr) const {
    const auto power = [](double base, int n) {
      double product = n < 0 ? 0 : 1;
      for (; n > 0; --n) product *= base;
      return product;
    };
    Vector2d f(0, 0);
    if (slopes != nullptr) slopes->setZero();
    for (const auto& [c, i, j, k, factor] : terms) {
      const double by_u = power(u, i), by_v = power(v, j), by_w = power(w, k);
      f[c] += factor * by_u * by_v * by_w;
      if (slopes == nullptr) continue;
      (*slopes)(c, 0) += factor * i * power(u, i - 1) * by_v * by_w;
      (*slopes)(c, 1) += factor * j * power(v, j - 1) * by_u * by_w;
      (*slopes)(c, 2) += factor * k * power(w, k - 1) * by_u * by_v;
    }
    return f;
  }
};

/// Multiplies the rates of the motions about an equilibrium.
void hasten(Equilibrium& each, double factor) {
  each.slopes *= factor;
  if (!each.eigenvalues) return;
  each.eigenvalues->first *= factor;
  each.eigenvalues->second *= factor;
}

/// Returns the equilibria on the circle in the order of their angles.
/// @param unit    unit of length of the disc
/// @param length  unit of length in the charts, in units of the disc; the terms of low degree are seen well in one
/// unit,
///                and not in another
std::vector<Equilibrium> on_circle(const SmoothField& field, double unit, double length) {
  std::vector<Equilibrium> all;
  for (const double sign : {1., -1.}) {
    for (const bool exchanged : {false, true}) {
      const HomogeneousField f(field, sign * length * unit, exchanged);
      const auto value = [f](const Vector2d& x) {
        const Vector2d at = f(1, x[0], x[1]);
        return Vector2d(at[1] - x[0] * at[0], -x[1] * at[0]);
      };
      const auto jacobian = [f](const Vector2d& x) {
        Slopes slopes;
        const double first = f(1, x[0], x[1], &slopes)[0];
        Matrix2d chart = -x * slopes.rightCols<2>().row(0) - first * Matrix2d::Identity();
        chart.row(0) += slopes.rightCols<2>().row(1);
        return chart;
      };
      constexpr double widest = 1.05, same = 1e-9;
      const Vector2d corner(widest, widest);
      for (Equilibrium& each : find_equilibria(SmoothField(value, jacobian), -corner, corner).points) {
        const double u = each.x[0];
        if (std::abs(each.x[1]) > same || std::abs(u) > (exchanged ? 1 - same : 1 + same)) continue;
        const double c = 1 / std::hypot(1, u);
        each.x = sign * c * (exchanged ? Vector2d(u, 1) : Vector2d(1, u));
        Matrix2d onto;
        onto << c * c * (exchanged ? -1 : 1) * Vector2d(-each.x[1], each.x[0]), -c / (2 * length) * each.x;
        each.slopes = onto * each.slopes * onto.inverse();
        hasten(each, std::pow(c / length, f.degree - 1));
        all.push_back(each);
      }
    }
  }
  std::ranges::sort(all, {}, [](const Equilibrium& each) { return std::atan2(each.x[1], each.x[0]); });
  return all;
}

/// Returns true if the terms of degree d have no part across any direction. Their part across is a polynomial of degree
/// d + 1 in the tangent of the angle, so d + 2 directions decide.
bool rests_on_circle(const HomogeneousField& f) {
  constexpr double rounding = 1e-12;
  double largest = 0, across = 0;
  for (int i = 0; i < f.degree + 2; ++i) {
    const double angle = std::numbers::pi * (i + 0.3) / (f.degree + 2);
    const Vector2d n(std::cos(angle), std::sin(angle)), at = f(n[0], n[1], 0);
    largest = std::max(largest, at.norm());
    across = std::max(across, std::abs(n[0] * at[1] - n[1] * at[0]));
  }
  return across <= rounding * largest;
}

/// Returns true if f is 0 at x except for rounding: beside the circle, the field of the disc is small in many places.
bool vanishes(const SmoothField& field, const Vector2d& x) {
  HomogeneousField sizes(field, 1);
  for (HomogeneousField::Term& term : sizes.terms) term.factor = std::abs(term.factor);
  constexpr double small = 1e-7;  // a coordinate of 0 can be a smaller number
  const Vector2d at = x.cwiseAbs().array() + small * x.norm();
  return (field(x).cwiseAbs().array() <= small * sizes(at[0], at[1], 1).array()).all();
}

}  // namespace

Vector2d PoincareDisc::onto(const Vector2d& x) const {
  const Vector2d y = x / radius;
  return 2 * y / (1 + std::hypot(1, 2 * y.norm()));
}

Vector2d PoincareDisc::from(const Vector2d& X) const { return radius / (1 - X.squaredNorm()) * X; }

PoincareDisc poincare_disc(const SmoothField& field, double radius) {
  if (field.polynomials.size() != 2) {
    throw std::domain_error("the Poincaré disc needs a field whose components are polynomials");
  }
  if (!(radius > 0) || !std::isfinite(radius)) {
    throw std::domain_error(fmt::format("the radius of the Poincaré disc must be positive and finite, got {}", radius));
  }
  const HomogeneousField f(field, radius);
  if (f.terms.empty()) throw std::domain_error("the Poincaré disc needs a field that is not 0");
  const auto plain = [f](const Vector2d& X) { return f(X[0], X[1], 1 - X.squaredNorm()); };
  const auto value = [plain](const Vector2d& X) -> Vector2d {
    const Vector2d g = plain(X);
    return g - 2 * X.dot(g) / (1 + X.squaredNorm()) * X;
  };
  const auto jacobian = [f](const Vector2d& X) -> Matrix2d {
    Slopes by;
    const Vector2d g = f(X[0], X[1], 1 - X.squaredNorm(), &by);
    const Matrix2d slopes = by.leftCols<2>() - 2 * by.col(2) * X.transpose();
    const double one = 1 + X.squaredNorm(), inner = X.dot(g);
    return slopes - 2 / one * (inner * Matrix2d::Identity() + X * (g + slopes.transpose() * X).transpose()) +
           4 * inner / (one * one) * X * X.transpose();
  };
  PoincareDisc disc{f.degree, radius, SmoothField(value, jacobian), SmoothField(plain), rests_on_circle(f), {}, {}};

  constexpr double around = 1.05;
  disc.equilibria = find_equilibria(disc.field, Vector2d::Constant(-around), Vector2d::Constant(around));
  std::optional<int> sum = 0;
  const auto count = [&](const Equilibrium& each, int times) {
    sum = sum && each.index ? std::optional(*sum + times * *each.index) : std::nullopt;
  };
  for (Equilibrium& each : std::exchange(disc.equilibria.points, {})) {
    constexpr double snap = 2e-9;
    const double w = 1 - each.x.squaredNorm();
    if (w <= 0 || !vanishes(field, disc.from(each.x))) continue;
    each.x = disc.onto(few_decimals(field, disc.from(each.x), Vector2d::Constant(radius), snap).value());
    count(each, 2);
    hasten(each, std::pow(w, 1 - f.degree));  // ds/dt
    disc.equilibria.points.push_back(each);
  }
  // The field of the disc is small beside the circle, where the field of the plane is not.
  const Vector2d corner = Vector2d::Constant(2 * radius);
  std::optional<Vector2d>& curve = disc.equilibria.on_curve = find_equilibria(field, -corner, corner).on_curve;
  if (curve) curve = disc.onto(*curve);
  const std::optional<int> finite = sum;
  for (const double length : {1., 1. / 8, 8.}) {
    std::vector<Equilibrium> found = on_circle(field, radius, length);
    sum = finite;
    for (const Equilibrium& each : found) count(each, 1);
    const bool enough = disc.rests || curve || sum == 2;
    if (enough || found.size() > disc.at_infinity.size()) disc.at_infinity = std::move(found);
    if (!disc.rests && !curve) disc.equilibria.complete = enough && f.degree < TaylorPolynomial::degree;
    if (enough) break;
  }
  return disc;
}

}  // namespace contensou::reduction
