#include "contensou/reduction/detail/stop_times_of_mu.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("stop times of any mu, against 40 digits", "[stop_times_of_mu][table]") {
  const StopTimesOfMu stop_time(*find_law("exact"), homogeneous_ball);
  WorstCase cases("tau*");
  std::size_t alone = 0, rows = 0;
  for (const ReferenceRow& row : reference_table("stop_hertz")) {
    const double mu = row.input("mu");
    const State start{row.input("u0"), row.input("v0")};
    cases.add(row.result("tau_stop"), stop_time(mu, start), row.where());
    const auto moderate = [](double speed) { return speed == 0 || (speed > 1e-80 && speed < 1e80); };
    if (mu > 1 || !moderate(std::abs(start.u)) || !moderate(start.v)) continue;
    ++rows;
    alone += stop_time.solves_alone(mu, start, false) ? 1 : 0;
  }
  CHECK_WITHIN_EPS(cases, 6);
  CHECK(rows > 90);
  CHECK(alone == 0);
}

namespace {

/// Starts, each with its own mu from 1e-3 (small_mu: some from 1e-9) to 1. k is from 1e-10 to 1e10, or 0.1 to 10.
struct Rows {
  struct Row {
    double mu;
    State start;
  };

  explicit Rows(unsigned seed, bool with_small_mu = false) : generator(seed), small_mu(with_small_mu) {}

  Row next() {
    const double kind = share(generator), where = 2 * share(generator) - 1;
    const double mu = std::pow(10, (small_mu && kind < 0.2 ? -9 : -3) * share(generator));
    const double k = std::pow(10, (kind < 0.6 ? 10 : 1) * where);
    return {mu, {-1.3, 1.3 * mu * k}};
  }

  std::mt19937_64 generator;
  std::uniform_real_distribution<double> share{0, 1};
  bool small_mu;
};

std::vector<Law> laws_and_tables() {
  std::vector<Law> laws = CONTENSOU_FULL_TESTS ? named_laws() : paper_laws();
  laws.push_back(*find_law("annulus:0.65"));
  return laws;
}

}  // namespace

TEST_CASE("stop times of any mu are those of its flow", "[stop_times_of_mu][route]") {
  for (const Law& law : laws_and_tables()) {
    for (const Inertia body : {homogeneous_ball, Inertia{.chi = 1, .gamma = 2}}) {
      const StopTimesOfMu stop_time(law, body);
      WorstCase cases(fmt::format("{}, chi = {}", law.name(), body.chi));
      Rows rows(7, true);
      int alone = 0;
      for (int i = 0; i < 60; ++i) {
        const auto [mu, start] = rows.next();
        cases.add(Flow({law, mu, body}).stop_time(start).tau, stop_time(mu, start),
                  fmt::format("mu = {}, v0 = {}", mu, start.v));
        const bool within = body.gamma * mu * mu / body.chi <= StopTimesOfMu::max_r;
        alone += within && stop_time.solves_alone(mu, start, false) ? 1 : 0;
      }
      CHECK_WITHIN_EPS(cases, 8);
      CAPTURE(law.name(), body.chi);
      CHECK(alone <= 1);
    }
  }
}

TEST_CASE("with a drive stop times of any mu are those of its flow", "[stop_times_of_mu][drive]") {
  for (const Law& law : laws_and_tables()) {
    for (double drive : {1e-3, 0.1, 0.6, 0.95}) {
      const StopTimesOfMu stop_time(law, homogeneous_ball, drive);
      WorstCase cases(fmt::format("{}, drive = {}", law.name(), drive));
      Rows rows(8);
      int alone = 0;
      constexpr int count = CONTENSOU_FULL_TESTS ? 20 : 5;
      for (int i = 0; i < count; ++i) {
        auto [mu, start] = rows.next();
        if (i == 0) start.v = 0;
        cases.add(Flow({law, mu, homogeneous_ball, drive}).stop_time(start).tau, stop_time(mu, start),
                  fmt::format("mu = {}, v0 = {}", mu, start.v));
        alone += stop_time.solves_alone(mu, start, false) ? 1 : 0;
      }
      CHECK_WITHIN_EPS(cases, 10 / (1 - drive));
      CAPTURE(law.name(), drive);
      CHECK(alone <= 1);
    }
  }
}

