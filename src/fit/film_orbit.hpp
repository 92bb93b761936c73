#pragma once

#include <cstddef>

namespace contensou::fit {

/// Sliding and pivoting speeds, m/s, and their integrals over T = f g t; or a derivative of all of them.
struct Speeds {
  double v, u, slid, turned;
  double centre = 0, way = 0;  ///< of the centre along the slip: of a ball with rolling friction only
};

Speeds operator+(const Speeds& a, const Speeds& b);
Speeds operator*(double c, const Speeds& a);

/// An orbit of a body's reduced system in T = f g t, where friction is in no equation, with its derivatives by ln mu and by the
/// start. The start's v is of either sign: the motion of -v is that of v, mirrored.
class FilmOrbit {
 public:
  virtual ~FilmOrbit() = default;

  /// Computes it up to that T, or to the stop.
  /// @throws std::domain_error  if it meets an invariant ray that it cannot follow
  virtual void reach(double T) = 0;

  /// A moment of the orbit, with the derivatives there.
  struct Moment {
    Speeds now;
    double dv, du;  ///< by T
    Speeds by_ln_mu, by_v, by_u;
    double dcentre = 0;               ///< by T
    Speeds by_rolling{}, by_drive{};  ///< of a ball with rolling friction only
  };

  /// @param T     >= 0, up to where it was computed
  /// @param cell  where the last moment was found: begin with 0, with T in increasing order
  virtual Moment at(double T, std::size_t& cell) const = 0;

  /// The same without derivatives.
  virtual Speeds speeds_at(double T, std::size_t& cell) const = 0;

  /// T of the stop and its derivatives; after reach(infinity).
  struct Stop {
    double T, by_ln_mu, by_v, by_u;
    double by_rolling = 0, by_drive = 0;
  };
  virtual Stop stop() const = 0;
};

}  // namespace contensou::fit
