#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "fit/film_orbit.hpp"

namespace contensou::fit {

/// The orbit of a ball, with its exact derivatives where there is no drive.
///
/// Everything is a quadrature over x = ln k, since k decreases all the time. With A = chi Phi/k, B = gamma mu^2 Psi,
/// w = mu |u| and q = B/(A - B):
///   d ln w/dx = q,   dT/dx = -w/(A - B),   v = e^x w,
/// and by ln mu at one x:  d(d ln w)/dx = 2 q (1 + q) =: dE/dx,   d(dT)/dx = dT/dx (E + 2 q).
/// Cells of x are as wide as polynomials of degree 9 allow.
///
/// With a drive rho the ratio tends to that of a ray, k* > 0, and x = ln |k - k*| stands for it: A - B is
/// (chi (Phi - rho) - B k)/(k - k*), and all else stays as it is.
class ScaledOrbit final : public FilmOrbit {
 public:
  /// @param law       without an invariant ray below k0: A > B
  /// @param accuracy  of T and ln w, relative
  /// @param drive     rho, 0 <= rho <= greatest_drive(); with one the start's v >= 0, and speeds_at() and stop().T are
  ///                  all there is
  /// @throws std::domain_error  if the start is on an invariant ray
  ScaledOrbit(const reduction::Law& law, double mu, reduction::State start, double accuracy = standard_accuracy,
              reduction::Inertia inertia = reduction::homogeneous_ball, double drive = 0);

  /// A drive below which there is a ray: 0.9 of that from which on there is none.
  static double greatest_drive(const reduction::Law& law, double mu, reduction::Inertia inertia);

  /// k* of the ray; 0 without a drive.
  double ray() const { return ray_; }

  void reach(double T) override;

  static constexpr double standard_accuracy = 1e-10;

  Moment at(double T, std::size_t& cell) const override;
  Speeds speeds_at(double T, std::size_t& cell) const override;
  Stop stop() const override;

 private:
  static constexpr int nodes = 10;  ///< of a cell
  /// What is integrated over x: T, ln w, their derivatives by ln mu (G, E), and the integrals of v and w over T with theirs.
  enum { T_, ln_w, E, G, slid, slid_by, turned, turned_by, integrals };
  using Integrals = Eigen::Array<double, integrals, 1>;
  /// In powers of z, which goes from -1 at the left end, where x is largest, to 1.
  struct Cell {
    double x, half_width;
    Eigen::Array<double, integrals, nodes + 1> powers;
    Integrals at(double z) const;
    double T_left, T_end;
    double bend_left, bend_end;  ///< slopes of z over (T - T_left)/(T_end - T_left), less 2
  };
  struct Basis;

  /// How x and ln w at the start change with one of the numbers, and whether mu itself does.
  struct Direction {
    double x, ln_w, ln_mu;
  };
  double change_of_T(const Direction& by, const Integrals& here) const;

  /// Where a T lies.
  struct Place {
    const Cell* cell;
    double z;
    bool moves;
    Integrals here;
    Speeds unit;  ///< v, slid of a v of 1 m/s at the start, u, turned of such a u
  };
  Place place_of(double T, std::size_t& cell) const;
  Speeds now(const Place& place) const;

  /// What x and ln w change by.
  struct Rates {
    double fall;  ///< A - B
    double B;
  };
  Rates rates(double x) const;
  double ratio(double x) const { return ray_ + side_ * std::exp(x); }
  /// (chi (Phi - rho) - B k)/(k - k*)
  double fall_towards_ray(double distance) const;
  void find_ray();

  reduction::Law law_;
  double mu_, accuracy_;
  reduction::Inertia inertia_;
  double drive_, ray_ = 0, side_ = 1;  ///< k = k* + side e^x
  std::array<double, 2> near_ray_{};   ///< fall_towards_ray a little below and above it
  std::vector<Cell> cells_;
  std::vector<double> kinks_;  ///< ln k of those ahead, the next one last
  double x_ = 0, width_;       ///< of the next cell
  Integrals now_ = Integrals::Zero();
  double v0_, u0_;             ///< of the start
  double x0_ = 0, ln_w0_ = 0;  ///< of the orbit, which no axis is
  double orbit_v0_ = 0, orbit_w0_ = 0;
  double q0_ = 0, dT0_ = 0;  ///< q and dT/dx at the start
  Direction by_[3] = {};     ///< ln mu, ln v, ln u
};

}  // namespace contensou::fit
