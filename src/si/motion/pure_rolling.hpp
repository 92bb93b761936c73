#pragma once

#include <Eigen/Core>

namespace contensou::si {

/// Rolling without slip on a plane with a constant pull, V' = A - a V/|V| (reduction/README.md, (R56)): down a slope A is
/// (1 - 1/chi) g sin(alpha), and a = u_r g cos(alpha).
class PureRolling {
 public:
  /// @param velocity   m/s
  /// @param pull       A, m/s^2
  /// @param resisting  a, m/s^2, >= 0
  PureRolling(const Eigen::Vector2d& velocity, const Eigen::Vector2d& pull, double resisting);

  /// What has come of it.
  struct Here {
    Eigen::Vector2d velocity, way;  ///< m/s; m from the start
    double path;                    ///< m
  };
  Here after(double seconds) const;

  /// s until it rests for good; infinity where it never does.
  double rest_time() const;

  /// Returns the s until it needs more friction than there is, |share + a V/|V|| > most (R56); infinity where it never does.
  /// @param most   m/s^2, f N/m
  /// @param share  m/s^2, along the pull: what friction bears of it, A/(chi - 1)
  double slides_after(double most, double share) const;

 private:
  /// A straight stretch at a constant deceleration.
  struct Stretch {
    double speed, slowing;  ///< m/s, m/s^2
    double lasts() const;
    double way(double seconds) const { return (speed - slowing * seconds / 2) * seconds; }
  };

  double turned_time(double fall) const;
  Here turned(double fall) const;

  Eigen::Vector2d along_, down_;  ///< of the velocity, of the pull
  double pull_, resisting_;
  bool straight_;
  Stretch first_;
  double z_ = 0, scale_ = 0;  ///< z_0 and B of (R56)
};

}  // namespace contensou::si
