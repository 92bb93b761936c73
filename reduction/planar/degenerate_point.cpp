// Kinds of isolated zeros with a singular Jacobian, from the Taylor polynomial g of the field in a small disc.
//
// One direction. Let the Jacobian L have the singular values s1 > s2 = 0: L v1 = s1 u1, L v2 = 0. On the curve
// z(s) = s v2 + w(s) v1 with u1 . g = 0 the field is h(s) u2, h = a s^m + ... (method of Lyapunov and Schmidt). The
// order m and the sign of a do not depend on the curve: two curves on which the rest of g is of order m differ by that
// order, and h changes by the order m + 1. A shift of s by -h_{m-1}/(m h_m) moves s = 0 onto the m-fold zero. Both the
// zero found and the Jacobian there are accurate only to the m-th root of rounding; the shifted zero is accurate.
//
// (a) The other eigenvalue is the divergence d(0) = r, not 0. The left null vector is u2/(u2 . v2), so the motion on
// the centre manifold is s' = a/(u2 . v2) s^m + ..., to which the motion across is added with the rate r. For even m
// the motion along comes from one side and leaves on the other: a saddle-node. For odd m both sides agree: a node if
// the signs of s' / s and of r agree, else a saddle.
//
// (b) r = 0. With X = v2 . z and Y = X' the field is X' = Y, Y' = A(X) + B(X) Y + O(Y^2), where on the curve X' = 0
// A = s1 (v2 . u1) (v1 . u2) h and B = d(s) + O(A). The terms have the weights (m + 1)/2 for Y if X has the weight 1.
// The term b X^k Y belongs to the principal part if m = 2 k + 1, and Y^2 never does. A term of B of lower order than
// (m - 1)/2 lies below the principal part, so that this part does not decide.
//
// If L = 0, the weights are sought for which the terms of least weight contain a power of z1 alone and a power of z2
// alone. Without these powers the zero of the principal part is not isolated.
//
// A principal part is invariant under the scaling of its weights, so PlanarReduction classifies it. If all its rays are
// simple and points move on them, or if orbits turn and a turn multiplies by a factor other than 1, the terms of higher
// weight do not change the kind.
//
// Imaginary eigenvalues. Let J q = i omega q, J^T p = -i omega p and conj(p) . q = 1. The coordinate z = conj(p) . x
// has z' = i omega z + g20 z^2/2 + g11 z conj(z) + ... + g21 z^2 conj(z)/2. On a turn |z| grows by the rate l |z|^2
// with l = omega l1 > 0 or < 0, l1 = Re(i g20 g11 + omega g21)/(2 omega^2): the first Lyapunov coefficient. Source:
// Y. Kuznetsov, Elements of Applied Bifurcation Theory, section 3.5.
#include "planar/degenerate_point.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <Eigen/LU>

#include "contensou/reduction/planar_reduction.hpp"
#include "numerics/decomposition.hpp"
#include "numerics/epsilon.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;

namespace {

Series product_of(const Series& a, const Series& b) {
  Series c = Series::Zero();
  for (int i = 0; i < c.size(); ++i) {
    if (a[i] != 0) c.tail(c.size() - i) += a[i] * b.head(c.size() - i);
  }
  return c;
}

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

/// The points of a fit, and the matrix that makes coefficients of values at these points.
struct TaylorFit {
  std::vector<Vector2d> points;
  MatrixXd powers, inverse;
  std::array<double, TaylorPolynomial::degree + 1>
      gain{};  ///< largest factor from values to coefficients, for each degree

  TaylorFit() {
    // A polynomial of degree n is fixed by n/2 + 1 rings with 2 n + 1 points each. One more ring makes the fit even.
    constexpr int n = TaylorPolynomial::degree, rings = n / 2 + 2, around = 2 * n + 1;
    for (int ring = 0; ring < rings; ++ring) {
      const double radius = std::cos(std::numbers::pi * ring / (2 * rings));
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * (i + ring * std::numbers::phi) / around;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      }
    }
    powers.resize(std::ssize(points), TaylorPolynomial::terms);
    for (Eigen::Index row = 0; row < powers.rows(); ++row) {
      const Vector2d& z = points[static_cast<std::size_t>(row)];
      for (int d = 0; d <= n; ++d) {
        for (int j = 0; j <= d; ++j) {
          powers(row, static_cast<Eigen::Index>(TaylorPolynomial::place(d - j, j))) =
              std::pow(z[0], d - j) * std::pow(z[1], j);
        }
      }
    }
    const SingularValues svd(powers);
    inverse = product(MatrixXd(svd.V * svd.values.cwiseInverse().asDiagonal()), MatrixXd(svd.U.transpose()));
    for (int d = 0; d <= n; ++d) {
      const auto of_degree = static_cast<std::size_t>(d);
      for (int j = 0; j <= d; ++j) {
        const auto row = static_cast<Eigen::Index>(TaylorPolynomial::place(d - j, j));
        gain[of_degree] = std::max(gain[of_degree], inverse.row(row).lpNorm<1>());
      }
    }
  }
};

