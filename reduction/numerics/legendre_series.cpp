#include "numerics/legendre_series.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <Eigen/LU>

namespace contensou::reduction {

namespace {

using GaussRule = boost::math::quadrature::gauss<long double, LegendreSeries::order>;

/// The Gauss points, the matrix from samples to coefficients (discrete orthogonality of the Gauss rule) and the inverse
/// matrix. All are computed in long double, because their errors add up at the ends, where all P_j are +-1.
struct Transform {
  static constexpr int order = LegendreSeries::order;
  LegendreSeries::Samples points;
  Eigen::Matrix<double, order, order> analysis;
  Eigen::Matrix<double, order, order + 1> synthesis;
  Eigen::Matrix<double, 1, order> end;  ///< samples -> value at 1; samples in reverse order -> value at -1

  Transform() {
    const auto& half_points = GaussRule::abscissa();
    const auto& half_weights = GaussRule::weights();
    for (int i = 0; i < order; ++i) {
      const auto half = static_cast<std::size_t>(i < order / 2 ? order / 2 - 1 - i : i - order / 2);
      const long double point = i < order / 2 ? -half_points[half] : half_points[half];
      points[i] = static_cast<double>(point);
      long double before = 0;
      long double here = 1;
      for (int j = 0; j <= order; ++j) {
        synthesis(i, j) = static_cast<double>(here);
        if (j < order) analysis(j, i) = static_cast<double>((2 * j + 1) / 2.0L * half_weights[half] * here);
        before = std::exchange(here, ((2 * j + 1) * point * here - j * before) / (j + 1));
      }
    }
    end = analysis.colwise().sum();
  }
};

const Transform& transform() {
  static const Transform instance;
  return instance;
}

template <class Function>
constexpr std::array<double, LegendreSeries::order + 1> of_each(Function function) {
  std::array<double, LegendreSeries::order + 1> values{};
  for (int j = 0; j <= LegendreSeries::order; ++j) values[static_cast<std::size_t>(j)] = function(j);
  return values;
}

}  // namespace

const LegendreSeries::Samples& LegendreSeries::points() { return transform().points; }

LegendreSeries LegendreSeries::through(const Samples& samples) {
  LegendreSeries series;
  series.coefficients_.head<order>() = (transform().analysis * samples.matrix()).array();
  return series;
}

LegendreSeries LegendreSeries::antiderivative() const {
  // The integral of P_j from -1 to t is (P_{j+1} - P_{j-1})/(2j + 1), but t + 1 for j = 0. The highest term is dropped.
  LegendreSeries integral;
  integral.coefficients_[0] = coefficients_[0];
  integral.coefficients_[1] = coefficients_[0];
  for (int j = 1; j < order; ++j) {
    const double term = coefficients_[j] / (2 * j + 1);
    integral.coefficients_[j + 1] += term;
    integral.coefficients_[j - 1] -= term;
  }
  return integral;
}

LegendreSeries LegendreSeries::derivative() const {
  // P_j' = (2j - 1) P_{j-1} + P_{j-2}'.
  LegendreSeries slope;
  auto c = coefficients_;
  for (int j = order; j >= 1; --j) {
    slope.coefficients_[j - 1] = (2 * j - 1) * c[j];
    if (j >= 2) c[j - 2] += c[j];
  }
  return slope;
}

LegendreSeries LegendreSeries::divided_by_x() const {
  // The recurrence t P_j = ((j + 1) P_{j+1} + j P_{j-1})/(2j + 1) gives the highest coefficient of the quotient first.
  LegendreSeries quotient;
  auto& q = quotient.coefficients_;
  for (int j = order; j >= 1; --j) {
    const double above = j < order ? q[j + 1] * (j + 1) / (2 * j + 3) : 0;
    q[j - 1] = (2 * coefficients_[j] - q[j] - above) * (2 * j - 1) / j;
  }
  return quotient;
}

LegendreSeries LegendreSeries::without_noise(double bound) const {
  LegendreSeries series = *this;
  for (int j = order; j >= 1 && std::abs(series.coefficients_[j]) <= bound; --j) series.coefficients_[j] = 0;
  return series;
}

double LegendreSeries::operator()(double t) const {
  // Clenshaw's algorithm with (j + 1) P_{j+1} = (2j + 1) t P_j - j P_{j-1}.
  constexpr auto here = of_each([](int j) { return (2 * j + 1) / (j + 1.0); });
  constexpr auto after = of_each([](int j) { return (j + 1) / (j + 2.0); });
  double next = 0;
  double after_next = 0;
  for (int j = order; j >= 1; --j) {
    const auto i = static_cast<std::size_t>(j);
    const double current = (coefficients_[j] - after[i] * after_next) + here[i] * t * next;
    after_next = std::exchange(next, current);
  }
  return coefficients_[0] + t * next - 0.5 * after_next;
}

LegendreSeries::Samples LegendreSeries::samples() const {
  return (transform().synthesis * coefficients_.matrix()).array();
}

double LegendreSeries::at_end(const Samples& samples, int end) {
  return end > 0 ? transform().end.dot(samples.matrix()) : transform().end.dot(samples.matrix().reverse());
}

double LegendreSeries::tail() const {
  return std::max(std::abs(coefficients_[order - 1]), std::abs(coefficients_[order - 2]));
}

double LegendreSeries::tail(const Samples& samples) {
  return (transform().analysis.bottomRows<2>() * samples.matrix()).cwiseAbs().maxCoeff();
}

namespace {

constexpr int order = LegendreSeries::order;
using Samples = LegendreSeries::Samples;
using Matrix = Eigen::Matrix<double, order, order>;

/// Returns true if exp of the integral of h/d is a polynomial of the degree of a series, to the last bit. Near a zero
/// of d it is a power of the distance from the zero, which is no polynomial, however small h is.
bool factor_is_polynomial(const Samples& advection, const Samples& rate) {
  if (!(rate <= 1.5 * advection).all() || !(advection.minCoeff() > 0)) return false;
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  const Samples ratio = rate / advection;
  return ratio.maxCoeff() - ratio.minCoeff() <= 1 && LegendreSeries::tail(ratio) <= rounding;
}

/// Returns true if d y' is small compared with h y for every polynomial y of the degree of a series.
bool forgets_start(const Samples& advection, const Samples& rate) {
  return advection.maxCoeff() * (order * order) < rate.minCoeff();
}

/// Returns the matrix from samples of a function to samples of a linear operation on it.
template <class Operation>
Matrix matrix_of(Operation operation) {
  Matrix columns;
  for (int j = 0; j < order; ++j) {
    columns.col(j) = operation(LegendreSeries::through(Matrix::Identity().col(j).array())).samples().matrix();
  }
  return columns;
}

/// Returns the matrix from samples to samples of the antiderivative that vanishes at -1.
const Matrix& integration() {
  static const Matrix matrix = matrix_of([](const LegendreSeries& series) { return series.antiderivative(); });
  return matrix;
}

const Matrix& differentiation() {
  static const Matrix matrix = matrix_of([](const LegendreSeries& series) { return series.derivative(); });
  return matrix;
}

/// Returns z' at the points for z' + h z = g, z(-1) = 0.
Samples slope_by_factor(const Samples& rate, const Samples& source) {
  const Samples factor = LegendreSeries::through(rate).antiderivative().samples().exp();
  return source - rate * (LegendreSeries::through(factor * source).antiderivative().samples() / factor);
}

/// Returns z' at the points for d z' + h z = g, z(-1) = 0.
Samples slope_by_collocation(const Samples& advection, const Samples& rate, const Samples& source) {
  // z = A z' with A = integration(), so (d + h A) z' = g. `unit` scales the rows, also those with d = 0.
  const Samples unit = advection + rate.abs() * (LegendreSeries::points() + 1);
  Matrix system = (rate / unit).matrix().asDiagonal() * integration();
  system.diagonal().array() += advection / unit;
  return system.partialPivLu().solve((source / unit).matrix()).array();
}

}  // namespace

LegendreSeries solve_linear_ode(const Samples& advection, const Samples& rate, const Samples& source, double start) {
  // Solve for z = y - start. Noise that h and g share cancels in g/h and so in y. Rounding is relative to z.
  const Samples change = source - rate * start;
  LegendreSeries y;
  if (forgets_start(advection, rate)) {
    Matrix system = (advection / rate).matrix().asDiagonal() * differentiation();
    system.diagonal().array() += 1;
    y = LegendreSeries::through(system.partialPivLu().solve((change / rate).matrix()).array());
  } else {
    // A series for z itself would amplify its rounding at the ends, at which one panel continues the other. Therefore z
    // is the antiderivative of a series for z'.
    const Samples slope = factor_is_polynomial(advection, rate) ? slope_by_factor(rate / advection, change / advection)
                                                                : slope_by_collocation(advection, rate, change);
    y = LegendreSeries::through(slope).antiderivative();
  }
  y += start;
  return y;
}

}  // namespace contensou::reduction
