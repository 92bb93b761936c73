#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// The two numbers of inertia of an axisymmetric body of mass m and radius R. They multiply the body's decelerations.
struct Inertia {
  double chi = 3.5;  ///< factor of sliding: 1 + m R^2/J_h, J_h about a horizontal axis; 1 for a puck, which cannot roll
  double gamma = 2.5;  ///< factor of pivoting: m R^2/J_z, J_z about the vertical axis
};

/// The homogeneous ball of the paper (V. F. Zhuravlev, 1998): chi = 7/2, gamma = 5/2.
inline constexpr Inertia homogeneous_ball{};

/// The limit of k = v/(mu |u|) as a body that slides and pivots comes to rest. u and v always vanish at the same time
/// (numerics.md (R29)). The limit of k shows whether u or v vanishes faster.
enum class TerminalRegime {
  zero,      ///< k -> 0: v vanishes faster
  ray,       ///< k tends to the k of an invariant ray
  infinity,  ///< k -> infinity: u vanishes faster
};

/// Returns a regime in words.
constexpr std::string_view meaning(TerminalRegime regime) {
  return regime == TerminalRegime::zero  ? "u and v vanish together, v faster"
         : regime == TerminalRegime::ray ? "u and v vanish together, in the ratio of an invariant ray"
                                         : "u and v vanish together, u faster";
}

/// A limit of k, with the starts whose motions have this limit.
struct TerminalRatio {
  TerminalRegime regime;
  double k;     ///< 0, the k of a ray, or infinity
  double from;  ///< starts with a ratio in (from, to) have this limit; both are invariant, except 0 with a drive
  double to;
};

/// An orbit along a ray v = k mu |u|, on which k stays constant: Phi = r k Psi.
struct InvariantRay {
  double k;
  bool attracts_above;  ///< starts with a slightly larger k tend to the ray; if false, they leave the ray
  bool attracts_below;  ///< likewise for a slightly smaller k; if Phi/(k Psi) touches r there, one side only attracts
  double accuracy;      ///< relative error of k: rounding of the law divided by the slope of Phi/(k Psi)

  bool attracts() const { return attracts_above && attracts_below; }
};

/// The zeros of Phi - r k Psi for 0 < k < infinity, and the limits of k between them.
///
/// k falls if Phi > r k Psi and grows if Phi < r k Psi (theory.md (R2)). Therefore every motion between two neighbours
/// among 0, the rays and infinity moves away from one neighbour and tends to the other. For the named pressures and the
/// Pade law Phi/(k Psi) grows with k. Then, for low < r < high, there is one ray; it attracts and is the only limit. A
/// tabulated pressure can have several rays. For r <= 1/2 no pressure on a disc has a ray (numerics.md (R33)).
struct TerminalRatios {
  double low;                       ///< Phi/(k Psi) at k = 0, that is Phi'(0)/Psi(0)
  double high;                      ///< (Phi - rho)/(k Psi) at k = infinity
  std::vector<InvariantRay> rays;   ///< increasing in k
  std::vector<TerminalRatio> ends;  ///< increasing in k; never empty

  /// Returns the limit of k of the motions with this k. The k of an axis or a ray is its own limit.
  /// @param k  from 0 to infinity
  /// @throws std::domain_error  if k is negative or not a number
  TerminalRatio end_of(double k) const;

  /// If the relative difference of Phi/(k Psi) and r is at most this number, it counts as 0. Two rays count as one if
  /// the difference stays that small between them. A ray is left out if the difference stays so up to an axis.
  static constexpr double tolerance = 512 * std::numeric_limits<double>::epsilon();
};

/// Finds every k with Phi(k) = rho + r k Psi(k), at which k stays constant: d ln k/ds = 0 in the scaled time s.
///
/// @param r      gamma mu^2/chi, > 0
/// @param drive  rho of ReducedSystem. Under a drive k = 0 is not invariant, and motions from k = 0 have the limit of
///               neighbouring motions
/// @throws std::domain_error   if r is not positive and finite
/// @throws std::runtime_error  if a ray next to infinity can be neither found nor excluded, because a drive next to 1
///                             nearly cancels the friction and the law does not state its force_deficit
///
/// Accuracy  as InvariantRay::accuracy: 2e-15 if Phi/(k Psi) is steep.
/// Cost      700 calls of the law, at distances of 1/16 in ln k. Two rays between neighbouring calls are found if
///           Phi/(k Psi) has no more than one extremum between these calls.
TerminalRatios terminal_ratios(const Law& law, double r, double drive = 0);

/// Returns the smallest ln k under a drive. A motion from v = 0 has this k just after it has begun to creep.
double least_log_ratio(const Law& law, double r, double drive);

/// A point of the phase plane (u, v): two speeds in one unit.
struct State {
  double u;  ///< pivoting speed R omega_z, of either sign
  double v;  ///< sliding speed of the contact point, >= 0
};

/// A velocity in the phase plane: the derivatives of u and v.
struct Rate {
  double u;
  double v;
};

/// Two numbers that enclose a third.
struct Bounds {
  double lower;
  double upper;
};

/// A stop time, its error and its cost.
struct StopTime {
  double tau;        ///< the time tau of ReducedSystem; infinity if it exceeds the largest double
  double accuracy;   ///< bound of the relative error of tau
  long evaluations;  ///< number of calls of the friction law; 0 for a closed form
  Bounds bounds;     ///< ReducedSystem::stop_time_bounds
};