const TaylorFit& fit() {
  static const TaylorFit points;
  return points;
}

}  // namespace

Series TaylorPolynomial::at(const Series& first, const Series& second) const {
  Series sum = Series::Zero(), power = Series::Zero();
  power[0] = 1;  // power is first^i
  for (int i = 0; i <= degree; ++i) {
    Series inner = Series::Zero();
    for (int j = degree - i; j >= 0; --j) {
      inner = product_of(inner, second);
      inner[0] += (*this)(i, j);
    }
    sum += product_of(power, inner);
    power = product_of(power, first);
  }
  return sum;
}

TaylorPolynomial TaylorPolynomial::derivative(int variable) const {
  TaylorPolynomial result;
  for (int d = 0; d < degree; ++d) {
    for (int j = 0; j <= d; ++j) {
      const int i = d - j;
      result(i, j) = variable == 0 ? (i + 1) * (*this)(i + 1, j) : (j + 1) * (*this)(i, j + 1);
    }
  }
  return result;
}

TaylorPolynomial TaylorPolynomial::shifted(const Vector2d& shift) const {
  TaylorPolynomial result;
  for (int d = 0; d <= degree; ++d) {
    for (int j = 0; j <= d; ++j) {
      for (int a = 0; a <= d - j; ++a) {
        for (int b = 0; b <= j; ++b) {
          result(a, b) += (*this)(d - j, j) * binomial(d - j, a) * binomial(j, b) * std::pow(shift[0], d - j - a) *
                          std::pow(shift[1], j - b);
        }
      }
    }
  }
  return result;
}

double TaylorPolynomial::largest(int of_degree) const {
  double size = 0;
  for (int j = 0; j <= of_degree; ++j) size = std::max(size, std::abs((*this)(of_degree - j, j)));
  return size;
}

Series shifted(const Series& a, double shift) {
  Series result = Series::Zero();
  for (int i = static_cast<int>(a.size()) - 1; i >= 0; --i) {  // Horner's rule in s + shift
    Series next = shift * result;
    next.tail(a.size() - 1) += result.head(a.size() - 1);
    next[0] += a[i];
    result = next;
  }
  return result;
}

double Taylor::error(int of_degree) const {
  return fit().gain[static_cast<std::size_t>(of_degree)] * std::max(misfit, 4 * eps * size);
}

std::optional<Taylor> taylor(const PlanarField& field, const Vector2d& centre, const Vector2d& radii) {
  const TaylorFit& points = fit();
  MatrixXd values(points.powers.rows(), 2);
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const auto f = value_of(field, centre + radii.cwiseProduct(points.points[static_cast<std::size_t>(row)]));
    if (!f) return std::nullopt;
    values.row(row) = f->cwiseQuotient(radii).transpose();
  }
  const MatrixXd coefficients = product(points.inverse, values);
  const MatrixXd misfit = values - product(points.powers, coefficients);
  Taylor result{{}, values.cwiseAbs().maxCoeff(), misfit.cwiseAbs().maxCoeff()};
  for (int component = 0; component < 2; ++component) {
    auto& polynomial = result.g[static_cast<std::size_t>(component)];
    for (Eigen::Index i = 0; i < coefficients.rows(); ++i) {
      polynomial.coefficients[static_cast<std::size_t>(i)] = coefficients(i, component);
    }
  }
  if (!std::isfinite(result.size) || result.size == 0) return std::nullopt;
  return result;
}

