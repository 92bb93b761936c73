#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "contensou/si/scaling.hpp"
#include "solution.hpp"

namespace contensou::si {

namespace {

/// A motion under a changing load with a constant patch. Speeds equal the speeds under the nominal load at
/// LoadHistory::clock. Lengths and angles are integrals of these speeds over the real time, to 1e-10.
class Loaded final : public Motion::Solution {
 public:
  Loaded(SolvedMotion nominal, const LoadHistory& history)
      : Solution(nominal->experiment), motion_(std::move(nominal)), load_(history) {
    require_undriven(experiment, "a load that changes");
    end_ = load_.time_of(motion_->stop_time());
    if (std::isinf(end_))
      throw std::domain_error("the load ends at 0 before the motion does, which then goes on for ever: end it above 0");
    for (double t : load_.instants()) {
      if (t < end_ && (edges_.empty() || t > edges_.back())) edges_.push_back(t);
    }
    edges_.push_back(end_);
    slid_ = integrals([](const MotionPoint& point) { return point.slip; });
    turned_ = integrals([](const MotionPoint& point) { return point.angular_velocity.z(); });
  }

  MotionPoint at(double t) const override {
    if (t >= end_) return motion_by_slip(experiment, t, 0, slid_.back(), 0);
    const MotionPoint then = nominal_at(t);
    return motion_by_slip(experiment, t, then.slip, slid(t), then.angular_velocity.z());
  }

  double stop_time() const override { return end_; }
  double spin_end() const override { return load_.time_of(motion_->spin_end()); }
  double slip_time(double speed) const override { return load_.time_of(motion_->slip_time(speed)); }
  double spin_time(double speed) const override { return load_.time_of(motion_->spin_time(speed)); }
  double slip_length() const override { return slid_.back(); }
  double spin_angle() const override { return turned_.back(); }
  double path_length(double t) const override {
    const auto speed = [this](const MotionPoint& then) {
      return motion_by_slip(experiment, 0, then.slip, 0, then.angular_velocity.z()).velocity.norm();
    };
    double sum = 0;
    for (std::size_t i = 1; i < edges_.size() && edges_[i - 1] < t; ++i)
      sum += integral(speed, edges_[i - 1], std::min(t, edges_[i]));
    return sum + speed(nominal_at(end_)) * std::max(0.0, t - end_);
  }
  bool is_reduced() const override { return motion_->is_reduced(); }
  std::vector<ReducedPiece> pieces() const override { return motion_->pieces(); }
  long steps() const override { return motion_->steps(); }

 private:
  using Value = double (*)(const MotionPoint&);

  MotionPoint nominal_at(double t) const { return motion_->at(load_.clock(std::min(t, end_))); }

  /// The error is 1e-11 of this integral, or 1e-11 of all integrals together divided by their number. Just before the
  /// stop the second one is larger: there a speed is so small that its rounding exceeds 1e-11 of it.
  double integral(const std::function<double(const MotionPoint&)>& value, double from, double to) const {
    constexpr double accuracy = 1e-11;
    const auto most = [&](double begin, double end) { return std::abs(value(nominal_at(begin))) * (end - begin); };
    const double shares = most(0, end_) / (most(from, to) * static_cast<double>(edges_.size()));
    return integral_over_time([&](double t) { return value(nominal_at(t)); }, from, to,
                              accuracy * std::max(1.0, shares));
  }

  /// Returns the integrals of a speed from 0 to each edge.
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

  SolvedMotion motion_;
  LoadHistory load_;
  double end_ = 0;
  std::vector<double> edges_;  ///< times before the end at which the load has a corner, and the end, s
  std::vector<double> slid_, turned_;
};

}  // namespace

SolvedMotion loaded_motion(SolvedMotion nominal, const LoadHistory& history) {
  return std::make_shared<Loaded>(std::move(nominal), history);
}

}  // namespace contensou::si
