#include "contensou/si/ball_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/si/scaling.hpp"

namespace contensou::si {

BallMotion::BallMotion(const Experiment& experiment, const reduction::Law& law)
    : BallMotion(experiment, reduction::Flow(reduced_system(experiment, law))) {}

BallMotion::BallMotion(const Experiment& experiment, const reduction::Flow& flow)
    : experiment_(experiment),
      orbit_(flow.orbit(reduced_start(experiment))),
      stop_(seconds(experiment, orbit_.stop_time())),
      scale_(1 / seconds(experiment, 1)) {
  if (!std::isfinite(stop_)) throw std::runtime_error("the stop time exceeds the largest double");
}

double BallMotion::paper_time(double t) const { return t >= stop_ ? orbit_.stop_time() : t * scale_; }

MotionPoint BallMotion::at_time(double t) const {
  if (!(t >= 0)) throw std::domain_error(fmt::format("BallMotion::at_time: t must be >= 0, in s; got {}", t));
  const double tau = paper_time(t);
  const reduction::OrbitPoint point = orbit_.at_time(tau);
  return motion_by_slip(experiment_, t, point.v, seconds(experiment_, orbit_.slip_length(tau)),
                        point.u / experiment_.ball.radius);
}

MotionColumns BallMotion::at_times(const Eigen::ArrayXd& times) const {
  MotionColumns columns(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at_time(times[i]));
  return columns;
}

template <class Function>
double BallMotion::time_until_not(Function holds) const {
  double low = 0;
  double high = orbit_.stop_time();
  for (double middle = high / 2; middle > low && middle < high; middle = low + (high - low) / 2) {
    (holds(orbit_.at_time(middle)) ? low : high) = middle;
  }
  return seconds(experiment_, high);
}

double BallMotion::slip_time(double speed) const {
  if (!(speed >= 0))
    throw std::domain_error(fmt::format("BallMotion::slip_time: speed >= 0 is required, got {}", speed));
  if (slip_at_start(experiment_) <= speed) return 0;
  return time_until_not([ln_v = std::log(speed)](const reduction::OrbitPoint& at) { return at.ln_v > ln_v; });
}

double BallMotion::spin_time(double speed) const {
  if (!(speed >= 0))
    throw std::domain_error(fmt::format("BallMotion::spin_time: speed >= 0 is required, got {}", speed));
  if (std::abs(spin_at_start(experiment_)) <= speed) return 0;
  return time_until_not(
      [u = speed * experiment_.ball.radius](const reduction::OrbitPoint& at) { return std::abs(at.u) > u; });
}

double BallMotion::slip_length() const { return seconds(experiment_, orbit_.slip_length(orbit_.stop_time())); }

template <class Function>
double BallMotion::integral(Function function, double end) const {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
  constexpr unsigned depth = 12;
  constexpr double tolerance = 1e-10;
  std::vector<double> edges{0, end};
  for (double fraction : {0.5, 0.1, 0.01, 1e-4, 1e-8}) {
    edges.push_back(std::min(slip_time(fraction * slip_at_start(experiment_)), end));
  }
  std::ranges::sort(edges);
  double sum = 0;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i] > edges[i - 1]) sum += Rule::integrate(function, edges[i - 1], edges[i], depth, tolerance);
  }
  return sum;
}

double BallMotion::spin_angle() const {
  return integral([this](double t) { return orbit_.at_time(paper_time(t)).u / experiment_.ball.radius; }, stop_);
}

double BallMotion::path_length(double t) const {
  if (!(t >= 0)) throw std::domain_error(fmt::format("BallMotion::path_length: t must be >= 0, in s; got {}", t));
  return integral([this](double at) { return at_time(at).velocity.norm(); }, t);
}

}  // namespace contensou::si
