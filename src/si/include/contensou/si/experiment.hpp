#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/body.hpp"
#include "contensou/si/hertz_contact.hpp"
#include "contensou/si/spreads.hpp"

namespace contensou::si {

/// The mass of a ball that nobody gave. It is NaN, so that no energy computed from it is a number. The motion needs no mass.
inline constexpr double unknown_mass = std::numeric_limits<double>::quiet_NaN();

/// A ball, or a body that lies flat.
struct Ball {
  std::string name;
  double mass = unknown_mass;  ///< kg
  double radius;               ///< m
  Body body = {};              ///< of bodies(), with its own factor where one was given
};

/// Returns whether the mass is given, that is other than unknown_mass.
bool mass_is_known(const Ball& ball);

/// Returns the mass of a ball in kg.
/// @param user  names in the message whatever needs the mass
/// @throws std::domain_error  if the mass is not known
double mass_for(std::string_view user, const Ball& ball);

/// The patch as it was measured.
struct PatchRadius {
  double value;  ///< m
};

/// The patch as it follows from how fast a spin without sliding dies out (patch_radius_of_deceleration).
struct SpinDeceleration {
  double value;  ///< rad/s^2
};

/// The whole face of a body that lies flat.
struct WholeFace {};

/// Where the patch radius comes from. Kept with the contact, so that it follows when radius, mass, friction or gravity
/// change.
using PatchSource = std::variant<PatchRadius, SpinDeceleration, HertzModuli, WholeFace>;

/// The patch where ball and plane touch, and its friction.
struct Contact {
  double friction;  ///< coefficient of dry friction
  PatchSource patch;
  std::string law = {};         ///< of friction, by its name, where the pressure is not that of the body
  double rolling_friction = 0;  ///< u_r: rolling without slip, the ball slows down at u_r g; 0: it rolls on
};

/// A ball that slides along x and spins about the vertical, with no horizontal angular velocity.
struct SlipAndSpin {
  double slip;  ///< m/s, sliding speed of the contact point
  double spin;  ///< rad/s about the vertical, either sign
};

/// Any motion of a ball on the plane.
struct Velocities {
  Eigen::Vector2d velocity;          ///< m/s, of the centre
  Eigen::Vector3d angular_velocity;  ///< rad/s, z up
};

/// How the ball is set going, in the way in which it was given.
using Start = std::variant<SlipAndSpin, Velocities>;

/// What presses the ball on the plane.
struct Environment {
  /// m/s^2, the load over the mass: nothing else of a ball on a horizontal plane depends on it. A ball that something
  /// presses on the plane with N newtons has N/mass.
  double gravity = 9.80665;
  std::optional<double> load{};  ///< N, where it was given in place of gravity, which is load/mass then
  double slope = 0;              ///< degrees above -90 and below 90: the plane rises along x
};

/// m/s^2, the load over the mass: gravity, on a slope times its cosine.
double pressing(const Environment& environment);

/// m/s^2 that gravity alone accelerates along the plane; (0, 0) on a level one.
Eigen::Vector2d pull(const Environment& environment);

/// Everything that decides one motion of a ball on a plane.
struct Experiment {
  Ball ball;
  Contact contact;
  Start start;
  Environment environment{};
  Spreads spreads = {};  ///< what its numbers are known to, where that is said
};

/// What a quantity has been given, as many values as it has components.
struct GivenQuantity {
  const Quantity* quantity;
  std::vector<double> values;
};

/// What an experiment is given by, in the order of quantities(); standard values, gravity's aside, are left out.
std::vector<GivenQuantity> given_by(Experiment experiment);

/// What a patch is given by, in words: "given", "from its spin deceleration 10 rad/s^2", "by Hertz's formula" or "its whole face".
std::string origin_of(const PatchSource& patch);

/// The name of the law of an experiment of which no other is asked for: the contact's own, or that of the body's pressure.
std::string law_of(const Experiment& experiment);

/// The member of an experiment that is a quantity by itself, with no other way to give it; null for others.
double* member_of(Experiment& experiment, const Quantity& quantity);

/// Radius of the contact patch in m, from whatever the contact gives it by.
/// @param law  a measured spin deceleration holds under it
/// @throws std::domain_error  unless it is in (0, R]
double patch_radius_of(const Experiment& experiment, const reduction::Law& law);

/// A start as velocities of the centre and of the ball.
Velocities velocities_of(const Start& start);

/// The same experiment with a start that does not spin about the vertical.
Experiment without_spin(Experiment experiment);

/// Velocity (m/s) of the point of the ball that touches the plane, at the start:
///   (vx - R omega_y, vy + R omega_x), Zh98 (2.1); 0 where the terms cancel to rounding.
Eigen::Vector2d slip_velocity_at_start(const Experiment& experiment);

/// Its size in m/s.
double slip_at_start(const Experiment& experiment);

/// omega_z in rad/s at the start.
double spin_at_start(const Experiment& experiment);

/// Rejects what no ball can be or do.
/// @throws std::domain_error  if a value is outside its Quantity's range, or if R omega_z or the slip overflows; as
///                            patch_radius_of, where no law decides the patch
void require_experiment(const Experiment& experiment);

/// Rejects a motion whose lengths, angles or energies may exceed the largest double.
/// @param braked  s, when friction has ended
/// @param last    s, the last instant that is asked for, if one is
/// @throws std::domain_error  with the greatest speed that is allowed
void require_finite_motion(const Experiment& experiment, double braked, double last = 0);

}  // namespace contensou::si
