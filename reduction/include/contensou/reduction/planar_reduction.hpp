#pragma once

#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/detail/planar_kinds.hpp"
#include "contensou/reduction/symmetries.hpp"

namespace contensou::reduction {

/// A point in the canonical coordinates q, p of a scaling X (Generator) with the centre x_0 and the matrix A:
/// x = x_0 + S exp(p A') n(q), A' = S^-1 A S, n(q) = (cos q, sin q), S fixed. The closed curve p = 0 is x_0 + S n(q).
/// X moves p alone, p -> p + s. For A = 1 the curve is a circle, p is ln |x - x_0| up to a constant, q is the angle.
struct PlanarCanonical {
  double q;      ///< angle, -pi < q <= pi
  double p;      ///< -infinity at the centre x_0
  double dp_dq;  ///< slope of the orbit through the point, R/T of PlanarRay; infinite on a ray; NaN at the centre
};

/// The end of an orbit or of a sector.
enum class PlanarEnd {
  centre,  ///< the centre x_0 of the scaling
  infinity,
  rest,         ///< a point other than the centre, at which the field, or Filippov's velocity (R62), vanishes
  border,       ///< a pole, a jump, or the edge of the points at which the field has a value; no orbit continues
  periodic,     ///< no end: the orbit is closed
  undecided,    ///< unknown: PlanarReduction::undecided returns the reason
  equilibrium,  ///< a zero of the field, which the orbit approaches for ever
  cycle,        ///< a closed orbit, which the orbit approaches for ever, or joins after a slide
};

inline constexpr int planar_ends = 8;

/// Returns the name of the enumerator, such as "centre".
std::string_view name(PlanarEnd end);

/// An orbit with a constant q. Along it the field f is parallel to X. R = dp/dsigma and T = dq/dsigma are the rates
/// of the canonical coordinates in the time sigma, dsigma = exp(-c p) dt, with c of the Generator.
struct PlanarRay {
  double q;
  bool attracts;   ///< true if neighbouring orbits on both sides tend to the ray
  bool to_centre;  ///< true if the motion on the ray goes to the centre
  double radial;   ///< R on the ray: the radial eigenvalue of the field blown up at the centre
  double angular;  ///< dT/dq, the angular eigenvalue; on the counter-clockwise side unless only the other side is a ray
  double order;    ///< exponent a of |T| ~ |q - q_ray|^a: 1 for a simple ray, 2 for a double one
  double k = std::numeric_limits<double>::quiet_NaN();  ///< |v|/(mu |u|), if `reduced` made the system
};

/// The directions between two neighbours, each a ray or a border. No orbit crosses these two.
struct PlanarSector {
  double from, to;        ///< q where motions begin and q where they end, at most 2 pi apart; q grows if from < to
  bool from_ray, to_ray;  ///< true: this end is a ray; false: it is a border
};

/// The change of p and of the time sigma in one turn about the centre, for a field without rays.
struct PlanarTurn {
  double factor;  ///< factor by which exp(p) grows in a turn; for A = 1 also the factor of the distance
  double sigma;   ///< duration of a turn in sigma, dsigma = exp(-c p) dt; for c = 0 it is the period
};

/// Thrown if T, the rate of q of planar.md (R64), comes so near to 0 that rounding hides whether there are rays.
class UndecidedRays : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

class Flow;
class PlanarOrbit;

/// The inverse integrating factor V (f . grad V = V div f) in a rectangle, up to a constant factor.
struct FactorPiece {
  Eigen::Vector2d low, high;
  std::function<double(const Eigen::Vector2d& x)> value;  ///< V at x; NaN at a point where V has no value
};

/// A form of V that was tried, and the error of the best V of this form in planar.md (R57), f . grad V = V div f.
struct TriedForm {
  std::string_view form;
  double singular_value;  ///< smallest singular value: root mean square of the misfit (R59) over the points of the fit
  double gap;             ///< smallest singular value that does not count as 0, divided by the largest that does
  double residual;        ///< largest misfit (R59) at points that the fit did not use
  bool cleared = false;   ///< true if V D, V times the denominator of the field, has the form
};

/// The first integral H and the inverse integrating factor V at a point, where |grad H| = |f|/|V|.
struct LevelPoint {
  double integral = std::numeric_limits<double>::quiet_NaN(), factor = integral;
};

/// A planar system x' = f(x) reduced to quadratures. The reduction uses a scaling X = c t d/dt + A (x - x_0) . d/dx, so
/// that f on one closed curve about x_0 determines f everywhere. If there is no scaling, the reduction uses an inverse
/// integrating factor V. Orbits of a system without both are integrated by steps.
///
///     const PlanarReduction plane = reduce(field, start);
///     plane.form();                    // "scaling", a form of by_factor, or empty: orbits by steps
///     plane.orbit(start).at(0.5);      // state at the time 0.5
///     if (plane.solved()) plane.end(start);  // PlanarEnd::centre
///
/// Source: planar.md (R64), (R66), (R67), (R69). A value type; copies share the solution.
///
/// Accuracy  relative 1e-12 of times, for a field that is smooth except for kinks and jumps and accurate to its last
///           bits. End times are less accurate next to multiple rays and to poles off the axes: see end_time_error().
///           Two rays closer than 1e-7 count as one double ray, as does a minimum of |T| that equals 0 within rounding.
class PlanarReduction {
 public:
  /// @param scaling  scaling of the field
  /// @param around   point at which the field has a value and is not tiny; not the centre
  /// @param noise    relative error of the field's values (PlanarSymmetries::residual)
  /// @throws std::domain_error  unless all eigenvalues of A have positive real parts; for a field without values
  /// @throws UndecidedRays      if T comes near to 0 and its values do not show whether it vanishes there
  PlanarReduction(SmoothField field, const Generator& scaling, const Eigen::Vector2d& around, double noise = 0);