namespace {

constexpr int degree = TaylorPolynomial::degree, highest = degree - 1;
constexpr double margin = 8;         ///< factor of all bounds of errors
constexpr int steps = 4;             ///< steps of Newton's method for the shift of the centre
constexpr double significant = 1e3;  ///< a coefficient counts if it is this many times as large as its error
constexpr double farthest = 0.3;     ///< largest shift of the centre, in radii of the disc

/// The field along the curve z(s) of the comment above.
struct AlongCurve {
  Vector2d u1, u2, v1, v2;
  double s1;
  Series w, h, divergence;
  double wide;  ///< largest coefficient of w from s^2 on
};

Matrix2d linear_part(const Taylor& t) {
  return (Matrix2d() << t.g[0](1, 0), t.g[0](0, 1), t.g[1](1, 0), t.g[1](0, 1)).finished();
}

AlongCurve along_curve(const Taylor& t) {
  const SingularValues svd(linear_part(t));
  AlongCurve c{svd.U.col(0), svd.U.col(1), svd.V.col(0), svd.V.col(1), svd.values[0], Series::Zero(), {}, {}, 0};
  Series s = Series::Zero();
  s[1] = 1;
  const auto at = [&](const TaylorPolynomial& p) {
    return p.at(c.v2[0] * s + c.v1[0] * c.w, c.v2[1] * s + c.v1[1] * c.w);
  };
  for (int i = 0; i < degree + 2; ++i) c.w -= (c.u1[0] * at(t.g[0]) + c.u1[1] * at(t.g[1])) / c.s1;
  c.h = c.u2[0] * at(t.g[0]) + c.u2[1] * at(t.g[1]);
  c.divergence = at(t.g[0].derivative(0)) + at(t.g[1].derivative(1));
  c.wide = c.w.tail(degree - 1).abs().maxCoeff();
  return c;
}

/// A multiple zero of the Taylor polynomial.
struct Multiple {
  int order;
  Vector2d shift;     ///< from the centre of the disc, in radii
  double known;       ///< error of the shift
  double s = 0;       ///< place on the curve
  bool fixed = true;  ///< false if the terms of least degree do not fix the place in both directions
};

std::optional<Multiple> multiple_zero(const Taylor& t, const AlongCurve& c) {
  const auto error = [&](int k) { return margin * t.error(k); };
  for (int m = highest; m >= 2; --m) {
    if (!(std::abs(c.h[m]) > significant * error(m))) continue;
    double s = 0;
    Series there = c.h;
    for (int step = 0; step < steps && std::abs(s) <= farthest; ++step) {
      s -= there[m - 1] / (m * there[m]);
      there = shifted(c.h, s);
    }
    bool multiple = std::abs(s) <= farthest;
    for (int k = 0; k < m; ++k) multiple &= std::abs(there[k]) <= error(k);
    if (!multiple) continue;
    double across = 0;
    for (int k = degree; k >= 0; --k) across = across * s + c.w[k];
    return Multiple{m, s * c.v2 + across * c.v1, error(m - 1) / (m * std::abs(there[m])), s};
  }
  return std::nullopt;
}

/// Returns the multiple zero if the Jacobian is 0 there, and the least degree of the terms.
std::optional<Multiple> multiple_zero(const Taylor& t) {
  const auto error = [&](int k) { return margin * t.error(k); };
  const auto largest = [](const std::array<TaylorPolynomial, 2>& g, int k) {
    return std::max(g[0].largest(k), g[1].largest(k));
  };
  for (int m = highest; m >= 2; --m) {
    const double size = largest(t.g, m);
    if (!(size > significant * error(m))) continue;
    Vector2d shift(0, 0);
    Eigen::Index rank = 2;
    std::array there = t.g;
    for (int step = 0; step < steps && shift.norm() <= farthest; ++step) {
      MatrixXd slopes(2 * m, 2), values(2 * m, 1);
      for (int component = 0; component < 2; ++component) {
        const auto& g = there[static_cast<std::size_t>(component)];
        for (int j = 0; j < m; ++j) {
          const int row = component * m + j, i = m - 1 - j;
          slopes.row(row) << (i + 1) * g(i + 1, j), (j + 1) * g(i, j + 1);
          values(row, 0) = -g(i, j);
        }
      }
      const SingularValues svd(slopes);
      rank = (svd.values.array() > significant * error(m)).count();
      shift += svd.solution(values.col(0), rank);
      there = {t.g[0].shifted(shift), t.g[1].shifted(shift)};
    }
    bool multiple = shift.norm() <= farthest;
    for (int k = 0; k < m; ++k) multiple &= largest(there, k) <= error(k);
    if (multiple) return Multiple{m, shift, error(m - 1) / size, 0, rank == 2};
  }
  return std::nullopt;
}

/// Returns the kind of the zero of a principal part, or "degenerate".
/// @param p, q    weights of u and v
/// @param weight  weight of the field: f(exp(p s) u, exp(q s) v) = exp(weight s) (exp(p s) u', exp(q s) v')
std::string_view kind_of_principal_part(const PlanarField& field, double p, double q, double weight) {
  const double largest = std::max({p, q, std::abs(weight)});
  const Generator scaling{-weight / largest, Vector2d(p / largest, q / largest).asDiagonal(), Vector2d(0, 0)};
  try {
    const PlanarReduction plane(field, scaling, Vector2d(1, 0.7));
    if (plane.turn() != nullptr) {
      constexpr double certain = 1e-6;
      return std::abs(plane.turn()->factor - 1) > certain ? plane.kind() : planar_kind("center or focus");
    }
    constexpr double moving = 1e-9;
    const bool simple = std::ranges::all_of(
        plane.rays(), [](const PlanarRay& ray) { return ray.order == 1 && std::abs(ray.radial) > moving; });
    const std::string_view kind = plane.kind();
    if (!plane.rays().empty() && simple && !kind.empty() && kind != "bordered") return kind;
  } catch (const std::domain_error&) {
    // The rays are not decided.
  }
  return planar_kind("degenerate");
}

/// Rule (b) for a Jacobian that is not 0: the principal part u' = v, v' = a u^m + b u^k v, in units in which |a| = 1.
std::string_view kind_of_nilpotent(double a, int m, double b, int k) {
  const double sign = std::copysign(1, a), damping = b / std::sqrt(std::abs(a));
  const auto field = [=](const Vector2d& x) {
    const double power = std::pow(x[0], k);
    return Vector2d(x[1], sign * std::pow(x[0], m) + (damping == 0 ? 0 : damping * power * x[1]));
  };
  return kind_of_principal_part(field, 2, m + 1, m - 1);
}

/// Rule (b) for the Jacobian 0.
std::string_view kind_of_principal_part(const Taylor& t, const Multiple& zero) {
  struct Term {
    int component, i, j;
    double factor;
    bool counts;  ///< false: it is not known whether the term is 0
  };
  std::vector<Term> terms;
  for (int component = 0; component < 2; ++component) {
    const TaylorPolynomial there = t.g[static_cast<std::size_t>(component)].shifted(zero.shift);
    for (int d = zero.order; d <= highest; ++d) {
      for (int j = 0; j <= d; ++j) {
        const double factor = there(d - j, j), error = margin * t.error(d);
        if (std::abs(factor) <= error) continue;
        terms.push_back({component, d - j, j, factor, std::abs(factor) > significant * error});
      }
    }
  }
  for (int p = 1; p <= highest; ++p) {
    for (int q = 1; q <= highest; ++q) {
      if (std::gcd(p, q) != 1) continue;
      const auto weight = [=](const Term& term) {
        return p * (term.i - (term.component == 0)) + q * (term.j - (term.component == 1));
      };
      const auto least = std::ranges::min_element(terms, {}, weight);
      if (least == terms.end()) return planar_kind("degenerate");
      std::vector<Term> part;
      std::ranges::copy_if(terms, std::back_inserter(part), [&](const Term& x) { return weight(x) == weight(*least); });
      const bool known = std::ranges::all_of(part, &Term::counts);
      const bool of_u = std::ranges::any_of(part, [](const Term& x) { return x.j == 0; });
      const bool of_v = std::ranges::any_of(part, [](const Term& x) { return x.i == 0; });
      if (!known || !of_u || !of_v) continue;
      double largest = 0;
      for (const Term& term : part) largest = std::max(largest, std::abs(term.factor));
      const auto field = [=](const Vector2d& x) {
        Vector2d f(0, 0);
        for (const Term& term : part) {
          f[term.component] += term.factor / largest * std::pow(x[0], term.i) * std::pow(x[1], term.j);
        }
        return f;
      };
      return kind_of_principal_part(field, p, q, weight(*least));
    }
  }
  return planar_kind("degenerate");
}

/// A Taylor polynomial that gives the field to about rounding, and its curve if the Jacobian is not 0.
struct Local {
  Taylor taylor;
  std::optional<AlongCurve> curve;
  double radius;

