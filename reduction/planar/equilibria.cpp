#include "contensou/reduction/equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/LU>

#include "planar/inverse_factor.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

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
  if (first.imag() != 0) {
    return first.real() < -zero ? "stable focus" : first.real() > zero ? "unstable focus" : "center or focus";
  }
  if (std::abs(first.real()) <= zero || std::abs(second.real()) <= zero) return "degenerate";
  return first.real() * second.real() < 0 ? "saddle" : second.real() < 0 ? "stable node" : "unstable node";
}

std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Vector2d& low, const Vector2d& high) {
  constexpr int across = 40, most = 30;
  constexpr double same = 1e-6, exact = 1e-13;
  const Vector2d sides = high - low;
  const auto place = [&](const Vector2d& x) { return Vector2d((x - low).cwiseQuotient(sides)); };
  std::vector<Equilibrium> found;
  for (int i = 0; i < across * across; ++i) {
    Vector2d x = low + Vector2d((i % across + 0.5) / across, (i / across + 0.5) / across).cwiseProduct(sides);
    const Vector2d from = place(x);
    for (int step = 0; step < most; ++step) {
      const auto here = jet_of(field, x);
      if (!here) break;
      const Vector2d way = here->f.isZero(0) ? Vector2d(0, 0) : Vector2d(here->slopes.fullPivLu().solve(here->f));
      // Other cells have their own starts.
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
      // Where the Jacobian is singular a step of length 0 is no zero of the field.
      constexpr double zero = 1e-9;
      if (at->f.norm() <= zero * (at->slopes * sides.asDiagonal()).norm()) found.push_back({x, at->slopes});
      break;
    }
  }
  std::ranges::sort(found, {}, [](const Equilibrium& each) { return std::pair(each.x[0], each.x[1]); });
  return found;
}

}  // namespace contensou::reduction
