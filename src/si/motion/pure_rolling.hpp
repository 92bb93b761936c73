#pragma once

#include <Eigen/Core>

namespace contensou::si {

/// Rolling without slip on a plane with a constant pull, V' = A - a V/|V| (reduction/theory.md, (R24)). On a slope A is
/// (1 - 1/chi) g sin(alpha), downwards, and a is u_r g cos(alpha).
class PureRolling {
 public:
  /// @param velocity   velocity at the start, m/s
  /// @param pull       A, m/s^2
  /// @param resisting  a, m/s^2, >= 0
  PureRolling(const Eigen::Vector2d& velocity, const Eigen::Vector2d& pull, double resisting);

  /// The velocity in m/s, the displacement from the start in m and the length of the path in m at one time.
  struct Here {
    Eigen::Vector2d velocity, way;
    double path;
  };
  Here after(double seconds) const;

  /// Returns the time until the ball rests for good, s; infinity if it never does.
  double rest_time() const;

  /// Returns the time, s, until rolling needs too much friction, |share + a V/|V|| > most (R24); infinity if never.
  /// @param most   largest friction, f N/m, m/s^2
  /// @param share  part of the pull that friction balances, A/(chi - 1), m/s^2
  double slides_after(double most, double share) const;

 private:
  /// A straight part of the path with a constant deceleration.
  struct Stretch {
    double speed, slowing;  ///< initial speed, m/s; deceleration, m/s^2
    double lasts() const;
    double way(double seconds) const { return (speed - slowing * seconds / 2) * seconds; }
  };

  double turned_time(double fall) const;
  Here turned(double fall) const;

  Eigen::Vector2d along_, down_;  ///< directions of the velocity and of the pull
  double pull_, resisting_;
  bool straight_;
  Stretch first_;
  double z_ = 0, scale_ = 0;  ///< constants z_0 and B of (R24)
};

}  // namespace contensou::si
