#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contensou::si {

/// A number or vector of an experiment: a key of run files, an option of the program and a field of Python's Ball.
struct Quantity {
  enum class Range { any, not_zero, not_negative, positive, poisson_ratio, tilt };

  std::string_view name;  ///< name in run files, a key
  std::string_view unit;  ///< SI unit; empty for a pure number
  std::string_view meaning;
  Range range;
  std::string_view section;             ///< section of a run file
  std::string_view components = {};     ///< names of a vector's components, with commas; empty for a number
  std::optional<double> standard = {};  ///< default value; it may be infinity, which a user cannot give

  /// Returns the number of components.
  std::size_t count() const;
};

inline constexpr Quantity mass{"mass", "kg", "mass of the ball", Quantity::Range::positive, "ball"};
inline constexpr Quantity radius{"radius", "m", "radius of the ball", Quantity::Range::positive, "ball"};
inline constexpr Quantity inertia_factor{
    "inertia", "",
    "moment of inertia divided by m R^2: of a ball 2/5 (homogeneous) or 2/3 (hollow), of a disc 1/2 and of a ring 1 "
    "about the vertical",
    Quantity::Range::positive, "ball"};
inline constexpr Quantity friction{"friction", "", "coefficient of dry friction", Quantity::Range::positive, "contact"};
inline constexpr Quantity rolling_friction{
    .name = "rolling_friction",
    .unit = "",
    .meaning =
        "coefficient of rolling resistance: deceleration of a rolling ball divided by gravity (pool 0.005 to 0.015)",
    .range = Quantity::Range::not_negative,
    .section = "contact",
    .standard = 0};
inline constexpr Quantity patch_radius{"patch_radius", "m", "radius of the contact patch", Quantity::Range::positive,
                                       "contact"};
inline constexpr Quantity spin_deceleration{"spin_deceleration", "rad/s^2",
                                            "measured angular deceleration of a ball that spins in place",
                                            Quantity::Range::positive, "contact"};
inline constexpr Quantity youngs_modulus{
    "youngs_modulus", "Pa", "Young's moduli of ball and plane", Quantity::Range::positive, "contact.hertz", "E1,E2"};
inline constexpr Quantity poisson_ratio{
    "poisson_ratio", "",     "Poisson's ratios of ball and plane", Quantity::Range::poisson_ratio,
    "contact.hertz", "N1,N2"};
inline constexpr Quantity counter_radius{
    .name = "counter_radius",
    .unit = "m",
    .meaning = "radius of the surface below, which changes the patch alone: > 0 for another ball, < 0 for a dish",
    .range = Quantity::Range::not_zero,
    .section = "contact.hertz",
    .standard = std::numeric_limits<double>::infinity()};
inline constexpr Quantity slip{"slip", "m/s", "sliding speed of the contact point, along x",
                               Quantity::Range::not_negative, "start"};
inline constexpr Quantity spin{"spin", "rad/s", "angular velocity about the vertical", Quantity::Range::any, "start"};
inline constexpr Quantity velocity{"velocity",           "m/s",   "velocity of the centre, x and y",
                                   Quantity::Range::any, "start", "VX,VY"};
inline constexpr Quantity angular_velocity{"angular_velocity",   "rad/s", "angular velocity about x, y and z (up)",
                                           Quantity::Range::any, "start", "WX,WY,WZ"};
inline constexpr Quantity gravity{.name = "gravity",
                                  .unit = "m/s^2",
                                  .meaning = "acceleration of gravity",
                                  .range = Quantity::Range::positive,
                                  .section = "environment",
                                  .standard = 9.80665};
inline constexpr Quantity load{"load", "N", "normal force on the plane, in place of the weight",
                               Quantity::Range::positive, "environment"};
inline constexpr Quantity slope{.name = "slope",
                                .unit = "deg",
                                .meaning = "angle of the plane against the horizontal; above 0 the plane rises along x",
                                .range = Quantity::Range::tilt,
                                .section = "environment",
                                .standard = 0};

/// Returns all quantities in the order of a run file.
const std::vector<const Quantity*>& quantities();

/// The ways to give one value, of which a user chooses one. The quantities of one way belong together.
using Ways = std::vector<std::vector<const Quantity*>>;

/// Returns the quantities of a way that must all be given. The other quantities of the way have a default.
Ways::value_type needed_of(const Ways::value_type& way);

/// Returns the values of an experiment that can be given in several ways: the patch, the start and the load.
const std::vector<Ways>& alternatives();

/// A unit that may follow a number. It equals factor/divisor SI units.
struct Unit {
  std::string_view symbol;
  double factor;
  double divisor = 1;
};

/// A dimension: its SI unit (or degrees) and the other units that users may write.
struct Dimension {
  std::string_view name;    ///< name in the program's help
  std::string_view symbol;  ///< symbol of the unit that a number without a unit has
  std::string_view words;   ///< name of this unit in the plural
  std::vector<Unit> others;
};
const std::vector<Dimension>& dimensions();

/// Returns the dimension to which a unit's symbol belongs; null for the empty symbol of a pure number.
const Dimension* find_dimension(std::string_view symbol);

/// Returns the units as text, such as "m, cm, mm, in, ft or yd".
std::string units_of(const Dimension& dimension);

/// Returns the value of a number that is followed by one of the units, such as "2.25 in"; empty for any other text.
std::optional<double> parse_quantity(std::string_view text, const Dimension& dimension);

/// Throws for a value that the quantity cannot have. Infinity and NaN are never allowed.
/// @throws std::domain_error  with the quantity, the allowed values and the value in the message
void require(const Quantity& quantity, double value);

}  // namespace contensou::si
