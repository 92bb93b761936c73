#include "numerics/relaxation.hpp"

#include <Eigen/LU>

namespace contensou::reduction {

namespace {

constexpr int order = LegendreSeries::order;
using Samples = LegendreSeries::Samples;
using Matrix = Eigen::Matrix<double, order, order>;

/// Whether exp of the integral of h is a polynomial of that order to the last bit.
bool moderate(const Samples& rate) { return rate.maxCoeff() <= 1.5 && rate.maxCoeff() - rate.minCoeff() <= 1; }

/// Samples of a function -> samples of its antiderivative that vanishes at -1.
const Matrix& integration() {
  static const Matrix matrix = [] {
    Matrix columns;
    for (int j = 0; j < order; ++j) {
      columns.col(j) = LegendreSeries::through(Matrix::Identity().col(j).array()).antiderivative().samples().matrix();
    }
    return columns;
  }();
  return matrix;
}

/// z' at the points, for  z' + h z = g,  z(-1) = 0; so does the next.
Samples slope_by_factor(const Samples& rate, const Samples& source) {
  const Samples factor = LegendreSeries::through(rate).antiderivative().samples().exp();
  return source - rate * (LegendreSeries::through(factor * source).antiderivative().samples() / factor);
}

Samples slope_by_collocation(const Samples& rate, const Samples& source) {
  // z = A z', so (1 + h A) z' = g.
  const Matrix system = Matrix::Identity() + rate.matrix().asDiagonal() * integration();
  return system.partialPivLu().solve(source.matrix()).array();
}

}  // namespace

LegendreSeries relax(const Samples& rate, const Samples& source, double start) {
  // For z = y - start: where h and g share a noise, g/h does not have it, and nor has y. As the antiderivative of z':
  // a series through y itself would amplify its rounding at the ends, where one panel hands over to the next.
  const Samples change = source - rate * start;
  const Samples slope = moderate(rate) ? slope_by_factor(rate, change) : slope_by_collocation(rate, change);
  LegendreSeries y = LegendreSeries::through(slope).antiderivative();
  y += start;
  return y;
}

}  // namespace contensou::reduction
