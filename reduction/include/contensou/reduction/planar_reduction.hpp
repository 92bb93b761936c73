#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_symmetry.hpp"

namespace contensou::reduction {

/// A point in the canonical coordinates of a scaling X: x = x_0 + S exp(p A') n(q), n(q) = (cos q, sin q), S n the closed
/// curve p = 0 and A' = S^-1 A S. X moves p alone, p -> p + s; for A = 1 the curve is a circle, p = ln |x - x_0| up to a
/// constant and q the angle.
struct PlanarCanonical {
  double q;      ///< in (-pi, pi]
  double p;      ///< -infinity at the centre x_0
  double dp_dq;  ///< R/T along the orbit through it; infinite on a ray; NaN at the centre
};

/// Where an orbit ends, or where a sector does.
enum class PlanarEnd {
  centre,  ///< x_0
  infinity,
  rest,         ///< a point other than the centre, at which the field vanishes
  border,       ///< a pole, a border of the field's values, or a jump: no orbit goes on
  periodic,     ///< none: the orbit returns
  undecided,    ///< not known: PlanarReduction::undecided says why
  equilibrium,  ///< a zero of the field, which the orbit nears for ever
  cycle,        ///< a closed orbit, which it nears for ever
};

/// As its name in C++, such as "centre".
std::string_view name(PlanarEnd end);

/// An orbit on which q stays: the field points along X there.
struct PlanarRay {
  double q;
  bool attracts;   ///< its neighbours on both sides, as time goes on
  bool to_centre;  ///< the motion on it
  double radial;   ///< R: dp = R d sigma, d sigma = exp(-c p) dt; an eigenvalue of the field blown up at the centre
  double angular;  ///< dT/dq: the other one, on the counter-clockwise side unless only the other is a ray
  double order;    ///< a of |T| ~ |q - q_ray|^a: 1 for a simple ray, 2 for a double one
};

/// Directions between two rays or borders, which no orbit crosses.
struct PlanarSector {
  double from, to;        ///< q in the way of the motion, at most 2 pi apart; it grows where from < to
  bool from_ray, to_ray;  ///< else a border
};

/// What is always the same after a turn of a field without rays.
struct PlanarTurn {
  double factor;  ///< by which exp(p) changes: of the distance, where A = 1
  double sigma;   ///< in d sigma = exp(-c p) dt; the period, where c = 0
};

/// T, of README (R42), comes so near to 0 that its values do not tell if rays are there.
class UndecidedRays : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

class PlanarOrbit;

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
/// Accuracy  relative 1e-12 of times, for a field that is smooth except for kinks and jumps and good to its last bits.
///           Next to multiple rays and poles that lie on no axis digits are lost: end_time_error() estimates how many.
///           Two rays closer to one another than 1e-7, and rays that T misses by its rounding, count as one double ray.
class PlanarReduction {
 public:
  /// @param scaling  of the field
  /// @param around   a point other than the centre, where the field may be called and is not tiny
  /// @param noise    of its values, relative: what PlanarSymmetries::residual says
  /// @throws std::domain_error  unless all eigenvalues of A have positive real parts; and for a field without values
  /// @throws UndecidedRays      where T comes near to 0 and its values show no zero of any order
  PlanarReduction(PlanarField field, const Generator& scaling, const Eigen::Vector2d& around, double noise = 0);

  struct Solution;  // planar/solution.hpp
  explicit PlanarReduction(std::shared_ptr<const Solution> solution);

  /// Returns the way it was solved: "scaling", or a form of FactorReduction.
  std::string_view form() const;

  const PlanarField& field() const;

  /// Returns V, an inverse integrating factor: f . grad V = V div f. By a scaling it is f ^ (A (x - x_0)).
  /// @throws std::domain_error  if x is not finite, or V is not known there
  double factor(const Eigen::Vector2d& x) const;

  /// Returns the scaling that solves it; null where V alone does. Without a scaling there are no centre, canonical
  /// coordinates, rays, sectors, turn and kind.
  const Generator* scaling() const;
  const Eigen::Vector2d& centre() const;

  /// @throws std::domain_error  if x is not finite, and without a scaling
  PlanarCanonical canonical(const Eigen::Vector2d& x) const;
  Eigen::Vector2d point(double q, double p) const;

  /// Whether every ray is an orbit: T = 0 throughout.
  bool star() const;
  /// In the order of q; none for a star.
  const std::vector<PlanarRay>& rays() const;
  /// Counter-clockwise; none for a star, and where orbits turn for ever. Where the field has no values there is none.
  const std::vector<PlanarSector>& sectors() const;
  /// Of a field without rays, stars and borders.
  const PlanarTurn* turn() const;

  /// "stable node", "unstable node", "saddle", "stable focus", "unstable focus", "center", "stable star", "unstable
  /// star"; "regular point", which orbits pass, and "cusp", which they pass as well, where the field is 0 or has no value;
  /// "mixed" with sectors of several kinds; "degenerate" if all points of a ray are at rest; "bordered" if the field has
  /// values in a part of the plane, a pole or a jump that orbits do not cross; empty if it is not decided
  std::string_view kind() const;

  /// Why some kinds and ends are not decided; empty if all are.
  const std::string& undecided() const;

  /// Where the motion from this point ends.
  /// @throws std::domain_error  if x is not finite, or the field has no value there
  PlanarEnd end(const Eigen::Vector2d& x) const;

  /// When it is there: 0 at the centre; infinity if it takes for ever; the time of a border by V alone, else infinity
  /// before one; NaN if the end is not decided, by V alone.
  double end_time(const Eigen::Vector2d& x) const;

  /// Returns an estimate of the relative error of end_time(x): eight times the difference from a solution about another
  /// curve, at least 1e-13; 0 for an end time of 0 or infinity. Cost: as a second PlanarReduction.
  /// @throws as end, and as the constructor
  double end_time_error(const Eigen::Vector2d& x) const;

  /// Returns a number that is constant along an orbit. By V alone it is H, dH = (F dv - G du)/V, 0 at the start of the
  /// search. By a scaling it is p - L(q), the logarithm of the factor that moves one curve of the sector onto the orbit of x. It is constant
  /// along an orbit, different on any two of one sector, and grows by s under exp(s X); after a turn about a centre
  /// without rays it is less by ln factor.
  /// @throws std::domain_error  as end; on a ray and where V = 0, where it has no value
  double first_integral(const Eigen::Vector2d& x) const;

  PlanarOrbit orbit(const Eigen::Vector2d& start) const;

  /// Returns the first part of the orbit, for a picture: by V alone its end is not decided where that takes more work
  /// than some boxes.
  PlanarOrbit part_of_orbit(const Eigen::Vector2d& start) const;

  /// Returns the system whose motions go the other way: x' = -f(x).
  PlanarReduction reversed() const;

 private:
  std::shared_ptr<const Solution> solution_;
};

/// One motion.
class PlanarOrbit {
 public:
  struct Motion;  // planar/solution.hpp
  explicit PlanarOrbit(std::shared_ptr<const Motion> motion);

  PlanarEnd end() const;
  double end_time() const;

  /// Returns the period, if it returns.
  std::optional<double> period() const;

  /// Returns why the end is not decided; empty if it is.
  const std::string& undecided() const;

  /// Where it is at a time after the start; from end_time on at the centre, if it ends there.
  /// @throws std::domain_error  unless time >= 0; and for a time when it is at infinity or beyond a border
  Eigen::Vector2d at(double time) const;

 private:
  std::shared_ptr<const Motion> motion_;
};

}  // namespace contensou::reduction
