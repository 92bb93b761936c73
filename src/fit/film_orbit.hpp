#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fit/orbit_cells.hpp"

namespace contensou::fit {

/// The orbit of a body in a film, the velocity V of its centre along the slip v, and all derivatives. T is f g t.
///
///   V = v0 + W0 - (v0 - v)/chi - rho T, with the slip v0 and the rolling W0 at the start.
/// For a ball without rolling friction the orbit contains only the change of V by the slip, -(v0 - v)/chi.
/// A ball with rolling friction u_r that turns about a horizontal axis has the drive rho = u_r/f (reduction/theory.md,
/// (R21)); its rolling is V - v. After the rolling has come to 0, rolling resistance holds the ball: it slides like a
/// puck, with chi = 1 and without a drive. After slip and spin have ended, the ball rolls on, slower and slower, and
/// comes to rest.
///
/// Parabolas through orbits with neighbouring numbers give derivatives to 1e-8: by ln mu, by the drive, by the smaller
/// of slip and rim speed at the start and, if resistance comes to hold the ball, by the rolling. The derivative by the
/// larger of the two speeds follows from the symmetry, which scales all speeds of the start.
class FilmOrbit {
 public:
  /// The numbers of an orbit; drive and rolling exist only with rolling friction.
  enum Number : std::size_t { ln_mu, slip, spin, drive, rolling, numbers };
  using Numbers = std::array<double, numbers>;

  static constexpr double standard_accuracy = 1e-10;

  /// @param at  numbers; the slip may be < 0: the orbit of -v mirrors the orbit of v. For a resisted body
  ///            slip, rolling and drive are >= 0
  /// @param accuracy  as for OrbitCells
  FilmOrbit(const reduction::Law& law, reduction::Inertia inertia, Kind kind, const Numbers& at,
            double accuracy = standard_accuracy);

  /// Computes the orbit up to T, or to the stop.
  void reach(double T);

  /// @param T  >= 0, at most the T reached; calls with nearly equal T are fastest
  Speeds speeds_at(double T) const;
  Speeds by_T(double T) const;
  Speeds by(Number number, double T) const;

  /// Returns T of the stop and its derivatives. Call reach(infinity) before.
  double stop() const;
  double stop_by(Number number) const;

 private:
  Speeds mirrored(const Speeds& speeds) const;
  /// Returns the speeds with the speed of the centre added. The function is linear in speeds and numbers. Both may
  /// therefore be derivatives.
  Speeds with_centre(Speeds speeds, const Numbers& at, double T) const;
  bool depends_on(Number number) const { return kind_ == Kind::resisted || (number != drive && number != rolling); }
  bool is_held(double T) const { return held_ && T >= held_from_; }
  void hold(double T, const Speeds& then);

  Number smaller_speed() const;
  Number larger_speed() const { return smaller_speed() == slip ? spin : slip; }

  /// Two orbits with one number changed. They and this orbit define a parabola, which gives the derivative at *this.
  struct Beside {
    std::vector<FilmOrbit> orbits;
    double of_here, of_first, of_second;
  };
  const Beside& beside(Number number) const;
  std::array<double, 2> steps(Number number) const;

  reduction::Law law_;
  reduction::Inertia inertia_;
  Kind kind_;
  Numbers at_;
  double accuracy_;
  double rests_;  ///< T at which the centre comes to rest if the slip has ended before; infinite without a drive
  double reached_ = 0;
  std::optional<OrbitCells> turns_, held_;
  double held_from_ = 0;
  Speeds then_{};  ///< speeds at the moment at which resistance begins to hold the ball
  mutable std::array<std::optional<Beside>, numbers> beside_;
};

}  // namespace contensou::fit
