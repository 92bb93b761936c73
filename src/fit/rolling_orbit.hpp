#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "contensou/reduction/friction_law.hpp"
#include "fit/scaled_orbit.hpp"

namespace contensou::fit {

/// The orbit of a ball with rolling friction that slides the way it rolls, or does not roll at first.
///
/// While it turns about a horizontal axis it has the drive rho = u_r/f (reduction/README.md, (R53)), and the rolling
///   W = W0 + (1 - 1/chi) (v0 - v) - rho T.
/// Where W has come to 0 rolling resistance holds it: it slides like a puck, chi = 1, without a drive. Where slip and spin
/// have ended it rolls on, slower and slower, and rests. Its derivatives are those of the orbits. Where W(T) = 0 holds it, T
/// changes by dT = -dW/W', the state then by its own derivatives and dT times its rates, and what follows by those of an orbit
/// from that state, less dT times its rates.
class RollingOrbit final : public FilmOrbit {
 public:
  /// @param start    v >= 0
  /// @param rolling  W0 >= 0, m/s
  /// @param drive    rho >= 0
  /// @param accuracy  as of ScaledOrbit
  RollingOrbit(const reduction::Law& law, double mu, reduction::State start, double rolling, double drive,
               reduction::Inertia inertia, double accuracy = ScaledOrbit::standard_accuracy);

  void reach(double T) override;
  Moment at(double T, std::size_t& cell) const override;
  Speeds speeds_at(double T, std::size_t& cell) const override;
  Stop stop() const override;

 private:
  /// The numbers that the orbit depends on.
  enum : std::size_t { ln_mu, slip, spin, rolling, drive, numbers };
  using Numbers = std::array<double, numbers>;

  /// Derivatives, by one number, of the time and the state at which resistance begins to hold the ball.
  struct Held {
    double T = 0;
    Speeds state{};
  };
  const std::array<Held, numbers>& held_by() const;
  static std::array<Speeds Moment::*, numbers> derivatives();
  void set_rates(Moment& moment, bool is_held) const;
  Moment turning_moment(double T) const;

  double turning(double T, double v) const;
  Speeds turning_at(double T, Speeds now) const;
  void hold(double T, const Speeds& then);
  Speeds speeds_at(double T) const;

  reduction::Law law_;
  Numbers at_;
  reduction::Inertia inertia_;
  double accuracy_;
  double rests_;  ///< T, if slip and spin have ended before
  std::optional<ScaledOrbit> turns_, held_;
  double held_from_ = 0;
  Speeds then_{};  ///< when resistance began to hold it
  mutable std::size_t turns_cell_ = 0, held_cell_ = 0;
  mutable std::optional<std::array<Held, numbers>> held_by_;
};

}  // namespace contensou::fit
