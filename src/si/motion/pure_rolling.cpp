// Notation (reduction/theory.md, (R24)): V velocity, A pull, a deceleration, phi angle from A to V, p = a/A, z =
// tan(phi/2) = z_0 exp(-fall), y = z/z_0. Then |V| = B (y^(p-1) + z_0^2 y^(p+1)).
#include "pure_rolling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contensou/reduction/detail/root.hpp"

namespace contensou::si {

using Eigen::Vector2d;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Returns the integral of y^power from exp(-fall) to 1.
double power_integral(double power, double fall) {
  const double n = power + 1;
  return n == 0 ? fall : -std::expm1(-n * fall) / n;
}

Vector2d direction_of(const Vector2d& vector) {
  const double size = vector.norm();
  return size > 0 ? Vector2d(vector / size) : Vector2d(0, 0);
}

}  // namespace

double PureRolling::Stretch::lasts() const {
  return slowing > 0 ? speed / slowing : speed > 0 || slowing < 0 ? never : 0;
}

PureRolling::PureRolling(const Vector2d& velocity, const Vector2d& pull, double resisting)
    : along_(direction_of(velocity)),
      down_(direction_of(pull)),
      pull_(pull.norm()),
      resisting_(resisting),
      first_{velocity.norm(), resisting - along_.dot(pull)} {
  const double across = along_.x() * down_.y() - along_.y() * down_.x();
  constexpr double parallel = 1e-12;
  straight_ = std::abs(across) <= parallel;
  if (straight_) return;
  z_ = std::tan(std::atan2(std::abs(across), along_.dot(down_)) / 2);
  scale_ = first_.speed / (1 + z_ * z_);
}

double PureRolling::rest_time() const {
  const bool held = pull_ <= resisting_;
  if (straight_) return first_.speed == 0 ? (held ? 0 : never) : held ? first_.lasts() : never;
  const double p = resisting_ / pull_;
  return p > 1 ? scale_ / pull_ * (1 / (p - 1) + z_ * z_ / (p + 1)) : never;
}

double PureRolling::slides_after(double most, double share) const {
  const auto exceeds = [&](double cosine) {
    return std::hypot(share + resisting_ * cosine, resisting_ * std::sqrt(1 - cosine * cosine)) > most;
  };
  const bool held = pull_ <= resisting_;
  if (straight_) {
    if (first_.speed > 0 && exceeds(along_.dot(down_) < 0 ? -1 : 1)) return 0;
    return held || !exceeds(1) ? never : first_.speed > 0 ? first_.lasts() : 0;
  }
  if (exceeds(along_.dot(down_))) return 0;
  if (!exceeds(1)) return never;
  const double cosine = (most * most - share * share - resisting_ * resisting_) / (2 * share * resisting_);
  return turned_time(std::max(0.0, std::log(z_ / std::tan(std::acos(std::clamp(cosine, -1.0, 1.0)) / 2))));
}

double PureRolling::turned_time(double fall) const {
  const double p = resisting_ / pull_;
  return scale_ / pull_ * (power_integral(p - 2, fall) + z_ * z_ * power_integral(p, fall));
}

PureRolling::Here PureRolling::turned(double fall) const {
  const double p = resisting_ / pull_, y = std::exp(-fall), z2 = z_ * z_;
  const double speed = scale_ * std::exp(-(p - 1) * fall) * (1 + z2 * y * y);
  const double cosine = (1 - z2 * y * y) / (1 + z2 * y * y), sine = 2 * z_ * y / (1 + z2 * y * y);
  const Vector2d across = direction_of(along_ - along_.dot(down_) * down_);
  const double square = scale_ * scale_ / pull_;
  const double low = power_integral(2 * p - 3, fall), high = power_integral(2 * p + 1, fall);
  return {.velocity = speed * (cosine * down_ + sine * across),
          .way = square * (low - z2 * z2 * high) * down_ +
                 2 * square * z_ * (power_integral(2 * p - 2, fall) + z2 * power_integral(2 * p, fall)) * across,
          .path = square * (low + 2 * z2 * power_integral(2 * p - 1, fall) + z2 * z2 * high)};
}

PureRolling::Here PureRolling::after(double seconds) const {
  if (straight_) {
    const double whole = first_.lasts(), rolled = std::min(seconds, whole), way = first_.way(rolled);
    const bool on = seconds < whole;
    Here here{on ? Vector2d((first_.speed - first_.slowing * rolled) * along_) : Vector2d(0, 0), way * along_, way};
    if (on && first_.speed > 0) return here;
    // After this stretch the ball rests, or rolls down.
    const Stretch back{0, std::min(resisting_ - pull_, 0.0)};
    const double since = first_.speed > 0 ? seconds - whole : seconds;
    here.velocity = -back.slowing * since * down_;
    here.way += back.way(since) * down_;
    here.path += back.way(since);
    return here;
  }
  if (seconds >= rest_time()) seconds = rest_time();
  constexpr double most = 1e300;
  double high = 1;
  while (turned_time(high) < seconds && high < most) high *= 2;
  if (turned_time(high) <= seconds) return turned(high);
  if (seconds <= 0) return turned(0);
  return turned(reduction::root_between([&](double fall) { return turned_time(fall) - seconds; }, 0, high));
}

}  // namespace contensou::si
