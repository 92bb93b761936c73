#include "contensou/reduction/small_mu_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/small_mu.hpp"

using namespace contensou::reduction;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The worst error over nine tenths of the motion, instants of the sliding layer among them.
struct Error {
  double u = 0;
  double ln_v = 0;
};

template <class Motion>
Error worst_error(double mu, double k0, const Motion& motion) {
  const ReducedSystem system(PadeLaw{}, mu);
  const State start{1, mu * k0};
  const Orbit orbit(system, start);
  const double layer = system.sliding_limit(start.v) + system.sliding_limit(mu);
  const double last = 0.9 * orbit.stop_time();
  Error worst;
  for (int i = 0; i <= 400; ++i) {
    for (double tau : {last * i / 400, std::min(layer * i / 100, last)}) {
      const auto estimate = motion.at_time(tau);
      const OrbitPoint exact = orbit.at_time(tau);
      worst.u = std::max(worst.u, std::abs(estimate.u - exact.u));
      worst.ln_v = std::max(worst.ln_v, std::abs(estimate.ln_v - exact.ln_v));
    }
  }
  return worst;
}

Error worst_error(double mu, double k0) { return worst_error(mu, k0, SmallMuMotion(mu, {1, mu * k0})); }

/// The layer and the spin-down without what joins them: u runs down from the start as if nothing slid.
struct Disjoined {
  SmallMuMotion motion;
  double pivoting;
  SmallMuMotion::Point at_time(double tau) const { return {1 - tau / pivoting, motion.at_time(tau).ln_v}; }
};

}  // namespace

TEST_CASE("the motion for small mu: u to the fourth order, ln v to the second", "[small_mu_motion][limit]") {
  for (double k0 : {0.01, 0.3, 3.0, 30.0}) {
    const Error coarse = worst_error(0.025, k0);
    const Error fine = worst_error(0.0125, k0);
    CAPTURE(k0, coarse.u, coarse.ln_v, fine.u, fine.ln_v);
    CHECK(std::log2(coarse.u / fine.u) == Approx(4).margin(0.05));
    CHECK(std::log2(coarse.ln_v / fine.ln_v) == Approx(2).margin(0.06));
  }
}

TEST_CASE("the motion for small mu is uniformly good in k0", "[small_mu_motion][limit]") {
  for (double mu : {0.1, 0.03, 0.01}) {
    const double r = 5 * mu * mu / 7;
    for (double ln_k = -10; ln_k <= 25; ln_k += 0.5) {
      const double k0 = std::exp(ln_k);
      const double logarithm = std::log(2 + k0);
      const Error error = worst_error(mu, k0);
      CAPTURE(mu, k0, error.u, error.ln_v);
      CHECK(error.u < 0.1 * r * r * logarithm * logarithm);
      CHECK(error.ln_v < 1.5 * r * logarithm * logarithm);
    }
  }
}

TEST_CASE("layer and spin-down that are not joined are two orders worse", "[small_mu_motion]") {
  const auto error = [](double mu) {
    const State start{1, 3 * mu};
    const ReducedSystem system(PadeLaw{}, mu);
    return worst_error(mu, 3, Disjoined{SmallMuMotion(mu, start), system.pivoting_limit(1)}).u;
  };
  CHECK(std::log2(error(0.025) / error(0.0125)) == Approx(2).margin(0.1));
}

TEST_CASE("the motion for small mu begins at its start and stops at E1", "[small_mu_motion][limit]") {
  for (const State start : {State{1, 1}, State{-2, 1e-5}, State{1e-300, 1e300}, State{1e300, 1e-300}, State{-3, 0},
                            State{0, 2}, State{1e-310, 1}, State{1, 1e-310}}) {
    for (double mu : {1e-100, 1e-3, 0.1}) {
      const ReducedSystem system(PadeLaw{}, mu);
      const SmallMuMotion motion(mu, start);
      const double stop = motion.stop_time();
      CAPTURE(mu, start.u, start.v, stop);
      CHECK(motion.at_time(0).u == Approx(start.u).epsilon(1e-14));
      if (start.v > 0) CHECK(motion.at_time(0).ln_v == Approx(std::log(start.v)).margin(1e-12).epsilon(1e-14));
      CHECK(motion.at_time(stop).u == 0);
      CHECK(motion.at_time(stop).ln_v == -infinity);
      const auto estimates = small_mu_estimates(system, start);
      CHECK(stop == Approx(estimates[estimates.size() - 2].tau).epsilon(1e-14));
      if (std::isinf(stop)) continue;
      // Both fall all the time.
      SmallMuMotion::Point before = motion.at_time(0);
      for (int i = 1; i <= 50; ++i) {
        const SmallMuMotion::Point here = motion.at_time(stop * i / 50);
        CHECK(std::abs(here.u) <= std::abs(before.u));
        CHECK(here.ln_v <= before.ln_v);
        before = here;
      }
    }
  }
  CHECK(SmallMuMotion(0.1, {0, 0}).stop_time() == 0);
  CHECK(SmallMuMotion(0.1, {0, 0}).at_time(0).u == 0);
}

TEST_CASE("the motion for small mu rejects what is no time, no start and not small", "[small_mu_motion][domain]") {
  CHECK_THROWS_AS(SmallMuMotion(0.1, {1, 1}).at_time(-1), std::domain_error);
  CHECK_THROWS_AS(SmallMuMotion(0.1, {1, 1}).at_time(std::nan("")), std::domain_error);
  CHECK_THROWS_AS(SmallMuMotion(0.1, {1, -1}), std::domain_error);
  CHECK_THROWS_WITH(SmallMuMotion(1, {1, 1}, {1, 2}), Catch::Matchers::Contains("small"));
}