/// A stop time and its partial derivatives by the speeds at the start and by the numbers of ReducedSystem.
///
/// The stop time is homogeneous: u by_u + v by_v = tau (Euler's identity). It is even in u, so by_u is 0 at u = 0.
/// Without a drive by_v is 0 at v = 0.
struct StopTimeGradient {
  double tau;
  double by_u, by_v;        ///< derivatives by the speeds at the start
  double by_mu;             ///< derivative by mu, which is (patch radius)/R
  double by_chi, by_gamma;  ///< derivatives by the two numbers of Inertia
  double by_drive;          ///< derivative by rho, the drive along the slip
};

/// The two equations of motion (2.6) of V. F. Zhuravlev, 1998 (Zh98), for any friction law and any axisymmetric body:
///   dv/dtau = -(2 chi/(3 pi)) (Phi(k) - rho),  du/dtau = -(2 gamma mu/(3 pi)) Psi(k) sign(u),  k = v/(mu |u|).
/// v is the sliding speed, u = R omega_z the pivoting speed, mu the patch radius divided by R. rho is a constant drive
/// along the slip, 0 in the paper. It represents a slope straight down, or the rolling resistance of a ball that rolls
/// in the direction in which it slides (reduction/theory.md, "A constant drive"). Under a drive v = 0 is no orbit: a
/// body that spins without sliding begins to creep.
///
/// The time is the paper's tau = (3 pi/2) f g t with the coefficient of friction f; tau has the unit of a speed. A
/// system never changes and is cheap to copy.
class ReducedSystem {
 public:
  /// @param patch_ratio  mu = patch radius/R, > 0; more than 1 is allowed, because R need not be the width of the body
  /// @param drive        rho: 0, or from least_drive to below 1; a drive of 1 or more would not let the body stop
  /// @throws std::domain_error  if mu, chi or gamma is not a positive finite number, or drive is not allowed
  ReducedSystem(const Law& law, double patch_ratio, Inertia inertia, double drive = 0);

  /// Makes the system of the homogeneous ball on a level plane.
  /// @param patch_ratio  mu, above 0 and at most 1: no patch is wider than the ball
  /// @throws std::domain_error  for any other mu
  ReducedSystem(const Law& law, double patch_ratio);

  const Law& law() const { return law_; }
  double mu() const { return mu_; }
  Inertia inertia() const { return inertia_; }
  double drive() const { return drive_; }

  /// Smallest drive except 0. A smaller drive changes no digit of a motion, and its ray leaves the range of doubles.
  static constexpr double least_drive = 1e-100;

  /// Returns r = gamma mu^2/chi, a normal double. r and rho determine the shape of a motion (theory.md (R1)).
  double r() const { return r_; }

  /// Returns ds/dtau of the scaled time s = chi f g t (theory.md (R1)): dv/ds = rho - Phi, dw/ds = -r Psi, w = mu |u|.
  double scaled_time_rate() const { return scaled_time_rate_; }

  /// Returns d(u, v)/dtau, the right side of the equations of motion.
  /// @throws std::domain_error  at u = v = 0, where the equations have no value, and for v < 0
  Rate field(State state) const;

  /// Returns dtau/dbeta = (16 mu |u| + 15 pi v)(8 mu |u| + 3 pi v), the weight of the regularised time beta of (2.8),
  /// for every law.
  double regularising_weight(State state) const;

  /// Returns d(u, v)/dbeta, the field times the weight; 0 at rest. For the Pade law it is the right side of (2.7).
  /// @throws std::domain_error  for v < 0
  Rate regularised_field(State state) const;

  /// Returns dv/du along an orbit.
  /// @throws std::domain_error  at u = 0 and for v < 0
  double slope(State state) const;

  /// Returns S = 3 pi v/(2 chi), the stop time of a body that slides without pivoting and without a drive (ball: 3 pi
  /// v/7). Under a drive the stop time is S/(1 - rho).
  double sliding_limit(double v) const;

  /// Returns P = 3 pi |u|/(2 gamma mu Psi(0)), the stop time of pivoting without sliding (ball: 16 |u|/(5 mu)).
  double pivoting_limit(double u) const;

  /// Returns bounds of the stop time from the law's SlidingBounds and max(S, P) (theory.md (R6), with a drive (R27)),
  /// widened by 2 rounding_of_stop_time(r)/(1 - rho). For a law without SlidingBounds they are [0, infinity].
  Bounds stop_time_bounds(State start) const;

 private:
  Law law_;
  double mu_;
  Inertia inertia_;
  double drive_;
  double r_;
  double scaled_time_rate_;
};

/// Returns the largest relative error of a stop time by rounding: eps (4 + ln(1 + r)/2), r = gamma mu^2/chi. For r >
/// 1e12, larger than r of any real body, 2 eps ln(r/1e12) is added.
///
/// The error was measured for closed forms up to mu = 1e6 (tests/certify), for quadratures (tests/reference/rays.csv),
/// and up to r = 1e24 as the distance outside proved bounds (tests/reduction/differential.cpp).
double rounding_of_stop_time(double r);

/// Returns true if u and v are finite and v >= 0.
bool is_state(State state);

/// Throws unless is_state(state).
/// @throws std::domain_error  if u or v is not finite or v < 0; the message begins with the function's name
void require_state(const char* function, State state);

}  // namespace contensou::reduction
