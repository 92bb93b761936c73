// A constant drive: (R20), (R25) to (R28) of reduction/theory.md.
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/verification.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;

namespace {

/// Returns a system with exactly this r in scaled units: mu = chi = 1, so that w is |u|.
ReducedSystem scaled(const Law& law, double r, double drive) { return {law, 1, {.chi = 1, .gamma = r}, drive}; }

/// Returns the scaled stop time.
double stop(const Flow& flow, double w, double v) {
  return flow.stop_time({w, v}).tau * flow.system().scaled_time_rate();
}

double ray_of(const Law& law, double r, double drive) {
  const TerminalRatios ratios = terminal_ratios(law, r, drive);
  REQUIRE(ratios.rays.size() == 1);
  CHECK(ratios.rays[0].attracts());
  CHECK(ratios.ends.size() == 1);
  return ratios.rays[0].k;
}

/// Integrates (R20) for v and w by the classical Runge-Kutta method. Only the law is taken from the library.
struct Stepped {
  double w, v, slip, angle;
};
Stepped stepped(const Law& law, double r, double drive, double w, double v, double s, int steps) {
  using Values = std::array<double, 4>;
  const auto rate = [&](const Values& x) -> Values {
    const auto [force, moment] = law(Slip{x[1], x[0]});
    return {-r * moment, drive - force, x[1], x[0]};
  };
  const auto moved = [](const Values& x, const Values& by, double h) {
    Values result = x;
    for (std::size_t i = 0; i < x.size(); ++i) result[i] += h * by[i];
    return result;
  };
  Values x{w, v, 0, 0};
  const double h = s / steps;
  for (int i = 0; i < steps; ++i) {
    const Values a = rate(x), b = rate(moved(x, a, h / 2)), c = rate(moved(x, b, h / 2)), d = rate(moved(x, c, h));
    for (std::size_t j = 0; j < x.size(); ++j) x[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
  }
  return {x[0], x[1], x[2], x[3]};
}

}  // namespace

TEST_CASE("what is no drive is refused, and why", "[drive][errors]") {
  CHECK_THROWS_WITH(scaled(HertzLaw{}, 0.1, 1), Contains("never stop"));
  CHECK_THROWS_WITH(scaled(HertzLaw{}, 0.1, -0.1), Contains("turn it round"));
  for (double bad : {1e-101, 2.0, std::nan("")}) CHECK_THROWS_AS(scaled(HertzLaw{}, 0.1, bad), std::domain_error);
  CHECK_NOTHROW(scaled(HertzLaw{}, 0.1, std::nextafter(1.0, 0.0)));
}

TEST_CASE("the ray of creeping: closed for Pade and the ellipse, third order for the exact law", "[drive][formula]") {
  for (double r : {0.007, 0.5, 1.9, 2.0, 2.6, 4.0}) {
    for (double drive : {1e-90, 1e-12, 0.01, 0.15}) {
      INFO("r = " << r << ", drive = " << drive);
      if (r == 2.0 && drive < 1e-12) continue;  // the drive is so small that rounding hides the ray
      const double a = 5 - 5 * drive - r, b = 2 - 7 * drive - r;
      const double root = std::sqrt(b * b + 8 * drive * a);
      const double z = b > 0 ? 4 * drive / (b + root) : (root - b) / (2 * a);
      CHECK(ray_of(PadeLaw{}, r, drive) == Approx(8 * z / (3 * std::numbers::pi)).epsilon(r == 2.0 ? 1e-9 : 1e-12));
    }
  }
  const EllipticLaw ellipse(0.7);
  for (double drive : {1e-9, 0.1, 0.5}) {
    const double left = 1 - 0.6 * 0.7 * 0.7;
    const double k = drive * 0.7 / std::sqrt(left * left - drive * drive);
    CHECK(ray_of(ellipse, 0.6, drive) == Approx(k).epsilon(1e-13));
    CHECK(terminal_ratios(ellipse, (1 - drive) / 0.49 * 1.001, drive).ends.at(0).regime == TerminalRegime::infinity);
  }
  const Law exact = HertzLaw{};
  for (double r : {0.007, 0.5, 1.2}) {
    const double delta = exact.force_slope() - r * exact.pivoting_moment();
    double last = 0;
    for (double drive : {0.08, 0.04, 0.02}) {
      const double third = 3 * std::numbers::pi / 32 * (1 - 2 * r) * std::pow(drive, 3) / std::pow(delta, 4);
      const double error = std::abs(ray_of(exact, r, drive) - drive / delta - third);
      if (last > 0) CHECK(error < last / 25);  // the next term is of order 5
      last = error;
    }
  }
  CHECK(ray_of(exact, 5e-3 / 0.7, 0.05) == Approx(0.04261).epsilon(1e-3));
}

TEST_CASE("one ray below 1 - r K, and none from there on", "[drive][limit]") {
  for (const std::string name : {"exact", "pade", "uniform", "punch", "ring", "paraboloid", "elliptic"}) {
    const Law law = *find_law(name);
    for (double r : {1e-6, 0.3, 1.0, 1.7}) {
      const double border = 1 - r / terminal_ratios(law, r).high;
      if (!(border > 0)) continue;
      for (double below : {1e-6, 0.5, 0.999}) {
        const TerminalRatios ratios = terminal_ratios(law, r, border * below);
        INFO(name << ", r = " << r << ", drive = " << border * below);
        CHECK(ratios.rays.size() == 1);
        CHECK(ratios.ends.size() == 1);
      }
      if (border < 0.999) {
        CHECK(terminal_ratios(law, r, border + 1e-3).ends.at(0).regime == TerminalRegime::infinity);
      }
    }
  }
}

TEST_CASE("closed stop times with a drive", "[drive][formula]") {
  // Cases: no spin; a start on the ray; every start under the elliptic law with r C^2 = 1 (R28).
  for (double drive : {1e-60, 1e-6, 0.05, 0.5, 0.9, 0.999999}) {
    INFO("drive = " << drive);
    for (const Law& law : paper_laws()) {
      const Flow flow(scaled(law, 0.4, drive));
      CHECK(stop(flow, 0, 3) == Approx(3 / (1 - drive)).epsilon(1e-15));
      const Orbit sliding = flow.orbit({0, 3});
      const double tau = sliding.stop_time();
      CHECK(sliding.slip_length(tau) * flow.system().scaled_time_rate() == Approx(4.5 / (1 - drive)).epsilon(1e-14));
      CHECK(sliding.at_time(tau / 4).v == Approx(2.25).epsilon(1e-14));
      if (!flow.terminal().rays.empty()) {
        const double k = flow.terminal().rays[0].k;
        CHECK(stop(flow, 2, 2 * k) == Approx(2 / (0.4 * law({k, 1}).moment)).epsilon(1e-13));
      }
    }
    const double C = 0.7;
    const Flow flow(scaled(EllipticLaw(C), 1 / (C * C), drive));
    CHECK(flow.terminal().ends.at(0).regime == TerminalRegime::infinity);
    for (double w : {1e-8, 0.3, 1.0, 1e6}) {
      for (double v : {0.0, 1e-9, 0.4, 1.0, 1e7}) {
        INFO("w = " << w << ", v = " << v);
        const double closed = (std::hypot(v, C * w) + drive * v) / ((1 - drive) * (1 + drive));
        CHECK(stop(flow, w, v) == Approx(closed).epsilon(drive > 0.99 ? 1e-12 : 1e-14));
      }
    }
  }
}

TEST_CASE("a driven motion against Runge-Kutta: speeds, slip and angle", "[drive][orbit]") {
  struct Case {
    std::string law;
    double r, drive, w, v;
  };
  // Cases: k tends to a small ray from above, from below, from rest; to a ray at larger k; to infinity, also from rest.
  const std::vector<Case> cases{
      {"exact", 0.007, 0.05, 1, 3},    {"exact", 0.6, 0.3, 1, 2},   {"exact", 0.6, 0.3, 1, 0},
      {"exact", 1.5, 0.2, 1, 0.01},    {"pade", 0.6, 0.3, 1, 0},    {"pade", 3, 0.1, 1, 0.2},
      {"uniform", 0.5, 0.5, 1, 0},     {"exact", 2.6, 0.2, 1, 0.1}, {"exact", 0.6, 0.95, 1, 0},
      {"exact", 0.6, 0.95, 1, 0.5},    {"ring", 0.3, 0.7, 1, 0},    {"exact", 6, 0.2, 1, 0.3},
      {"elliptic:0.5", 2, 0.3, 1, 0.2}};
  for (const auto& [name, r, drive, w, v] : cases) {
    INFO(name << ", r = " << r << ", drive = " << drive << ", w = " << w << ", v = " << v);
    const Law law = *find_law(name);
    const Flow flow(scaled(law, r, drive));
    const Orbit orbit = flow.orbit({w, v});
    const double rate = flow.system().scaled_time_rate();
    const double end = orbit.stop_time() * rate;
    for (double part : {0.1, 0.6, 0.95}) {
      const Stepped truth = stepped(law, r, drive, w, v, part * end, 40'000);
      const Orbit::Instant at = orbit.instant(part * orbit.stop_time());
      INFO("at " << part << " of the stop time");
      CHECK(at.u == Approx(truth.w).epsilon(1e-9));
      CHECK(at.v == Approx(truth.v).epsilon(1e-9));
      CHECK(at.slip_length * rate == Approx(truth.slip).epsilon(1e-9));
      CHECK(at.turned * rate == Approx(truth.angle).epsilon(1e-9));
      CHECK(stop(flow, truth.w, truth.v) == Approx((1 - part) * end).epsilon(1e-8));
    }
    // Compare with the steppers of the library. The comparison includes beta.
    for (const auto integrate : {integrate_directly, integrate_regularised}) {
      const Eigen::ArrayXd times = Eigen::Array2d(0.2, 0.7) * orbit.stop_time();
      const Motion motion = integrate(flow.system(), {w, v}, times, {});
      REQUIRE(motion.outcome.ok());
      CHECK(motion.stop_time == Approx(orbit.stop_time()).epsilon(1e-10));
      for (Eigen::Index i = 0; i < 2; ++i) {
        const OrbitPoint here = orbit.at_time(times[i]);
        CHECK(here.u == Approx(motion.points.u[i]).epsilon(1e-9));
        CHECK(here.v == Approx(motion.points.v[i]).epsilon(1e-9));
        CHECK(here.beta == Approx(motion.points.beta[i]).epsilon(1e-8));
      }
    }
  }
}

TEST_CASE("the sliding speed of a driven body may grow before it falls", "[drive][orbit]") {
  const Flow flow(scaled(HertzLaw{}, 0.6, 0.3));
  const Orbit creeping = flow.orbit({1, 0});
  CHECK(creeping.at_time(0).v == 0);
  CHECK(creeping.at_time(0).k == 0);
  CHECK_FALSE(creeping.on_axis());
  for (double v : {0.01, 0.1, 0.15}) {
    const double tau = creeping.time_of_v(v);
    INFO("v = " << v);
    CHECK(tau > 0);
    CHECK(creeping.at_time(tau).v == Approx(v).epsilon(1e-10));
    CHECK(creeping.at_time(tau + 1e-3 * creeping.stop_time()).v < v);
  }
  CHECK(creeping.time_of_v(10) == 0);
  CHECK(creeping.time_of_v(0) == creeping.stop_time());
}

TEST_CASE("as the drive vanishes, the answer without it", "[drive][limit]") {
  for (const Law& law : paper_laws()) {
    for (double r : {0.007, 1.0, 3.0, 6.0}) {
      const Flow free(scaled(law, r, 0));
      for (double v : {0.01, 1.0, 20.0}) {
        double last = 0;
        for (double drive : {1e-3, 1e-4, 1e-5, 1e-14, 1e-80}) {
          const double change = stop(Flow(scaled(law, r, drive)), 1, v) / stop(free, 1, v) - 1;
          INFO(law.name() << ", r = " << r << ", v = " << v << ", drive = " << drive);
          CHECK(change > -1e-14);
          CHECK(change < 40 * drive + 1e-14);
          if (last > 1e-9) CHECK(change < last / 5);
          last = change;
        }
      }
    }
  }
}

TEST_CASE("the bounds enclose a driven stop, and are met", "[drive][bounds]") {
  for (const Law& law : paper_laws()) {
    for (double drive : {0.01, 0.3, 0.8}) {
      const Flow flow(scaled(law, 0.3, drive));
      for (double v : {0.0, 0.1, 1.0, 10.0}) {
        const StopTime stop = flow.stop_time({1, v});
        INFO(law.name() << ", drive = " << drive << ", v = " << v);
        CHECK(stop.bounds.lower <= stop.tau);
        CHECK(stop.tau <= stop.bounds.upper);
      }
      const StopTime sliding = flow.stop_time({0, 1});
      CHECK(sliding.bounds.lower == Approx(sliding.tau));
      const bool pade = law.name() == "pade";
      CHECK(std::isinf(sliding.bounds.upper) == (pade && drive > 0.4));
    }
  }
}

TEST_CASE("every statement holds with a drive", "[drive][verification]") {
  for (const Law& law : paper_laws()) {
    for (double drive : {0.05, 0.6, 0.97}) {
      const Flow flow({law, 0.3, homogeneous_ball, drive});
      for (const Check& check : verify(flow, {{1, 1}, {-1, 1e-3}, {1, 30}, {0, 1}, {1, 0}})) {
        INFO(law.name() << ", drive " << drive << ": " << check.name << " " << check.measured);
        CHECK(check.passed());
      }
    }
  }
}

// References by 128-bit arithmetic (Runge-Kutta-Fehlberg 7(8) from the ray's tangent). For small r, k follows the ray.
TEST_CASE("stop times of motions that ride the ray have the accuracy that they state", "[drive][reference]") {
  struct Row {
    double moment;  ///< C of the elliptic law; 0: the Pade law
    double mu;
    Inertia inertia;
    double drive, v, tau;
  };
  const std::vector<Row> rows{
      {0.9, 0.07662523492755605, {2.5, 1.5}, 0.44720678712703743, 5.310780907806737e-05, 50.94132786441093193775},
      {0.21236988759051478,
       0.26948796382739509,
       {3.5682597992964609, 2.6774788145486976},
       0.47166116601674679,
       0.03080119213408369,
       34.9003875432191337497112},
      {0.8117907773821883,
       0.041054602867559686,
       {1.8992063237994787, 1.9699274377411933},
       0.48929677143458833,
       0.018466815375915879,
       82.3314283570658519763937},
      {0,
       0.053519743104989637,
       {2.445768914677509, 2.634322262738634},
       0.73585291919365092,
       0.12066225414868283,
       452.965207938579587041681},
      {0,
       0.082403310998366591,
       {1.5238745007511452, 1.400841623466611},
       0.023212470289815545,
       0.0016786797019523085,
       73.4338641541609382668193},
      {0.86244734845527404,
       0.021389287923030985,
       {2.4539094018023295, 2.4513117869489007},
       0.92968747784383154,
       0.054054039643749975,
       283.629553873995595452992},
  };
  for (const Row& row : rows) {
    const Law law = row.moment > 0 ? Law(EllipticLaw(row.moment)) : Law(PadeLaw{});
    INFO(law.name() << ", mu " << row.mu << ", drive " << row.drive);
    const auto stop = Flow::by_quadrature({law, row.mu, row.inertia, row.drive}).stop_time({1, row.v});
    CHECK(stop.accuracy < 3e-14);
    CHECK(std::abs(stop.tau / row.tau - 1) <= stop.accuracy);
  }
}

// References for k* with 60 digits, from 1 - drive = r k Psi + (1 - Phi), with the doubles below taken as exact.
TEST_CASE("a ray beside its birth at infinity has the digits that it states", "[drive][reference]") {
  struct Row {
    const char* law;
    double r, drive, k;
  };
  for (const auto& [name, r, drive, k] : {
           Row{"exact", 0.004999999444047623, 0.999, 29999.999989770634},
           {"exact", 2.4999999648063226e-08, 0.999999995, 50000000.081316432},
           {"exact", 4.9998768913993925e-12, 0.999999999999, 200000000.00050604},
           {"exact", 1.499999999939286, 0.7, 99999.969740405111},
           {"uniform", 0.003999999444074078, 0.999, 29999.99999995835},
           {"uniform", 1.999999967845058e-08, 0.999999995, 50000000.075364051},
           {"uniform", 3.999899013119514e-12, 0.999999999999, 200000000.00050128},
           {"paraboloid", 2.999999961767587e-08, 0.999999995, 49999999.67219042},
           {"ring", 9.99999973922529e-09, 0.999999995, 50000000.054530718},
           {"ring", 0.5999999999425001, 0.7, 99999.99586341649},
           {"elliptic", 1.4410123608222042e-08, 0.999999995, 50000000.01530441},
           {"elliptic", 0.8646074337129491, 0.7, 99999.923680632974},
           {"pade", 0.00485858792951745, 0.999, 30000.000000000084},
           {"pade", 1.4999626518561713, 0.7, 99999.999999820728},
       }) {
    CAPTURE(name, drive, k);
    const Law law = *find_law(name);
    const TerminalRatios ratios = terminal_ratios(law, r, drive);
    REQUIRE(ratios.rays.size() == 1);
    const double accuracy = ratios.rays[0].accuracy;
    CHECK(ratios.rays[0].attracts());
    CHECK(std::abs(ratios.rays[0].k / k - 1) <= accuracy);
    // Far out k Psi is about its limit K. The deficit 1 - Phi is then 1 - drive - r K, with rounding eps (1 - drive).
    CHECK(accuracy <= 16 * eps * (1 + (1 - drive) / law.force_deficit({k, 1})));
  }
}

TEST_CASE("a drive next to 1 leaves friction its digits, or the law is asked for them", "[drive][reference]") {
  // In quadruple precision, k* = 50101105.3 and tau = 408610279.52626.
  const Law uniform = *find_law("uniform");
  const State start{1, 0.01730412754774478};
  const ReducedSystem system(uniform, 0.0001875959958651888, {2.5, 1.5}, 0.9999999947211613);
  const Flow flow(system);
  CHECK(flow.terminal().end_of(1).k == Approx(50101105.3).epsilon(1e-7));
  const StopTime stop = flow.stop_time(start);
  CHECK(stop.tau == Approx(408610279.52626).epsilon(1e-13));
  CHECK(stop.accuracy < 1e-6);
  CHECK(integrate_directly(system, start, {}).stop_time == Approx(408610279.52626).epsilon(1e-11));
  // A law that is a single function gives 1 - Phi only with the absolute rounding error of Phi.
  const Law unstated([uniform](Slip slip) { return uniform(slip); });
  const auto beside = [&](double drive) { return ReducedSystem(unstated, system.mu(), system.inertia(), drive); };
  CHECK_THROWS_WITH(Flow(beside(system.drive())).stop_time(start), Contains("another drive"));
  CHECK(Flow(beside(0.99999999)).stop_time(start).tau ==
        Approx(Flow({uniform, system.mu(), system.inertia(), 0.99999999}).stop_time(start).tau).epsilon(1e-8));
}
