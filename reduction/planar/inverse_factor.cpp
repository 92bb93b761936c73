// The equation of V, planar.md (R57), in a basis of functions: f . grad V - V div f = 0, one row for each point.
//   If [X, f] = g f for a generator X of the orbits (g a function), f ^ X is a solution: areas grow at the rate div f.
// Rows are divided by |F|/radius + |G|/radius + |div f|, with f = (F, G), and the basis is made orthonormal over the
// points. Then the singular values are the misfits (R59) of all V of the form. The terms of f . grad V are not used for
// this division, because they vanish for V = 1 and a conservative field.
#include "planar/inverse_factor.hpp"

#include <algorithm>
#include <numbers>

#include "numerics/decomposition.hpp"
#include "planar/differences.hpp"

namespace contensou::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int series_terms = 15;

/// Returns true if a form has the term u^i v^j. For a product, ln V has these terms: powers of u alone or of v alone.
bool has_term(FactorForm form, int i, int j) {
  switch (form) {
    case FactorForm::constant:
      return i + j == 0;

    case FactorForm::affine:
      return i + j <= 1;
    case FactorForm::polynomial:
      return i + j <= 4;
    case FactorForm::linear_v:
      return j <= 1;
    case FactorForm::quadratic_v:
      return j <= 2;
    case FactorForm::linear_u:
      return i <= 1;
    case FactorForm::quadratic_u:
      return i <= 2;
    case FactorForm::product:
      return i == 0 || j == 0;
    case FactorForm::basis:
      break;
  }
  return false;
}

/// Chebyshev's polynomials T_0, T_1, ... and their derivatives.
struct Chebyshev {
  std::array<double, series_terms> value, slope;
  explicit Chebyshev(double x) {
    value = {1, x};
    slope = {0, 1};
    for (std::size_t k = 2; k < series_terms; ++k) {
      value[k] = 2 * x * value[k - 1] - value[k - 2];
      slope[k] = 2 * value[k - 1] + 2 * x * slope[k - 1] - slope[k - 2];
    }
  }
};

}  // namespace

double weight(const Box& box, const Jet& jet) {
  const double size = jet.f.cwiseQuotient(box.radii).lpNorm<1>() + std::abs(jet.slopes.trace());
  return size > 0 ? 1 / size : 0;
}

std::optional<Jet> jet_of(const SmoothField& field, const Vector2d& x) {
  const auto f = value_of(field.value, x);
  if (!f) return std::nullopt;
  Jet jet{*f, Eigen::Matrix2d::Zero()};
  if (field.jacobian) {
    try {
      jet.slopes = field.jacobian(x);
    } catch (const std::exception&) {
      return std::nullopt;
    }
  } else {
    for (int i = 0; i < 2; ++i) {
      constexpr double step = 1. / 32;
      const auto found = slope([&](const Vector2d& at) { return value_of(field.value, at); }, x, i,
                               step * std::max(std::abs(x[i]), 1.));
      if (!found) return std::nullopt;
      jet.slopes.col(i) = found->value;
      jet.error += found->error;
    }
  }
  if (field.basis.values) jet.basis = field.basis.values(x);
  if (!jet.slopes.allFinite() || !jet.basis.allFinite()) return std::nullopt;
  return jet;
}

SmoothField with_cleared_denominator(const SmoothField& field) {
  SmoothField cleared;
  cleared.value = [f = field.value, d = field.denominator](const Vector2d& x) -> Vector2d { return d(x)[0] * f(x); };
  cleared.basis = field.basis;
  if (field.jacobian) {
    cleared.jacobian = [=](const Vector2d& x) -> Eigen::Matrix2d {
      const Eigen::RowVector3d d = field.denominator(x);
      return d[0] * field.jacobian(x) + field.value(x) * d.tail<2>();
    };
  }
  return cleared;
}

