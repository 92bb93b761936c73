#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

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

  LegendreSeries& operator+=(double shift) {
    coefficients_[0] += shift;
    return *this;
  }

 private:
  Eigen::Array<double, order + 1, 1> coefficients_ = Eigen::Array<double, order + 1, 1>::Zero();
};

/// An interval of x on which a function is a series in t, -1 <= t <= 1.
struct SeriesPanel {
  double left, right;

  double half() const { return (right - left) / 2; }
  double x(double t) const { return left + half() * (1 + t); }
  double t(double x) const { return (x - left) / half() - 1; }
};

/// Returns the panel that contains x, or the nearest one.
/// @param panels  SeriesPanels with series, in the order of x; not empty
template <class Panel>
const Panel& panel_at(const std::vector<Panel>& panels, double x) {
  const auto after = std::ranges::upper_bound(panels, x, {}, &Panel::left);
  return after == panels.begin() ? panels.front() : *std::prev(after);
}

/// Makes one continuous function of the antiderivatives on all panels. Each is 0 at the left end of its panel; the
/// function is 0 at `zero`, an end of a panel.
template <class Panel>
void join(std::vector<Panel>& panels, LegendreSeries Panel::*part, double zero) {
  const auto first = std::ranges::lower_bound(panels, zero, {}, &Panel::left);
  double level = 0;
  for (auto panel = first; panel != panels.end(); ++panel) level = ((*panel).*part += level).at_end();
  level = 0;
  for (auto panel = std::make_reverse_iterator(first); panel != panels.rend(); ++panel) {
    level -= ((*panel).*part).at_end();
    (*panel).*part += level;
  }
}

/// Solves d y' + h y = g on [-1, 1] with y(-1) = start. For h/d >= 0, y relaxes towards g/h, forgets its start and
/// never amplifies an error. If d vanishes at -1, the result is the regular solution, which starts at g/h.
///
/// @param advection  d at the points of LegendreSeries, >= 0
/// @param rate       h at these points; h/d can have any size; for h < 0, y moves away from g/h
/// @param source     g at these points
/// @param start      y(-1)
/// @return           y
///
/// If h/d is moderate, the method is the integrating factor. If h/d is large, the factor is no polynomial, but y is,
/// and the method is collocation: one linear system for y' at the points, or for y if y forgets its start
/// immediately.
LegendreSeries solve_linear_ode(const LegendreSeries::Samples& advection, const LegendreSeries::Samples& rate,
                                const LegendreSeries::Samples& source, double start);

}  // namespace contensou::reduction