  std::optional<Multiple> zero() const { return curve ? multiple_zero(taylor, *curve) : multiple_zero(taylor); }
};

/// Returns the Taylor polynomial in the largest disc in which it is accurate.
/// @param radius  the largest radius that is tried; afterwards the radius of the disc
std::optional<Taylor> accurate_taylor(const PlanarField& field, const Vector2d& x, const Vector2d& radii,
                                      double& radius) {
  constexpr double accurate = 1e-12, smallest = 1e-3;
  for (; radius > smallest; radius /= 2) {
    const auto t = taylor(field, x, radius * radii);
    if (t && !(t->misfit > accurate * t->size)) return t;
  }
  return std::nullopt;
}

/// Returns an accurate polynomial whose curve, if there is one, is not steep.
/// @param radius  the largest radius of the disc
std::optional<Local> local_polynomial(const PlanarField& field, const Vector2d& x, const Vector2d& radii,
                                      double radius) {
  constexpr double zero = 1e-5, steepest = 2;
  for (; const auto t = accurate_taylor(field, x, radii, radius); radius /= 2) {
    if (linear_part(*t).norm() <= zero * t->size) return Local{*t, {}, radius};
    AlongCurve curve = along_curve(*t);
    if (curve.wide <= steepest) return Local{*t, std::move(curve), radius};
  }
  return std::nullopt;
}

/// Returns the kind of the multiple zero at the centre of the polynomial.
DegeneratePoint classified(const Local& local, const Vector2d& x, const Multiple& zero) {
  DegeneratePoint point{x, planar_kind("degenerate"), 0};
  const Taylor& t = local.taylor;
  const int m = zero.order;
  if (!local.curve) {
    point.kind = kind_of_principal_part(t, zero);
    return point;
  }
  const AlongCurve& c = *local.curve;
  const Series h = shifted(c.h, zero.s), divergence = shifted(c.divergence, zero.s);
  const double a = h[m], rate = divergence[0];
  const auto error = [&](int k) {
    return margin * ((k + 1) * t.error(k + 1) + std::abs(divergence[k + 1]) * (k + 1) * zero.known);
  };
  if (std::abs(rate) > significant * error(0)) {
    point.rate = rate;
    const double along = a / c.u2.dot(c.v2);
    point.kind = m % 2 == 0         ? planar_kind("saddle-node")
                 : along * rate < 0 ? planar_kind("saddle")
                 : rate < 0         ? planar_kind("stable node")
                                    : planar_kind("unstable node");
    return point;
  }
  if (std::abs(rate) > error(0)) return point;
  for (int k = 1; 2 * k + 1 < m; ++k) {
    if (std::abs(divergence[k]) > error(k)) return point;
  }
  const int k = (m - 1) / 2;
  const bool part = m % 2 == 1 && std::abs(divergence[k]) > error(k);
  point.kind = kind_of_nilpotent(c.s1 * c.v2.dot(c.u1) * c.v1.dot(c.u2) * a, m, part ? divergence[k] : 0, k);
  return point;
}

}  // namespace

