#include "numerics/linear_ode.hpp"

#include <limits>

#include <Eigen/LU>

namespace contensou::reduction {

namespace {

constexpr int order = LegendreSeries::order;
using Samples = LegendreSeries::Samples;
using Matrix = Eigen::Matrix<double, order, order>;

/// True if exp of the integral of h/d is a polynomial of that order to the last bit. Near a zero of d it is not, however
/// small h: it is a small power of the distance from there.
bool factor_is_polynomial(const Samples& advection, const Samples& rate) {
  if (!(rate <= 1.5 * advection).all() || !(advection.minCoeff() > 0)) return false;
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  const Samples ratio = rate / advection;
  return ratio.maxCoeff() - ratio.minCoeff() <= 1 && LegendreSeries::tail(ratio) <= rounding;
}

/// Whether d y' is small beside h y for every polynomial y of that order.
bool forgets_start(const Samples& advection, const Samples& rate) {
  return advection.maxCoeff() * (order * order) < rate.minCoeff();
}

/// Samples of a function -> samples of a linear function of it.
template <class Operation>
Matrix matrix_of(Operation operation) {
  Matrix columns;
  for (int j = 0; j < order; ++j) {
    columns.col(j) = operation(LegendreSeries::through(Matrix::Identity().col(j).array())).samples().matrix();
  }
  return columns;
}

/// Samples of the antiderivative that vanishes at -1.
const Matrix& integration() {
  static const Matrix matrix = matrix_of([](const LegendreSeries& series) { return series.antiderivative(); });
  return matrix;
}

const Matrix& differentiation() {
  static const Matrix matrix = matrix_of([](const LegendreSeries& series) { return series.derivative(); });
  return matrix;
}

/// z' at the points, for  z' + h z = g,  z(-1) = 0.
Samples slope_by_factor(const Samples& rate, const Samples& source) {
  const Samples factor = LegendreSeries::through(rate).antiderivative().samples().exp();
  return source - rate * (LegendreSeries::through(factor * source).antiderivative().samples() / factor);
}

/// z' at the points, for  d z' + h z = g,  z(-1) = 0.
Samples slope_by_collocation(const Samples& advection, const Samples& rate, const Samples& source) {
  // z = A z', so (d + h A) z' = g; the rows where d vanishes with 1 + t as large as the others.
  const Samples unit = advection + rate.abs() * (LegendreSeries::points() + 1);
  Matrix system = (rate / unit).matrix().asDiagonal() * integration();
  system.diagonal().array() += advection / unit;
  return system.partialPivLu().solve((source / unit).matrix()).array();
}

}  // namespace

LegendreSeries solve_linear_ode(const Samples& advection, const Samples& rate, const Samples& source, double start) {
  // For z = y - start: where h and g share a noise, g/h does not have it, and nor has y; and the rounding of a series
  // is that of what y changes by.
  const Samples change = source - rate * start;
  LegendreSeries y;
  if (forgets_start(advection, rate)) {
    Matrix system = (advection / rate).matrix().asDiagonal() * differentiation();
    system.diagonal().array() += 1;
    y = LegendreSeries::through(system.partialPivLu().solve((change / rate).matrix()).array());
  } else {
    // As the antiderivative of z': a series through z itself would amplify its rounding at the ends, where one panel
    // hands over to the next.
    const Samples slope = factor_is_polynomial(advection, rate) ? slope_by_factor(rate / advection, change / advection)
                                                                : slope_by_collocation(advection, rate, change);
    y = LegendreSeries::through(slope).antiderivative();
  }
  y += start;
  return y;
}

}  // namespace contensou::reduction
