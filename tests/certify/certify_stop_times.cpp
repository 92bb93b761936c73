#include "certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "motion/stop_time_table.hpp"
#include "reduction/user_laws.hpp"
#include "reference_table.hpp"
#include "similarity/curves.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

using contensou::infinity;
constexpr double largest = std::numeric_limits<double>::max();

constexpr int points = CONTENSOU_FULL_TESTS ? 100'000 : 10'000;

/// Error that the library promises: of the closed form, and, if r is above PadeCurve::max_r, of quadrature.
constexpr double promised_ulp = 4;
constexpr double promised_beyond = 8;

/// The worst and the mean error of stop times over random starts.
class Sample {
 public:
  explicit Sample(std::string name) : name_(std::move(name)) {}

  void add(const ReducedSystem& system, State start) { add(system, start, Flow(system).stop_time(start).tau); }

  void add(const ReducedSystem& system, State start, double tau) {
    const double error = certify_stop_time(system, start, tau);
    sum_ += error;
    ++count_;
    if (error < worst_) return;
    worst_ = error;
    where_ = fmt::format("mu = {}, u0 = {}, v0 = {}", system.mu(), start.u, start.v);
  }

  /// Prints the result and checks it.
  void judge(double promised = promised_ulp) const {
    WARN(fmt::format("{}: {} starts, worst {:.2f} ulp, mean {:.2f} ulp; worst at {}", name_, count_, worst_,
                     sum_ / count_, where_));
    CHECK(worst_ <= promised);
  }

 private:
  std::string name_;
  double worst_ = 0;
  double sum_ = 0;
  int count_ = 0;
  std::string where_;
};

class Random {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double log_uniform(double low, double high) { return low * std::exp(uniform(0, std::log(high) - std::log(low))); }

 private:
  std::mt19937_64 engine_{20'240'817};
};

}  // namespace

TEST_CASE("random stop times of the Pade ball against their enclosures", "[certify]") {
  Random random;
  Sample ordinary("mu in [1e-10, 1], k0 in [1e-8, 1e8]"), wide("mu in [1, 3], k0 in [1e-4, 1e4]"),
      critical("mu^2 within 1e-3 of 14/5 and 7, k0 in [1e-3, 1e3]");
  const auto add = [&](Sample& sample, double mu, double k0) {
    const double u0 = random.uniform(-2, 2);
    sample.add(ReducedSystem(PadeLaw{}, mu, homogeneous_ball), {u0, mu * std::abs(u0) * k0});
  };
  for (int i = 0; i < points; ++i) add(ordinary, random.log_uniform(1e-10, 1), random.log_uniform(1e-8, 1e8));
  for (int i = 0; i < points / 4; ++i) add(wide, random.uniform(1, 3), random.log_uniform(1e-4, 1e4));
  for (int i = 0; i < points / 20; ++i) {
    const double distance = random.log_uniform(1e-16, 1e-3) * (i % 2 == 0 ? 1 : -1);
    add(critical, std::sqrt((i % 4 < 2 ? 2.8 : 7.0) * (1 + distance)), random.log_uniform(1e-3, 1e3));
  }
  // Cases with mu = 1, r = gamma/chi, are r = 2, r = 5, and r = 3 with starts on both sides of the ray.
  Sample bodies("chi, gamma of other bodies");
  for (const Inertia body : {Inertia{1, 2}, Inertia{1, 5}, Inertia{1, 1}, Inertia{2.5, 1.5}, Inertia{1, 3},
                             Inertia{1, 40}, Inertia{3, 1e-9}}) {
    for (double k0 = 1e-6; k0 < 1e6; k0 *= 1.3) bodies.add(ReducedSystem(PadeLaw{}, 1, body), {1, k0});
  }
  ordinary.judge();
  for (const Sample& sample : {wide, critical, bodies}) sample.judge(promised_beyond);
}