int lyapunov_sign(const PlanarField& field, const Vector2d& x, const Vector2d& radii) {
  using Eigen::Vector2cd;
  double radius = 0.2;
  const auto t = accurate_taylor(field, x, radii, radius);
  if (!t) return 0;
  const Matrix2d slopes = linear_part(*t);
  const double omega = std::sqrt(slopes.determinant());
  const std::complex<double> i(0, 1);
  const Vector2cd q(slopes(0, 1), i * omega - slopes(0, 0));
  Vector2cd p(slopes(1, 0), -i * omega - slopes(0, 0));
  p /= std::conj(p.dot(q));
  // Q and C are the quadratic and cubic terms, as symmetric forms: Q(a, a)/2 and C(a, a, a)/6 are the terms at a.
  const auto along = [&](const auto& form) { return p.dot(Vector2cd(form(t->g[0]), form(t->g[1]))); };
  const auto quadratic = [&](const Vector2cd& a, const Vector2cd& b) {
    return along([&](const TaylorPolynomial& g) {
      return 2. * g(2, 0) * a[0] * b[0] + g(1, 1) * (a[0] * b[1] + a[1] * b[0]) + 2. * g(0, 2) * a[1] * b[1];
    });
  };
  const Vector2cd r = q.conjugate();
  const auto cubic = along([&](const TaylorPolynomial& g) {
    return 6. * g(3, 0) * q[0] * q[0] * r[0] + 2. * g(2, 1) * q[0] * (q[0] * r[1] + 2. * q[1] * r[0]) +
           2. * g(1, 2) * q[1] * (q[1] * r[0] + 2. * q[0] * r[1]) + 6. * g(0, 3) * q[1] * q[1] * r[1];
  });
  const double coefficient = (i * quadratic(q, q) * quadratic(q, r) + omega * cubic).real();
  // Each form has at most 4 quadratic or 12 cubic terms.
  const double a = p.norm() * q.squaredNorm(), wide = std::max(t->g[0].largest(2), t->g[1].largest(2));
  const double error = 32 * a * a * wide * t->error(2) + 12 * omega * a * q.norm() * t->error(3);
  return std::abs(coefficient) > significant * error ? (coefficient < 0 ? -1 : 1) : 0;
}

