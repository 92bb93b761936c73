// V as a formula. The functions of V's form have names. The null vectors of planar.md (R57) in these functions
// are brought to row echelon form. The entries are rational if V has rational coefficients. They are rounded to
// fractions, and the misfit (R59) is computed with the fractions.
#include "planar/inverse_factor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "numerics/decomposition.hpp"

namespace contensou::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Whole = long long;

constexpr double exact = 1e-12;

/// The coefficients of a sum of functions: whole numbers `above`, all divided by the whole number `below`.
struct Coefficients {
  std::vector<Whole> above;
  Whole below = 1;
};

/// Returns the fraction with the smallest denominator that differs from x by at most the error.
std::optional<std::pair<Whole, Whole>> fraction(double x, double error) {
  constexpr Whole largest = 1000;
  constexpr double highest = 1e6;
  if (!(std::abs(x) <= highest)) return std::nullopt;
  for (Whole below = 1; below <= largest; ++below) {
    const double above = std::rint(x * static_cast<double>(below));
    if (std::abs(x - above / static_cast<double>(below)) <= error) return std::pair(static_cast<Whole>(above), below);
  }
  return std::nullopt;
}

std::optional<Coefficients> rational(const VectorXd& values, double error) {
  std::vector<std::pair<Whole, Whole>> all;
  Coefficients result;
  for (const double value : values) {
    const auto found = fraction(value, error);
    if (!found) return std::nullopt;
    all.push_back(*found);
    result.below = std::lcm(result.below, found->second);
    constexpr Whole longest = 1000000;
    if (result.below > longest) return std::nullopt;
  }
  for (const auto& [above, below] : all) result.above.push_back(above * (result.below / below));
  return result;
}

/// Returns a term of a sum without its sign, such as "3*u^2/4" for 3, "u^2" and 4.
std::string term(Whole above, const std::string& name, Whole below) {
  const Whole divisor = std::gcd(above, below), size = std::abs(above) / divisor;
  const bool bare = name.empty() || name == "1";
  std::string text = bare ? fmt::to_string(size) : size == 1 ? name : fmt::format("{}*{}", size, name);
  if (below != divisor) text += fmt::format("/{}", below / divisor);
  return text;
}

/// Returns a sum with its signs; "0" if it is empty.
std::string sum(const std::vector<std::string>& names, const Coefficients& factors) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Whole above = factors.above[i];
    if (above == 0) continue;
    text += text.empty() ? (above < 0 ? "-" : "") : above < 0 ? " - " : " + ";
    text += term(above, names[i], factors.below);
  }
  return text.empty() ? "0" : text;
}

std::string power(char name, int exponent) {
  return exponent == 0 ? "" : exponent == 1 ? std::string(1, name) : fmt::format("{}^{}", name, exponent);
}

/// A polynomial in u and v.
class Polynomial {
 public:
  static constexpr int degree = 4, side = degree + 1;

  Whole& at(int i, int j) { return terms_[place(i, j)]; }
  Whole at(int i, int j) const { return terms_[place(i, j)]; }

  double operator()(const Vector2d& x) const {
    double value = 0;
    for (int i = degree; i >= 0; --i) {
      double row = 0;
      for (int j = degree; j >= 0; --j) row = row * x[1] + static_cast<double>(at(i, j));
      value = value * x[0] + row;
    }
    return value;
  }

  /// Divides by a polynomial if no remainder is left. The divisor's last term (by powers of u, then of v) is not 0.
  bool divide(const Polynomial& by) {
    const auto [m, n] = by.last();
    Polynomial rest = *this, quotient;
    for (int i = degree; i >= m; --i) {
      for (int j = degree; j >= n; --j) {
        const Whole factor = rest.at(i, j) / by.at(m, n);
        if (factor == 0) continue;
        quotient.at(i - m, j - n) = factor;
        for (int k = 0; k <= m; ++k) {
          for (int l = 0; l < side; ++l) {
            if (by.at(k, l) == 0) continue;
            if (j - n + l > degree) return false;
            rest.at(i - m + k, j - n + l) -= factor * by.at(k, l);
          }
        }
      }
    }
    if (std::ranges::any_of(rest.terms_, [](Whole each) { return each != 0; })) return false;
    *this = quotient;
    return true;
  }

