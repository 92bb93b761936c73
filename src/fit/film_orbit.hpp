#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fit/orbit_cells.hpp"

namespace contensou::fit {

/// The orbit of a body in a film, with the velocity V of its centre along the slip, and its derivatives.
///
///   V = v0 + W0 - (v0 - v)/chi - rho T,   W0 the rolling at the start;
/// of a ball without rolling friction only the change of V, by the slip, is in the orbit: -(v0 - v)/chi.
/// While a ball with rolling friction turns about a horizontal axis it has the drive rho = u_r/f (reduction/README.md,
/// (R53)), and V - v is its rolling. Where that has come to 0 rolling resistance holds the ball: it slides like a puck,
/// chi = 1, without a drive. Where slip and spin have ended it rolls on, slower and slower, and rests.
///
/// Parabolas through orbits with neighbouring numbers give, to 1e-8, the derivatives with respect to ln mu, the drive,
/// the smaller speed of the start and, once the ball is held, its rolling. That with respect to the larger speed
/// follows from the symmetry, which scales all speeds of the start.
class FilmOrbit {
 public:
  /// The numbers of an orbit; drive and rolling exist only with rolling friction.
  enum Number : std::size_t { ln_mu, slip, spin, drive, rolling, numbers };
  using Numbers = std::array<double, numbers>;

  static constexpr double standard_accuracy = 1e-10;

  /// @param at  slip of either sign; -v has the mirror image of the orbit of v. For a resisted body slip,
  ///            rolling and drive are >= 0
  /// @param accuracy  as of OrbitCells
  FilmOrbit(const reduction::Law& law, reduction::Inertia inertia, Kind kind, const Numbers& at,
            double accuracy = standard_accuracy);

  /// Computes it up to that T, or to the stop.
  void reach(double T);

  /// @param T  >= 0, up to where it was computed; cheapest next to the last one
  Speeds speeds_at(double T) const;
  Speeds by_T(double T) const;
  Speeds by(Number number, double T) const;

  /// T of the stop and its derivatives; after reach(infinity).
  double stop() const;
  double stop_by(Number number) const;

 private:
  Speeds mirrored(const Speeds& speeds) const;
  /// The speeds with those of the centre: linear in speeds and numbers, and so of their derivatives, too.
  Speeds with_centre(Speeds speeds, const Numbers& at, double T) const;
  bool depends_on(Number number) const { return kind_ == Kind::resisted || (number != drive && number != rolling); }
  bool is_held(double T) const { return held_ && T >= held_from_; }
  void hold(double T, const Speeds& then);

  Number smaller_speed() const;
  Number larger_speed() const { return smaller_speed() == slip ? spin : slip; }

  /// The derivative of a parabola: at this orbit, from orbits with one number changed by two steps.
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
  double rests_;  ///< T, if slip and spin have ended before
  double reached_ = 0;
  std::optional<OrbitCells> turns_, held_;
  double held_from_ = 0;
  Speeds then_{};  ///< speeds at the moment from which resistance holds the ball
  mutable std::array<std::optional<Beside>, numbers> beside_;
};

}  // namespace contensou::fit