std::optional<Vector2d> few_decimals(const PlanarField& field, const Vector2d& x, const Vector2d& radii, double known) {
  constexpr double rarely = 100;  // multiples of a step of `rarely` errors lie next to few points by chance
  const auto size = [&](const Vector2d& at) {
    const auto f = value_of(field, at);
    return f ? std::optional(f->cwiseQuotient(radii).norm()) : std::nullopt;
  };
  Vector2d rounded = x;
  for (int i = 0; i < 2; ++i) {
    const double error = known * radii[i];
    if (std::abs(x[i]) <= error) {
      rounded[i] = 0;
      continue;
    }
    for (int decimals = -static_cast<int>(std::floor(std::log10(radii[i])));; ++decimals) {
      const double step = std::pow(10, -decimals);
      if (step < rarely * error) break;
      const double near = decimals > 0 ? std::round(x[i] * std::pow(10, decimals)) / std::pow(10, decimals)
                                       : std::round(x[i] / step) * step;
      if (std::abs(near - x[i]) > error) continue;
      rounded[i] = near;
      break;
    }
  }
  const auto here = size(x);
  if (rounded == x) return here ? std::optional(x) : std::nullopt;
  const auto there = size(rounded);
  if (!there) return std::nullopt;
  if (*there == 0 || !here || *there < *here) return rounded;
  for (int i = 0; i < 2; ++i) {
    Vector2d one = x;
    one[i] = rounded[i];
    const auto beside = size(one);
    if (beside && (*beside == 0 || *beside < *here)) return one;
  }
  return x;
}

std::optional<DegeneratePoint> degenerate_point(const PlanarField& field, const Vector2d& near, const Vector2d& radii) {
  constexpr double largest = 0.2, certain = 1e-5;
  const auto first = local_polynomial(field, near, radii, largest);
  if (!first) return std::nullopt;
  const auto zero = first->zero();
  if (!zero) return std::nullopt;
  const Vector2d moved = near + first->radius * radii.cwiseProduct(zero->shift);
  const double known = first->radius * std::max(zero->known, 4 * eps);
  if (known > certain) return std::nullopt;
  const auto x = few_decimals(field, moved, radii, known);
  if (!x) return std::nullopt;
  // The kind must be the same in two discs.
  DegeneratePoint point{*x, planar_kind("degenerate"), 0};
  double radius = first->radius;
  for (int disc = 0; disc < 2; ++disc, radius /= 2) {
    const auto local = local_polynomial(field, *x, radii, radius);
    const auto there = local ? local->zero() : std::nullopt;
    const DegeneratePoint found = there && there->order == zero->order
                                      ? classified(*local, *x, *there)
                                      : DegeneratePoint{*x, planar_kind("degenerate"), 0};
    const bool agree = disc == 0 || point.kind == found.kind;
    point = agree ? found : DegeneratePoint{*x, planar_kind("degenerate"), 0};
  }
  // A principal part with a kind has powers of both variables, which fix the place.
  return zero->fixed || point.kind != "degenerate" ? std::optional(point) : std::nullopt;
}

}  // namespace contensou::reduction
