#include "contensou/reduction/phase_plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "user_laws.hpp"

using namespace contensou::reduction;
using std::numbers::pi;

namespace {

/// Returns the singular point with a direction and a place; fails the test if it does not exist.
SingularPoint point_of(const PhasePlane& plane, InvariantDirection direction, SingularPlace place) {
  const auto found = std::ranges::find_if(
      plane.points, [&](const SingularPoint& point) { return point.direction == direction && point.place == place; });
  REQUIRE(found != plane.points.end());
  return *found;
}

bool has_ray(const PhasePlane& plane) {
  return std::ranges::any_of(plane.points,
                             [](const SingularPoint& point) { return point.direction == InvariantDirection::ray; });
}

/// Returns the rates of (radial, angular): the regularised field, desingularised, in the chart of a point.
Eigen::Vector2d chart_field(const ReducedSystem& system, const SingularPoint& point, double radial, double angular) {
  const bool at_origin = point.place == SingularPlace::origin;
  const double speed = at_origin ? radial : 1 / radial;
  const bool sliding = point.direction == InvariantDirection::sliding;
  const State state = sliding ? State{angular * speed, speed} : State{speed, angular * speed};
  const Rate rate = system.regularised_field(state);
  const double along = sliding ? rate.v : rate.u;
  const double across = sliding ? rate.u : rate.v;
  // Divide the field by the speed. The coordinate `radial` is the speed, or 1/speed at infinity.
  return {(at_origin ? along : -along / (speed * speed)) / speed, (across - angular * along) / speed / speed};
}

}  // namespace

TEST_CASE("Eigenvalues of the paper's system are those of the blow-up by hand", "[phase_plane][table]") {
  for (double mu : {1e-4, 0.1, 0.3, 1.0, 1.6, 1.7, 2.2, 2.6, 2.7, 5.0}) {
    CAPTURE(mu);
    const PhasePlane plane = phase_plane(ReducedSystem(PadeLaw{}, mu, homogeneous_ball));
    const double A = 8 * (14 - 5 * mu * mu);
    const double B = 15 * pi * (7 - mu * mu);
    CHECK(plane.mu_low == Approx(std::sqrt(14.0 / 5)).epsilon(1e-14));
    CHECK(plane.mu_high == Approx(std::sqrt(7.0)).epsilon(1e-14));
    const auto check = [&](InvariantDirection direction, double radial, double angular) {
      const SingularPoint origin = point_of(plane, direction, SingularPlace::origin);
      CHECK(origin.radial == Approx(-radial).epsilon(1e-12));
      CHECK(origin.angular == Approx(angular).epsilon(1e-11));
      const SingularPoint far = point_of(plane, direction, SingularPlace::infinity);
      CHECK(far.radial == Approx(radial).epsilon(1e-12));
      CHECK(far.angular == Approx(angular).epsilon(1e-11));
    };
    check(InvariantDirection::pivoting, 40 * mu * mu * mu, -mu * A);
    check(InvariantDirection::sliding, 105 * pi, B);
    CHECK(has_ray(plane) == (mu * mu > 14.0 / 5 && mu * mu < 7));
    if (has_ray(plane)) {
      const double q = -mu * A / B;
      CHECK(point_of(plane, InvariantDirection::ray, SingularPlace::origin).q == Approx(q).epsilon(1e-13));
      check(InvariantDirection::ray, 5 * mu * mu * (8 * mu + 3 * pi * q), mu * A);
    }
  }
}

/// Returns true for the elliptic law, under which k falls everywhere or grows everywhere, so that no ray exists.
bool has_no_ray(const TerminalRatios& limits) { return std::abs(limits.high - limits.low) < 1e-12 * limits.low; }

