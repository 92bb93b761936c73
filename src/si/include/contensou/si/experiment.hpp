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

/// The mass of a ball without a given mass. Every energy computed from it is NaN. The motion needs no mass.
inline constexpr double unknown_mass = std::numeric_limits<double>::quiet_NaN();

/// A ball, or a body that lies flat.
struct Ball {
  std::string name;
  double mass = unknown_mass;  ///< kg
  double radius;               ///< m
  Body body = {};              ///< one of bodies(), with its own inertia factor if one is given
};

/// Returns true if the mass is given, that is, is not unknown_mass.
bool mass_is_known(const Ball& ball);

/// Returns the mass of a ball in kg.
/// @param user  the function that needs the mass, for the message
/// @throws std::domain_error  if the mass is not known
double mass_for(std::string_view user, const Ball& ball);

/// A measured patch radius.
struct PatchRadius {
  double value;  ///< m
};

/// The rate at which a spin without sliding falls. The patch follows from it (patch_radius_of_deceleration).
struct SpinDeceleration {
  double value;  ///< rad/s^2
};

/// The patch is the whole face of a body that lies flat.
struct WholeFace {};

/// The source of the patch radius. The radius is recomputed from the source if R, mass, friction or gravity change.
using PatchSource = std::variant<PatchRadius, SpinDeceleration, HertzModuli, WholeFace>;

/// The patch where ball and plane touch, and its friction.
struct Contact {
  double friction;  ///< coefficient of dry friction
  PatchSource patch;
  std::string law = {};         ///< name of the friction law, if it is not the law of the body's pressure
  double rolling_friction = 0;  ///< coefficient u_r: a ball that rolls without slip slows down at u_r g; 0: it rolls on
};

/// A start of a ball that slides along x and spins about the vertical, without horizontal angular velocity.
struct SlipAndSpin {
  double slip;  ///< sliding speed of the contact point, m/s
  double spin;  ///< spin about the vertical, rad/s, of either sign
};

/// Any motion of a ball on the plane.
struct Velocities {
  Eigen::Vector2d velocity;          ///< velocity of the centre, m/s
  Eigen::Vector3d angular_velocity;  ///< rad/s, z up
};

/// The start of a motion, in either of the forms in which it can be given.
using Start = std::variant<SlipAndSpin, Velocities>;

/// The forces between ball and plane other than friction.
struct Environment {
  /// Load divided by mass, m/s^2. The motion on a level plane depends on this ratio only. It is N/mass for a ball that
  /// is pressed on the plane by N newtons.
  double gravity = 9.80665;
  std::optional<double> load{};  ///< load in N, if given; gravity is then load/mass
  double slope = 0;              ///< angle of the plane in degrees, above -90 and below 90; it rises along x
};

/// Returns the load divided by the mass, m/s^2: gravity, multiplied on a slope by the cosine of the angle.
double pressing(const Environment& environment);

/// Returns the acceleration of gravity along the plane, m/s^2; (0, 0) on a level plane.
Eigen::Vector2d pull(const Environment& environment);

/// All values that determine one motion of a ball on a plane.
struct Experiment {
  Ball ball;
  Contact contact;
  Start start;
  Environment environment{};
  Spreads spreads = {};  ///< standard deviations of the numbers, if given
};

/// A quantity with its values, one for each component.
struct GivenQuantity {
  const Quantity* quantity;
  std::vector<double> values;
};

/// Returns the values by which an experiment is given, in the order of quantities(). Only gravity may be a default.
std::vector<GivenQuantity> given_by(Experiment experiment);

/// Returns the source of a patch in words: "given", "from its spin deceleration 10 rad/s^2", "by Hertz's formula" or
/// "its whole face".
std::string origin_of(const PatchSource& patch);

/// Returns the name of the law of an experiment: the law of the contact if given, else the law of the body's pressure.
std::string law_of(const Experiment& experiment);

/// Returns the member of an experiment that stores a quantity; null if there is none, as for all of alternatives().
double* member_of(Experiment& experiment, const Quantity& quantity);

/// Returns the radius of the contact patch in m, from its source.
/// @param law  law under which the spin deceleration was measured
/// @throws std::domain_error  unless the radius is in (0, R]
double patch_radius_of(const Experiment& experiment, const reduction::Law& law);

/// Returns a start as velocity of the centre and angular velocity.
Velocities velocities_of(const Start& start);

/// Returns the experiment with a start that does not spin about the vertical.
Experiment without_spin(Experiment experiment);

/// Returns the velocity (m/s), at the start, of the point of the ball that touches the plane: (vx - R omega_y, vy + R
/// omega_x). It is 0 if the terms cancel up to rounding.
Eigen::Vector2d slip_velocity_at_start(const Experiment& experiment);

/// Returns the slip at the start in m/s, the absolute value of slip_velocity_at_start.
double slip_at_start(const Experiment& experiment);

/// Returns the spin omega_z at the start in rad/s.
double spin_at_start(const Experiment& experiment);

/// Throws for values that no ball can have.
/// @throws std::domain_error  if a value is outside its Quantity's range, or R omega_z or the slip overflows; as
///                            patch_radius_of, if the patch does not depend on the law
void require_experiment(const Experiment& experiment);

/// Throws for a motion whose lengths, angles or energies may exceed the largest double.
/// @param braked  time at which friction ends, s
/// @param last    last requested time, s, if any
/// @throws std::domain_error  with the largest allowed speed in the message
void require_finite_motion(const Experiment& experiment, double braked, double last = 0);

}  // namespace contensou::si
