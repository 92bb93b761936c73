#pragma once

#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>

namespace contensou::reduction {

/// Smooth functions on [-1, 1] as Legendre series, sampled at Gauss points.
class LegendreSeries {
 public:
  static constexpr int order = 20;
  using Samples = Eigen::Array<double, order, 1>;

  /// The Gauss points in increasing order.
  static const Samples& points();

  /// The series of degree order - 1 through the samples at points().
  static LegendreSeries through(const Samples& samples);

  /// The antiderivative that vanishes at -1.
  LegendreSeries antiderivative() const;

  LegendreSeries derivative() const;

  /// The series divided by x = (1 + t)/2; its value at x = 0 is left out.
  LegendreSeries divided_by_x() const;

  /// The series without its highest coefficients, as long as they are not above a bound.
  LegendreSeries without_noise(double bound) const;

  double operator()(double t) const;

  /// The value at 1.
  double at_end() const { return coefficients_.sum(); }

  /// The values at points().
  Samples samples() const;

  /// How fast the series still moves at its end, in the unit of the samples.
  double tail() const;

  /// through(samples).tail().
  static double tail(const Samples& samples);

  LegendreSeries& operator*=(double factor) {
    coefficients_ *= factor;
    return *this;
  }
  LegendreSeries& operator+=(double shift) {
    coefficients_[0] += shift;
    return *this;
  }

 private:
  Eigen::Array<double, order + 1, 1> coefficients_ = Eigen::Array<double, order + 1, 1>::Zero();
};

}  // namespace contensou::reduction