TEST_CASE("The linear parts are the derivatives of the regularised field in its charts", "[phase_plane][route]") {
  const auto check = [](const ReducedSystem& system) {
    for (const SingularPoint& point : phase_plane(system).points) {
      CAPTURE(system.law().name(), system.r(), name(point.direction), name(point.place));
      const double at = point.direction == InvariantDirection::sliding ? 0 : point.q;
      const double scale = point.direction == InvariantDirection::sliding ? 1 / system.mu() : system.mu();
      // Use one-sided differences at an axis. Laws with a logarithm or |u| are not smooth there, so the step is small.
      const double h = 1e-6 * scale;
      const auto across = [&](double angular) { return chart_field(system, point, 1, angular)[1]; };
      const double angular = at == 0 ? across(h) / h : (across(at + h) - across(at - h)) / (2 * h);
      CHECK(point.angular == Approx(angular).epsilon(3e-5));
      const double radial = chart_field(system, point, 2, at)[0] - chart_field(system, point, 1, at)[0];
      CHECK(point.radial == Approx(radial).epsilon(1e-11));
    }
  };
  for (const Law& law : named_laws()) {
    const TerminalRatios limits = terminal_ratios(law, 1);
    for (double r : {0.1 * limits.low, 0.7 * limits.low + 0.3 * limits.high, 0.5 * (limits.low + limits.high),
                     1.5 * limits.high}) {
      if (has_no_ray(limits) && r > 0.9 * limits.low && r < 1.1 * limits.high) continue;
      check({law, 1, {1, r}});
      check({law, 0.25, {1, 16 * r}});
    }
  }
  check({contensou::tests::RootLaw{}, 0.7});
}

TEST_CASE("Every half-line joins a saddle to a node, and the regime says which", "[phase_plane][invariant]") {
  using enum InvariantDirection;
  using enum SingularPlace;
  for (const Law& law : named_laws()) {
    const TerminalRatios limits = terminal_ratios(law, 1);
    const auto plane_at = [&](double r) { return phase_plane(ReducedSystem(law, 1, {1, r})); };
    const auto check = [&](const PhasePlane& plane, InvariantDirection tangent) {
      CAPTURE(law.name(), name(tangent));
      REQUIRE(plane.tangents.size() == 1);
      CHECK(plane.tangents[0].direction == tangent);
      CHECK(plane.tangents[0].contact_order > 0);
      for (const SingularPoint& point : plane.points) {
        if (point.direction == tangent) {
          CHECK(point.kind == (point.place == origin ? "stable node" : "saddle"));
        } else {
          CHECK(point.kind == (point.place == origin ? "saddle" : "unstable node"));
        }
      }
      const SingularPoint node = point_of(plane, tangent, origin);
      CHECK(plane.tangents[0].contact_order == Approx(node.angular / node.radial).epsilon(1e-12));
    };
    check(plane_at(0.9 * limits.low), pivoting);
    check(plane_at(1.1 * limits.high), sliding);
    CHECK(plane_at(0.9 * limits.low).points.size() == 4);
    CHECK(plane_at(1.1 * limits.high).points.size() == 4);
    if (has_no_ray(limits)) continue;
    check(plane_at(0.4 * limits.low + 0.6 * limits.high), ray);
    CHECK(plane_at(0.4 * limits.low + 0.6 * limits.high).points.size() == 6);
  }
}

TEST_CASE("Where two points merge the linear part says so", "[phase_plane][limit]") {
  for (const char* law : {"pade", "exact", "uniform"}) {
    const TerminalRatios limits = terminal_ratios(*find_law(law), 1);
    const PhasePlane low = phase_plane(ReducedSystem(*find_law(law), 1, {1, limits.low}));
    CAPTURE(law);
    CHECK(low.points.size() == 4);
    CHECK(low.tangents[0].direction == InvariantDirection::pivoting);
    CHECK(low.tangents[0].contact_order == 0);
    const SingularPoint merged = point_of(low, InvariantDirection::pivoting, SingularPlace::origin);
    CHECK(merged.kind == "degenerate");
    CHECK(merged.angular == 0);
    const PhasePlane high = phase_plane(ReducedSystem(*find_law(law), 1, {1, limits.high}));
    CHECK(high.points.size() == 4);
    CHECK(high.tangents[0].direction == InvariantDirection::sliding);
    CHECK(point_of(high, InvariantDirection::sliding, SingularPlace::infinity).kind == "degenerate");
  }
}

