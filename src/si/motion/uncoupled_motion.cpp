#include "contensou/si/uncoupled_motion.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/si/scaling.hpp"

namespace contensou::si {

UncoupledMotion::UncoupledMotion(const Experiment& experiment, const reduction::Law& law) : experiment_(experiment) {
  const reduction::ReducedSystem system = undriven_system(experiment, law);
  const reduction::State start = reduced_start(experiment);
  slip_end_ = seconds(experiment, system.sliding_limit(start.v));
  spin_end_ = seconds(experiment, system.pivoting_limit(start.u));
}

double UncoupledMotion::slip_time(double speed) const {
  const double v0 = slip_at_start(experiment_);
  return v0 > speed ? slip_end_ * (1 - speed / v0) : 0;
}

double UncoupledMotion::path_length(double t) const {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
  constexpr unsigned depth = 12;
  return t > 0 ? Rule::integrate([this](double at) { return at_time(at).velocity.norm(); }, 0, t, depth, 1e-10) : 0;
}

MotionPoint UncoupledMotion::at_time(double t) const {
  if (!(t >= 0)) throw std::domain_error(fmt::format("UncoupledMotion::at_time: t must be >= 0, in s; got {}", t));
  const double v0 = slip_at_start(experiment_);
  const bool slides = t < slip_end_;
  const double slip = slides ? v0 * (1 - t / slip_end_) : 0;
  const double slip_length = slides ? (v0 + slip) / 2 * t : v0 / 2 * slip_end_;
  const double spin = t < spin_end_ ? spin_at_start(experiment_) * (1 - t / spin_end_) : 0;
  return motion_by_slip(experiment_, t, slip, slip_length, spin);
}

MotionColumns UncoupledMotion::at_times(const Eigen::ArrayXd& times) const {
  MotionColumns columns(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at_time(times[i]));
  return columns;
}

}  // namespace contensou::si
