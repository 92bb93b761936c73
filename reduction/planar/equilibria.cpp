#include "contensou/reduction/equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/LU>

#include "contensou/reduction/planar_kinds.hpp"
#include "numerics/decomposition.hpp"
#include "numerics/epsilon.hpp"
#include "planar/inverse_factor.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

/// Returns true if other zeros lie arbitrarily near to `zero`, at which the Jacobian has the null vector `along`.
bool on_curve_of_zeros(const SmoothField& field, const Vector2d& zero, const Vector2d& along) {
  // Newton's method reaches a simple zero in a few steps, but a multiple zero only in many.
  constexpr int steps = 3;
  constexpr double left = 1e-12, apart = 0.5;
  Vector2d x = zero + along;
  for (int i = 0; i < steps; ++i) {
    const auto here = jet_of(field, x);
    if (!here) return false;
    if (!here->f.isZero(0)) x -= least_squares(here->slopes, here->f);
  }
  const auto there = jet_of(field, x);
  return there && (x - zero).norm() > apart * along.norm() &&
         there->f.norm() <= left * there->slopes.norm() * along.norm();
}

}  // namespace

std::vector<Reversor> find_reversors(const SmoothField& field, const Vector2d& around) {
  const Reversor known[]{{"(u, -v)", Matrix2d{{1, 0}, {0, -1}}},
                         {"(-u, v)", Matrix2d{{-1, 0}, {0, 1}}},
                         {"(v, u)", Matrix2d{{0, 1}, {1, 0}}},
                         {"(-v, -u)", Matrix2d{{0, -1}, {-1, 0}}},
                         {"(-u, -v)", Matrix2d{{-1, 0}, {0, -1}}}};
  constexpr int points = 60, least = 20;
  const double large = around.lpNorm<Eigen::Infinity>(), small = around.cwiseAbs().minCoeff();
  std::vector<Reversor> found;
  for (const Reversor& reversor : known) {
    int compared = 0;
    const auto holds = [&](int i) {
      const double size = i % 2 == 0 || small == 0 ? large : small;
      const Vector2d x = size * (2 * evenly_spread(i) - Vector2d::Ones()), image = reversor.matrix * x;
      const auto here = jet_of(field, x), there = jet_of(field, image);
      if (!here || !there) return !here && !there;
      ++compared;
      constexpr double roundings = 64;
      const Vector2d allowed =
          roundings * eps * (here->f.cwiseAbs() + there->f.cwiseAbs() + here->slopes.cwiseAbs() * x.cwiseAbs());
      const Vector2d image_allowed = reversor.matrix.cwiseAbs() * allowed;
      return ((there->f + reversor.matrix * here->f).cwiseAbs().array() <= image_allowed.array()).all();
    };
    bool all = true;
    for (int i = 1; i <= points && all; ++i) all = holds(i);
    if (all && compared >= least) found.push_back(reversor);
  }
  return found;
}

std::pair<std::complex<double>, std::complex<double>> Equilibrium::eigenvalues() const {
  const double half = slopes.trace() / 2, difference = (slopes(0, 0) - slopes(1, 1)) / 2;
  const double square = difference * difference + slopes(0, 1) * slopes(1, 0);
  const std::complex<double> root = std::sqrt(std::complex<double>(square));
  return {half - root, half + root};
}

std::string_view Equilibrium::kind() const {
  constexpr double rounding = 1e-10;
  const auto [first, second] = eigenvalues();
  const double zero = rounding * slopes.norm();
  if (std::min(std::abs(first), std::abs(second)) <= zero) return planar_kind("degenerate");
  if (first.imag() != 0) {
    return first.real() < -zero  ? planar_kind("stable focus")
           : first.real() > zero ? planar_kind("unstable focus")
           : closes              ? planar_kind("center")
                                 : planar_kind("center or focus");
  }
  return first.real() * second.real() < 0 ? planar_kind("saddle")
         : second.real() < 0              ? planar_kind("stable node")
                                          : planar_kind("unstable node");
}