TEST_CASE("A ray at the kink k = 1 has the slope of the law there", "[phase_plane][table]") {
  // For D = Phi - r k Psi, dD/dk = Phi' (1 + r k^2) - r Psi. `scale` is 2 chi W/(3 pi), chi = 1, W(k = 1) of (R9).
  const double scale = 2 / (3 * pi) * (16 + 15 * pi) * (8 + 3 * pi);
  const auto angular = [](const char* law, double r) {
    return point_of(phase_plane(ReducedSystem(*find_law(law), 1, {1, r})), InvariantDirection::ray,
                    SingularPlace::origin)
        .angular;
  };
  CHECK(angular("exact", 4) == Approx(-scale * 6 * pi / 32).epsilon(1e-6));
  CHECK(angular("uniform", 3) == Approx(-scale * 8 / (3 * pi)).epsilon(1e-6));
  // At k = 1 the force of the ring has an infinite slope.
  const PhasePlane ring = phase_plane(ReducedSystem(*find_law("ring"), 1, {1, 1}));
  CHECK(point_of(ring, InvariantDirection::ray, SingularPlace::origin).angular == -INFINITY);
  CHECK(point_of(ring, InvariantDirection::ray, SingularPlace::origin).kind == "stable node");
  CHECK(point_of(ring, InvariantDirection::ray, SingularPlace::infinity).kind == "saddle");
  CHECK(ring.tangents[0].contact_order == INFINITY);
}

TEST_CASE("Orbits touch their tangent to the order of contact", "[phase_plane][route]") {
  for (const Law& law : {Law(PadeLaw{}), Law(HertzLaw{})}) {
    for (double mu : {0.05, 0.3, 1.0}) {
      const ReducedSystem system(law, mu, homogeneous_ball);
      const Orbit orbit = Flow(system).orbit({1, 1});
      const OrbitPoint a = orbit.at_time_left(1e-4 * orbit.stop_time());
      const OrbitPoint b = orbit.at_time_left(1e-7 * orbit.stop_time());
      const double order = (a.ln_v - b.ln_v - std::log(a.u / b.u)) / std::log(a.u / b.u);  // d ln k/d ln u
      CAPTURE(law.name(), mu);
      CHECK(phase_plane(system).tangents[0].contact_order == Approx(order).epsilon(1e-3));
    }
    // On orbits near a ray, computed by steps, k - k* must be proportional to a power of u.
    const ReducedSystem disc(law, 1, {1, 3});
    const PhasePlane plane = phase_plane(disc);
    REQUIRE(plane.tangents[0].direction == InvariantDirection::ray);
    const Motion motion = integrate_regularised(disc, {1, 2});
    double ln_u[2] = {}, ln_gap[2] = {};
    for (Eigen::Index i = 0; i < motion.points.rows(); ++i) {
      for (int j : {0, 1}) {
        if (motion.points.u[i] < (j == 0 ? 1e-9 : 1e-13)) continue;
        ln_u[j] = std::log(motion.points.u[i]);
        ln_gap[j] = std::log(motion.points.k[i] - plane.tangents[0].k);
      }
    }
    CHECK((ln_gap[0] - ln_gap[1]) / (ln_u[0] - ln_u[1]) == Approx(plane.tangents[0].contact_order).epsilon(0.02));
  }
}

TEST_CASE("A patch ratio whose powers underflow has its kinds all the same", "[phase_plane][limit]") {
  const PhasePlane plane = phase_plane(ReducedSystem(PadeLaw{}, 1e-150));
  CHECK(point_of(plane, InvariantDirection::pivoting, SingularPlace::origin).kind == "stable node");
  CHECK(point_of(plane, InvariantDirection::pivoting, SingularPlace::infinity).kind == "saddle");
  CHECK(std::isfinite(plane.tangents[0].contact_order));
}
