#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Exact Coulomb friction of a circular patch that slides and pivots, under Hertz's pressure; k = sliding/pivoting.
///
/// Source    V. F. Zhuravlev, 1998 (Zh98): the closed forms (1.3) of the force and (1.5) of the moment, for k < 1.25,
///           with the angle asin(1/k) by atan2. For larger k, the 2F1 series in 1/k^2: the printed (1.5) loses
///           all digits by k = 1e4, because its terms cancel to 1/k^4 of their size.
/// Accuracy  4 eps relative for every k (tests/reference/laws.csv).
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
struct HertzLaw {
  static constexpr std::string_view name = "exact";
  static constexpr SlidingBounds sliding_bounds{0, 1};

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0), without cancellation for k <= 1.
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;
};

/// Coulomb friction of a circular patch; at rho patch radii from its centre the pressure is const (1 - rho^2)^p.
///
/// p = 1/2 is Hertz's pressure (HertzLaw), p = 0 a uniform disc, p = -1/2 a flat rigid punch, p = 1 a paraboloid (a
/// soft foundation). The limit p -> -1 is a thin ring (numerics.md (R48)).
///
/// Source    z = k^2:   Phi = C (p + 3/2) k 2F1(1/2, -p - 1/2; 2; z),  Psi = C 2F1(1/2, -p - 3/2; 1; z),   k <= 1
///           z = k^-2:  Phi = 2F1(-1/2, 1/2; p + 2; z),  Psi = 2F1(1/2, 1/2; p + 3; z)/(2 (p + 2) k),      k >= 1
///           with C = Psi(0) = sqrt(pi) Gamma(p + 2)/(2 Gamma(p + 5/2)); elliptic integrals for integer p.
/// Accuracy  4 eps for every k from 1e-300 to 1e300 (tests/reference/laws_pressure.csv), with the 64-bit mantissa of
///           x87's long double. Without it, as in WebAssembly, 7 eps for the named laws and 40 eps at p = 25.
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
class PressureLaw {
 public:
  static constexpr SlidingBounds sliding_bounds{0, 1};
  static constexpr double max_p = 25;

  /// @param p  exponent, -1 < p <= max_p
  /// @throws std::domain_error  for any other p
  explicit PressureLaw(double p);

  static PressureLaw uniform();
  static PressureLaw punch();
  static PressureLaw ring();
  static PressureLaw paraboloid();

  /// Returns "uniform", "punch", "ring", "paraboloid", or "pressure:P" with the shortest P that reads back as p.
  const std::string& name() const { return name_; }

  /// Returns the exponent p; -1 for the ring.
  double p() const { return p_; }

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;

 private:
  struct Series;
  PressureLaw(double p, std::string name);

  double p_;
  std::string name_;
  std::shared_ptr<const Series> series_;
};

/// Friction whose force Phi and moment Psi lie on an ellipse, Phi^2 + (Psi/C)^2 = 1. The velocity (v, w) is normal to
/// this ellipse. Robotics calls the ellipse a limit surface, physics engines call it an elliptic friction cone.
///
/// Source    Phi = k/sqrt(k^2 + C^2), Psi = C^2/sqrt(k^2 + C^2); R. D. Howe and M. R. Cutkosky, "Practical
///           force-motion models for sliding manipulation", Int. J. Robotics Research 15 (1996) 557,
///           doi:10.1177/027836499601500603.
/// Orbits are powers, v ~ w^(1/(r C^2)), w = mu |u|, r of ReducedSystem; the stop time is one integral, numerics.md
/// (R47). Accuracy  2 eps relative for every k (eps: the rounding of a double). Symmetry  degree 0: unchanged, bit for
/// bit, when both speeds are scaled by a power of two.
class EllipticLaw {
 public:
  static constexpr SlidingBounds sliding_bounds{0, 1};
  /// The moment Psi(0) of pure pivoting under Hertz's pressure, 3 pi/16.
  static constexpr double hertz_moment = 3 * std::numbers::pi / 16;
  static constexpr double min_moment = 1e-3;

  /// @param moment  C = Psi(0), moment of pure pivoting over f N (patch radius), from min_moment to 1 (a thin ring)
  /// @throws std::domain_error  for any other moment
  explicit EllipticLaw(double moment = hertz_moment);

  /// Returns "elliptic", or "elliptic:C" with the shortest C that reads back to the same double.
  std::string name() const;

  double moment() const { return moment_; }

  /// Returns an empty list: Phi and Psi are smooth.
  static std::vector<double> kinks() { return {}; }

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;

 private:
  double moment_;
};

/// The rational approximation to HertzLaw in V. F. Zhuravlev, 1998 (Zh98): Phi = 3 pi k/(8 + 3 pi k), Psi = 3 pi/(16 +
/// 15 pi k), k = sliding/pivoting.
///
/// The approximation has the Phi(0), Phi'(0), Phi(infinity), Psi(0) and lim k Psi of the exact law. The slope of Psi at
/// k = 0 is -1.735 instead of 0, and the slope of Phi in 1/k at infinity is -0.849 instead of 0. In between, the
/// approximation is lower by up to 39 % (Phi, k = 0.91) and 48 % (Psi, k = 0.54). It has no dissipation potential.
///
/// Source    Zh98 (1.4) for the force, (1.6) for the moment.
/// Accuracy  4 eps relative for every k (tests/reference/laws.csv).
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
struct PadeLaw {
  static constexpr std::string_view name = "pade";
  static constexpr SlidingBounds sliding_bounds{1, 2.5};

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0) = 15 pi k/(16 + 15 pi k).
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;
};

/// Returns the two laws of V. F. Zhuravlev, 1998 (Zh98): exact, (1.3) and (1.5), and Pade, (1.4) and (1.6).
const std::vector<Law>& paper_laws();

/// Returns the names of all named laws; the two laws of the paper come first.
std::vector<std::string_view> names_of_laws();

/// Returns all named laws, in the order of names_of_laws. The call makes all tables of laws; find_law makes one law.
const std::vector<Law>& named_laws();

/// Returns a description of the law with that name, in a few words; empty if there is none.
std::string_view meaning_of_law(std::string_view name);

/// A family of laws that differ by one number, such as "pressure:0.5".
struct LawFamily {
  std::string_view name;     ///< name before the colon
  std::string_view letter;   ///< letter of the number in messages, such as P
  std::string_view meaning;  ///< meaning of the number
  std::string_view allowed;  ///< min and max as text, for messages
  double example;
  double min, max;  ///< least and largest number, both allowed
  Law (*law)(double number);

  /// Returns the form of the names of this family, such as pressure:P.
  std::string form() const { return std::string(name).append(":").append(letter); }
};
const std::vector<LawFamily>& law_families();

/// Returns the law with that name, or with that family and number; empty if there is no such law. The last 64 laws and
/// their tables are kept, and shared by all threads.
/// @throws std::domain_error  if the text after a family's colon is no number or a number outside the family's range;
///                            the message does not contain the law's name, because the caller adds it
std::optional<Law> find_law(std::string_view name);

}  // namespace contensou::reduction