  int total_degree() const {
    int most = 0;
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        if (at(i, j) != 0) most = std::max(most, i + j);
      }
    }
    return most;
  }

  /// Returns the polynomial as text, with the sign that makes the term of the lowest degree positive.
  std::string text() const {
    std::vector<std::string> names;
    Coefficients factors;
    for (int total = 0; total <= 2 * degree; ++total) {
      for (int i = std::min(total, degree); i >= 0 && total - i <= degree; --i) {
        const int j = total - i;
        if (at(i, j) == 0) continue;
        const std::string of_u = power('u', i), of_v = power('v', j);
        names.push_back(fmt::format("{}{}{}", of_u, of_u.empty() || of_v.empty() ? "" : "*", of_v));
        factors.above.push_back(at(i, j));
      }
    }
    if (factors.above.front() < 0) {
      for (Whole& each : factors.above) each = -each;
    }
    return sum(names, factors);
  }

 private:
  std::pair<int, int> last() const {
    for (int i = degree; i >= 0; --i) {
      for (int j = degree; j >= 0; --j) {
        if (at(i, j) != 0) return {i, j};
      }
    }
    return {0, 0};
  }

  static std::size_t place(int i, int j) { return static_cast<std::size_t>(i) * side + static_cast<std::size_t>(j); }

  std::array<Whole, side* side> terms_ = {};
};

/// Returns the polynomial, up to its sign, as a product of factors with small coefficients.
std::string factorised(Polynomial rest) {
  std::vector<std::pair<std::string, int>> found;
  constexpr int large = 10;
  for (const int degree : {1, 2}) {  // lines, then conics and pairs of lines
    for (int a = 0; a <= large; ++a) {
      for (int b = a == 0 ? 1 : -large; b <= large; ++b) {
        for (int c = -large; c <= large; ++c) {
          if (std::gcd(std::gcd(a, b), c) != 1) continue;
          Polynomial by;
          by.at(degree, 0) = a;
          by.at(0, degree) = b;
          by.at(0, 0) = c;
          int times = 0;
          while (rest.total_degree() >= degree && rest.divide(by)) ++times;
          if (times > 0) found.emplace_back(by.text(), times);
        }
      }
    }
  }
  if (rest.total_degree() > 0 || found.empty()) found.emplace_back(rest.text(), 1);
  std::ranges::sort(found, {}, [](const auto& each) { return std::pair(each.first.size(), each.first); });
  if (found.size() == 1 && found[0].second == 1) return found[0].first;
  std::string text;
  for (const auto& [factor, times] : found) {
    const bool bare = factor.find(' ') == std::string::npos;
    text += (text.empty() ? "" : "*") + (bare ? factor : "(" + factor + ")");
    if (times > 1) text += fmt::format("^{}", times);
  }
  return text;
}

/// Values and derivatives of functions at a point. Each function has a row: value, d/du, d/dv.
using Functions = std::function<Eigen::MatrixX3d(const Vector2d& x, const Jet& jet)>;

/// Returns the functions of a form of V in the coordinates u and v, not in those of a box.
Functions terms_of(FactorForm form) {
  return [form](const Vector2d& x, const Jet& jet) -> Eigen::MatrixX3d {
    return InverseFactor::terms(form, {Vector2d::Zero(), Vector2d::Ones()}, x, jet);
  };
}

/// Returns the rows of V's equation (R57) in these functions, scaled as in the misfit (R59).
MatrixXd rows_of(const Functions& functions, const FieldSamples& samples) {
  MatrixXd rows(std::ssize(samples.points), functions(samples.points[0], samples.jets[0]).rows());
  for (Index k = 0; k < rows.rows(); ++k) {
    const Jet& jet = samples.jets[static_cast<std::size_t>(k)];
    const Eigen::MatrixX3d at = functions(samples.points[static_cast<std::size_t>(k)], jet);
    rows.row(k) = weight(samples.box, jet) * (at.rightCols<2>() * jet.f - at.col(0) * jet.slopes.trace()).transpose();
  }
  return rows;
}

