#include "planar/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/decomposition.hpp"
#include "numerics/epsilon.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

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

}  // namespace contensou::reduction
