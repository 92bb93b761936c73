// Tests the search for the start that has a given result: (R36) and (R37) of reduction/numerics.md.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/aim.hpp"
#include "contensou/reduction/laws.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using contensou::tests::WorstCase;

namespace {

const std::vector<std::string> names{"exact", "pade", "uniform", "ring", "elliptic", "annulus:0.6"};

struct Case {
  std::string text;
  Flow flow;
};

/// Laws and bodies. For a small mu the ratio k falls along orbits, for a large mu it grows. For a mu between them there
/// is a ray.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& name : names) {
    for (const Inertia& body : {homogeneous_ball, Inertia{2.5, 1.5}, Inertia{1, 2}}) {
      for (double mu : {1e-3, 0.3, 1.3, 6.0}) {
        all.push_back({fmt::format("{} chi {} gamma {} mu {}", name, body.chi, body.gamma, mu),
                       Flow({*find_law(name), mu, body})});
      }
    }
  }
  return all;
}

/// A law whose Phi falls from 2.1 near k = 1.2 to 1, or, for {0, 6}, whose Psi grows first. (R36) excludes both.
struct WavyLaw {
  double force = 6, moment = 0;

  Resistance operator()(Slip slip) const {
    const double size = std::hypot(slip.sliding, slip.pivoting), s = slip.sliding / size, p = slip.pivoting / size;
    const double wave = s * s * p * p;
    return {s * (1 + force * wave), 0.6 * p * (1 + moment * wave)};
  }
};

}  // namespace

TEST_CASE("two of time, distance and turning lead back to the start", "[aim][invariant]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> ln_k(-5, 5), ln_speed(-20, 20);
  WorstCase tau("tau"), distance("distance"), turned("turned"), speeds("u and v");
  for (const auto& [text, flow] : cases()) {
    for (int i = 0; i < 2; ++i) {
      const double v = std::exp(ln_speed(random)), k = std::exp(ln_k(random));
      const State start{v / (flow.system().mu() * k), v};
      const Reached wanted = reached(flow, start);
      for (const Aim& aim : {Aim{wanted.tau, wanted.distance, {}}, Aim{wanted.tau, {}, wanted.turned},
                             Aim{{}, wanted.distance, wanted.turned}}) {
        const std::string where = fmt::format("{} k {}", text, k);
        INFO(where);
        const auto found = aimed(flow, aim);
        REQUIRE(found);
        const Reached got = reached(flow, *found);
        if (aim.tau) tau.add(wanted.tau, got.tau, where);
        if (aim.distance) distance.add(wanted.distance, got.distance, where);
        if (aim.turned) turned.add(wanted.turned, got.turned, where);
        if (aim.distance && aim.turned) {
          speeds.add(start.u, found->u, where);
          speeds.add(start.v, found->v, where);
        }
      }
    }
  }
  CHECK_WITHIN_EPS(tau, 100);
  CHECK_WITHIN_EPS(distance, 100);
  CHECK_WITHIN_EPS(turned, 100);
  CHECK_WITHIN_EPS(speeds, 1000);
}

TEST_CASE("distance over turning and over time squared, and time squared over turning, grow with k",
          "[aim][invariant]") {
  for (const auto& [text, flow] : cases()) {
    Reached last{};
    for (double ln_k = -6; ln_k <= 6; ln_k += 0.25) {
      const Reached here = reached(flow, {std::exp(-ln_k) / flow.system().mu(), 1});
      if (last.tau > 0) {
        INFO(fmt::format("{} k {}", text, std::exp(ln_k)));
        CHECK(here.distance / here.turned > last.distance / last.turned);
        CHECK(here.distance / (here.tau * here.tau) > last.distance / (last.tau * last.tau));
        // If Psi is nearly constant, rounding may make the last ratio grow.
        CHECK(here.tau * here.tau / here.turned > last.tau * last.tau / last.turned * (1 - 1e-13));
      }
      last = here;
    }
  }
}

TEST_CASE("what a motion comes to is what its steps sum up to", "[aim][invariant]") {
  // Compute distance and angle by the midpoint rule.
  for (const char* name : {"exact", "pade", "ring"}) {
    for (const Inertia& body : {homogeneous_ball, Inertia{1, 2}}) {
      const Flow flow({*find_law(name), 0.4, body});
      const State start{3, 1};
      const Orbit orbit = flow.orbit(start);
      const double tau = orbit.stop_time();
      double distance = 0, turned = 0;
      constexpr int steps = 20000;
      for (int i = 0; i < steps; ++i) {
        const OrbitPoint at = orbit.at_time(tau * (i + 0.5) / steps);
        distance += ((1 - 1 / body.chi) * start.v + at.v / body.chi) * tau / steps;
        turned += at.u * tau / steps;
      }
      const Reached got = reached(flow, start);
      CHECK(got.tau == tau);
      CHECK(got.distance == Approx(distance).epsilon(1e-7));
      CHECK(got.turned == Approx(turned).epsilon(1e-7));
    }
  }
}