/// Returns the combination with rational coefficients and the fewest functions that satisfies V's equation (R57).
std::optional<Coefficients> null_combination(const Functions& functions, const FieldSamples& samples) {
  MatrixXd rows = rows_of(functions, samples);
  VectorXd sizes = VectorXd::Zero(rows.cols());
  for (std::size_t k = 0; k < samples.points.size(); ++k) {
    sizes = sizes.cwiseMax(functions(samples.points[k], samples.jets[k]).col(0).cwiseAbs());
  }
  if (!(sizes.minCoeff() > 0) || rows.rows() < rows.cols()) return std::nullopt;
  for (Index i = 0; i < sizes.size(); ++i) sizes[i] = std::exp2(std::rint(std::log2(sizes[i])));
  const SingularValues svd(rows * sizes.cwiseInverse().asDiagonal());
  const double mean = std::sqrt(static_cast<double>(rows.rows()));
  const Index nullity = (svd.values.array() <= exact * mean).count();
  if (nullity == 0) return std::nullopt;
  const MatrixXd basis = echelon(svd.V.rightCols(nullity));
  std::optional<Coefficients> best;
  const auto terms = [](const Coefficients& all) {
    return std::ranges::count_if(all.above, [](Whole x) { return x != 0; });
  };
  for (Index i = 0; i < nullity; ++i) {
    VectorXd factors = basis.col(i);
    for (double& factor : factors) factor = std::abs(factor) <= exact ? 0 : factor;
    factors = factors.cwiseQuotient(sizes);
    for (const double unit : VectorXd(factors)) {
      if (unit == 0) continue;
      auto found = rational(factors / unit, exact * std::max(1., (factors / unit).lpNorm<Eigen::Infinity>()));
      if (!found) continue;
      VectorXd rounded(factors.size());
      std::ranges::transform(found->above, rounded.begin(), [](Whole x) { return static_cast<double>(x); });
      const double size = rounded.cwiseProduct(sizes).lpNorm<Eigen::Infinity>();
      if ((rows * rounded).lpNorm<Eigen::Infinity>() > exact * size) continue;
      const Whole common = std::accumulate(found->above.begin(), found->above.end(), Whole{0}, std::gcd<Whole, Whole>);
      for (Whole& each : found->above) each /= common;
      found->below = 1;
      if (!best || terms(*found) < terms(*best)) best = found;
      break;
    }
  }
  return best;
}

/// Returns the functions u^i v^j up to a degree.
Functions monomials(int degree) {
  return [degree](const Vector2d& x, const Jet&) {
    Eigen::MatrixX3d all((degree + 1) * (degree + 2) / 2, 3);
    Index row = 0;
    const auto raised = [](double base, int exponent) { return exponent < 0 ? 0 : std::pow(base, exponent); };
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; i + j <= degree; ++j) {
        const double of_u = raised(x[0], i), of_v = raised(x[1], j);
        all.row(row++) << of_u * of_v, i * raised(x[0], i - 1) * of_v, j * of_u * raised(x[1], j - 1);
      }
    }
    return all;
  };
}

}  // namespace

std::string recognised(const SmoothField& field, const Vector2d& start) {
  const Box about = box_about(start);
  const double scale = start.lpNorm<Eigen::Infinity>();
  // Prefer the box in which powers of u and v differ most. If the field has no values there, take the next box.
  std::optional<FieldSamples> samples;
  for (const Box& box : {Box{start / 4, Vector2d::Constant(2 * scale)}, Box{start, 4 * about.radii}, about}) {
    if (!samples) samples = sample(field, box);
  }
  if (!samples) return {};
  if (field.basis.values) {
    const auto found = null_combination(terms_of(FactorForm::basis), *samples);
    return found ? sum(field.basis.names, *found) : "";
  }
  for (int degree = 0; degree <= Polynomial::degree; ++degree) {
    const auto found = null_combination(monomials(degree), *samples);
    if (!found) continue;
    Polynomial v;
    std::size_t term = 0;
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; i + j <= degree; ++j) v.at(i, j) = found->above[term++];
    }
    return factorised(v);
  }
  if (const auto found = null_combination(terms_of(FactorForm::affine), *samples)) {
    const std::vector<std::string> names{"u'", "v'", "v*u'", "v*v'", "u*u'", "u*v'"};
    return sum(names, *found);
  }
  return "";
}

}  // namespace contensou::reduction
