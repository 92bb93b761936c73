#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>

#include "contensou/reduction/planar_reduction.hpp"
#include "planar/inverse_factor.hpp"

namespace contensou::reduction {

/// The way of an orbit about a point, in steps in which neither its direction from the point nor its distance changes
/// much. Lengths are divided by half axes of an ellipse about the point.
class Winding {
 public:
  /// @param widest  largest change of the angle, and of the logarithm of the distance, in a step
  /// @param step    time of the first step that is tried
  /// @param least   shortest step towards a time at which the orbit has no state
  Winding(PlanarOrbit orbit, const Eigen::Vector2d& start, const Eigen::Vector2d& centre, const Eigen::Vector2d& half,
          double widest, double step, double least = 0)
      : orbit_(std::move(orbit)),
        centre_(centre),
        half_(half),
        widest_(widest),
        step_(step),
        least_(least),
        here_(scaled(start)) {}

  /// Goes on by a step. Returns false if there is no step.
  bool advance() {
    for (; time_ + step_ > time_; step_ /= 2) {
      const Eigen::Vector2d next = state(time_ + step_);
      if (!next.allFinite() && step_ < least_) return false;
      const double turned = std::atan2(cross(here_, next), here_.dot(next));
      const double grown = std::log(next.norm() / here_.norm());
      if (!(std::abs(turned) < widest_ && std::abs(grown) < widest_)) continue;
      before_ = time_;
      time_ += step_;
      angle_ += turned;
      moved_ = (next - here_).norm();
      here_ = next;
      if (std::abs(turned) < widest_ / 3 && std::abs(grown) < widest_ / 3) step_ *= 1.5;
      return true;
    }
    return false;
  }

  const PlanarOrbit& orbit() const { return orbit_; }
  Eigen::Vector2d scaled(const Eigen::Vector2d& x) const { return (x - centre_).cwiseQuotient(half_); }
  const Eigen::Vector2d& here() const { return here_; }  ///< place after the last step, from the point
  double angle() const { return angle_; }                ///< by which the direction has turned from the start on
  double moved() const { return moved_; }                ///< length of the last step
  double before() const { return before_; }              ///< time before the last step
  double time() const { return time_; }
  double step() const { return step_; }

 private:
  /// Returns the scaled state at a time; NaN if the orbit has none.
  Eigen::Vector2d state(double time) const {
    try {
      return scaled(orbit_.at(time));
    } catch (const std::domain_error&) {
      return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    }
  }

  PlanarOrbit orbit_;
  Eigen::Vector2d centre_, half_;
  double widest_, step_, least_;
  Eigen::Vector2d here_;
  double angle_ = 0, moved_ = 0, before_ = 0, time_ = 0;
};

}  // namespace contensou::reduction
