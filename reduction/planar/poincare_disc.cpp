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

using Polynomials = std::vector<MatrixXd>;

int degree_of(const MatrixXd& polynomial) {
  int degree = 0;
  for (Eigen::Index i = 0; i < polynomial.rows(); ++i) {
    for (Eigen::Index j = 0; j < polynomial.cols(); ++j) {
      if (polynomial(i, j) != 0) degree = std::max(degree, static_cast<int>(i + j));
    }
  }
  return degree;
}

/// The function g(X) = w^d f(r X/w)/r with its Jacobian.
struct Homogenised {
  Polynomials coefficients;  ///< those of f in units of r
  int degree;

  struct Value {
    Vector2d g = Vector2d::Zero();
    Matrix2d slopes = Matrix2d::Zero();
  };

  Value operator()(const Vector2d& X) const {
    const double w = 1 - X.squaredNorm();
    const auto term = [](double base, int n) { return n < 0 ? 0 : std::pow(base, n); };
    Value value;
    for (int c : {0, 1}) {
      const MatrixXd& all = coefficients[static_cast<std::size_t>(c)];
      for (int i = 0; i < all.rows(); ++i) {
        for (int j = 0; j < all.cols(); ++j) {
          if (all(i, j) == 0) continue;
          const int k = degree - i - j;
          const double u = term(X[0], i), v = term(X[1], j), power = term(w, k);
          value.g[c] += all(i, j) * u * v * power;
          const double by_w = k * u * v * term(w, k - 1);
          value.slopes(c, 0) += all(i, j) * (i * term(X[0], i - 1) * v * power - 2 * X[0] * by_w);
          value.slopes(c, 1) += all(i, j) * (j * term(X[1], j - 1) * u * power - 2 * X[1] * by_w);
        }
      }
    }
    return value;
  }
};

/// Returns the field of a chart: the polynomials of u' and z' in u and z.
Polynomials chart_of(const Polynomials& f, int degree) {
  Polynomials chart(2, MatrixXd(MatrixXd::Zero(degree + 2, degree + 2)));
  for (int c : {0, 1}) {
    const MatrixXd& all = f[static_cast<std::size_t>(c)];
    for (int i = 0; i < all.rows(); ++i) {
      for (int j = 0; j < all.cols() && i + j <= degree; ++j) {
        const int k = degree - i - j;
        if (c == 0) chart[0](j + 1, k) -= all(i, j);
        if (c == 0) chart[1](j, k + 1) -= all(i, j);
        if (c == 1) chart[0](j, k) += all(i, j);
      }
    }
  }
  return chart;
}

SmoothField field_of(const Polynomials& polynomials) {
  const auto sum = [](const MatrixXd& all, const Vector2d& x, int by) {
    double value = 0;
    for (int i = 0; i < all.rows(); ++i) {
      for (int j = 0; j < all.cols(); ++j) {
        const int n = by == 0 ? i : by == 1 ? j : 1;  // factor of the derivative
        if (all(i, j) != 0 && n != 0) {
          value += n * all(i, j) * std::pow(x[0], i - (by == 0 ? 1 : 0)) * std::pow(x[1], j - (by == 1 ? 1 : 0));
        }
      }
    }
    return value;
  };
  return SmoothField([=](const Vector2d& x) { return Vector2d(sum(polynomials[0], x, 2), sum(polynomials[1], x, 2)); },
                     [=](const Vector2d& x) {
                       Matrix2d all;
                       for (int i : {0, 1}) {
                         for (int j : {0, 1}) all(i, j) = sum(polynomials[static_cast<std::size_t>(i)], x, j);
                       }
                       return all;
                     });
}

/// Returns the coefficients of f in another unit of length.
Polynomials in_units(Polynomials f, double length) {
  for (MatrixXd& each : f) {
    for (Eigen::Index i = 0; i < each.rows(); ++i) {
      for (Eigen::Index j = 0; j < each.cols(); ++j) each(i, j) *= std::pow(length, i + j - 1);
    }
  }
  return f;
}