std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Vector2d& low, const Vector2d& high) {
  constexpr int across = 40, most = 100;  // near a multiple zero a step only halves the distance
  constexpr double same = 1e-6, exact = 1e-13;
  const Vector2d sides = high - low;
  const auto place = [&](const Vector2d& x) { return Vector2d((x - low).cwiseQuotient(sides)); };
  std::vector<Equilibrium> found;
  for (int i = 0; i < across * across; ++i) {
    const int row = i / across, column = i % across;
    Vector2d x = low + Vector2d((column + 0.5) / across, (row + 0.5) / across).cwiseProduct(sides);
    const Vector2d from = place(x);
    for (int step = 0; step < most; ++step) {
      const auto here = jet_of(field, x);
      if (!here) break;
      const Vector2d way = here->f.isZero(0) ? Vector2d(0, 0) : Vector2d(here->slopes.fullPivLu().solve(here->f));
      // Zeros farther away are found from the grid points in their own cell.
      constexpr double reach = 0.1;
      if (!((place(x - way) - from).norm() <= reach)) break;
      x -= way;
      if (!(way.cwiseQuotient(sides).norm() <= exact)) continue;
      const Vector2d there = place(x);
      const bool inside = there.minCoeff() >= 0 && there.maxCoeff() <= 1;
      const bool known =
          std::ranges::any_of(found, [&](const Equilibrium& other) { return (place(other.x) - there).norm() < same; });
      const auto at = jet_of(field, x);
      if (!inside || known || !at || !at->slopes.allFinite()) break;
      // A singular Jacobian can give a step of length 0 at a point that is no zero. Therefore test the field itself.
      constexpr double zero = 1e-9;
      if (at->f.norm() <= zero * (at->slopes * sides.asDiagonal()).norm()) found.push_back({x, at->slopes});
      break;
    }
  }
  constexpr double beside = 0.02;
  std::erase_if(found, [&](const Equilibrium& each) {
    if (each.kind() != "degenerate") return false;
    const bool first = each.slopes.row(0).squaredNorm() >= each.slopes.row(1).squaredNorm();
    const Vector2d row = each.slopes.row(first ? 0 : 1);
    const Vector2d along = row.isZero(0) ? Vector2d(0, 1) : Vector2d(-row[1], row[0]).normalized();
    return on_curve_of_zeros(field, each.x, beside * sides.minCoeff() * along);
  });
  for (const Reversor& reversor : find_reversors(field, low.cwiseAbs().cwiseMax(high.cwiseAbs()))) {
    if (reversor.matrix.determinant() > 0) continue;
    for (Equilibrium& each : found) each.closes |= (reversor.matrix * each.x - each.x).norm() < same * sides.norm();
  }
  std::ranges::sort(found, {}, [](const Equilibrium& each) { return std::pair(each.x[0], each.x[1]); });
  return found;
}

void prove_centers(std::vector<Equilibrium>& equilibria, const PlanarReduction& plane) {
  constexpr double least = 1e-3;
  for (Equilibrium& each : equilibria) {
    const Vector2d& radii = box_about(each.x).radii;
    each.closes |= plane.form() == name(FactorForm::constant);
    for (const FactorPiece& piece : plane.factor_pieces(each.x - radii, each.x + radii)) {
      const bool within = (each.x - piece.low).minCoeff() >= 0 && (piece.high - each.x).minCoeff() >= 0;
      const double largest = std::max(std::abs(piece.value(piece.low)), std::abs(piece.value(piece.high)));
      each.closes |= within && std::abs(piece.value(each.x)) > least * largest;
    }
  }
}

std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Vector2d& start) {
  const Vector2d corner = Vector2d::Constant(2.5 * start.lpNorm<Eigen::Infinity>());
  return find_equilibria(field, -corner, corner);
}

}  // namespace contensou::reduction
