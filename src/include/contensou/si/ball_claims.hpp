#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/paper_claim.hpp"
#include "contensou/si/integrated_motion.hpp"
#include "contensou/si/shot.hpp"

namespace contensou::si {

/// The equations of the whole ball of Zh98, exactly as printed, in SI. Another function in place of one of them is
/// another paper: this is how a test lies.
struct PrintedBall {
  double inertia;  ///< J/(m R^2)
  /// (2.1)
  std::function<Eigen::Vector2d(double R, Eigen::Vector2d velocity, Eigen::Vector3d angular_velocity)> contact_velocity;
  /// (2.3): F_x, F_y at the contact velocity
  std::function<Eigen::Vector2d(double normal_friction, double eps, double spin, Eigen::Vector2d contact_velocity)>
      force;
  /// (2.4)
  std::function<Eigen::Vector3d(double normal_friction, double eps, double R, double spin, double slip,
                                Eigen::Vector2d force)>
      moment;
  /// The five equations before and in (2.6): d(omega_x, omega_y, u, v, alpha)/dtau
  std::function<Eigen::Matrix<double, 5, 1>(double mu, double R, double u, double v, double alpha)> rates;
};

PrintedBall printed_ball();

/// How the motion is found: integrate_motion, unless a test lies.
using Integration =
    std::function<IntegratedMotion(const Shot& shot, const reduction::Law& law, const Eigen::ArrayXd& times)>;

/// Every equation and claim of section 2 of Zh98 up to (2.6), and what it says of the motion after the stop, against
/// mechanics in vectors and against the integrated motion of that shot.
///
/// @param shot  with slip, spin and horizontal angular velocity, none of them 0
/// @throws std::domain_error  as require_shot
std::vector<reduction::PaperClaim> ball_claims(const Shot& shot, const PrintedBall& printed = printed_ball(),
                                               const Integration& integration = integrate_motion);

}  // namespace contensou::si
