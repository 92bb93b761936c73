#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/inertia.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::fit {

/// Sliding and pivoting speeds, m/s, and their integrals over T = f g t; or a derivative of all of them.
struct Speeds {
  double v = 0, u = 0, slid = 0, turned = 0;
  double centre = 0, way = 0;  ///< speed of the centre along the slip, and its integral: of a FilmOrbit only
};

inline Speeds operator+(const Speeds& a, const Speeds& b) {
  return {a.v + b.v, a.u + b.u, a.slid + b.slid, a.turned + b.turned, a.centre + b.centre, a.way + b.way};
}
inline Speeds operator*(double c, const Speeds& a) {
  return {c * a.v, c * a.u, c * a.slid, c * a.turned, c * a.centre, c * a.way};
}

/// Bodies by what differs in their orbits.
enum class Kind {
  ball,      ///< without an invariant ray
  flat,      ///< its law may have invariant rays
  resisted,  ///< a ball with rolling friction: there may be a drive
};

/// An orbit of a body's reduced system in T = f g t, in cells.
///
/// k = v/w, w = mu |u|, tends to an end k*: 0, that of an invariant ray, or infinity. With c = k, or c = 1/k where k
/// grows without a drive,
///   c = c* + (c0 - c*) exp(-s)
/// makes the orbit two quadratures over s, and two more for the integrals of v and u. With B = gamma mu^2 Psi,
/// D = chi (Phi - rho) - B k, and F = D/(k - k*), or -D c^2/(c - c*) for c = 1/k:
///   d ln |u|/ds = -B/F,   dT/ds = w/F.
/// Cells of s are as wide as polynomials of degree 9 allow.
class OrbitCells {
 public:
  /// @param start     u and v >= 0
  /// @param drive     rho, 0 <= rho <= greatest_drive()
  /// @param accuracy  relative accuracy of the polynomials; T and ln |u|, their integrals, are 100 times as accurate
  /// @throws std::domain_error  if the orbit meets a ray that it cannot follow
  OrbitCells(const reduction::Law& law, double mu, reduction::Inertia inertia, Kind kind, reduction::State start,
             double drive, double accuracy);

  /// Returns a drive below which there is a ray: 0.9 of that from which on there is none.
  static double greatest_drive(const reduction::Law& law, double mu, reduction::Inertia inertia);

  /// Computes the orbit up to that T, or to the stop.
  void reach(double T);

  /// @param T  >= 0, up to where the orbit was computed; cheapest next to the last one
  Speeds speeds_at(double T) const;

  /// T of the stop; after reach(infinity).
  double stop() const;

 private:
  static constexpr int nodes = 10;  ///< nodes of a cell
  enum { T_, ln_u, slid, turned, integrals };
  using Integrals = Eigen::Array<double, integrals, 1>;
  /// In powers of z, which goes from -1 at the start of a cell to 1.
  using Powers = Eigen::Array<double, integrals, nodes + 1>;
  struct Basis;
  struct Cell {
    double s, half_width, T_end;
    Powers powers;
  };

  /// D and B.
  struct Forces {
    double D, B;
  };
  Forces forces(double k) const;
  double k_end(double k) const;
  double F(double distance, double D) const;
  double ratio(double s) const;
  /// The next cell, and the error of its polynomials over what it may be.
  Powers next_powers(double half_width, double& error) const;

  reduction::Law law_;
  double mu_;
  reduction::Inertia inertia_;
  Kind kind_;
  reduction::State
      start_;  ///< next to an axis that of an orbit beside it, to whose smaller speed this one is in proportion
  double drive_, accuracy_;
  double v_share_ = 1, u_share_ = 1;
  bool inverse_ = false;           ///< c = 1/k
  double end_ = 0, distance_ = 0;  ///< c* and c0 - c*
  std::array<double, 2> near_{};   ///< F a little below and above c*
  std::vector<double> kinks_;      ///< s of the kinks ahead, the next one last
  double s_ = 0, width_;           ///< start and width of the next cell
  Integrals now_ = Integrals::Zero();
  std::vector<Cell> cells_;
  mutable std::size_t last_cell_ = 0;
  mutable double last_z_ = -1;
};

}  // namespace contensou::fit
