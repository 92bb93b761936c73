#pragma once

#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>

namespace contensou::reduction {

/// A smooth function on [-1, 1] as a Legendre series, sampled at Gauss points.
class LegendreSeries {
 public:
  static constexpr int order = 20;
  using Samples = Eigen::Array<double, order, 1>;

  /// Returns the Gauss points in increasing order.
  static const Samples& points();

  /// Returns the series of degree order - 1 through the samples at points().
  static LegendreSeries through(const Samples& samples);

  /// Returns the antiderivative that vanishes at -1.
  LegendreSeries antiderivative() const;

  LegendreSeries derivative() const;

  /// Returns the series divided by x = (1 + t)/2, after subtraction of its value at x = 0.
  LegendreSeries divided_by_x() const;

  /// Returns the series without the coefficients after the last one above a bound.
  LegendreSeries without_noise(double bound) const;

  double operator()(double t) const;

  /// Returns the value at 1.
  double at_end() const { return coefficients_.sum(); }

  /// Returns the value of through(samples) at an end, -1 or 1. The cost is one scalar product.
  static double at_end(const Samples& samples, int end);

  /// Returns the values at points().
  Samples samples() const;

  /// Returns the larger of the last two coefficients: a measure of the error, in the unit of the samples.
  double tail() const;

  /// Returns through(samples).tail().
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