TEST_CASE("gradients of any mu are those of its flow", "[stop_times_of_mu][gradient]") {
  for (const Law& law : laws_and_tables()) {
    for (double drive : {0.0, 0.1}) {
      const StopTimesOfMu stop_time(law, homogeneous_ball, drive);
      // A drive needs slopes by differences, which have fewer digits.
      const double allowed = (law.as<HertzLaw>() || law.as<PadeLaw>() ? 1e-13 : drive > 0 ? 1e-8 : 1e-13);
      Rows rows(9);
      double worst = 0, worst_of_u = 0;
      std::string where;
      int alone = 0;
      constexpr int count = CONTENSOU_FULL_TESTS ? 12 : 4;
      for (int i = 0; i < count; ++i) {
        const auto [mu, start] = rows.next();
        const StopTimeGradient wanted = Flow({law, mu, homogeneous_ball, drive}).stop_time_gradient(start);
        const StopTimeGradient found = stop_time.gradient(mu, start);
        CHECK(found.tau == stop_time(mu, start));
        const double tau = wanted.tau;
        for (const double error :
             {start.u * (found.by_u - wanted.by_u), start.v * (found.by_v - wanted.by_v),
              mu * (found.by_mu - wanted.by_mu), homogeneous_ball.chi * (found.by_chi - wanted.by_chi),
              homogeneous_ball.gamma * (found.by_gamma - wanted.by_gamma),
              (found.by_drive - wanted.by_drive) * std::min(1.0, tau / std::abs(wanted.by_drive))}) {
          if (!(std::abs(error) / tau <= worst)) {
            worst = std::abs(error) / tau;
            where = fmt::format("mu = {}, v0 = {}", mu, start.v);
          }
        }
        worst_of_u = std::max(worst_of_u, std::abs(found.by_u / wanted.by_u - 1));
        alone += mu < 0.75 && stop_time.solves_alone(mu, start, true) ? 1 : 0;  // for mu > 0.837 the ring has a ray
      }
      CAPTURE(law.name(), drive, where);
      CHECK(worst <= allowed);
      CHECK(worst_of_u <= 1e-8);
      CHECK(alone <= 1);
    }
  }
}

TEST_CASE("neither other starts nor their order change a stop time of any mu", "[stop_times_of_mu][invariant]") {
  for (double drive : {0.0, 0.2}) {
    const StopTimesOfMu one(*find_law("punch"), homogeneous_ball, drive),
        other(*find_law("punch"), homogeneous_ball, drive);
    const std::vector<double> mus{0.001, 0.03, 0.1, 0.5, 0.8, 0.95};
    std::vector<double> found, reversed(mus.size());
    for (double mu : mus) found.push_back(one(mu, {1, 0.1}));
    for (std::size_t i = mus.size(); i-- > 0;) reversed[i] = other(mus[i], {1, 0.1});
    CHECK(found == reversed);
  }
}

TEST_CASE("on its axes a body of any mu is not solved", "[stop_times_of_mu][limit]") {
  for (double drive : {0.0, 0.2}) {
    const Law law = *find_law("uniform");
    const StopTimesOfMu stop_time(law, homogeneous_ball, drive);
    const Flow flow({law, 0.2, homogeneous_ball, drive});
    for (const State start : {State{0, 2}, State{-3, 0}}) {
      CAPTURE(drive, start.u, start.v);
      CHECK(!stop_time.solves_alone(0.2, start, false));
      CHECK(!stop_time.solves_alone(0.2, start, true));
      CHECK(stop_time(0.2, start) == Approx(flow.stop_time(start).tau).epsilon(2e-15));
      const StopTimeGradient found = stop_time.gradient(0.2, start), wanted = flow.stop_time_gradient(start);
      CHECK(found.by_u == Approx(wanted.by_u).epsilon(1e-12));
      CHECK(found.by_v == Approx(wanted.by_v).epsilon(1e-12));
      CHECK(found.by_mu == Approx(wanted.by_mu).epsilon(1e-12));
    }
    CHECK(stop_time.solves_alone(1.1, {1, 1}, false));
    CHECK_THROWS_AS(stop_time.gradient(0.2, {0, 0}), std::domain_error);
    CHECK_THROWS_AS(stop_time.gradient(-1, {1, 0}), std::domain_error);
    CHECK_THROWS_AS(stop_time(0.2, {0, -1}), std::domain_error);
  }
  CHECK_THROWS_AS(StopTimesOfMu(*find_law("exact"), homogeneous_ball, 1), std::domain_error);
}

TEST_CASE("what no table answers is computed by a flow, and no number is refused", "[stop_times_of_mu][limit]") {
  const Law law = *find_law("exact");
  const StopTimesOfMu stop_time(law, homogeneous_ball);
  for (double mu : {1e-300, 0.3, 1.0, 1.01, 5.0}) {
    for (const State start : {State{0, 0}, State{1, 0}, State{0, 1}, State{1e300, 1e-300}, State{5e-324, 1},
                              State{1e-310, 1e-310}, State{1e308, 1e308}}) {
      CAPTURE(mu, start.u, start.v);
      CHECK(stop_time(mu, start) == Approx(Flow({law, mu, homogeneous_ball}).stop_time(start).tau).epsilon(2e-15));
    }
  }
  for (double bad : {0.0, -0.1, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(stop_time(bad, {1, 1}), std::domain_error);
  }
  CHECK_THROWS_AS(stop_time(0.1, {1, -1}), std::domain_error);
  CHECK_THROWS_AS(stop_time(0.1, {infinity, 1}), std::domain_error);
  CHECK_THROWS_AS(StopTimesOfMu(law, {.chi = -1, .gamma = 1}), std::domain_error);
}

TEST_CASE("stop times of any mu scale bit for bit", "[stop_times_of_mu][symmetry]") {
  const StopTimesOfMu stop_time(*find_law("exact"), homogeneous_ball);
  for (int power : {-200, -1, 3, 200}) {
    CHECK(stop_time(0.1, {std::ldexp(-1.1, power), std::ldexp(0.3, power)}) ==
          std::ldexp(stop_time(0.1, {1.1, 0.3}), power));
  }
}
