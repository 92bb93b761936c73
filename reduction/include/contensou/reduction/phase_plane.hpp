#pragma once

#include <string_view>
#include <vector>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// An invariant direction v/u: the half-line from the origin in this direction consists of orbits.
enum class InvariantDirection {
  pivoting,  ///< the axis v = 0, q = v/|u| = 0
  ray,       ///< an invariant ray, v = mu k |u|
  sliding,   ///< the axis u = 0
};

/// The end of an invariant half-line, at which a singular point of the field lies.
enum class SingularPlace {
  origin,    ///< u = v = 0: the field has no linear part there, so the blow-up replaces the origin by a line
  infinity,  ///< circle at infinity of the Poincare disc
};

std::string_view name(InvariantDirection direction);
std::string_view name(SingularPlace place);

/// A singular point of the regularised field (2.7) (ReducedSystem::regularised_field) after desingularisation.
///
/// The angular coordinate is q = v/|u| for u > 0, and |u|/v at the axis u = 0. The radial coordinate at the origin is
/// the speed |u|, but at the axis u = 0 the speed v. At infinity the radial coordinate is the inverse of this speed. At
/// both ends the field is divided by this speed. The half-plane u < 0 is the mirror image of u > 0.
struct SingularPoint {
  InvariantDirection direction;
  SingularPlace place;
  double k;        ///< v/(mu |u|): 0, the k of a ray, or infinity
  double q;        ///< mu k
  double radial;   ///< eigenvalue along the half-line, dimensionless
  double angular;  ///< eigenvalue across the half-line; -infinity if the law has an infinite slope (the ring at k = 1)
  /// One of planar_kinds: saddle (the half-line is a separatrix), stable node, unstable node, or degenerate if the
  /// angular eigenvalue is 0. Two points merge at a degenerate point: r = r_low, r = r_high, or Phi/(k Psi) touches r.
  std::string_view kind;
};

/// The direction along which orbits enter the origin.
struct EndTangent {
  InvariantDirection direction;
  double k;
  /// Exponent a in |angle - limit| ~ speed^a along these orbits: the angular coordinate q (or 1/q) tends to 0, or to q*
  /// on a ray. a is the angular eigenvalue divided by the radial one, and 0 if degenerate (slower than any power).
  double contact_order;
};

/// The singular points of the regularised phase plane. All orbits begin and end at them.
struct PhasePlane {
  TerminalRatios terminal;
  double mu_low, mu_high;  ///< mu at which r = TerminalRatios::low, and r = high; with a drive mu_low has no meaning
  /// The points in the order of direction from v = 0 to u = 0; in each direction the point at the origin is first.
  /// Every half-line is an orbit from infinity to the origin and joins a saddle to a node. Under a drive the axis v = 0
  /// is no orbit and is left out.
  std::vector<SingularPoint> points;
  std::vector<EndTangent> tangents;  ///< one for each of terminal.ends: the tangent of the orbits with this limit
};

/// Finds the singular points and the linear part of the field at each (theory.md (R17) to (R19)).
///
/// Accuracy  eigenvalues on the axes 1e-14 relative; on a ray 1e-11, and 1e-6 for a ray at k* within 1e-3 of 1, where
///           many laws have a kink; never below the error of the ray's k. An r within TerminalRatios::tolerance of
///           r_low (TerminalRatios::low) or r_high (TerminalRatios::high) counts as this value.
PhasePlane phase_plane(const Flow& flow);

}  // namespace contensou::reduction
