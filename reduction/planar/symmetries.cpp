// The determining equations of X = c t d/dt + (A x + b) . d/dx, planar.md (R63):
//   A f - Df (A x + b) - c f = 0,   unknowns (A11, A12, A21, A22, b1, b2, c)
#include "contensou/reduction/symmetries.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/LU>

#include "numerics/decomposition.hpp"
#include "numerics/epsilon.hpp"
#include "planar/differences.hpp"

namespace contensou::reduction {

namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Unknowns = Eigen::Matrix<double, 7, 1>;

Generator generator_of(const Unknowns& x) {
  return {x[6], (Matrix2d() << x[0], x[1], x[2], x[3]).finished(), Vector2d(x[4], x[5]), true};
}

Unknowns unknowns_of(const Generator& g) {
  return (Unknowns() << g.matrix(0, 0), g.matrix(0, 1), g.matrix(1, 0), g.matrix(1, 1), g.shift, g.time).finished();
}

/// The field, with a count of its failures (points without a value) and the message of the first failure.
class Sampler {
 public:
  explicit Sampler(const SmoothField& field) : field_(field) {}

  /// Sets the units of the points and of the values. They are powers of 2, so that no rounding occurs.
  void set_units(double length, double value) {
    length_ = length;
    value_ = value;
  }

  std::optional<Vector2d> operator()(const Vector2d& in_units) {
    const Vector2d x = length_ * in_units;
    try {
      const Vector2d value = field_(x);
      if (value.allFinite()) return value / value_;
      remember(fmt::format("the field has no value at ({}, {})", x[0], x[1]));
    } catch (const std::exception& failure) {
      remember(failure.what());
    }
    return std::nullopt;
  }

  /// Returns the derivatives by u and by v, with their errors: exact except for rounding, or differences.
  std::optional<std::array<Slope, 2>> slopes(const Vector2d& in_units, const Vector2d& first_steps) {
    if (!field_.jacobian) {
      const auto by_u = slope(*this, in_units, 0, first_steps[0]), by_v = slope(*this, in_units, 1, first_steps[1]);
      return by_u && by_v ? std::optional(std::array{*by_u, *by_v}) : std::nullopt;
    }
    try {
      const Matrix2d all = length_ / value_ * field_.jacobian(length_ * in_units);
      constexpr double roundings = 4;
      const double error = roundings * eps * all.norm();
      if (all.allFinite()) return std::array{Slope{all.col(0), error}, Slope{all.col(1), error}};
    } catch (const std::exception& failure) {
      remember(failure.what());
    }
    return std::nullopt;
  }

  bool is_exact() const { return static_cast<bool>(field_.jacobian); }
  const std::string& first_failure() const { return first_failure_; }

 private:
  void remember(const std::string& failure) {
    if (first_failure_.empty()) first_failure_ = failure;
  }

