#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "fit/film_orbit.hpp"

namespace contensou::fit {

/// The orbit of a ball, with its derivatives.
///
/// Everything is a quadrature over x = ln k, since k decreases all the time. With A = chi Phi/k, B = gamma mu^2 Psi,
/// w = mu |u| and q = B/(A - B):
///   d ln w/dx = q,   dT/dx = -w/(A - B),   v = e^x w,
/// and by ln mu at one x:  d(d ln w)/dx = 2 q (1 + q) =: dE/dx,   d(dT)/dx = dT/dx (E + 2 q).
/// Cells of x are as wide as polynomials of degree 9 allow.
///
/// With a drive rho the ratio tends to that of a ray, k* > 0, and x = ln |k - k*| stands for it: A - B is
/// F = (chi (Phi - rho) - B k)/(k - k*), and all else stays as it is. By a number p, ln mu or rho, at one x
///   d(d ln w)/dx = dq/dp,   d(dT)/dx = dT/dx (E - d ln F/dp),   d(v dT)/dx = v dT/dx (2 E - d ln F/dp + (dk*/dp)/k),
/// with dq/dp, d ln F/dp and dk*/dp from q, F and k* of numbers beside p, which are known in closed form.
class ScaledOrbit final : public FilmOrbit {
 public:
  /// @param law       without an invariant ray below k0: A > B
  /// @param accuracy  of T and ln w, relative
  /// @param drive     rho, 0 <= rho <= greatest_drive(); with one the start's v >= 0, and there are derivatives by it; those
  ///                  of a start nearer to the ray than 1e-4 k* are those of a start so far from it
  /// @throws std::domain_error  if the start is on an invariant ray
  ScaledOrbit(const reduction::Law& law, double mu, reduction::State start, double accuracy = standard_accuracy,
              reduction::Inertia inertia = reduction::homogeneous_ball, std::optional<double> drive = std::nullopt);

  /// A drive below which there is a ray: 0.9 of that from which on there is none.
  static double greatest_drive(const reduction::Law& law, double mu, reduction::Inertia inertia);

  /// k* of the ray; 0 without a drive.
  double ray() const { return here_.k; }

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
  /// Derivatives of T and ln w by x.
  struct Slopes {
    double T, ln_w;
  };
  static Slopes slopes(const Place& place);

  /// What x and ln w change by.
  struct Rates {
    double fall;  ///< A - B
    double B;
  };
  /// The ray of a patch and a drive.
  struct Ray {
    double mu, drive;
    double k = 0;                       ///< k*
    std::array<double, 2> fall_near{};  ///< F a little below and above it
  };
  Ray ray_of(double mu, double drive) const;
  double fall_towards(const Ray& ray, double distance) const;
  Rates rates(const Ray& ray, double x) const;
  Rates rates(double x) const { return rates(here_, x); }
  double ratio(double x) const { return here_.k + side_ * std::exp(x); }

  /// A difference quotient: the rays beside, and their weights and that of this one.
  struct Beside {
    Ray first, second;
    double of_here, of_first, of_second;
    double of(double here, double at_first, double at_second) const {
      return of_here * here + of_first * at_first + of_second * at_second;
    }
    double k = 0;  ///< of the ray, by the number
  };
  Beside beside(double first, double second, bool by_drive) const;

  /// Derivatives of a start by one number, and of the integrals by that number alone.
  struct Shift {
    double k, ln_w;  ///< at the start
    double ray = 0;  ///< k*
    double E = 0, T = 0, slid = 0, turned = 0;
  };
  Shift shift_by(std::size_t which, const Integrals& here, const Eigen::Array4d& by_drive) const;
  enum : std::size_t { by_ln_mu, by_v, by_u, by_rho };
  /// Derivatives of x at the start, of the scale, and of T at one x.
  struct Moved {
    double x, scale, T;
  };
  Moved moved(const Shift& by, const Integrals& here) const;
  Moment driven(const Place& place, std::size_t cell) const;

  reduction::Law law_;
  double accuracy_;
  reduction::Inertia inertia_;
  Ray here_;
  double side_ = 1;  ///< k = k* + side e^x
  bool w_follows_ = false;
  std::vector<Beside> beside_;  ///< by ln mu and by the drive, where there is one
  std::vector<Cell> cells_;
  /// E, T, slid and turned by the drive, in powers of z, of each cell.
  std::vector<Eigen::Array<double, 4, nodes + 1>> by_drive_;
  Eigen::Array4d now_by_drive_ = Eigen::Array4d::Zero();
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
