#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_symmetry.hpp"

namespace contensou::reduction {

/// A point in the canonical coordinates of a scaling X: x = x_0 + S exp(p A') n(q), A' = S^-1 A S, n(q) = (cos q, sin
/// q). S n is the closed curve p = 0. X moves p alone, p -> p + s. For A = 1 the curve is a circle, p is ln |x - x_0|
/// up to a constant, and q the angle.
struct PlanarCanonical {
  double q;      ///< angle, -pi < q <= pi
  double p;      ///< -infinity at the centre x_0
  double dp_dq;  ///< R/T along the orbit through the point; infinite on a ray; NaN at the centre
};

/// The end of an orbit or of a sector.
enum class PlanarEnd {
  centre,  ///< x_0
  infinity,
  rest,         ///< a point other than the centre, at which the field vanishes
  border,       ///< a pole, a border of the field's values, or a jump: no orbit goes on
  periodic,     ///< no end: the orbit is closed
  undecided,    ///< unknown: PlanarReduction::undecided returns the reason
  equilibrium,  ///< a zero of the field, which the orbit approaches for ever
  cycle,        ///< a closed orbit, which the orbit approaches for ever
};

inline constexpr int planar_ends = 8;

/// Returns the name of the enumerator, such as "centre".
std::string_view name(PlanarEnd end);

/// An orbit with a constant q: the field points along X there.
struct PlanarRay {
  double q;
  bool attracts;   ///< true if its neighbours on both sides tend to it
  bool to_centre;  ///< true if the motion on it goes to the centre
  double radial;   ///< R: dp = R d sigma, d sigma = exp(-c p) dt; an eigenvalue of the field blown up at the centre
  double angular;  ///< dT/dq, the other eigenvalue; on the counter-clockwise side unless only the other side is a ray
  double order;    ///< a of |T| ~ |q - q_ray|^a: 1 for a simple ray, 2 for a double one
  double k = std::numeric_limits<double>::quiet_NaN();  ///< |v|/(mu |u|), if `reduced` made the system
};

/// The directions between two rays or borders, which no orbit crosses.
struct PlanarSector {
  double from, to;        ///< q in the direction of the motion, at most 2 pi apart; it grows if from < to
  bool from_ray, to_ray;  ///< false: a border
};

/// The change of p and sigma in each turn of a field without rays.
struct PlanarTurn {
  double factor;  ///< factor of exp(p); for A = 1 of the distance
  double sigma;   ///< sigma of a turn, d sigma = exp(-c p) dt; the period, if c = 0
};

/// Thrown if T of README (R42) comes so near to 0 that its values do not determine whether there are rays.
class UndecidedRays : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

class Flow;
class PlanarOrbit;

/// V in a rectangle, except for a constant factor.
struct FactorPiece {
  Eigen::Vector2d low, high;
  std::function<double(const Eigen::Vector2d& x)> value;  ///< NaN where V has no value
};

/// A planar system x' = f(x) reduced to quadratures, by a scaling X = c t d/dt + A (x - x_0) . d/dx, for which f on one
/// closed curve about x_0 is all of f, or by an inverse integrating factor V alone (reduced_by_factor).
///
///     const PlanarReduction reduction(field, *find_symmetries(field, start).scaling, start);
///     reduction.end(start);        // PlanarEnd::centre
///     reduction.end_time(start);   // when
///     reduction.orbit(start).at(0.5)
///
/// README (R42) to (R45). A value; copies share what is solved.
///
/// Accuracy  relative 1e-12 of times, for a field that is smooth except for kinks and jumps and accurate to its last
///           bits. It is less next to multiple rays and poles that lie on no axis: end_time_error() estimates by how
///           much. Two rays closer than 1e-7, and rays that T misses by its rounding, count as one double ray.
class PlanarReduction {
 public:
  /// @param scaling  scaling of the field
  /// @param around   point other than the centre at which the field has a value and is not tiny
  /// @param noise    relative error of the field's values (PlanarSymmetries::residual)
  /// @throws std::domain_error  unless all eigenvalues of A have positive real parts; for a field without values
  /// @throws UndecidedRays      if T comes near to 0 and its values show no zero of any order
  PlanarReduction(PlanarField field, const Generator& scaling, const Eigen::Vector2d& around, double noise = 0);

  struct Solution;  // planar/solution.hpp
  explicit PlanarReduction(std::shared_ptr<const Solution> solution);

  /// Returns the method of the solution: "scaling", or a form of FactorReduction.
  std::string_view form() const;

  const PlanarField& field() const;

  /// Returns V, an inverse integrating factor: f . grad V = V div f. By a scaling it is f ^ (A (x - x_0)).
  /// @throws std::domain_error  if x is not finite, or V is not known there
  double factor(const Eigen::Vector2d& x) const;

