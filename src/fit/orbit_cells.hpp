#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::fit {

/// Sliding and pivoting speeds, m/s, and their integrals over T = f g t; or the derivatives of these numbers.
struct Speeds {
  double v = 0, u = 0, slid = 0, turned = 0;
  double centre = 0, way = 0;  ///< speed of the centre along the slip, and its integral; only for FilmOrbit
};

inline Speeds operator+(const Speeds& a, const Speeds& b) {
  return {a.v + b.v, a.u + b.u, a.slid + b.slid, a.turned + b.turned, a.centre + b.centre, a.way + b.way};
}
inline Speeds operator*(double c, const Speeds& a) {
  return {c * a.v, c * a.u, c * a.slid, c * a.turned, c * a.centre, c * a.way};
}

/// Kinds of bodies whose orbits need different treatment.
enum class Kind {
  ball,      ///< a ball, whose law has no invariant ray
  flat,      ///< a body that lies flat, whose law may have invariant rays
  resisted,  ///< a ball with rolling friction, which may have a drive
};

/// An orbit of a body's reduced system as a function of T = f g t, computed in cells.
///
/// k = v/w, w = mu |u|, tends to an end k*: 0, the k of an invariant ray, or infinity. Let c = k, or c = 1/k if k grows
/// without a drive; c is c0 at the start and c* at the end. The substitution
///   c = c* + (c0 - c*) exp(-s)
/// turns the orbit into two quadratures over s, and the integrals of v and u into two more. For force Phi, moment Psi
/// and drive rho let B = gamma mu^2 Psi, D = chi (Phi - rho) - B k and F = D/(k - k*), for c = 1/k F = -D c^2/(c - c*):
///   d ln |u|/ds = -B/F,   dT/ds = w/F.
/// The cells of s are as wide as polynomials of degree 9 allow.
class OrbitCells {
 public:
  /// @param start     u and v >= 0
  /// @param drive     rho, 0 <= rho <= greatest_drive()
  /// @param accuracy  relative accuracy of the polynomials; their integrals T and ln |u| are 100 times as accurate
  /// @throws std::domain_error  if the orbit meets a ray that it cannot follow
  OrbitCells(const reduction::Law& law, double mu, reduction::Inertia inertia, Kind kind, reduction::State start,
             double drive, double accuracy);

  /// Returns a drive for which there is a ray: 0.9 of the smallest drive without a ray.
  static double greatest_drive(const reduction::Law& law, double mu, reduction::Inertia inertia);

  /// Computes the orbit up to T, or to the stop.
  void reach(double T);

  /// @param T  >= 0, at most the T reached; calls with nearly equal T are fastest
  Speeds speeds_at(double T) const;

  /// Returns T of the stop. Call reach(infinity) before.
  double stop() const;

 private:
  static constexpr int nodes = 10;  ///< nodes of a cell
  enum { T_, ln_u, slid, turned, integrals };
  using Integrals = Eigen::Array<double, integrals, 1>;
  /// Coefficients of powers of z, where z runs from -1 at the start of a cell to 1 at its end.
  using Powers = Eigen::Array<double, integrals, nodes + 1>;
  struct Basis;
  struct Cell {
    double s, half_width, T_end;
    Powers powers;
  };

  /// The values D and B at one k.
  struct Forces {
    double D, B;
  };
  Forces forces(double k) const;
  double k_end(double k) const;
  double F(double distance, double D) const;
  double ratio(double s) const;
  /// Returns the next cell, and the error of its polynomials divided by the allowed error.
  Powers next_powers(double half_width, double& error) const;

  reduction::Law law_;
  double mu_;
  reduction::Inertia inertia_;
  Kind kind_;
  reduction::State start_;  ///< start of the cells; next to an axis a neighbouring start, whose smaller speed is scaled
  double drive_, accuracy_;
  double v_share_ = 1, u_share_ = 1;
  bool inverse_ = false;           ///< true: c = 1/k; false: c = k
  double end_ = 0, distance_ = 0;  ///< c* and c0 - c*
  std::array<double, 2> near_{};   ///< F slightly below and slightly above c*
  std::vector<double> kinks_;      ///< s of the kinks still to come, decreasing: the last entry is the next kink
  double s_ = 0, width_;           ///< start and width of the next cell
  Integrals now_ = Integrals::Zero();
  std::vector<Cell> cells_;
  mutable std::size_t last_cell_ = 0;
  mutable double last_z_ = -1;
};

}  // namespace contensou::fit
