// The equations of motion (2.6) as a planar system with the scaling X = t d/dt + u d/du + v d/dv.
//
// First integral: ln |u| - ln w(k) of the flow and p - L(q) of planar.md (R64) are constant along orbits, and exp(s X)
// adds s to both. Therefore their difference is the same on an orbit and on its copies. All orbits of a sector are
// copies of one orbit, so the two first integrals differ by a constant in each sector.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/phase_plane.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "planar/directions.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/solution.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;
using std::numbers::pi;

namespace {

/// A motion of the flow, or its mirror image.
struct FlowMotion final : PlanarOrbit::Motion {
  FlowMotion(const Orbit& of, double v) : orbit(of), side(std::copysign(1, v)) { end_time = orbit.stop_time(); }
  Vector2d at(double time) const override {
    const Orbit::Instant now = orbit.instant(time);
    return {now.u, side * now.v};
  }
  Vector2d at_end() const override { return {0, 0}; }

  Orbit orbit;
  double side;  ///< 1 or -1, the sign of v
};

/// Returns the exponent of the power law by which D (Balance) vanishes beside an axis or a ray at which dD/dk = 0.
double order_of_contact(const ReducedSystem& system, double k) {
  constexpr double z = 1e-3;
  const auto angular = [&](double distance) {
    const double at = k == 0 ? distance : k == infinity ? 1 / distance : k * (1 + distance);
    return Balance::of(system.law(), system.r(), system.drive(), at).difference() / std::max(1.0, at);
  };
  return std::round(std::log2(angular(2 * z) / angular(z)));
}

struct FlowSolution final : SectionSolution {
  explicit FlowSolution(const Flow& of)
      : SectionSolution(planar_field(of.system()), {1, Eigen::Matrix2d::Identity(), Vector2d::Zero()}, {1, 0}),
        motions(of) {
    make_sectors(rays_of_quadrant());
    kind = of.system().drive() > 0 ? planar_kind("bordered") : planar_kind("stable node");
  }

  PlanarOrbit orbit(const Vector2d& start) const override {
    return PlanarOrbit(std::make_shared<const FlowMotion>(motions.orbit(state_of(start)), start[1]));
  }
  double end_time_error(const Vector2d& x, const PlanarOrbit&) const override {
    return motions.stop_time(state_of(x)).accuracy;
  }
  std::optional<double> first_integral(const Vector2d& x) const override {
    const State state = state_of(x);
    try {
      return motions.log_first_integral(state.u, std::log(state.v));
    } catch (const std::domain_error&) {
      return std::nullopt;  // the start lies on an axis or a ray
    }
  }
  std::shared_ptr<const Solution> reversed() const override {
    return solved_by_scaling(backward(field), *scaling, {1, 0}, 0);
  }

  const Flow* flow() const override { return &motions; }

  State state_of(const Vector2d& x) const {
    if (x[1] != 0 || motions.system().drive() == 0) return {x[0], std::abs(x[1])};
    throw std::domain_error("PlanarReduction: with a drive two motions leave v = 0, mirror images of one another");
  }

  std::vector<PlanarRay> rays_of_quadrant() const;
  void make_sectors(std::vector<PlanarRay> quadrant);

  Flow motions;
};

/// Returns the rays from v = 0 to u = 0, both included. Under a drive the order at v = 0 is 0, because T jumps there.
std::vector<PlanarRay> FlowSolution::rays_of_quadrant() const {
  const ReducedSystem& system = motions.system();
  const auto& [low, high, rays_by_k, ends] = motions.terminal();
  std::vector<PlanarRay> quadrant;
  if (system.drive() > 0) quadrant.emplace_back();
  for (const SingularPoint& point : phase_plane(motions).points) {
    if (point.place != SingularPlace::origin) continue;
    const Vector2d n = point.k == infinity ? Vector2d(0, 1) : Vector2d(1, point.q).normalized();
    const auto ray = std::ranges::find(rays_by_k, point.k, &InvariantRay::k);
    const bool attracts =
        ray != rays_by_k.end() ? ray->attracts() : std::ranges::count(ends, point.k, &TerminalRatio::k) > 0;
    // The ratio angular/radial is independent of the coordinates and of the weight of beta in (2.7).
    const double radial = section(n)->radial;
    const bool degenerate = point.kind == planar_kind("degenerate");
    quadrant.push_back({angle_of(n), attracts, true, radial, degenerate ? 0 : radial * (point.angular / point.radial),
                        degenerate ? order_of_contact(system, point.k) : 1, point.k});
  }
  return quadrant;
}

void FlowSolution::make_sectors(std::vector<PlanarRay> quadrant) {
  const auto image = [](int i, double q) { return i == 0 ? q : i == 1 ? pi - q : i == 3 ? -q : q == 0 ? pi : q - pi; };
  for (int i = 0; i < 4; ++i, std::ranges::reverse(quadrant)) {
    for (auto ray = quadrant.begin(); ray + 1 != quadrant.end(); ++ray) {
      rays.push_back(*ray);
      rays.back().q = image(i, ray->q);
    }
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const PlanarRay &here = rays[i], &next = rays[(i + 1) % rays.size()];
    const Vector2d n = turned({1, 0}, here.q);
    const double to = here.q + angle_between(n, turned({1, 0}, next.q));
    const bool forward = section(turned({1, 0}, (here.q + to) / 2))->angular > 0;
    sectors.push_back(forward ? PlanarSector{here.q, to, here.order > 0, next.order > 0}
                              : PlanarSector{to, here.q, next.order > 0, here.order > 0});
  }
  std::erase_if(rays, [](const PlanarRay& ray) { return ray.order == 0; });
  std::ranges::sort(rays, {}, &PlanarRay::q);
}

}  // namespace

PlanarReduction reduced(const Flow& flow) { return PlanarReduction(std::make_shared<const FlowSolution>(flow)); }

}  // namespace contensou::reduction