  /// Returns V in the parts of a rectangle in which it is known and may vanish: fitted anew there, where the form of V
  /// is that of a box. Empty by a scaling, whose rays are the curves V = 0. Where several V of the form exist, each
  /// with curves V = 0 of its own, only a V that is the same everywhere is returned.
  std::vector<FactorPiece> factor_pieces(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;

  /// Returns the scaling that solves it; null where V alone does. Without a scaling there are no centre, canonical
  /// coordinates, rays, sectors, turn and kind.
  const Generator* scaling() const;
  const Eigen::Vector2d& centre() const;

  /// Returns the flow that solves system (2.6), given to `reduced`; null for another system.
  const Flow* flow() const;

  /// @throws std::domain_error  if x is not finite, and without a scaling
  PlanarCanonical canonical(const Eigen::Vector2d& x) const;
  Eigen::Vector2d point(double q, double p) const;

  /// Returns true if T = 0 throughout, so that every ray is an orbit.
  bool star() const;
  /// Returns the rays in the order of q; empty for a star.
  const std::vector<PlanarRay>& rays() const;
  /// Returns the sectors counter-clockwise; empty for a star and if orbits turn for ever. Directions without values of
  /// the field have none.
  const std::vector<PlanarSector>& sectors() const;
  /// Returns the turn of a field without rays, stars and borders; else null.
  const PlanarTurn* turn() const;

  /// Returns one of planar_kinds: "stable node", "unstable node", "saddle", "stable focus", "unstable focus", "center",
  /// "stable star", "unstable star"; "regular point", which orbits pass, and "cusp", which they pass as well, where the
  /// field is 0 or has no value; "mixed" with sectors of several kinds; "degenerate" if all points of a ray are at
  /// rest; "bordered" if the field has values in a part of the plane, a pole or a jump that orbits do not cross; empty
  /// if it is not decided.
  std::string_view kind() const;

  /// Returns the reason why some kinds and ends are not decided; empty if all are.
  const std::string& undecided() const;

  /// Returns the end of the motion from a point.
  /// @throws std::domain_error  if x is not finite, or the field has no value there
  PlanarEnd end(const Eigen::Vector2d& x) const;

  /// Returns the time of the end: 0 at the centre; infinity if it takes for ever. By a scaling it is infinity before a
  /// border. By V alone it is the time at the border, and NaN if the end is not decided.
  double end_time(const Eigen::Vector2d& x) const;

  /// Returns an estimate of the relative error of end_time(x): eight times the difference from a solution about another
  /// curve, at least 1e-13; 0 for an end time of 0 or infinity. Cost: as a second PlanarReduction.
  /// @throws as end, and as the constructor
  double end_time_error(const Eigen::Vector2d& x) const;

  /// Returns a number that is constant along an orbit. By V alone it is H, dH = (F dv - G du)/V, 0 at the start of the
  /// search. By a scaling it is p - L(q), the logarithm of the factor that moves one curve of the sector onto the orbit
  /// of x. Orbits of one sector differ in it; exp(s X) adds s; a turn about a centre without rays subtracts ln factor.
  /// @throws std::domain_error  as end; on a ray and where V = 0, where it has no value
  double first_integral(const Eigen::Vector2d& x) const;

  PlanarOrbit orbit(const Eigen::Vector2d& start) const;

  /// Returns the first part of the orbit, for a picture. If V alone solves the system, the end may stay undecided.
  PlanarOrbit part_of_orbit(const Eigen::Vector2d& start) const;

  /// Returns the system whose motions go the other way: x' = -f(x).
  PlanarReduction reversed() const;

 private:
  std::shared_ptr<const Solution> solution_;
};

/// Returns system (2.6) in the whole plane, planar_field, solved by its flow. Its rays are those of the phase plane.
///
/// p is ln |x|. The first integral is that of the flow, ln |u| - ln w(k). With a drive v = 0 is a border. Two motions
/// leave each point there, mirror images of one another, so that orbits from v = 0 are refused.
///
/// Accuracy  that of the flow: StopTime::accuracy for times. reversed() solves the field by its values, as
///           PlanarReduction does.
/// Cost      0.1 ms, and the solution of the flow
PlanarReduction reduced(const Flow& flow);

/// One motion of a planar system.
class PlanarOrbit {
 public:
  struct Motion;  // planar/solution.hpp
  explicit PlanarOrbit(std::shared_ptr<const Motion> motion);

  PlanarEnd end() const;
  double end_time() const;

  /// Returns the period of a motion that returns.
  std::optional<double> period() const;

  /// Returns the reason why the end is not decided; empty if it is.
  const std::string& undecided() const;

  /// Returns the state at a time after the start; from end_time on the point of rest, if the motion ends in one.
  /// @throws std::domain_error  unless time >= 0; for a time at which it is at infinity or beyond a border
  Eigen::Vector2d at(double time) const;

 private:
  std::shared_ptr<const Motion> motion_;
};

}  // namespace contensou::reduction