TEST_CASE("m of the Pade law at random r and k against its enclosure", "[certify]") {
  Random random;
  double worst = 0, worst_r = 0, worst_k = 0;
  for (int i = 0; i < points / 2; ++i) {
    const double r = random.log_uniform(1e-12, PadeCurve::max_r), ln_k = random.uniform(-27, 27);
    const double error = certify_sliding_share(r, std::exp(ln_k), PadeCurve(r).sliding_coefficient(ln_k));
    if (error > worst) std::tie(worst, worst_r, worst_k) = std::tie(error, r, ln_k);
  }
  WARN(fmt::format("m for r in [1e-12, {}], k in [2e-12, 5e11]: {} pairs, worst {:.2f} ulp at r = {}, ln k = {}",
                   PadeCurve::max_r, points / 2, worst, worst_r, worst_k));
  CHECK(worst <= promised_ulp);
  CHECK(certify_sliding_share(1.67, 7e8, 1.00000000217824487593) <= 0.5);
  CHECK(certify_sliding_share(1.67, 7e8, 1 + 2.1782e-9) > 100);
}

TEST_CASE("stop times keep the accuracy they state up to mu = 1e6", "[certify]") {
  Random random;
  double worst = 0;
  std::string where;
  for (int i = 0; i < points / 4; ++i) {
    const double mu = random.log_uniform(i % 2 == 0 ? 1e-10 : 1, 1e6);
    // The sliding coefficient m matters to the stop time only if k is at least of the size of 1/r.
    const double k0 = random.log_uniform(1e-3, 1e3) / (i % 3 == 0 ? 1 : std::max(1.0, mu * mu));
    const ReducedSystem system(PadeLaw{}, mu, homogeneous_ball);
    const State start{1, mu * k0};
    const StopTime stop = Flow(system).stop_time(start);
    const double ulp = std::nextafter(stop.tau, infinity) - stop.tau;
    const double share = certify_stop_time(system, start, stop.tau) * ulp / (stop.accuracy * stop.tau);
    if (share <= worst) continue;
    worst = share;
    where = fmt::format("mu = {}, v0 = {}", mu, start.v);
  }
  WARN(fmt::format("mu in [1e-10, 1e6]: {} starts, worst {:.2f} of the accuracy stated, at {}", points / 4, worst,
                   where));
  CHECK(worst <= 1);
}

TEST_CASE("random stop times of tables against their enclosures", "[certify]") {
  Random random;
  Sample tables("tables, mu in [1e-10, 1], k0 in [1e-8, 1e8]"), wide("tables, mu in [1, 3], k0 in [1e-4, 1e4]");
  constexpr int starts = 500;
  const auto add = [&](Sample& sample, double mu, double largest_k0) {
    const ReducedSystem system(PadeLaw{}, mu, homogeneous_ball);
    std::vector<double> u0, v0;
    for (int i = 0; i < starts; ++i) {
      u0.push_back(random.uniform(-2, 2));
      v0.push_back(mu * std::abs(u0.back()) * random.log_uniform(1 / largest_k0, largest_k0));
    }
    std::vector<double> tau(u0.size());
    StopTimeTable(system).evaluate(u0, v0, tau);
    for (std::size_t i = 0; i < tau.size(); ++i) sample.add(system, {u0[i], v0[i]}, tau[i]);
  };
  for (int i = 0; i < points / starts; ++i) add(tables, random.log_uniform(1e-10, 1), 1e8);
  for (int i = 0; i < points / starts / 4; ++i) add(wide, random.uniform(1, 3), 1e4);
  tables.judge();
  wide.judge(promised_beyond);
}