  const SmoothField& field_;
  double length_ = 1, value_ = 1;
  std::string first_failure_;
};

constexpr int tried = 128;
constexpr double sampled_to = 3;  ///< largest distance of the samples, in units of `around`

/// Returns point i of those at which the field is sampled. Points with even i are spread evenly about the origin, at
/// 1/3 to 3 times `around`. Points with odd i lie nearer to the axes, down to a ratio of 1e-5.
Vector2d sample_point(int i, const Vector2d& around) {
  const auto fraction = [](double x) { return x - std::floor(x); };
  const double turn = fraction(i * std::numbers::phi);
  const double radius = std::pow(sampled_to, 2 * fraction(i * std::numbers::sqrt2) - 1);
  Vector2d direction{std::cos(2 * std::numbers::pi * turn), std::sin(2 * std::numbers::pi * turn)};
  if (i % 2 == 1) {
    const double ratio = std::pow(10, 10 * fraction(i * std::numbers::sqrt3) - 5);
    direction = Vector2d(std::copysign(1, direction[0]), std::copysign(ratio, direction[1])) / std::hypot(1, ratio);
  }
  return radius * direction.cwiseProduct(around);
}

/// The determining equations at the samples. Rows and columns are scaled to similar magnitudes.
struct Equations {
  MatrixXd matrix;
  Eigen::VectorXd row_scale;
  Unknowns column_scale;
  std::vector<Vector2d> points = {};
  double error = 0;  ///< Frobenius norm of the matrix's error, which comes from the derivatives
  double range = 1;  ///< largest |f| at the samples divided by the smallest
};

Equations determining_equations(Sampler& field, const Vector2d& around) {
  constexpr int least = 12;
  struct Sample {
    Vector2d x;
    Eigen::Matrix<double, 2, 7> rows, errors;
    Eigen::Matrix<double, 2, 7> sizes;  ///< sums of the absolute values of each row's terms, which can cancel
  };
  std::vector<Sample> samples;
  bool all_zero = true;
  double smallest = infinity, largest = 0;
  for (int i = 1; i <= tried; ++i) {
    const Vector2d x = sample_point(i, around);
    const auto f = field(x);
    if (!f) continue;
    all_zero &= f->isZero(0);
    if (!f->isZero(0)) {
      smallest = std::min(smallest, f->stableNorm());
      largest = std::max(largest, f->stableNorm());
    }
    const auto slopes = field.slopes(x, x.cwiseAbs() / 8);
    if (!slopes) continue;
    const auto& [by_u, by_v] = *slopes;
    const auto of_derivatives = [&](const Vector2d& du, const Vector2d& dv) {
      return (Eigen::Matrix<double, 2, 7>() << du * x[0], du * x[1], dv * x[0], dv * x[1], du, dv, Vector2d(0, 0))
          .finished();
    };
    Eigen::Matrix<double, 2, 7> of_values;
    of_values << f->transpose(), 0, 0, 0, 0, -(*f)[0], 0, 0, f->transpose(), 0, 0, -(*f)[1];
    const auto derivatives = of_derivatives(by_u.value, by_v.value);
    samples.push_back({x, of_values - derivatives,
                       of_derivatives(Vector2d::Constant(by_u.error), Vector2d::Constant(by_v.error)).cwiseAbs(),
                       of_values.cwiseAbs() + derivatives.cwiseAbs()});
  }
  if (std::ssize(samples) < least) {
    throw std::domain_error(
        fmt::format("the field has values and differences at {} of {} points about |u| = {}, |v| = {}, and {} "
                    "are needed{}{}",
                    samples.size(), tried, around[0], around[1], least,
                    field.first_failure().empty() ? "" : "; the first failure: ", field.first_failure()));
  }
  if (all_zero) throw std::domain_error("the field is 0 at every point that was tried");

  // Scale rows and columns in turn. Then repeat without the points next to a kink, whose errors are the largest.
  const auto inverse = [](double length) { return length > 0 ? 1 / length : 1; };
  const auto scaled = [&] {
    const auto count = static_cast<Eigen::Index>(2 * samples.size());
    Equations equations{
        .matrix = MatrixXd(count, 7), .row_scale = Eigen::VectorXd::Ones(count), .column_scale = Unknowns::Ones()};
    MatrixXd errors(count, 7), sizes(count, 7);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(2 * i);
      equations.matrix.middleRows<2>(row) = samples[i].rows;
      errors.middleRows<2>(row) = samples[i].errors;
      sizes.middleRows<2>(row) = samples[i].sizes;
      equations.points.push_back(samples[i].x);
    }
    for (int pass = 0; pass < 3; ++pass) {
      equations.row_scale = (sizes * equations.column_scale.asDiagonal()).rowwise().norm().unaryExpr(inverse);
      equations.column_scale =
          (equations.row_scale.asDiagonal() * sizes).colwise().norm().transpose().unaryExpr(inverse);
    }
    equations.matrix =
        (equations.row_scale.asDiagonal() * equations.matrix * equations.column_scale.asDiagonal()).eval();
    errors = (equations.row_scale.asDiagonal() * errors * equations.column_scale.asDiagonal()).eval();
    equations.error = errors.norm();
    return std::pair(std::move(equations), errors.rowwise().norm().eval());
  };
  const auto [first, errors] = scaled();
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    order.emplace_back(errors.segment<2>(static_cast<Eigen::Index>(2 * i)).maxCoeff(), i);
  }
  std::ranges::sort(order);
  order.resize(std::max<std::size_t>(least, order.size() / 2));
  std::vector<Sample> kept;
  for (const auto& [error, i] : order) kept.push_back(samples[i]);
  samples = std::move(kept);
  Equations equations = scaled().first;
  equations.range = largest / smallest;
  return equations;
}