TEST_CASE("the reversed question on the axes", "[aim][edge]") {
  const Flow flow(HertzLaw{}, 0.2);
  const auto same = [](const std::optional<State>& found, State wanted) {
    REQUIRE(found);
    CHECK(found->u == Approx(wanted.u).epsilon(1e-14));
    CHECK(found->v == Approx(wanted.v).epsilon(1e-14));
  };
  const Reached slides = reached(flow, {0, 2}), pivots = reached(flow, {3, 0});
  CHECK(slides.turned == 0);
  CHECK(pivots.distance == 0);
  same(aimed(flow, {{}, 0, 0}), {0, 0});
  same(aimed(flow, {slides.tau, slides.distance, {}}), {0, 2});
  same(aimed(flow, {slides.tau, {}, 0}), {0, 2});
  same(aimed(flow, {{}, slides.distance, 0}), {0, 2});
  same(aimed(flow, {pivots.tau, 0, {}}), {3, 0});
  same(aimed(flow, {pivots.tau, {}, pivots.turned}), {3, 0});
  same(aimed(flow, {{}, 0, pivots.turned}), {3, 0});
  // A time below the time of pure sliding, or of pure pivoting, cannot be reached.
  CHECK_FALSE(aimed(flow, {slides.tau * 0.999, slides.distance, {}}));
  CHECK_FALSE(aimed(flow, {pivots.tau * 0.999, {}, pivots.turned}));
  CHECK(least_time(flow, {1e9, slides.distance, {}}) == Approx(slides.tau).epsilon(1e-14));
  CHECK(least_time(flow, {1e9, {}, pivots.turned}) == Approx(pivots.tau).epsilon(1e-14));
  // Demands may differ by many orders of magnitude.
  for (double far : {1e-200, 1e-20, 1e20, 1e200}) {
    const auto found = aimed(flow, {{}, far, 1});
    REQUIRE(found);
    const Reached got = reached(flow, *found);
    CHECK(got.distance == Approx(far).epsilon(1e-12));
    CHECK(got.turned == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("what the reversed question refuses", "[aim][edge]") {
  const Flow flow(PadeLaw{}, 0.2);
  CHECK_THROWS_AS(aimed(flow, {1, {}, {}}), std::domain_error);
  CHECK_THROWS_AS(aimed(flow, {1, 1, 1}), std::domain_error);
  CHECK_THROWS_AS(aimed(flow, {1, -1, {}}), std::domain_error);
  CHECK_THROWS_AS(aimed(flow, {1, std::nan(""), {}}), std::domain_error);
  CHECK_THROWS_AS(aimed(Flow({PadeLaw{}, 0.2, homogeneous_ball, 0.1}), {1, 1, {}}), std::domain_error);
  // Demands at the edge of the range of doubles cannot be reached.
  CHECK_THROWS_AS(aimed(flow, {1e200, 1, {}}), TooFarApart);
  CHECK_THROWS_AS(aimed(flow, {1e200, {}, 1}), TooFarApart);
  CHECK_THROWS_AS(aimed(flow, {{}, 1e300, 1e-300}), TooFarApart);
  // Under WavyLaw a body with spin may go farther in a given time than a body without spin.
  using Catch::Matchers::Contains;
  const Flow falls({WavyLaw{}, 1, {1, 2}});
  const Reached spinning = reached(falls, {0.823, 2.38}), straight = reached(falls, {0, 1});
  CHECK(spinning.distance / (spinning.tau * spinning.tau) > straight.distance / (straight.tau * straight.tau));
  CHECK_THROWS_WITH(aimed(falls, {spinning.tau, spinning.distance, {}}), Contains("this law's Phi falls from"));
  CHECK_THROWS_WITH(aimed(Flow(WavyLaw{0, 6}, 0.2), {1, 1, {}}), Contains("this law's Psi grows from"));
  for (const std::string& name : names) CHECK_NOTHROW(require_monotone(*find_law(name)));
}