TEST_CASE("stop times at the ends of the double range against their enclosures", "[certify]") {
  Random random;
  Sample ends("speeds from 5e-324 to 1.8e308");
  for (int i = 0; i < points / 20; ++i) {
    const auto speed = [&] {
      return std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.uniform(-1074, 1023)));
    };
    ends.add(ReducedSystem(PadeLaw{}, random.log_uniform(1e-10, 3), homogeneous_ball), {speed(), speed()});
  }
  for (double mu : {1e-10, 0.1, 1.0, 1.7, 2.5, 2.8}) {
    for (double fraction = 0.999999; fraction < 1.000001; fraction += 1e-7) {
      // v is negligible, so the stop time is its pivoting part P, just below or above the largest double.
      const double u = std::min(largest / 3.2 * mu * fraction, largest);
      ends.add(ReducedSystem(PadeLaw{}, mu, homogeneous_ball), {u, u * (mu * 1e-9)});
      ends.add(ReducedSystem(PadeLaw{}, mu, homogeneous_ball), {std::ldexp(random.uniform(0.5, 1), -1060), 5e-324});
    }
  }
  ends.judge(promised_beyond);
}

TEST_CASE("the exact law at random k against its enclosure", "[certify]") {
  Random random;
  double worst_force = 0, worst_moment = 0, sum_force = 0, sum_moment = 0;
  for (int i = 0; i < points; ++i) {
    // Half of the starts lie around k = 1, at which other formulas of the law begin.
    const double k = i % 2 == 0 ? random.log_uniform(1e-10, 1e10) : random.log_uniform(0.5, 2);
    const auto [force, moment] = certify_hertz_law(k, HertzLaw{}({k, 1}));
    worst_force = std::max(worst_force, force);
    worst_moment = std::max(worst_moment, moment);
    sum_force += force;
    sum_moment += moment;
  }
  WARN(fmt::format("exact law: {} ratios, Phi worst {:.2f} ulp, mean {:.2f} ulp; Psi worst {:.2f} ulp, mean {:.2f} ulp",
                   points, worst_force, sum_force / points, worst_moment, sum_moment / points));
  CHECK(worst_force <= promised_ulp);
  CHECK(worst_moment <= promised_ulp);
  CHECK(certify_hertz_law(2, {HertzLaw{}({2, 1}).force * (1 + 1e-12), 1}).force_ulp > 1000);
}

TEST_CASE("the enclosures hold the table", "[certify][table]") {
  for (const ReferenceRow& row : reference_table("stop_pade")) {
    const ReducedSystem system(PadeLaw{}, row.input("mu"));
    const State start{row.input("u0"), row.input("v0")};
    const long double wanted = row.result("tau_stop");
    const auto rounded = static_cast<double>(wanted);
    CAPTURE(row.where());
    CHECK(certify_stop_time(system, start, rounded) <= 0.501);
    if (!std::isnormal(rounded)) continue;
    CHECK(certify_stop_time(system, start, rounded, static_cast<double>(wanted - rounded)) <= 0.005);
    CHECK(certify_stop_time(system, start, rounded * (1 + 1e-12)) > 2000);
  }
}

TEST_CASE("infinity, rest and the axes are certified, and what has no closed form is refused", "[certify][limit]") {
  const ReducedSystem system(PadeLaw{}, 0.1);
  CHECK(certify_stop_time(system, {largest, 1}, infinity) == 0);
  CHECK(certify_stop_time(system, {1e300, 1}, infinity) > 1e6);
  CHECK(certify_stop_time(system, {largest, 1}, largest) > 1e6);
  CHECK(certify_stop_time(system, {0, 0}, 0) == 0);
  CHECK(certify_stop_time(system, {0, 7}, Flow(system).stop_time({0, 7}).tau) <= 1);
  CHECK(certify_stop_time(system, {1, 0}, Flow(system).stop_time({1, 0}).tau) <= 1);
  CHECK_THROWS_AS(certify_stop_time(system, {1, -1}, 1), std::domain_error);
  CHECK_THROWS_WITH(certify_stop_time(ReducedSystem(HertzLaw{}, 0.1), {1, 1}, 1), Catch::Matchers::Contains("exact"));
  CHECK_THROWS_AS(certify_stop_time(ReducedSystem(Impostor{}, 0.1), {1, 1}, 1), std::domain_error);
  CHECK_THROWS_AS(certify_hertz_law(0, {0, 1}), std::domain_error);
}