SmoothField in_units(const SmoothField& field, double unit) {
  if (unit == 1) return field;
  // Multiplies the columns d/du and d/dv by the unit.
  const auto slopes_in_units = [unit](const auto& function) {
    return [unit, function](const Vector2d& x) {
      auto rows = function(unit * x);
      rows.template rightCols<2>() *= unit;
      return rows;
    };
  };
  SmoothField scaled;
  scaled.value = [unit, f = field.value](const Vector2d& x) -> Vector2d { return f(unit * x) / unit; };
  if (field.jacobian) scaled.jacobian = [unit, slopes = field.jacobian](const Vector2d& x) { return slopes(unit * x); };
  if (field.denominator) scaled.denominator = slopes_in_units(field.denominator);
  if (field.switches) scaled.switches = slopes_in_units(field.switches);
  if (field.branch) {
    scaled.branch = [unit, branch = field.branch](const Vector2d& x) { return in_units(branch(unit * x), unit); };
  }
  scaled.basis.names = field.basis.names;
  if (field.basis.values) scaled.basis.values = slopes_in_units(field.basis.values);
  return scaled;
}

SmoothField backward(const SmoothField& field) {
  SmoothField turned = field;
  turned.value = [f = field.value](const Vector2d& x) -> Vector2d { return -f(x); };
  if (field.jacobian) {
    turned.jacobian = [slopes = field.jacobian](const Vector2d& x) -> Eigen::Matrix2d { return -slopes(x); };
  }
  if (field.branch) turned.branch = [branch = field.branch](const Vector2d& x) { return backward(branch(x)); };
  return turned;
}

Vector2d evenly_spread(int i) {
  constexpr double plastic = 1.32471795724474602596;
  const auto fraction = [](double x) { return x - std::floor(x); };
  return {fraction(i / plastic), fraction(i / (plastic * plastic))};
}

Box widened(FactorForm form, Box box, double factor) {
  for (int i = 0; i < 2; ++i) {
    if (form != FactorForm::product && !has_term(form, i == 0 ? series_terms - 1 : 0, i == 1 ? series_terms - 1 : 0)) {
      box.radii[i] *= factor;
    }
  }
  return box;
}

Box box_about(const Vector2d& x) {
  constexpr double part = 0.3, least = 0.3;
  return {x, part * x.cwiseAbs().cwiseMax(least)};
}

std::string_view name(FactorForm form) {
  constexpr std::array<std::string_view, factor_forms + 1> names{"constant",       "affine",         "polynomial",
                                                                 "linear in v",    "quadratic in v", "linear in u",
                                                                 "quadratic in u", "product",        "basis"};
  return names[static_cast<std::size_t>(form)];
}

InverseFactor::Terms<3> InverseFactor::terms(FactorForm form, const Box& box, const Vector2d& x, const Jet& jet) {
  if (form == FactorForm::basis) return jet.basis;
  const Vector2d inside = box.inside(x);
  const Chebyshev a(inside[0]), b(inside[1]);
  Terms<3> terms(most, 3);
  Index count = 0;
  const auto add = [&](double f, double by_u, double by_v, int i, int j) {
    const auto m = static_cast<std::size_t>(i), n = static_cast<std::size_t>(j);
    const double term = a.value[m] * b.value[n];
    terms.row(count++) << f * term, by_u * term + f * a.slope[m] * b.value[n] / box.radii[0],
        by_v * term + f * a.value[m] * b.slope[n] / box.radii[1];
  };
  for (int i = 0; i < series_terms; ++i) {
    for (int j = 0; j < series_terms && has_term(form, i, j); ++j) {
      if (form != FactorForm::affine) {
        add(1, 0, 0, i, j);
      } else {
        for (int k = 0; k < 2; ++k) add(jet.f[k], jet.slopes(k, 0), jet.slopes(k, 1), i, j);
      }
    }
  }
  terms.conservativeResize(count, 3);
  return terms;
}