/// The finite transformation phi = exp(s X): x -> L x + d.
struct Transformation {
  Transformation(const Generator& g, double s) : linear(matrix_exponential(s * g.matrix)), shift(Vector2d::Zero()) {
    constexpr int terms = 60;  // terms of the integral of exp(s A) over s; no entry of A is above 1, and s is small
    Vector2d term = s * g.shift;
    for (int n = 2; n <= terms && !term.isZero(0); ++n) {
      shift += term;
      term = (s / n) * (g.matrix * term);
    }
  }
  Vector2d operator()(const Vector2d& x) const { return linear * x + shift; }

  Matrix2d linear;
  Vector2d shift;
};

/// Tests f(phi x) = exp(-c s) L f(x) for a finite phi. This test crosses kinks; derivatives do not. phi moves each
/// point, forwards and backwards, by about twice the point's distance from the origin.
///
/// @param scale    typical size of u and v
/// @param allowed  largest error, relative to f
bool holds_everywhere(Sampler& field, const Generator& g, const std::vector<Vector2d>& points, const Vector2d& scale,
                      double allowed) {
  const auto size = [&](const Vector2d& x) { return x.cwiseQuotient(scale).norm(); };
  return std::ranges::all_of(points, [&](const Vector2d& x) {
    constexpr double way = 2, longest = 4;
    const double s = std::min(way * size(x) / size(g.matrix * x + g.shift), longest);
    return std::ranges::all_of(std::array{-s, s}, [&](double step) {
      const Transformation phi(g, step);
      const auto here = field(x), moved = field(phi(x));
      if (!here || !moved) return true;  // the field has no value at x or phi x
      const Vector2d expected = std::exp(-g.time * step) * (phi.linear * *here);
      return size(*moved - expected) <= allowed * std::max(size(*moved), size(expected));
    });
  });
}

/// Returns points on both sides of the switching curves of a field, also of curves far from all samples.
std::vector<Vector2d> points_at_switches(const SmoothField& field, const Vector2d& scale, double unit) {
  constexpr int count = 12, steps = 20;
  constexpr double near = 1e-12, aside = 1e-5, farthest = 1e6;
  std::vector<Vector2d> points;
  if (!field.switches) return points;
  const double size = unit * scale.norm();
  for (int i = 1; i <= count; ++i) {
    const Eigen::Index functions = field.switches(unit * sample_point(i, scale)).rows();
    for (Eigen::Index k = 0; k < functions; ++k) {
      Vector2d x = unit * sample_point(i, scale), way = Vector2d::Constant(infinity);
      for (int step = 0; step < steps && way.norm() > near * x.norm() && x.norm() < farthest * size; ++step) {
        const Eigen::RowVector3d h = field.switches(x).row(k);
        way = h[0] / h.tail<2>().squaredNorm() * h.tail<2>();
        x -= way;
      }
      const Vector2d normal = field.switches(x).row(k).tail<2>().normalized();
      if (!x.allFinite() || !normal.allFinite() || !(way.norm() <= near * x.norm())) continue;
      for (const double side : {-aside, aside}) points.emplace_back((x + side * size * normal) / unit);
    }
  }
  return points;
}

/// `difference`: exp(s (c - A)) f(phi x) - f(x), divided by s, at all points x, with the finite transformation phi for
/// s = ln 2; a right side of the determining equations. `residual`: the largest |s `difference`|/|f(x)| of one point.
struct Finite {
  double residual = 0;
  Eigen::VectorXd difference;
};

Finite finite_transformation(Sampler& field, const Generator& g, const std::vector<Vector2d>& points,
                             Eigen::Index rows) {
  constexpr double s = std::numbers::ln2;
  const Transformation phi(g, s);
  const Matrix2d back = matrix_exponential(s * (g.time * Matrix2d::Identity() - g.matrix));
  Finite finite{.difference = Eigen::VectorXd::Zero(rows)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto here = field(points[i]), moved = field(phi(points[i]));
    if (!here || !moved) continue;  // the field has no value at x or phi x
    const Vector2d difference = back * *moved - *here;
    finite.residual = std::max(finite.residual, difference.norm() / here->norm());
    finite.difference.segment<2>(static_cast<Eigen::Index>(2 * i)) = difference / s;
  }
  return finite;
}

/// Returns X or -X, whichever moves points away from the centre.
Generator growing(const Generator& g) {
  return g.matrix.trace() > 0 ? g : generator_of(Unknowns::Zero() - unknowns_of(g));
}

