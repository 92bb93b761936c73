#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

/// A direction that the field keeps to: the half-line from the origin to infinity along it is made of orbits.
enum class InvariantDirection {
  pivoting,  ///< the axis v = 0, q = v/|u| = 0
  ray,       ///< an invariant ray, v = mu k |u|
  sliding,   ///< the axis u = 0
};

/// Where on its half-line a singular point lies.
enum class SingularPlace {
  origin,    ///< on the line that the origin, itself without a linear part, is blown up to
  infinity,  ///< on the circle at infinity of the Poincare disc
};

enum class SingularKind {
  saddle,
  stable_node,
  unstable_node,
  degenerate,  ///< the angular eigenvalue is 0, two points merge: r = r_low, r_high, or Phi/(k Psi) touches r
};

std::string_view name(InvariantDirection direction);
std::string_view name(SingularPlace place);
std::string_view name(SingularKind kind);

/// A singular point of the regularised field (2.7) after desingularisation. The angular coordinate is q = v/|u| on the
/// half-plane u > 0, and |u|/v at the axis u = 0; the radial one is the speed |u| (there v) at the origin, its inverse
/// at infinity. The field is divided by that speed in both places. The half-plane u < 0 is the mirror image.
struct SingularPoint {
  InvariantDirection direction;
  SingularPlace place;
  double k;                     ///< v/(mu |u|): 0, that of a ray, infinity
  double q;                     ///< mu k
  Eigen::Matrix2d linear_part;  ///< d(radial', angular')/d(radial, angular), no unit
  double radial;                ///< eigenvalue along the half-line
  double angular;               ///< eigenvalue across it; -infinity where a law's slope is (the ring's at k = 1)
  SingularKind kind;            ///< of a saddle, the half-line is a separatrix
};

/// The half-line along which orbits enter the origin.
struct EndTangent {
  InvariantDirection direction;
  double k;
  /// The angular coordinate goes to 0 (on a ray: to q*) like this power of the speed: angular/radial eigenvalue; 0
  /// where degenerate: slower than any power.
  double contact_order;
};

/// The phase plane of (2.7), whole: what orbits are born at and what they die at.
struct PhasePlane {
  TerminalRatios terminal;
  double mu_low, mu_high;  ///< r_low and r_high as patch ratios of this body; with a drive mu_low counts for nothing
  /// By direction from v = 0 to u = 0, at each the origin first. Every half-line is an orbit from infinity to the
  /// origin and joins a saddle to a node. With a drive v = 0 is none: orbits begin there.
  std::vector<SingularPoint> points;
  std::vector<EndTangent> tangents;  ///< of the orbits of each of terminal.ends
};

/// Solves for the singular points and linearises there (README (R15) to (R17)).
///
/// Accuracy  eigenvalues on the axes 1e-14 relative, on a ray 1e-11; 1e-6 where k* is within 1e-3 of 1, at which many
///           laws have a kink; on a ray whose k is less accurate, no better than that. r is taken for r_low or r_high
///           where TerminalRatios does not tell them apart.
PhasePlane phase_plane(const Flow& flow);

}  // namespace contensou::reduction
