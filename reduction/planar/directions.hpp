#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "numerics/epsilon.hpp"
#include "numerics/legendre_series.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

/// A function that is a power to leading order: factor z^order (1 + ...) for small z > 0.
struct LeadingPower {
  double order = 0;
  double factor = 0;  ///< 0 if the function vanishes identically
};

/// A direction with the error of its angle. The error is 0 for an axis.
struct Place {
  // NOLINTNEXTLINE(google-explicit-constructor): a direction is a place
  Place(const Eigen::Vector2d& at) : Place(at, at[0] == 0 || at[1] == 0 ? 0 : 2 * eps) {}
  Place(const Eigen::Vector2d& at, double known_to) : n(at), error(known_to) {}

  Eigen::Vector2d n;
  double error;
};

/// The rates R and T of planar.md (R64) beside a direction, on one side, as functions of the angle z > 0 from it (R65).
/// The leading orders come from a series through samples, in powers of z, of its square root or of its cube root,
/// poles included. If no series converges, the orders are slopes of logarithms. These slopes must agree at several
/// distances.
class Approach {
 public:
  using Rates = SectionField::Rates;

  /// Makes the object for a side on which the field has no values.
  Approach() = default;

  /// @param side    1: the side counter-clockwise of the direction; -1: the side clockwise of it
  /// @param length  angle to the next direction at which R or T might not be smooth
  /// @param noise   relative error of the field's values
  Approach(const SectionField& field, const Place& place, double side, double length, double noise);

  const Eigen::Vector2d& n() const { return n_; }

  /// True if the field has values next to the direction.
  bool exists() const { return exists_; }

  /// True if the leading orders of R and T are known.
  bool decided() const { return decided_; }

  /// Marks the orders as unknown.
  void leave_open() { decided_ = false; }

  /// T times side; positive if the motion on this side leads away from the direction.
  const LeadingPower& angular() const { return angular_; }
  const LeadingPower& radial() const { return radial_; }

  /// True if the field has a limit for z -> 0 and this limit is parallel to the scaling.
  bool ray() const { return decided_ && angular_.order > 0 && radial_.order >= 0; }
  /// True if R and T have limits and the limit of T is not 0.
  bool regular() const { return decided_ && angular_.order == 0 && radial_.order >= 0; }

  /// The exponent gamma in dp/dz ~ z^(gamma - 1) along orbits. p stays bounded if gamma > 0.
  double growth() const { return radial_.order - angular_.order + 1; }

  /// Largest angle z up to which the series give T and R to all digits; 0 if there are no series.
  double width() const { return width_; }
  /// Returns T times side, and R, at an angle z up to width().
  Rates series(double z) const;

 private:
  bool find_series(const SectionField& field, double width, int root, double noise, bool componentwise);
  void find_slopes(const SectionField& field, double length, double noise);

  Eigen::Vector2d n_ = Eigen::Vector2d::Zero();
  double side_ = 1;  ///< 1: the side counter-clockwise of the direction; -1: clockwise of it
  double error_ = 0;
  bool exists_ = false, decided_ = false;
  LeadingPower angular_, radial_;
  double width_ = 0;
  double root_ = 1;
  LegendreSeries angular_rest_, radial_rest_;  ///< T/z^order and R/z^order as series in z^(1/root)
};

/// Moves a direction onto a multiple zero of T beside it. Values of T lose half of their digits or more there, so the
/// result is the simple zero of a derivative of T. Without a multiple zero the result is the given direction.
Place sharpened_zero(const SectionField& field, const Eigen::Vector2d& n, double noise);

/// Moves a direction onto a pole of even order beside it. Without such a pole the result is the given direction.
Place sharpened_pole(const SectionField& field, const Eigen::Vector2d& n, double noise);

/// Returns the counter-clockwise angle from one direction to another, in (0, 2 pi].
double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// A direction that no orbit crosses: a ray, a jump at which T changes its sign, a pole, or a border. Beyond a border
/// the field has no values.
struct Direction {
  Eigen::Vector2d n;
  Approach before, after;                    ///< the side clockwise and the side counter-clockwise of the direction
  std::optional<SectionField::Rates> rates;  ///< rates at the direction itself; empty if the field has no value there
};

/// The directions of a section (SectionField), counter-clockwise along the closed curve of the section.
struct Directions {
  bool star = false;                    ///< true if T = 0 for all directions
  std::vector<Direction> dividing;      ///< counter-clockwise
  std::vector<Eigen::Vector2d> smooth;  ///< directions that orbits cross although R or T has a kink or a jump there
};

/// Thrown if T near a direction is 0 within its errors, so that it is unknown whether T vanishes there.
struct UndecidedDirection {
  Eigen::Vector2d n;
};

/// Finds the directions that divide a section.
///
/// Samples are evenly spaced. They become denser towards u = 0, v = 0 and the diagonals between these axes, because all
/// structure of a law can lie there. Between samples, zeros of T are found by a change of sign or at the least |T|;
/// poles by a change of sign or at the largest field. Structure narrower than the distance of the samples, pi/128, can
/// be missed.
///
/// @param noise    relative error of the field's values
/// @param between  further directions at which to sample
/// @throws std::domain_error  if the field has no values
/// @throws UndecidedDirection
Directions find_directions(const SectionField& field, double noise, std::vector<Eigen::Vector2d> between);

}  // namespace contensou::reduction