/// Returns true if X moves all points away from its centre at a rate clearly above 0.
/// @param scale  typical size of u and v
bool scales(const Generator& g, const Vector2d& scale) {
  const double growth = g.growth();
  const double largest = std::max(g.matrix.trace() - growth, std::sqrt(std::max(g.matrix.determinant(), 0.0)));
  return growth > 1e-6 * std::max({largest, std::abs(g.time), g.shift.cwiseQuotient(scale).cwiseAbs().maxCoeff()});
}

/// Finds a jump of the field between two points by bisection. Each step keeps the half with the larger change.
std::optional<Vector2d> jump_between(Sampler& field, Vector2d left, Vector2d right) {
  constexpr double least = 1e-3;  // smallest jump, relative to the field
  auto at_left = field(left), at_right = field(right);
  for (int halving = 0; halving < 60 && at_left && at_right; ++halving) {
    const Vector2d middle = (left + right) / 2;
    const auto here = field(middle);
    if (!here) return std::nullopt;
    const bool before = (*here - *at_left).norm() > (*at_right - *here).norm();
    (before ? right : left) = middle;
    (before ? at_right : at_left) = here;
  }
  if (!at_left || !at_right || (*at_right - *at_left).norm() <= least * (at_left->norm() + at_right->norm())) {
    return std::nullopt;
  }
  return (left + right) / 2;
}

/// Adds an equation for each line at which the field jumps. If the symmetry holds across the line, X is tangent to the
/// line: the cross product of A x + b and the direction of the line is 0.
void add_jumps(Equations& equations, Sampler& field, const Vector2d& scale) {
  std::vector<Unknowns> rows;
  for (std::size_t i = 1; i < equations.points.size(); ++i) {
    const Vector2d way = equations.points[i] - equations.points[i - 1];
    const auto jump = jump_between(field, equations.points[i - 1], equations.points[i]);
    if (!jump) continue;
    // Find the jump on parallel lines: its position along each line, in units of `along`, for each offset across.
    const double part = 0.1 * scale.minCoeff() / way.norm();
    const Vector2d along = part * way, across(-along[1], along[0]);
    const SmoothField line = [&](const Vector2d& offset) {
      const Vector2d beside = *jump + offset[0] * across;
      const auto there = jump_between(field, beside - along, beside + along);
      return there ? Vector2d((*there - beside).dot(along) / along.squaredNorm(), 0) : Vector2d(infinity, 0);
    };
    Sampler position(line);
    const auto tangent = slope(position, Vector2d(0, 0), 0, 0.25);
    constexpr double accurate = 1e-9;
    if (!tangent || !(tangent->error < accurate)) continue;
    const Vector2d t = (across + tangent->value[0] * along).normalized();
    const Vector2d& x = *jump;
    const Unknowns row =
        (Unknowns() << x[0] * t[1], x[1] * t[1], -x[0] * t[0], -x[1] * t[0], t[1], -t[0], 0).finished();
    rows.push_back(equations.column_scale.cwiseProduct(row).normalized());
  }
  const Eigen::Index known = equations.matrix.rows(), added = std::ssize(rows);
  equations.matrix.conservativeResize(known + added, 7);
  for (Eigen::Index i = 0; i < added; ++i) equations.matrix.row(known + i) = rows[static_cast<std::size_t>(i)];
  equations.row_scale.conservativeResize(known + added);
  equations.row_scale.tail(added).setZero();  // 0: Newton's method uses only the rows of the samples
}

/// Returns x divided by its largest entry. An entry within `error` of a simple fraction becomes that fraction.
Unknowns normalised(const Unknowns& x, double error) {
  const double largest = x.cwiseAbs().maxCoeff();
  const double first = *std::ranges::find_if(x, [=](double entry) { return std::abs(entry) > (1 - 1e-9) * largest; });
  return (x / first).unaryExpr([error](double entry) {
    for (int denominator = 1; denominator <= 12; ++denominator) {
      const double near = std::round(entry * denominator) / denominator;
      if (std::abs(entry - near) <= error) return near + 0.0;  // the addition turns -0 into 0
    }
    return entry;
  });
}

