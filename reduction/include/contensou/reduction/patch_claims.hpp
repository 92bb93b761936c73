#pragma once

#include <functional>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/paper_claim.hpp"

namespace contensou::reduction {

/// The formulas of section 1 of Zh98, exactly as printed, with the unit N f of force and N f eps of moment.
/// Another formula in place of one of them is another paper: this is how a test lies.
struct PrintedPatch {
  std::function<double(double rho)> pressure;                            ///< sigma eps^2/N
  std::function<double(double k)> inner_force;                           ///< (1.3), k <= 1
  std::function<double(double k)> outer_force;                           ///< (1.3), k > 1
  std::function<double(double k)> inner_moment;                          ///< (1.5), k <= 1
  std::function<double(double k)> outer_moment;                          ///< (1.5), k > 1
  std::function<double(double k)> pade_force;                            ///< (1.4)
  std::function<double(double k)> pade_moment;                           ///< (1.6)
  std::function<double(double k, double theta, double sign)> chord_end;  ///< q_- and q_+
  int force_cosines;           ///< power of cos(theta) under the integrals of (1.2)
  double inner_moment_angle;   ///< up to which theta runs in M^h, k <= 1
  double outer_moment_factor;  ///< before the integral in M^h, k > 1
  double slope_at_zero;        ///< of the force
  double deficit_at_infinity;  ///< k^2 (1 - F)
};

PrintedPatch printed_patch();

/// What the statements are held against: force and moment at a ratio k.
using PatchTruth = std::function<Resistance(double k)>;

/// Coulomb friction under Hertz pressure, integrated over the disc from its definition (ContactPatch).
PatchTruth integrated_patch();

/// Every equation and claim of section 1: (1.1) to (1.6) and the conclusions.
std::vector<PaperClaim> patch_claims(const PrintedPatch& printed = printed_patch(),
                                     const PatchTruth& truth = integrated_patch());

}  // namespace contensou::reduction
