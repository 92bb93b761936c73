#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/si/load_history.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

/// A motion under a load that changes, with a patch that does not: speeds are those of the same motion under the nominal
/// load at LoadHistory::clock, ways and angles their integrals over the time that passes, to 1e-10. Without a history it
/// is that motion itself.
/// @tparam Motion  BallMotion or UncoupledMotion
template <class Motion>
class Loaded {
 public:
  /// @param nominal  of the experiment, whose load is the history's nominal one
  /// @throws std::domain_error  if the load ends at 0 before the motion does
  Loaded(const Experiment& experiment, Motion nominal, std::optional<LoadHistory> history)
      : experiment_(experiment), motion_(std::move(nominal)), load_(std::move(history)) {
    if (!load_) return;
    end_ = load_->time_of(std::max(motion_.slip_time(0), motion_.spin_end()));
    if (std::isinf(end_))
      throw std::domain_error("the load ends at 0 before the motion does, which then goes on for ever: end it above 0");
    for (double t : load_->instants()) {
      if (t < end_ && (edges_.empty() || t > edges_.back())) edges_.push_back(t);
    }
    edges_.push_back(end_);
    slid_ = integrals([](const MotionPoint& point) { return point.slip; });
    turned_ = integrals([](const MotionPoint& point) { return point.angular_velocity.z(); });
  }

  MotionPoint at_time(double t) const {
    if (!load_) return motion_.at_time(t);
    if (!(t >= 0)) return motion_.at_time(t);  // says what is wrong
    if (t >= end_) return motion_by_slip(experiment_, t, 0, slid_.back(), 0);
    const MotionPoint then = nominal_at(t);
    return motion_by_slip(experiment_, t, then.slip, slid(t), then.angular_velocity.z());
  }
  MotionColumns at_times(const Eigen::ArrayXd& times) const {
    if (!load_) return motion_.at_times(times);
    MotionColumns columns(times.size());
    for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at_time(times[i]));
    return columns;
  }

  double stop_time() const requires requires(const Motion& of) { of.stop_time(); }
  { return time_of(motion_.stop_time()); }
  const auto& law() const requires requires(const Motion& of) { of.law(); }
  { return motion_.law(); }
  double slip_time(double speed) const { return time_of(motion_.slip_time(speed)); }
  double spin_end() const { return time_of(motion_.spin_end()); }
  double slip_length() const { return load_ ? slid_.back() : motion_.slip_length(); }
  double spin_angle() const { return load_ ? turned_.back() : motion_.spin_angle(); }
  double path_length(double t) const {
    if (!load_) return motion_.path_length(t);
    const auto speed = [this](const MotionPoint& then) {
      return motion_by_slip(experiment_, 0, then.slip, 0, then.angular_velocity.z()).velocity.norm();
    };
    double sum = 0;
    for (std::size_t i = 1; i < edges_.size() && edges_[i - 1] < t; ++i)
      sum += integral(speed, edges_[i - 1], std::min(t, edges_[i]));
    return sum + speed(nominal_at(end_)) * std::max(0.0, t - end_);
  }

 private:
  double time_of(double nominal) const { return load_ ? load_->time_of(nominal) : nominal; }
  MotionPoint nominal_at(double t) const { return motion_.at_time(load_->clock(std::min(t, end_))); }

  template <class Value>
  double integral(Value value, double from, double to) const {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
    constexpr unsigned depth = 12;
    return to > from ? Rule::integrate([&](double t) { return value(nominal_at(t)); }, from, to, depth, 1e-11) : 0;
  }

  /// Up to each edge.
  template <class Value>
  std::vector<double> integrals(Value value) const {
    std::vector<double> sums{0};
    for (std::size_t i = 1; i < edges_.size(); ++i)
      sums.push_back(sums.back() + integral(value, edges_[i - 1], edges_[i]));
    return sums;
  }

  double slid(double t) const {
    const auto i = static_cast<std::size_t>(std::ranges::upper_bound(edges_, t) - edges_.begin()) - 1;
    return slid_[i] + integral([](const MotionPoint& point) { return point.slip; }, edges_[i], std::min(t, end_));
  }

  Experiment experiment_;
  Motion motion_;
  std::optional<LoadHistory> load_;
  double end_ = 0;
  std::vector<double> edges_;  ///< s, from 0 to the end, where the load bends
  std::vector<double> slid_, turned_;
};

}  // namespace contensou::si