/// Returns the echelon basis of the kernel. The scaling replaces the basis vector that has the largest part in it.
std::vector<Generator> basis_of(const MatrixXd& given, double error, const std::optional<Generator>& scaling) {
  MatrixXd kernel = echelon(given);
  if (scaling) {
    Eigen::Index place = 0;
    least_squares(kernel, unknowns_of(*scaling)).cwiseAbs().maxCoeff(&place);
    kernel.col(place).swap(kernel.col(0));
  }
  std::vector<Generator> basis;
  for (Eigen::Index i = 0; i < kernel.cols(); ++i) {
    basis.push_back(i == 0 && scaling ? *scaling : generator_of(normalised(kernel.col(i), error)));
  }
  return basis;
}

/// Finds the simplest scaling in the null space that holds in the whole plane. Subspaces are tried in turn, the
/// simplest one first. From a subspace, the scaling nearest to A = 1 is taken.
///
/// @param largest  largest singular value of the equations
template <class Everywhere>
std::optional<Generator> simplest_scaling(Sampler& field, const Equations& equations, double largest, double level,
                                          const Vector2d& scale, const Everywhere& everywhere) {
  const auto spanned = [](std::initializer_list<Unknowns> vectors) {
    MatrixXd subspace(7, vectors.size());
    std::ranges::for_each(vectors, [&, i = Eigen::Index(0)](const Unknowns& x) mutable { subspace.col(i++) = x; });
    return subspace;
  };
  const auto unit = [](int i) -> Unknowns { return Unknowns::Unit(i); };
  const Unknowns identity = unit(0) + unit(3), b1 = unit(4), b2 = unit(5), c = unit(6);
  const auto transformed = [&](const Unknowns& x) {
    return finite_transformation(field, generator_of(x), equations.points, equations.matrix.rows());
  };
  for (const MatrixXd& subspace :
       {spanned({identity, c}), spanned({identity, b1, b2, c}), spanned({unit(0), unit(3), c}),
        spanned({unit(0), unit(3), b1, b2, c}), MatrixXd(MatrixXd::Identity(7, 7))}) {
    // Express the subspace in the unknowns of the matrix. Each vector of the subspace gets the length 1.
    MatrixXd inner = equations.column_scale.cwiseInverse().asDiagonal() * subspace;
    const Eigen::VectorXd lengths = inner.colwise().norm();
    inner = (inner * lengths.cwiseInverse().asDiagonal()).eval();
    const SingularValues part(product(equations.matrix, inner));
    const Eigen::VectorXd values = part.values / largest;
    const auto kernel_size = (values.array() <= level).count();
    if (kernel_size == 0) continue;
    const MatrixXd kernel =
        product(subspace, MatrixXd(lengths.cwiseInverse().asDiagonal() * part.V.rightCols(kernel_size)));
    Unknowns x = product(kernel, least_squares(kernel, identity));
    if (!scales(generator_of(x), scale)) continue;

    // Refine x by finite transformations, which need no derivatives, in Newton's method with one matrix for all steps.
    Finite finite = transformed(x);
    for (int step = 0; step < 4; ++step) {
      const Eigen::VectorXd correction =
          part.solution(equations.row_scale.cwiseProduct(finite.difference), inner.cols() - kernel_size);
      const Unknowns next = x + product(subspace, Eigen::VectorXd(correction.cwiseQuotient(lengths)));
      const Finite closer = transformed(next);
      if (!(closer.residual < finite.residual)) break;
      x = next;
      finite = closer;
    }
    x = normalised(x, 64 * eps);
    // If derivatives are exact, a field with a larger misfit admits the scaling only nearly.
    constexpr double rounding = 1e-12;
    if (field.is_exact() && transformed(x).residual > rounding) continue;
    const Generator found = growing(generator_of(x));
    if (everywhere(found)) return found;
  }
  return std::nullopt;
}

/// Converts the shift of a generator from units to the field's own lengths, and scales the largest entry to 1 again.
Generator in_lengths(Generator g, double unit) {
  if (unit == 1 || g.shift.isZero(0)) return g;
  g.shift *= unit;
  Generator other = generator_of(normalised(unknowns_of(g), 0));
  other.everywhere = g.everywhere;
  return other;
}

}  // namespace

double Generator::growth() const {
  const double half = (matrix(0, 0) - matrix(1, 1)) / 2, squared = half * half + matrix(0, 1) * matrix(1, 0);
  return matrix.trace() / 2 - std::sqrt(std::max(squared, 0.0));
}

bool Generator::fixes(const Vector2d& x) const {
  constexpr double rounding = 1e-12;
  return (x - centre()).stableNorm() <= rounding * x.stableNorm();
}

