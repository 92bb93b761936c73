#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/spreads.hpp"

namespace contensou::si {

/// Elastic constants of the two bodies in contact. In each array the ball is first, the plane second.
struct HertzModuli {
  std::array<double, 2> youngs_modulus;  ///< Pa, > 0
  std::array<double, 2> poisson_ratio;   ///< -1 < nu <= 1/2

  /// Radius R_c of the second body at the contact, m: infinite for a plane, negative for a dish; never 0.
  double counter_radius = std::numeric_limits<double>::infinity();
};

/// Returns E* in Pa: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
double effective_modulus(const HertzModuli& moduli);

/// Returns the patch radius (m) of a ball on a plane or a sphere: eps = (3 N R'/(4 E*))^(1/3), 1/R' = 1/R + 1/R_c.
///
/// @param normal_force  N, in newtons
/// @param ball_radius   R, m
/// @throws std::domain_error  unless R' is positive; in a dish no wider than the ball there is no single patch
double hertz_patch_radius(double normal_force, double ball_radius, const HertzModuli& moduli);

/// Returns the patch radius (m) of a ball whose spin about the vertical falls at a measured rate without sliding:
///   eps = R^2 alpha/(gamma f g Psi(0)).
///
/// This follows from J domega_z/dt = -f N eps Psi(0) with J = m R^2/gamma and N = m g.
///
/// @param ball_radius              R, m
/// @param deceleration             alpha, rad/s^2
/// @param dry_friction             f
/// @param acceleration_of_gravity  g, m/s^2
/// @param pivoting_moment          Psi(0) of the law: 3 pi/16 for the exact and the Pade law, 2/3 for uniform pressure
/// @param gamma                    m R^2/J, the inertia number of the body
double patch_radius_of_deceleration(double ball_radius, double deceleration, double dry_friction,
                                    double acceleration_of_gravity, double pivoting_moment,
                                    double gamma = reduction::homogeneous_ball.gamma);

/// An axisymmetric body.
struct Body {
  std::string_view name = "ball";  ///< empty for a body without a name
  reduction::Inertia inertia = reduction::homogeneous_ball;
  std::optional<double> patch_ratio{};  ///< patch radius/R if the body fixes it: a puck rests on its whole face
  bool rolls_on_a_small_patch = true;   ///< true: a ball, whose mu = patch radius/R must be at most 1
  std::string_view law = "exact";       ///< name of the friction law that follows from the body's pressure
  std::optional<double> factor = {};    ///< moment of inertia divided by m R^2, if given (with_factor)

  /// Returns true if the body turns about the vertical only, and never rolls.
  bool lies_flat() const { return inertia.chi == 1; }

  /// Returns the body with a moment of inertia of factor m R^2, about any axis of a ball or about the vertical of a
  /// body that lies flat. R is the largest radius with mass; this bounds the factor.
  /// @param of_m_R2  factor, above 0; at most 2/3, or 1 for a body that lies flat. A factor beyond this limit by up to
  ///                 0.1 % is the limit, rounded
  /// @throws std::domain_error  for any other factor
  Body with_factor(double of_m_R2) const;

  /// Returns the reason why mu is impossible for the body; empty if it is possible.
  std::string complaint(double mu) const;
};

/// Returns all bodies that have a name.
const std::vector<Body>& bodies();

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

/// Mass of a cue of 19 oz in kg.
inline constexpr double standard_cue_mass = 0.54;

/// A stroke with a cue that points along x. The tip hits the ball off its centre, as seen along the cue.
struct CueStrike {
  double speed;                     ///< speed of the cue, m/s, > 0
  double right;                     ///< offset to the right of the centre, in radii of the ball
  double above;                     ///< offset above the centre, in radii of the ball
  double elevation;                 ///< elevation of the cue's butt in degrees, 0 <= elevation < 90
  double mass = standard_cue_mass;  ///< mass of the cue, kg, > 0
};

/// Offset of the tip from the centre, in radii of the ball, above which the tip slips off.
inline constexpr double largest_tip_offset = 0.5;

/// Computes the velocities that a stroke gives to a ball at rest.
///
/// The cue is a rod of mass M and speed s at the elevation e. Its elastic impulse P acts along the cue; the tip has no
/// friction. The cue points along d = (cos e, 0, -sin e). The tip is at r = -c d - a y + b n, with the offsets a
/// (right), b (above) and c (along the cue), and n = (sin e, 0, cos e). For J = m R^2/gamma
///   m V = P d,  J omega = r x P d = P (a sin e, b, a cos e).
/// The points of contact separate as fast as they met. Therefore
///   P = 2 m s/(1 + m/M + gamma (a^2 + b^2)/R^2).
/// The table takes the downward part of V. The friction of the table during the impact is left out. The model is that
/// of W. Leckie and M. Greenspan, "An event-based pool physics simulator", LNCS 4250 (2006) 247,
/// doi:10.1007/11922155_19. Their b is measured in the vertical plane.
///
/// @throws std::domain_error  if a value is out of its range, or the tip slips off the ball
Velocities struck(const Ball& ball, const CueStrike& strike);

}  // namespace contensou::si
