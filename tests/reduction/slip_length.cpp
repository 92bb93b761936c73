// The length of slip, README (R13) and (R14): a quantity of Orbit and of the similarity curve.
#include <cmath>
#include <stdexcept>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_curve.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/quadrature_curve.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

/// The integral of v dtau from where ln k is top to where it is bottom, by v^2 d ln k/D along the orbit (R3).
double slip_between(const ReducedSystem& system, const Orbit& orbit, double bottom, double top) {
  const auto rate = [&](double ln_k) {
    const double k = std::exp(ln_k);
    const auto [force, moment] = system.law()(slip_of_ratio(k));
    const double v = orbit.at_log_ratio(ln_k).v;
    return v * v / (force - system.r() * k * moment) / system.scaled_time_rate();
  };
  double sum = 0;
  for (double left = bottom; left < top;) {
    const double right = std::min(std::floor(left + 1), top);  // panels end at k = 1
    sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(rate, left, right, 5, 1e-14);
    left = right;
  }
  return sum;
}

}  // namespace

TEST_CASE("the slip of the Pade law is its closed form", "[slip_length][route]") {
  WorstCase excess("n");
  for (double r : {1e-20, 1e-8, 1e-3, 0.1, 5.0 / 7, 1.0}) {
    const QuadratureCurve curve(PadeLaw{}, r);
    const PadeCurve closed(r);
    for (double ln_k : {-1e6, -60.0, -40.0, -10.0, -1.0, 0.0, 1.0, 5.0, 20.0, 40.0}) {
      // n enters as v w (n + k/2): its error counts relative to that.
      const double wanted = closed.slip_length_coefficient(ln_k);
      excess.add(wanted, curve.slip_length_coefficient(ln_k), wanted + std::exp(ln_k) / 2,
                 fmt::format("r = {}, ln k = {}", r, ln_k));
    }
  }
  CHECK_WITHIN_EPS(excess, 100);
}

TEST_CASE("the slip is the integral of v along the orbit", "[slip_length][route]") {
  WorstCase whole("whole slip"), part("slip of a part");
  for (const Law& law : {Law(PadeLaw{}), Law(HertzLaw{})}) {
    for (double mu : {1e-4, 0.1, 0.3, 1.0}) {
      for (double k0 : {1e-3, 0.5, 1.0, 3.0, 1e3}) {
        const std::string where = fmt::format("{}, mu = {}, k0 = {}", law.name(), mu, k0);
        const ReducedSystem system(law, mu);
        const Orbit orbit = Flow(system).orbit({-3, 3 * mu * k0});
        const double top = orbit.start_log_ratio();
        whole.add(slip_between(system, orbit, top - 40, top), orbit.slip_length(orbit.stop_time()), where);
        const double middle = top - 1;
        part.add(slip_between(system, orbit, middle, top), orbit.slip_length(orbit.at_log_ratio(middle).tau), where);
      }
    }
  }
  CHECK_WITHIN_EPS(whole, 200);
  // The time of the middle is known to eps of the stop time only, which is long against the slip where mu is small.
  CHECK_WITHIN_EPS(part, 1e6);
}

TEST_CASE("the slip of pure sliding is v0^2/2 over its deceleration, and without sliding there is none",
          "[slip_length][limit]") {
  const ReducedSystem system(HertzLaw{}, 0.2);
  const Orbit sliding = Flow(system).orbit({0, 3});
  const double stop = sliding.stop_time();
  CHECK(sliding.slip_length(stop) == Approx(3 * stop / 2).epsilon(1e-15));
  CHECK(sliding.slip_length(2 * stop) == sliding.slip_length(stop));
  CHECK(sliding.slip_length(stop / 2) == Approx(3 * (3 * stop / 8)).epsilon(1e-15));
  CHECK(sliding.slip_length(0) == 0);
  CHECK(Flow(system).orbit({3, 0}).slip_length(1) == 0);
  CHECK(Flow(system).orbit({0, 0}).slip_length(1) == 0);
  // Next to the axis.
  CHECK(Flow(system).orbit({1e-12, 3}).slip_length(1e3) == Approx(3 * stop / 2).epsilon(1e-11));
}

TEST_CASE("the slip is scaled by the square of a power of two, bit for bit", "[slip_length][symmetry]") {
  const ReducedSystem system(PadeLaw{}, 0.3);
  const Orbit orbit = Flow(system).orbit({1, 0.7});
  const Orbit scaled = Flow(system).orbit({1024, 0.7 * 1024});
  for (double tau : {0.0, 0.1, 1.0, 5.0, 100.0}) {
    CHECK(scaled.slip_length(1024 * tau) == 1024.0 * 1024.0 * orbit.slip_length(tau));
  }
}

TEST_CASE("the slip is asked within its motion", "[slip_length][domain]") {
  const Orbit orbit = Flow(ReducedSystem(PadeLaw{}, 0.3)).orbit({1, 1});
  CHECK_THROWS_AS(orbit.slip_length(-1), std::domain_error);
  CHECK_THROWS_AS(orbit.slip_length(std::nan("")), std::domain_error);
}