InverseFactor::Value InverseFactor::operator()(const Vector2d& x, const Jet& jet) const {
  Value value = coefficients_.transpose() * terms(form_, box_, x, jet);
  if (form_ == FactorForm::product) {
    value[0] = std::exp(value[0]);
    value.tail<2>() *= value[0];
  }
  return value;
}

double InverseFactor::size(const Vector2d& x, const Jet& jet) const {
  if (form_ == FactorForm::product) return (*this)(x, jet)[0];
  if (form_ == FactorForm::basis) return coefficients_.cwiseAbs().dot(jet.basis.col(0).cwiseAbs());
  const double largest = coefficients_.lpNorm<1>();
  return form_ == FactorForm::affine ? largest * jet.f.norm() * (1 + box_.inside(x).norm()) : largest;
}

InverseFactor::Misfit InverseFactor::misfit(const Vector2d& x, const Jet& jet) const {
  const Terms<3> all = terms(form_, box_, x, jet);
  const Value value = coefficients_.transpose() * all;
  const Value sizes = coefficients_.cwiseAbs().transpose() * all.cwiseAbs();
  return {value.tail<2>() * jet.f - value[0] * jet.slopes.trace(),
          sizes.tail<2>() * jet.f.cwiseAbs() + sizes[0] * jet.slopes.cwiseAbs().sum()};
}

double InverseFactor::residual(const Vector2d& x, const Jet& jet) const {
  const Value value = (*this)(x, jet);
  const double change = value.tail<2>() * jet.f - value[0] * jet.slopes.trace();
  return weight(box_, jet) * std::abs(change) / size(x, jet);
}

std::optional<FieldSamples> sample(const SmoothField& field, const Box& box) {
  constexpr int tried = 260;
  const auto centre = jet_of(field, box.centre);
  if (!centre || centre->f.isZero(0)) return std::nullopt;
  FieldSamples samples{box, *centre};
  int left_out = 0;
  for (int i = 1; i <= tried && 5 * left_out <= tried; ++i) {
    // The points are denser at the edges, like Chebyshev points.
    const Vector2d inside = evenly_spread(i).unaryExpr([](double x) { return std::cos(std::numbers::pi * x); });
    const Vector2d x = box.centre + inside.cwiseProduct(box.radii);
    if (const auto jet = jet_of(field, x)) {
      samples.points.push_back(x);
      samples.jets.push_back(*jet);
      samples.error = std::max(samples.error, jet->error * weight(box, *jet));
    } else {
      ++left_out;
    }
  }
  if (5 * left_out > tried) return std::nullopt;
  return samples;
}