/// Returns the equilibria on the circle in the order of their angles.
/// @param length  unit of length in the charts; the terms of low degree are seen well in one unit, and not in another
std::vector<Equilibrium> on_circle(const Polynomials& f, int degree, double length) {
  std::vector<Equilibrium> all;
  for (const double sign : {1., -1.}) {
    Polynomials turned = in_units(f, length);  // the field as seen in the coordinates -x
    for (MatrixXd& each : turned) {
      for (Eigen::Index i = 0; i < each.rows(); ++i) {
        for (Eigen::Index j = 0; j < each.cols(); ++j) each(i, j) *= (i + j) % 2 == 0 ? sign : 1;
      }
    }
    for (const bool exchanged : {false, true}) {
      if (exchanged) {
        std::swap(turned[0], turned[1]);
        for (MatrixXd& each : turned) each = each.transpose().eval();
      }
      constexpr double widest = 1.05, high = 1.05, same = 1e-9;
      for (Equilibrium& each :
           find_equilibria(field_of(chart_of(turned, degree)), {-widest, -high}, {widest, high}).points) {
        const double u = each.x[0];
        if (std::abs(each.x[1]) > same || std::abs(u) > (exchanged ? 1 - same : 1 + same)) continue;
        const Vector2d n = sign / std::hypot(1, u) * (exchanged ? Vector2d(u, 1) : Vector2d(1, u));
        const double c = 1 / std::hypot(1, u), rate = std::pow(c / length, degree - 1);
        Matrix2d onto;
        onto.col(0) = c * c * (exchanged ? -1 : 1) * Vector2d(-n[1], n[0]);
        onto.col(1) = -c / (2 * length) * n;
        each.x = n;
        each.slopes = rate * onto * each.slopes * onto.inverse();
        if (each.eigenvalues) {
          each.eigenvalues->first *= rate;
          each.eigenvalues->second *= rate;
        }
        all.push_back(each);
      }
    }
  }
  std::ranges::sort(all, {}, [](const Equilibrium& each) { return std::atan2(each.x[1], each.x[0]); });
  return all;
}

/// Returns true if f is 0 at x except for rounding: beside the circle, the field of the disc is small in many places.
bool vanishes(const SmoothField& field, const Vector2d& x) {
  Polynomials sizes = field.polynomials;
  for (MatrixXd& each : sizes) each = each.cwiseAbs();
  constexpr double small = 1e-7;  // a coordinate of 0 can be a smaller number
  return (field(x).cwiseAbs().array() <= small * field_of(sizes)(x.cwiseAbs().array() + small * x.norm()).array())
      .all();
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
  Homogenised g{field.polynomials, std::max(degree_of(field.polynomials[0]), degree_of(field.polynomials[1]))};
  if (std::ranges::all_of(g.coefficients, [](const MatrixXd& each) { return each.isZero(0); })) {
    throw std::domain_error("the Poincaré disc needs a field that is not 0");
  }
  g.coefficients = in_units(g.coefficients, radius);
  const auto value = [g](const Vector2d& X) -> Vector2d {
    const Vector2d at = g(X).g;
    return at - 2 * X.dot(at) / (1 + X.squaredNorm()) * X;
  };
  const auto jacobian = [g](const Vector2d& X) -> Matrix2d {
    const auto [at, slopes] = g(X);
    const double one = 1 + X.squaredNorm(), inner = X.dot(at);
    return slopes - 2 / one * (inner * Matrix2d::Identity() + X * (at + slopes.transpose() * X).transpose()) +
           4 * inner / (one * one) * X * X.transpose();
  };
  const auto plain = [g](const Vector2d& X) -> Vector2d { return g(X).g; };
  PoincareDisc disc{g.degree, radius, SmoothField(value, jacobian), SmoothField(plain), {}, {}};

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
    const double rate = std::pow(w, 1 - g.degree);  // ds/dt
    each.slopes *= rate;
    if (each.eigenvalues) {
      each.eigenvalues->first *= rate;
      each.eigenvalues->second *= rate;
    }
    disc.equilibria.points.push_back(each);
  }
  const std::optional<int> finite = sum;
  for (const double length : {1., 1. / 8, 8.}) {
    std::vector<Equilibrium> found = on_circle(g.coefficients, g.degree, length);
    sum = finite;
    for (const Equilibrium& each : found) count(each, 1);
    disc.equilibria.complete = sum == 2 || disc.equilibria.on_curve;
    if (disc.equilibria.complete || found.size() > disc.at_infinity.size()) disc.at_infinity = std::move(found);
    if (disc.equilibria.complete) break;
  }
  return disc;
}

}  // namespace contensou::reduction