  struct Solution;  // planar/solution.hpp
  explicit PlanarReduction(std::shared_ptr<const Solution> solution);

  /// Returns the method of the solution: "scaling", or a form of by_factor; empty if orbits are integrated by steps.
  std::string_view form() const;
  bool solved() const { return !form().empty(); }

  /// Returns the reason why the system is not solved by a quadrature; empty if it is.
  const std::string& why_not() const;

  /// Returns the forms of V in the order in which they were tried; empty for a scaling.
  const std::vector<TriedForm>& tried() const;

  /// Returns V up to a constant factor, as a formula in u, v, u' and v'; empty unless V solves the system and has
  /// rational coefficients with which the misfit (R59) is below 1e-12. V of degree 4 or less is factorised.
  std::string formula() const;

  const SmoothField& field() const;

  /// Returns V, an inverse integrating factor: f . grad V = V div f. For a scaling, V is f ^ (A (x - x_0)).
  /// @throws std::domain_error  if x is not finite, or V is not known at x
  double factor(const Eigen::Vector2d& x) const;

  /// Returns V in the parts of a rectangle in which V is known and can vanish. If the form of V holds in a box only, V
  /// is fitted anew in each part. For a scaling the result is empty: the curves V = 0 are its rays. If several V of the
  /// form have different curves V = 0, the result contains only a V that is the same everywhere.
  std::vector<FactorPiece> factor_pieces(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;

  /// Returns the scaling that solves the system; null if V alone solves it. Without a scaling there are no centre,
  /// canonical coordinates, rays, sectors, turn and kind.
  const Generator* scaling() const;
  const Eigen::Vector2d& centre() const;

  /// Returns the flow that solves the equations of motion, as given to `reduced`; null for another system.
  const Flow* flow() const;

  /// @throws std::domain_error  if x is not finite, or if the system has no scaling
  PlanarCanonical canonical(const Eigen::Vector2d& x) const;
  Eigen::Vector2d point(double q, double p) const;

  /// Returns true if T = 0 for every q; then every curve of constant q is an orbit.
  bool star() const;
  /// Returns the rays in the order of q; empty for a star.
  const std::vector<PlanarRay>& rays() const;
  /// Returns the sectors counter-clockwise; empty for a star and if orbits turn for ever. The sectors leave out the
  /// directions in which the field has no values.
  const std::vector<PlanarSector>& sectors() const;
  /// Returns the turn if orbits turn: the field has neither rays nor borders and is no star. Otherwise null.
  const PlanarTurn* turn() const;

  /// Returns one of planar_kinds: "stable node", "unstable node", "saddle", "stable focus", "unstable focus", "center",
  /// "stable star", "unstable star". Orbits pass a "regular point", and also a "cusp", at which the field is 0 or has
  /// no value. "mixed": sectors of several kinds. "degenerate": the field is 0 on a whole ray. "bordered": the field
  /// has values in a part of the plane only, or has a pole or jump that orbits do not cross. Empty: the kind is not
  /// decided.
  std::string_view kind() const;

  /// Returns the reason why some kinds and ends are not decided; empty if all are.
  const std::string& undecided() const;

  /// Returns the kind of end that the motion from a point has.
  /// @throws std::domain_error  if x is not finite, or the field has no value there
  PlanarEnd end(const Eigen::Vector2d& x) const;

  /// Returns the time until the end, also until a border: 0 for a motion that stays at the centre; infinity if the
  /// motion never ends; NaN if the end is not decided.
  double end_time(const Eigen::Vector2d& x) const;

  /// Returns an estimate of the relative error of end_time(x), or of the period: eight times the difference from a
  /// second solution. For a scaling it uses another curve about the centre, and is at least 1e-13; the cost is a second
  /// PlanarReduction. For V it follows the orbit from a later point, in other parts, and is at least 1e-12; 1 if the
  /// two orbits end in different ways. 0 for an end time of 0 or infinity without a period.
  /// @throws as end, and as the constructor
  double end_time_error(const Eigen::Vector2d& x) const;

  /// Returns the same estimate for an orbit from x that is known.
  double end_time_error(const Eigen::Vector2d& x, const PlanarOrbit& orbit) const;

  /// Returns a number that is constant along an orbit. If V alone solves the system it is H, dH = (F dv - G du)/V for f
  /// = (F, G), with H = 0 at the start of the search. For a scaling it is p - L(q), where p = L(q) is one orbit of the
  /// sector. This number differs between orbits of a sector; exp(s X) adds s to it. A turn about a centre without rays
  /// subtracts ln PlanarTurn::factor.
  /// @throws std::domain_error  as end; on a ray and at V = 0, where the first integral has no value
  double first_integral(const Eigen::Vector2d& x) const;

  /// Returns first_integral at the points of a path, and V. H is continued along straight lines from the start of the
  /// search to the first point, and from each point to the next. V is fitted anew where the path leaves its box. H is
  /// NaN where it is not known, and H is the same before and after a turn about a centre without rays.
  std::vector<LevelPoint> levels(const std::vector<Eigen::Vector2d>& path) const;

  PlanarOrbit orbit(const Eigen::Vector2d& start) const;

  /// Returns the first part of the orbit, for a picture. If V alone solves the system, the end might stay undecided.
  PlanarOrbit part_of_orbit(const Eigen::Vector2d& start) const;

  /// Returns the system with all motions reversed: x' = -f(x).
  PlanarReduction reversed() const;

 private:
  std::shared_ptr<const Solution> solution_;
};

/// One motion of a planar system.
class PlanarOrbit {
 public:
  struct Motion;  // planar/solution.hpp
  explicit PlanarOrbit(std::shared_ptr<const Motion> motion);

