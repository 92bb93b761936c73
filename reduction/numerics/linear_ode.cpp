#include "numerics/linear_ode.hpp"

#include <limits>

#include <Eigen/LU>

namespace contensou::reduction {

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