std::optional<FactorFit> fit_factor(FactorForm form, const FieldSamples& samples,
                                    const std::function<double(const Vector2d& x)>& like) {
  const bool log = form == FactorForm::product;
  const auto terms_at = [&](std::size_t i) {
    return InverseFactor::terms(form, samples.box, samples.points[i], samples.jets[i]);
  };
  const InverseFactor::Terms<3> here = InverseFactor::terms(form, samples.box, samples.box.centre, samples.centre);
  const Index rows = samples.fitted(), all = std::ssize(samples.points), columns = here.rows();
  MatrixXd values(all, columns), changes(all, columns);
  VectorXd divergence(all);
  for (Index i = 0; i < all; ++i) {
    const Jet& jet = samples.jets[static_cast<std::size_t>(i)];
    const double scale = weight(samples.box, jet);
    InverseFactor::Terms<3> terms = terms_at(static_cast<std::size_t>(i));
    if (form == FactorForm::affine) terms /= jet.f.norm();  // divided by |f|, so that all points have the same weight
    divergence[i] = scale * jet.slopes.trace();
    values.row(i) = terms.col(0).transpose();
    changes.row(i) = scale * (terms.rightCols<2>() * jet.f).transpose();
    if (!log) changes.row(i) -= divergence[i] * values.row(i);
  }
  constexpr double smallest = 1e-16, level = 1e-11, loosest = 1e-9, accurate = 1e-8, vanishing = 1e-12;
  const double limit = std::clamp(8 * samples.error, level, loosest);
  TriedForm tried{name(form), 0, 0, 0};
  InverseFactor::Terms<1> coefficients;
  bool vanishes = false, unique = true;
  VectorXd missed;
  double size = 1;
  if (log) {
    coefficients = least_squares(changes.topRows(rows), divergence.head(rows));
    coefficients[0] = 0;
    coefficients[0] = -coefficients.dot(here.col(0));
    missed = changes * coefficients - divergence;
    const double mean = std::sqrt(static_cast<double>(rows));
    tried.singular_value = missed.head(rows).norm() / mean;
    tried.gap = divergence.head(rows).norm() / mean / std::max(tried.singular_value, smallest);
  } else {
    // Make the functions of the form orthonormal over the points. This excludes the solution V = 0.
    constexpr double dependent = 1e-13;
    const SingularValues functions(values.topRows(rows));
    const Index rank = (functions.values.array() > dependent * functions.values[0]).count();
    if (rank == 0) return std::nullopt;
    const MatrixXd orthonormal = functions.V.leftCols(rank) * functions.values.head(rank).cwiseInverse().asDiagonal();
    const SingularValues svd(product(MatrixXd(changes.topRows(rows)), orthonormal));
    const VectorXd sigma = svd.values.reverse();
    Index nullity = 1;
    for (Index i = 0; i < rank && (i == 0 || sigma[i - 1] <= limit); ++i) {
      const double gap = i + 1 < rank                  ? sigma[i + 1] / std::max(sigma[i], smallest)
                         : i == 0 || sigma[i] <= limit ? 1 / smallest
                                                       : 0;
      if (gap > tried.gap) {
        tried.gap = gap;
        nullity = i + 1;
      }
    }
    tried.singular_value = sigma[0];
    unique = nullity == 1;
    const MatrixXd null = product(orthonormal, MatrixXd(svd.V.rightCols(nullity)));
    // Take the V that is largest at the centre. If all V vanish there, take the V that changes most across the orbit.
    const double mean = 1 / std::sqrt(static_cast<double>(rows));
    VectorXd part = null.transpose() * here.col(0);
    vanishes = part.norm() <= vanishing * mean;
    const Vector2d& f = samples.centre.f;
    if (vanishes) part = null.transpose() * (here.rightCols<2>() * Vector2d(-f[1], f[0]));
    if (like) {
      VectorXd wanted(all);
      for (Index i = 0; i < all; ++i) wanted[i] = like(samples.points[static_cast<std::size_t>(i)]);
      std::vector<Index> common;
      for (Index i = 0; i < all; ++i) {
        // An affine form divides its terms by |f|.
        if (form == FactorForm::affine) wanted[i] /= samples.jets[static_cast<std::size_t>(i)].f.norm();
        if (std::isfinite(wanted[i])) common.push_back(i);
      }
      constexpr Index least = 10;
      if (std::ssize(common) < least) return std::nullopt;
      const MatrixXd of_null = product(MatrixXd(values(common, Eigen::all)), null);
      part = least_squares(of_null, wanted(common));
      // Among several V, the errors of this choice grow from box to box.
      const double alike = unique ? 1e-10 : 1e-12;
      if (!((of_null * part - wanted(common)).norm() <= alike * wanted(common).norm())) return std::nullopt;
    }
    coefficients = null * part.normalized();
    const double one = vanishes ? mean : coefficients.dot(here.col(0));
    coefficients /= one;
    size = mean / std::abs(one);
    missed = changes * coefficients;
  }
  tried.residual = missed.tail(all - rows).cwiseAbs().maxCoeff() / size;
  FactorFit fit{InverseFactor(form, samples.box, coefficients), tried,
                tried.singular_value <= limit && tried.residual <= accurate, unique};
  fit.factor.vanishes = vanishes;
  fit.factor.error = 8 * eps / (tried.gap * std::max(tried.singular_value, smallest));
  return fit;
}

}  // namespace contensou::reduction