  PlanarEnd end() const;
  double end_time() const;

  /// Returns the period if the motion is periodic; else empty.
  std::optional<double> period() const;

  /// Returns the time at which an orbit by steps begins to slide or to rest on a switching curve, where other orbits
  /// join it; infinity if it does neither, up to the latest time of `at`.
  double first_slide() const;

  /// Returns the reason why the end is not decided; empty if the end is decided.
  const std::string& undecided() const;

  /// Returns false if the field determines no single motion after the last time of `at`; undecided() says where.
  bool unique() const;

  /// Returns the limits of the coordinates at the end, such as (inf, -5.718) for an end at infinity: infinite, finite,
  /// or NaN if unknown. At infinity they have 9 digits. At a border two sequences of states give them, and digits in
  /// which the two differ are rounded away.
  Eigen::Vector2d limit() const;

  /// Returns the state at a time after the start. A motion that ends where f = 0 stays there from end_time on.
  /// @throws std::domain_error  unless time >= 0; for a time at which the state is at infinity or beyond a border
  Eigen::Vector2d at(double time) const;

 private:
  std::shared_ptr<const Motion> motion_;
};

/// Returns the point whose coordinates set the scale of the samples of a field: the start. If the start lies at the
/// origin, or a million times nearer to it than the first change of the field, the point is (s, s) with the distance s
/// of this change, or 1 without a change. There a component or a switching function changes its sign, or f differs from
/// f(0) by half of f(0).
Eigen::Vector2d sampled_about(const SmoothField& field, const Eigen::Vector2d& start);

/// Returns a point, or one near it if the field has no value there, as the fields of textbooks at some round points.
Eigen::Vector2d valued_near(const SmoothField& field, const Eigen::Vector2d& point);

/// Solves x' = f(x) by a scaling, else by an inverse integrating factor (by_factor), else by steps (by_steps).
/// @param found  symmetries of the field, found about sampled_about(field, start)
/// @throws std::domain_error  unless the start is finite and the field has a value there; as find_symmetries
PlanarReduction reduce(const SmoothField& field, const Eigen::Vector2d& start, const PlanarSymmetries& found);
PlanarReduction reduce(const SmoothField& field, const Eigen::Vector2d& start);

/// Solves x' = f(x) by an inverse integrating factor V, f . grad V = V div f, planar.md (R57) to (R61); else by steps.
///
/// V is sought in a box, +-30 % about the start or, if the start (u, v) is an equilibrium, about (1.25 u, 0.8 v). The
/// search ends at the first form that satisfies the equation: "constant" (div f = 0), "affine" (V = f ^ X, X affine),
/// "polynomial" (degree 4 or less), "linear in v", "quadratic in v", "linear in u", "quadratic in u" (coefficients are
/// functions of the other coordinate) and "product" (V = A(u) B(v)); for a field with a basis only "basis" (V is a sum
/// of its functions). If the field f has a denominator D and no form fits V, the forms are tried for V D, an inverse
/// integrating factor of D f.
///
/// V is 1 at the start unless V vanishes there. V has values in the box of the start; V of form "affine" or "basis"
/// everywhere. H has values in this box up to the nearest curve V = 0. Orbits continue beyond the box, because V is
/// fitted anew there.
/// @throws std::domain_error  unless the start is finite and the field has a value there
///
/// Accuracy  relative 1e-12 of states and times, unless the motion amplifies rounding.
PlanarReduction by_factor(const SmoothField& field, const Eigen::Vector2d& start);

/// Returns a system whose orbits are integrated by Dormand-Prince 5(4), without reduction, for any planar field.
///
/// Each step keeps the error below `tolerance`, relative to the state or to a thousandth of the start. Orbits are cut
/// where a switching function changes its sign; there they cross, slide or rest (R62). Other jumps are detected by the
/// error estimate of this method; the estimate of Fehlberg 7(8) does not detect jumps. Tests and answers compare the
/// quadratures with these orbits.
///
/// @param most_steps  largest number of steps between two jumps. A step takes about 1.5 us, and 40 bytes. An orbit has
///                    at most 300 000 steps in all
/// @return a system with an empty form, and neither factor nor first integral. Ends are undecided, except the rest of
///         an orbit that a switching curve stops within its first 2000 steps
PlanarReduction by_steps(SmoothField field, double tolerance = 1e-12, std::size_t most_steps = 10'000);

/// Returns the equations of motion (2.6) in the whole plane, planar_field, solved by a flow. The rays of the result are
/// the invariant half-lines of PhasePlane.
///
/// p is ln |x|. The first integral is that of the flow, ln |u| - ln w(k). Under a drive v = 0 is a border. Two motions
/// that are mirror images start at each of its points, so orbits from v = 0 are rejected.
///
/// Accuracy  times as StopTime::accuracy. reversed() is solved from the values of the field, without the flow.
/// Cost      0.1 ms, and the solution of the flow
PlanarReduction reduced(const Flow& flow);

/// The motion at a point of a switching curve, by Filippov's definition, planar.md (R62).
struct SwitchingMotion {
  enum class Kind {
    crosses,  ///< also where the field is continuous
    slides,
    rests,   ///< slides with the velocity 0
    leaves,  ///< both sides point away: the motion is not unique
  };
  Kind kind;
  Eigen::Vector2d x;         ///< the nearest point of the curve
  Eigen::Vector2d velocity;  ///< Filippov's velocity along the curve, unless the motion crosses
};

/// Returns the motion at the point nearest to x on the curve on which a switching function is 0; empty if this function
/// has no curve there, or the field has no value on one side.
/// @param function  row of SmoothField::switches
/// @param size      length that is large beside the distance of x from the curve
std::optional<SwitchingMotion> motion_on_curve(const SmoothField& field, Eigen::Index function, Eigen::Vector2d x,
                                               double size);

/// A linear map R of the plane that reverses motions in time: f(R x) = -R f(x).
struct Reversor {
  std::string_view name;  ///< formula of the point to which R moves (u, v), such as "(u, -v)"
  Eigen::Matrix2d matrix;
};

/// Finds the reversors among (u, -v), (-u, v), (v, u), (-v, -u) and (-u, -v).
///
/// f(R x) = -R f(x) is tested up to rounding, at points x whose coordinates are about as large as those of `around`.
/// @param around  not 0
std::vector<Reversor> find_reversors(const SmoothField& field, const Eigen::Vector2d& around);

/// An isolated zero of a field.
struct Equilibrium {
  using Eigenvalues = std::pair<std::complex<double>, std::complex<double>>;

  Eigen::Vector2d x;
  Eigen::Matrix2d slopes;  ///< Jacobian of the field; NaN if it does not exist

  /// One of planar_kinds. "not smooth": the field jumps at x, or its Jacobian differs between the sides of x.
  /// "degenerate": an eigenvalue is 0 within its error, and the terms of higher order do not decide. "center or focus":
  /// motions turn about x, and neither the first Lyapunov coefficient proves a focus nor one of three proofs a center.
  /// First, x lies on the axis of a reflection that is a reversor; then every motion that meets this axis twice is
  /// closed. Second, the inverse integrating factor V is not 0 at x; then motions are level lines of the first integral
  /// H. Third, x is the centre of a scaling, and a turn multiplies by 1.
  std::string_view kind = planar_kind("degenerate");

  /// The eigenvalues of the Jacobian, the one with the smaller real or imaginary part first. An eigenvalue or a part
  /// that is 0 within its error is 0. Empty if the field is not smooth at x.
  std::optional<Eigenvalues> eigenvalues = {};

  /// The number of counter-clockwise turns of the field on a small counter-clockwise circle; empty if not known.
  std::optional<int> index = {};
};

/// The isolated equilibria in a rectangle.
struct Equilibria {
  std::vector<Equilibrium> points;  ///< in the order of u, then v
  Eigen::Vector2d low, high;        ///< corners of the rectangle

  /// False if there might be more equilibria: the field changes much between points, or rounding hides where it is 0.
  bool complete = true;

  std::optional<Eigen::Vector2d> on_curve = {};  ///< a point of the rectangle on a curve of equilibria

  std::vector<Reversor> reversors = {};  ///< maps that reverse motions at points of the rectangle
};

/// Finds the isolated equilibria in a rectangle by Newton's method from a grid of 40 x 40 points. The grid is refined
/// where the field is not nearly linear between its points. Zeros closer than 1e-6 of the rectangle's size, and zeros
/// that rounding does not separate, count as one.
Equilibria find_equilibria(const SmoothField& field, const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// Finds the isolated equilibria in the square about the origin whose half side is 2.5 times the larger coordinate of a
/// start: the usual window of a picture.
Equilibria find_equilibria(const SmoothField& field, const Eigen::Vector2d& start);

/// Turns "center or focus" into "center" where V or the scaling of the solved system proves it. A kind that the kind of
/// the scaling's centre (PlanarReduction::kind) contradicts becomes "center or focus" or "degenerate".
void compare_kinds(Equilibria& equilibria, const PlanarReduction& plane);

/// A closed orbit that no other closed orbits accompany.
struct LimitCycle {
  Eigen::Vector2d x;  ///< a point of the cycle
  double period;

  /// The factor by which the distance of a neighbouring orbit grows in a turn, the slope of the return map. It is 0 or
  /// infinite if neighbouring orbits join the cycle, as on a jump along which the motion slides. NaN if the slope by
  /// differences and the integral of the divergence do not agree to 1e-6.
  double multiplier;
  bool stable;
  std::vector<Eigen::Vector2d> line;  ///< points of the cycle in the order of time; the last equals the first
};

/// Finds the limit cycles that turn about equilibria, as fixed points of the return map of a ray.
///
/// Each of the first six equilibria with a positive or unknown index gets a ray. About 50 orbits start along the ray
/// and are followed for one turn, by steps. Cycles that touch from one side only are not found, and cycles about a
/// center whose orbits all are closed are no limit cycles.
///
/// Accuracy  1e-9 of the period and of the point, if the multiplier is not near 1
/// Cost      at most 400 000 values of the field for each ray, and 2 000 000 for each cycle
/// @param equilibria  equilibria of a rectangle
/// @param reach       length of the rays, in half sides of this rectangle; rays begin at reach/10000
std::vector<LimitCycle> find_limit_cycles(const SmoothField& field, const Equilibria& equilibria, double reach);

/// A point at which a separatrix of an equilibrium crosses a small closed curve about the equilibrium.
struct SeparatrixPoint {
  Eigen::Vector2d x;
  bool stable;  ///< true if the motion from the point tends to the equilibrium
};

/// Finds the separatrices of an equilibrium whose eigenvalues are both 0. The motions from the points of a small
/// ellipse are followed until they leave its surroundings or come near to the equilibrium. A separatrix starts between
/// two motions that pass the equilibrium on different sides, and between a motion that passes and one that arrives.
///
/// Accuracy  1e-5 of the sides
/// Cost      some 100 000 values of the field
/// @param sides  the half axes of the ellipse are 1 % of them
/// @return empty if a smaller ellipse has other separatrices
std::vector<SeparatrixPoint> degenerate_separatrices(const SmoothField& field, const Eigen::Vector2d& centre,
                                                     const Eigen::Vector2d& sides);

/// A polynomial field of degree d on the Poincaré disc. The disc |X| < 1 shows the whole plane by x = r X/(1 - |X|^2),
/// and the circle |X| = 1 shows infinity: each of its points is a direction. There the field is tangential, planar.md
/// (R70).
struct PoincareDisc {
  int degree;         ///< d, the larger degree of the two components
  double radius;      ///< r; the points with |x| = r lie at |X| = 0.618
  SmoothField field;  ///< dX/ds with ds = (1 - |X|^2)^(1 - d) dt, smooth also on the circle and beyond it
  SmoothField plain;  ///< (1 - |X|^2)^d f: the components vanish where those of f vanish

  bool rests;  ///< true if the circle consists of equilibria

  /// The equilibria in the finite plane, as points X. Eigenvalues and `slopes` belong to dX/dt; so the eigenvalues are
  /// those of the plane. `on_curve` lies in the plane. Without curves, `complete` is true if the theorem of Poincaré
  /// and Hopf holds: twice the sum of the indices here plus their sum in `at_infinity` is 2.
  Equilibria equilibria;
  /// The equilibria on the circle. Eigenvalues and slopes belong to dX/ds.
  std::vector<Equilibrium> at_infinity;

  /// Returns the point X of a point x of the plane.
  Eigen::Vector2d onto(const Eigen::Vector2d& x) const;
  /// Returns the point x of the plane that is shown at X, |X| < 1.
  Eigen::Vector2d from(const Eigen::Vector2d& X) const;
};

/// Makes the disc of a field.
/// @param radius  distance from the origin that is shown well
/// @throws std::domain_error  unless the field has polynomials other than 0, and the radius is positive and finite
PoincareDisc poincare_disc(const SmoothField& field, double radius);

/// Returns true if the motion from a start, by steps, nears a stable limit cycle: within 100 periods it comes to 1e-3
/// of the size of the cycle, and returns after one period to 1e-6 of this size.
bool nears(const SmoothField& field, const LimitCycle& cycle, const Eigen::Vector2d& start);

}  // namespace contensou::reduction