Vector2d Generator::centre() const {
  const Vector2d away = matrix.determinant() == 0 ? least_squares(matrix, shift) : solution(matrix, shift);
  return Vector2d::Zero() - away;  // the addition to 0 turns -0 into 0
}

PlanarSymmetries find_symmetries(const SmoothField& field, const Vector2d& around) {
  const double size = around.stableNorm();
  if (!std::isfinite(size) || size == 0) {
    throw std::domain_error(fmt::format(
        "a finite point other than 0 is needed, about which the field is sampled, got ({}, {})", around[0], around[1]));
  }
  constexpr double large = 1e100;  // squares of numbers above this or below its inverse can overflow or underflow
  const double unit = size < large && size > 1 / large ? 1 : std::ldexp(1, std::ilogb(size));
  const Vector2d scale = around.cwiseAbs().unaryExpr([&](double x) { return (x > 0 ? x : size) / unit; });
  Sampler sampler(field);
  sampler.set_units(unit, 1);
  for (int i = 1; i <= tried; ++i) {
    const auto value = sampler(sample_point(i, scale));
    if (!value || value->isZero(0)) continue;
    sampler.set_units(unit, std::ldexp(1, std::ilogb(value->stableNorm())));
    break;
  }
  Equations equations = determining_equations(sampler, scale);
  const SingularValues svd(equations.matrix);
  const double largest = svd.values[0];
  PlanarSymmetries result;
  // Beside a pole the error of the derivatives is not a number.
  const double error = equations.error / largest;
  result.level = std::isnan(error) ? infinity : 8 * std::max(error, 8 * eps);
  result.points = static_cast<int>(equations.points.size());
  result.within = unit * sampled_to * scale;
  int nullity = 0;
  for (int i = 0; i < 7; ++i) {
    result.singular_values[i] = svd.values[6 - i] / largest;
    nullity += result.singular_values[i] <= result.level;
  }
  constexpr double hidden = 1e-2;
  // If magnitudes differ that much, only a few samples have an influence, and the result is not reliable.
  constexpr double widest = 1e140;
  if (result.level > hidden || !(equations.range < widest)) result.verdict = PlanarSymmetries::Verdict::undecided;
  const double zero = std::max(result.level, nullity > 0 ? result.singular_values[nullity - 1] : 0);
  result.gap = nullity < 7 ? result.singular_values[nullity] / zero : infinity;
  if (nullity == 0 || result.verdict == PlanarSymmetries::Verdict::undecided) return result;
  result.verdict = PlanarSymmetries::Verdict::found;

  constexpr double finest = 1e-6, amplified = 100;
  std::vector<Vector2d> points = points_at_switches(field, scale, unit);
  points.insert(points.end(), equations.points.begin(), equations.points.end());
  const auto everywhere = [&](const Generator& g) {
    return holds_everywhere(sampler, g, points, scale, std::max(finest, amplified * result.level));
  };
  result.scaling = simplest_scaling(sampler, equations, largest, result.level, scale, everywhere);
  const MatrixXd kernel = equations.column_scale.asDiagonal() * svd.V.rightCols(nullity);
  const auto find_generators = [&] {
    result.generators = basis_of(kernel, result.level, result.scaling);
    for (Generator& g : result.generators) g.everywhere = everywhere(g);
  };
  find_generators();
  if (!result.scaling && !std::ranges::all_of(result.generators, &Generator::everywhere)) {
    // If several generators hold within sectors only, a combination that maps jumps to themselves can hold everywhere.
    add_jumps(equations, sampler, scale);
    const double largest_now = SingularValues(equations.matrix).values[0];
    result.scaling = simplest_scaling(sampler, equations, largest_now, result.level, scale, everywhere);
    if (result.scaling) find_generators();
  }
  if (result.scaling) {
    result.residual =
        finite_transformation(sampler, *result.scaling, equations.points, equations.matrix.rows()).residual;
  }
  for (Generator& g : result.generators) g = in_lengths(g, unit);
  if (result.scaling) result.scaling = result.generators.front() = growing(result.generators.front());
  return result;
}

PlanarField planar_field(const ReducedSystem& system) {
  return [=](const Vector2d& x) {
    const Rate rate = system.field({x[0], std::abs(x[1])});
    return Vector2d(rate.u, std::copysign(1, x[1]) * rate.v);
  };
}

}  // namespace contensou::reduction
