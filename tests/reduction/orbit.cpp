#include "contensou/reduction/orbit.hpp"

#include <cmath>
#include <future>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

namespace {

/// The promised accuracy of 1e-12, in units of eps.
constexpr double promised = 4503;

double beta_unit(double mu, State start) { return 1 / (16 * mu * std::abs(start.u) + 15 * pi * start.v); }

void check_trajectories(const std::string& table, const Law& law) {
  WorstCase u("u"), ln_v("ln v"), k("ln k"), beta("beta"), left("u at time left"), left_ln_v("ln v at time left");
  for (const ReferenceRow& row : reference_table(table)) {
    const double mu = row.input("mu");
    const State start{row.input("u0"), row.input("v0")};
    const Orbit orbit = Flow(ReducedSystem(law, mu)).orbit(start);
    const double tau = row.input("tau");
    const OrbitPoint point = orbit.at_time(tau);
    CHECK(point.tau == tau);
    u.add(row.result("u"), point.u, row.where());
    const long double ln_v_scale = 1 + std::abs(row.result("ln_v"));
    ln_v.add(row.result("ln_v"), point.ln_v, ln_v_scale, row.where());
    if (row.result("k") > 1e-290L) k.add(std::log(row.result("k")), std::log(point.k), ln_v_scale, row.where());
    beta.add(row.result("beta"), point.beta, row.result("beta") + beta_unit(mu, start), row.where());

    // The time left is taken from the table, which has more digits than the difference of two doubles.
    if (row.input("fraction") < 0.5) continue;
    const OrbitPoint from_stop =
        orbit.at_time_left(static_cast<double>(row.result("tau_stop") - static_cast<long double>(tau)));
    left.add(row.result("u"), from_stop.u, row.where());
    left_ln_v.add(row.result("ln_v"), from_stop.ln_v, ln_v_scale, row.where());
  }
  CHECK_WITHIN_EPS(u, promised);
  CHECK_WITHIN_EPS(ln_v, promised);
  CHECK_WITHIN_EPS(k, promised);
  CHECK_WITHIN_EPS(beta, 2 * promised);
  CHECK_WITHIN_EPS(left, promised);
  CHECK_WITHIN_EPS(left_ln_v, promised);
}

/// Returns the integral of a function of the state over time, between ln k = top and ln k = bottom. It is computed as
/// an integral of v d ln k/D along the orbit, with D of (R3).
template <class Function>
double integral_between(const ReducedSystem& system, const Orbit& orbit, double bottom, double top, Function function) {
  const auto rate = [&](double ln_k) {
    const double k = std::exp(ln_k);
    const auto [force, moment] = system.law()(slip_of_ratio(k));
    const OrbitPoint point = orbit.at_log_ratio(ln_k);
    return function(point) * point.v / std::abs(force - system.r() * k * moment) / system.scaled_time_rate();
  };
  double sum = 0;
  for (double left = bottom; left < top;) {
    const double right = std::min(std::floor(left + 1), top);  // panels must not contain the kink at k = 1
    sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(rate, left, right, 5, 1e-14);
    left = right;
  }
  return sum;
}

double slip_between(const ReducedSystem& system, const Orbit& orbit, double bottom, double top) {
  return integral_between(system, orbit, bottom, top, [](const OrbitPoint& point) { return point.v; });
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

TEST_CASE("the state at any fraction of the stop time", "[orbit][table]") {
  check_trajectories("trajectory_pade", PadeLaw{});
  check_trajectories("trajectory_hertz", HertzLaw{});
}

TEST_CASE("an orbit starts at its start and ends at rest", "[orbit][limit]") {
  for (const Law& law : paper_laws()) {
    for (const State start : {State{1, 0.1}, State{-3, 1e-9}, State{2e-5, 40}, State{-1e300, 1e290}}) {
      const Orbit orbit = Flow(ReducedSystem(law, 0.2)).orbit(start);
      CAPTURE(law.name(), start.u, start.v);
      const OrbitPoint first = orbit.at_time(0);
      CHECK(first.tau == 0);
      CHECK(first.u == start.u);
      CHECK(first.v == start.v);
      CHECK(first.ln_v == std::log(start.v));
      CHECK(first.beta == 0);
      CHECK(first.k == Approx(start.v / (0.2 * std::abs(start.u))).epsilon(1e-14));
      const double stop = orbit.stop_time();
      CHECK(orbit.at_time_left(stop).u == start.u);
      for (const OrbitPoint& last :
           {orbit.at_time(stop), orbit.at_time(2 * stop), orbit.at_time(infinity), orbit.at_time_left(0)}) {
        CHECK(last.u == 0);
        CHECK(last.v == 0);
        CHECK(last.ln_v == -infinity);
        CHECK(last.k == 0);
        CHECK(last.beta == infinity);
      }
      CHECK(orbit.at_time(2 * stop).tau == 2 * stop);
      CHECK(orbit.at_time_left(0).tau == stop);
    }
  }
}

TEST_CASE("along an orbit u, v and k fall and beta grows", "[orbit][invariant]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-4, 0.05, 1.0}) {
      for (double k0 : {1e-4, 1.0, 1e5}) {
        const Orbit orbit = Flow(ReducedSystem(law, mu)).orbit({-1, mu * k0});
        const OrbitColumns columns = orbit.sample(101);
        CAPTURE(law.name(), mu, k0);
        REQUIRE(columns.rows() == 101);
        CHECK(columns.tau[0] == 0);
        CHECK(columns.tau[100] == orbit.stop_time());
        CHECK(columns.u[100] == 0);
        for (Eigen::Index i = 1; i < 100; ++i) {
          CAPTURE(i);
          CHECK(columns.tau[i] > columns.tau[i - 1]);
          CHECK(std::abs(columns.u[i]) < std::abs(columns.u[i - 1]));
          CHECK(columns.u[i] < 0);
          CHECK(columns.ln_v[i] < columns.ln_v[i - 1]);
          CHECK(columns.k[i] <= columns.k[i - 1]);
          CHECK(columns.beta[i] > columns.beta[i - 1]);
        }
      }
    }
  }
}

TEST_CASE("scaling by powers of two and u -> -u hold bit for bit", "[orbit][symmetry]") {
  // Scaling by a power of two adds a multiple of ln 2 to ln v, which is rounded. All other digits stay equal.
  for (const Law& law : paper_laws()) {
    for (const State start : {State{1.1, 0.3}, State{-0.01, 2}, State{5, 1e-12}, State{0, 3}, State{-3, 0}}) {
      const ReducedSystem system(law, 0.05);
      const Orbit orbit = Flow(system).orbit(start), mirrored = Flow(system).orbit({-start.u, start.v});
      CHECK(mirrored.stop_time() == orbit.stop_time());
      for (int power : {-600, -300, -1, 1, 33, 900}) {
        const auto scale = [&](double x) { return std::ldexp(x, power); };
        const Orbit scaled = Flow(system).orbit({scale(start.u), scale(start.v)});
        CAPTURE(law.name(), start.u, start.v, power);
        CHECK(scaled.stop_time() == scale(orbit.stop_time()));
        CHECK(scaled.start_log_ratio() == orbit.start_log_ratio());
        for (double share : {0.0, 0.01, 0.4, 0.7, 0.99}) {
          const double tau = share * orbit.stop_time();
          const OrbitPoint here = orbit.at_time(tau);
          const OrbitPoint there = scaled.at_time(scale(tau));
          CAPTURE(share);
          CHECK(there.u == scale(here.u));
          if (std::isnormal(there.v) && std::isnormal(here.v)) CHECK(there.v == scale(here.v));
          CHECK(there.k == here.k);
          CHECK(there.beta == std::ldexp(here.beta, -power));
          if (std::abs(power) < 400)
            CHECK(scaled.slip_length(scale(tau)) == std::ldexp(orbit.slip_length(tau), 2 * power));
          const OrbitPoint left = mirrored.at_time(tau);
          CHECK((left.u == -here.u && left.v == here.v && left.ln_v == here.ln_v && left.beta == here.beta));
          if (std::isfinite(here.ln_v)) {
            const double moved = here.ln_v + power * std::numbers::ln2;
            CHECK(std::abs(there.ln_v - moved) <= 4e-16 * (std::abs(here.ln_v) + std::abs(power * std::numbers::ln2)));
          }
        }
      }
    }
  }
}

TEST_CASE("on the axes one speed falls linearly", "[orbit][limit]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.1);
    const Orbit sliding = Flow(system).orbit({0, 2});
    CHECK(sliding.stop_time() == Approx(6 * pi / 7).epsilon(1e-15));
    CHECK(sliding.start_log_ratio() == infinity);
    const Orbit pivoting = Flow(system).orbit({-2, 0});
    CHECK(pivoting.stop_time() == Approx(32 / 0.5).epsilon(1e-15));
    CHECK(pivoting.start_log_ratio() == -infinity);
    for (double share : {0.0, 0.25, 0.75}) {
      CAPTURE(law.name(), share);
      const double gone = share / (1 - share);
      for (const OrbitPoint& point :
           {sliding.at_time(share * sliding.stop_time()), sliding.at_time_left((1 - share) * sliding.stop_time())}) {
        CHECK(point.v == Approx(2 * (1 - share)).epsilon(1e-15));
        CHECK(point.ln_v == Approx(std::log(2 * (1 - share))).margin(1e-15));
        CHECK(point.u == 0);
        CHECK(point.k == infinity);
        CHECK(point.beta == Approx(sliding.stop_time() / (45 * pi * pi * 4) * gone).margin(1e-17).epsilon(1e-14));
      }
      for (const OrbitPoint& point : {pivoting.at_time(share * pivoting.stop_time()),
                                      pivoting.at_time_left((1 - share) * pivoting.stop_time())}) {
        CHECK(point.u == Approx(-2 * (1 - share)).epsilon(1e-15));
        CHECK(point.v == 0);
        CHECK(point.ln_v == -infinity);
        CHECK(point.k == 0);
        CHECK(point.beta == Approx(pivoting.stop_time() / (128 * 0.04) * gone).margin(1e-15).epsilon(1e-14));
      }
    }
    CHECK(sliding.at_time(infinity).k == infinity);
    CHECK(sliding.at_time(infinity).v == 0);
    CHECK_THROWS_AS(sliding.at_log_ratio(0), std::domain_error);
    CHECK_THROWS_AS(pivoting.at_log_ratio(0), std::domain_error);
  }
}

// Two starts with mu = 0.1 once failed. For u0 = 5e-324, v0 = 1, mu u0 underflows, and ln k0 was infinite. For u0 =
// 1e-200, v0 = 1e200, the number b of the curve underflows, and beta was 0.
TEST_CASE("a spin too faint for v0/(mu u0) leaves pure sliding", "[orbit][limit]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.1);
    for (const State start : {State{5e-324, 1}, State{-1e-309, 1}, State{1e-200, 1e200}, State{-1e-300, 1e300}}) {
      const Orbit orbit = Flow(system).orbit(start);
      const Orbit sliding = Flow(system).orbit({0, start.v});
      CAPTURE(law.name(), start.u, start.v);
      CHECK(orbit.start_log_ratio() == Approx(std::log(start.v) - std::log(0.1) - std::log(std::abs(start.u))));
      CHECK(orbit.at_time(0).u == start.u);
      CHECK(orbit.at_time(0).beta == 0);
      for (double share : {0.25, 0.75, 0.999}) {
        const OrbitPoint point = orbit.at_time(share * orbit.stop_time());
        const OrbitPoint axis = sliding.at_time(share * sliding.stop_time());
        CAPTURE(share);
        CHECK(point.v == Approx(axis.v).epsilon(1e-12));
        CHECK(point.beta == Approx(axis.beta).epsilon(1e-11));
        // Under both laws u is proportional to the power r/5 of the time left. A denormal u has few digits.
        const double power = std::pow(1 - share, system.r() / 5);
        CHECK(point.u == Approx(start.u * power).epsilon(1e-11).margin(5e-324));
        CHECK(std::signbit(point.u) == std::signbit(start.u));
      }
    }
  }
}

TEST_CASE("a body at rest stays at rest", "[orbit][limit]") {
  const Orbit orbit = Flow(ReducedSystem(HertzLaw{}, 0.1)).orbit({0, 0});
  CHECK(orbit.stop_time() == 0);
  for (const OrbitPoint& point : {orbit.at_time(0), orbit.at_time(1), orbit.at_time_left(0)}) {
    CHECK(point.u == 0);
    CHECK(point.v == 0);
    CHECK(point.ln_v == -infinity);
  }
  CHECK(orbit.sample(3).rows() == 3);
}

TEST_CASE("near the stop u is proportional to the time left", "[orbit][limit]") {
  for (const Law& law : paper_laws()) {
    const double mu = 0.3;
    const Orbit orbit = Flow(ReducedSystem(law, mu)).orbit({1, 0.5});
    for (double left : {1e-6, 1e-12, 1e-100, 1e-300}) {
      CAPTURE(law.name(), left);
      const OrbitPoint point = orbit.at_time_left(left);
      const OrbitPoint closer = orbit.at_time_left(left / 2);
      CHECK(point.u == Approx(5 * mu / 16 * left).epsilon(1e-12));
      // Here v is proportional to the power 14/(5 mu^2) of the time left.
      CHECK(point.ln_v - closer.ln_v == Approx(14 / (5 * mu * mu) * std::numbers::ln2).epsilon(1e-11));
    }
  }
}

TEST_CASE("close to the stop an instant is as good as its time left", "[orbit][limit]") {
  for (const Law& law : paper_laws()) {
    const Orbit orbit = Flow(ReducedSystem(law, 0.3)).orbit({1, 0.5});
    const double stop = orbit.stop_time();
    for (double left : {0x1p-2, 0x1p-20, 0x1p-45}) {
      const double tau = stop * (1 - left);  // the difference stop - tau is exact
      CAPTURE(law.name(), left);
      CHECK(orbit.at_time(tau).u == orbit.at_time_left(stop - tau).u);
      CHECK(orbit.at_time(tau).ln_v == orbit.at_time_left(stop - tau).ln_v);
    }
  }
}

TEST_CASE("the slip is the integral of v along the orbit", "[orbit][route]") {
  WorstCase whole("whole slip"), part("slip of a part");
  for (const Law& law : paper_laws()) {
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
  // The middle time has an error of eps of the stop time. For small mu the stop time far exceeds the sliding time.
  CHECK_WITHIN_EPS(part, 1e6);
}

// The integral is summed over panels in k, so it also covers motions beyond a ray and motions with k towards infinity.
TEST_CASE("what is turned is the integral of u along the orbit", "[orbit][route]") {
  WorstCase turned("turned"), slipped("slip");
  for (const char* name : {"exact", "pade", "ring"}) {
    for (double r : {1e-6, 0.1, 5.0 / 7, 1.7, 3.0, 6.0}) {
      const ReducedSystem system(*find_law(name), 0.3, {.chi = 3.5, .gamma = r * 3.5 / 0.09});
      const Flow flow(system);
      for (double k0 : {1e-2, 0.4, 3.0, 1e3}) {
        const Orbit orbit = flow.orbit({-3, 0.9 * k0});
        const double ln_k0 = orbit.start_log_ratio();
        const double end = orbit.chart().log_ratio(orbit.start_coordinate() - 3);
        // Integrate over panels on both sides of k = 1.
        const auto [bottom, top] = std::minmax({ln_k0, end});
        const auto by_quadrature = [&, bottom = bottom, top = top](auto of_point) {
          const double kink = std::clamp(0.0, bottom, top);
          return integral_between(system, orbit, bottom, kink, of_point) +
                 integral_between(system, orbit, kink, top, of_point);
        };
        const std::string where = fmt::format("{}, r = {}, k0 = {}", name, r, k0);
        const Orbit::Instant at = orbit.instant(orbit.at_log_ratio(end).tau);
        turned.add(by_quadrature([](const OrbitPoint& point) { return point.u; }), at.turned, where);
        slipped.add(by_quadrature([](const OrbitPoint& point) { return point.v; }), at.slip_length, where);
      }
    }
  }
  // The time at `end` has an error of eps of the stop time. For small r it is a small part of the stop time.
  CHECK_WITHIN_EPS(turned, 1e7);
  CHECK_WITHIN_EPS(slipped, 1e7);
}

TEST_CASE("an instant is the state with the slip, by one root", "[orbit][route]") {
  for (const Law& law : paper_laws()) {
    const Flow flow(ReducedSystem(law, 0.3));
    for (const State start : {State{-2, 0.7}, State{1, 1e-6}, State{1e-3, 5}, State{0, 2}, State{-2, 0}, State{0, 0}}) {
      const Orbit orbit = flow.orbit(start);
      for (double share : {0.0, 1e-3, 0.3, 0.9, 1.0, 2.0}) {
        const double tau = share * orbit.stop_time();
        const Orbit::Instant at = orbit.instant(tau);
        const OrbitPoint point = orbit.at_time(tau);
        CAPTURE(law.name(), start.u, start.v, share);
        CHECK((at.u == point.u && at.v == point.v && at.ln_v == point.ln_v));
        CHECK(at.slip_length == orbit.slip_length(tau));
        CHECK(at.turned * start.u >= 0);
      }
    }
    // If one speed is 0 from the start, the other speed falls linearly.
    const Orbit pivoting = flow.orbit({-2, 0});
    CHECK(pivoting.instant(pivoting.stop_time()).turned == Approx(-pivoting.stop_time()).epsilon(1e-15));
    CHECK(pivoting.instant(pivoting.stop_time() / 2).turned == Approx(-0.75 * pivoting.stop_time()).epsilon(1e-15));
    CHECK(flow.orbit({0, 2}).instant(1).turned == 0);
    CHECK_THROWS_AS(pivoting.instant(-1), std::domain_error);
    CHECK_THROWS_AS(pivoting.instant(std::nan("")), std::domain_error);
  }
}

TEST_CASE("when a speed has fallen to a value", "[orbit][route]") {
  WorstCase when_v("tau of v"), when_u("tau of u");
  for (const char* name : {"exact", "pade", "ring"}) {
    for (double r : {1e-4, 5.0 / 7, 3.0, 6.0}) {
      const Flow flow(ReducedSystem(*find_law(name), 0.3, {.chi = 3.5, .gamma = r * 3.5 / 0.09}));
      for (double k0 : {1e-2, 3.0, 1e3}) {
        const Orbit orbit = flow.orbit({-3, 0.9 * k0});
        const double stop = orbit.stop_time();
        for (double share : {1e-6, 1e-3, 0.3, 0.99}) {
          const OrbitPoint point = orbit.at_time(share * stop);
          const std::string where = fmt::format("{}, r = {}, k0 = {}, share = {}", name, r, k0, share);
          if (std::isnormal(point.v)) when_v.add(point.tau, orbit.time_of_v(point.v), stop, where);
          when_u.add(point.tau, orbit.time_of_u(std::abs(point.u)), stop, where);
        }
        CHECK(orbit.time_of_v(0) == stop);
        CHECK(orbit.time_of_u(0) == stop);
        CHECK(orbit.time_of_v(0.9 * k0) == 0);
        CHECK(orbit.time_of_u(3) == 0);
        CHECK(orbit.time_of_v(1e300) == 0);
        CHECK(orbit.time_of_v(5e-324) <= stop);
      }
    }
  }
  CHECK_WITHIN_EPS(when_v, promised);
  CHECK_WITHIN_EPS(when_u, promised);
  const Flow flow(ReducedSystem(HertzLaw{}, 0.3));
  const Orbit sliding = flow.orbit({0, 2});
  CHECK(sliding.time_of_v(0.5) == Approx(0.75 * sliding.stop_time()).epsilon(1e-15));
  CHECK(sliding.time_of_u(0) == 0);
  CHECK(flow.orbit({0, 0}).time_of_v(0) == 0);
  CHECK_THROWS_AS(sliding.time_of_v(-1), std::domain_error);
  CHECK_THROWS_AS(sliding.time_of_u(std::nan("")), std::domain_error);
}

TEST_CASE("the integral of a function of v", "[orbit][route]") {
  for (const char* name : {"exact", "pade", "ring"}) {
    if (!CONTENSOU_FULL_TESTS && name == std::string_view("ring")) continue;  // as slow as all other laws together
    for (double r : CONTENSOU_FULL_TESTS ? std::vector{1e-6, 5.0 / 7, 3.0, 6.0} : std::vector{6.0}) {
      const ReducedSystem system(*find_law(name), 0.3, {.chi = 3.5, .gamma = r * 3.5 / 0.09});
      const Flow flow(system);
      for (double k0 : {1e-2, 3.0, 1e3}) {
        const double v0 = 0.9 * k0;
        const Orbit orbit = flow.orbit({-3, v0});
        const double stop = orbit.stop_time();
        CAPTURE(name, r, k0);
        for (double tau : {orbit.time_of_v(0.1 * v0), stop, 2 * stop}) {
          const double end = std::min(tau, stop);
          CHECK(orbit.integral([](double) { return 3.0; }, tau) == Approx(3 * end).epsilon(1e-15));
          CHECK(orbit.integral([](double v) { return v; }, tau) == Approx(orbit.slip_length(tau)).epsilon(1e-10));
          // |v - c| can be integrated by slip lengths before and after the time at which v = c.
          const double c = 0.3 * v0;
          const double turn = orbit.time_of_v(c);
          const double sides = 2 * orbit.slip_length(turn) - orbit.slip_length(end) - c * (2 * turn - end);
          CHECK(orbit.integral([&](double v) { return std::abs(v - c); }, tau, {c}) == Approx(sides).epsilon(1e-9));
        }
        CHECK(orbit.integral([](double v) { return v; }, 0) == 0);
      }
    }
  }
  const Orbit sliding = Flow(ReducedSystem(HertzLaw{}, 0.3)).orbit({0, 2});
  CHECK(sliding.integral([](double v) { return v * v; }, sliding.stop_time()) ==
        Approx(4 * sliding.stop_time() / 3).epsilon(1e-12));
  CHECK_THROWS_AS(sliding.integral([](double v) { return v; }, -1), std::domain_error);

  // Count how often the path of a shot, which passes the kink of the exact law, calls the law.
  long calls = 0;
  const Orbit shot = Flow(ReducedSystem(HertzLaw{}, 0.1)).orbit({1.5, 1.5});
  const auto speed = [&](double v) { return ++calls, std::hypot(v - 0.8, 0.6); };
  shot.integral(speed, shot.time_of_v(1e-3), {0.8});
  CHECK(calls <= 250);
}

TEST_CASE("the slip of pure sliding is v0^2/2 over its deceleration, and without sliding there is none",
          "[orbit][limit]") {
  const ReducedSystem system(HertzLaw{}, 0.2);
  const Orbit sliding = Flow(system).orbit({0, 3});
  const double stop = sliding.stop_time();
  CHECK(sliding.slip_length(stop) == Approx(3 * stop / 2).epsilon(1e-15));
  CHECK(sliding.slip_length(2 * stop) == sliding.slip_length(stop));
  CHECK(sliding.slip_length(stop / 2) == Approx(3 * (3 * stop / 8)).epsilon(1e-15));
  CHECK(sliding.slip_length(0) == 0);
  CHECK(Flow(system).orbit({3, 0}).slip_length(1) == 0);
  CHECK(Flow(system).orbit({0, 0}).slip_length(1) == 0);
  // A start next to the axis.
  CHECK(Flow(system).orbit({1e-12, 3}).slip_length(1e3) == Approx(3 * stop / 2).epsilon(1e-11));
}

TEST_CASE("columns keep their points", "[orbit]") {
  OrbitColumns columns(2);
  columns.set(1, {1, 2, 3, 4, 5, 6});
  const OrbitPoint point = columns.row(1);
  CHECK(point.tau == 1);
  CHECK(point.u == 2);
  CHECK(point.v == 3);
  CHECK(point.ln_v == 4);
  CHECK(point.k == 5);
  CHECK(point.beta == 6);

  const Orbit orbit = Flow(ReducedSystem(PadeLaw{}, 0.1)).orbit({1, 1});
  const Eigen::ArrayXd times{{3.0, 0.5, 1e9}};
  const OrbitColumns asked = orbit.at_times(times);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const OrbitPoint one = orbit.at_time(times[i]);
    CHECK(same(asked.row(i).u, one.u));
    CHECK(same(asked.row(i).beta, one.beta));
  }
}

TEST_CASE("at a regularised time the state is that of steps of (2.7) in beta", "[orbit][route]") {
  struct System {
    const char* law;
    Inertia body;
    double mu, drive;
  };
  for (const auto& [law, body, mu, drive] :
       {System{"exact", {3.5, 2.5}, 1, 0}, System{"pade", {3.5, 2.5}, 0.3, 0}, System{"exact", {3.5, 2.5}, 0.01, 0},
        System{"uniform", {1, 2}, 1, 0}, System{"exact", {1, 8}, 1, 0}, System{"exact", {3.5, 2.5}, 0.3, 0.2}}) {
    const ReducedSystem system(*find_law(law), mu, body, drive);
    const Flow flow(system);
    for (const State start : {State{1, 1}, State{-3, 0.01}, State{1e-5, 2}, State{0, 2}, State{1, 0}}) {
      INFO(law << " mu " << mu << " gamma " << body.gamma << " drive " << drive << " u0 " << start.u << " v0 "
               << start.v);
      const Orbit orbit = flow.orbit(start);
      const Motion stepped = integrate_regularised(system, start);
      REQUIRE(stepped.outcome.ok());
      const double unit = beta_unit(mu, start);
      for (Eigen::Index row = 0; row < stepped.points.rows(); ++row) {
        const OrbitPoint wanted = stepped.points.row(row), found = at_beta(flow, start, wanted.beta);
        CHECK(found.beta == wanted.beta);
        CHECK(found.u == Approx(wanted.u).epsilon(1e-7));
        CHECK(found.tau == Approx(wanted.tau).epsilon(1e-7).margin(1e-9 * unit * unit * orbit.stop_time()));
        // A drive makes v grow from 0. At first v has as many correct digits as tau.
        const bool begins = start.v == 0 && wanted.beta < 1e-6 * unit;
        if (std::isfinite(wanted.ln_v) && !begins)
          CHECK(std::abs(found.ln_v - wanted.ln_v) < 1e-6 * (1 + std::abs(wanted.ln_v)));
      }
      // Convert tau to beta and back, for times up to the stop.
      for (double share : {1e-3, 0.1, 0.5, 0.9, 1 - 1e-6}) {
        const OrbitPoint wanted = orbit.at_time_left((1 - share) * orbit.stop_time()),
                         found = at_beta(flow, start, wanted.beta);
        CHECK(found.tau == Approx(wanted.tau).epsilon(1e-10));
        CHECK(found.u == Approx(wanted.u).epsilon(1e-8));
      }
      CHECK((at_beta(flow, start, infinity).u == 0 && at_beta(flow, start, infinity).tau == orbit.stop_time()));
      CHECK((at_beta(flow, start, 0).u == start.u && at_beta(flow, start, 0).tau == 0));
      const OrbitPoint far = at_beta(flow, start, 1e200 * unit);
      CHECK((far.beta == 1e200 * unit && far.u * start.u >= 0 && far.tau <= orbit.stop_time()));
    }
    CHECK(at_beta(flow, {0, 0}, 3).u == 0);
  }
}

TEST_CASE("next to the smallest doubles an orbit has its last states, or is at rest", "[orbit][limit]") {
  // Once k is tiny, du/dbeta = -40 mu^3 u^2 for a ball with Psi(0) = 3 pi/16.
  for (const double mu : {1e-4, 1e-2, 0.3}) {
    const Flow flow(HertzLaw{}, mu);
    for (const double beta : {1e180, 1e240, 1e280, 1e300, 1e308}) {
      CAPTURE(mu, beta);
      const double wanted = 1 / (40 * mu * mu * mu) / beta;
      CHECK(at_beta(flow, {1, 1}, beta).u == Approx(wanted).epsilon(1e-9));
      // 1e308 leaves u/1e10 only a few bits.
      if (beta < 1e305) CHECK(at_beta(flow, {1e10, 1e10}, beta).u == Approx(wanted).epsilon(1e-9));
    }
    const Orbit orbit = flow.orbit({1, 1});
    for (const double left : {5e-324, 1e-323, 1e-322, 1e-310}) {
      const OrbitPoint last = orbit.at_time_left(left);
      CHECK(last.u <= left);
      CHECK(last.beta > 1e300);
    }
  }
}

TEST_CASE("an orbit is asked within its motion", "[orbit][domain]") {
  using Catch::Matchers::Contains;
  const ReducedSystem system(PadeLaw{}, 0.1);
  const Orbit orbit = Flow(system).orbit({1, 1});
  for (double bad : {-1e-300, -1.0, -infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(orbit.at_time(bad), std::domain_error);
    CHECK_THROWS_AS(orbit.at_time_left(bad), std::domain_error);
    CHECK_THROWS_AS(at_beta(system, {1, 1}, bad), std::domain_error);
  }
  CHECK_THROWS_WITH(orbit.at_time(-2), Contains("Orbit::at_time") && Contains("-2"));
  CHECK_THROWS_WITH(orbit.at_time(not_a_number), Contains("Orbit::at_time") && Contains("nan"));
  CHECK_THROWS_AS(orbit.at_time_left(orbit.stop_time() * 1.0001), std::domain_error);
  CHECK_THROWS_AS(orbit.at_log_ratio(orbit.start_log_ratio() + 1e-9), std::domain_error);
  CHECK_THROWS_AS(orbit.at_log_ratio(not_a_number), std::domain_error);
  CHECK_THROWS_AS(orbit.remaining_at_coordinate(orbit.start_coordinate() + 1), std::domain_error);
  CHECK_THROWS_AS(orbit.slip_length(-1), std::domain_error);
  CHECK_THROWS_AS(orbit.slip_length(not_a_number), std::domain_error);
  CHECK_THROWS_AS(orbit.sample(1), std::domain_error);
  CHECK_THROWS_AS(orbit.sample(-3), std::domain_error);
  CHECK_THROWS_AS(orbit.at_times(Eigen::ArrayXd{{0.5, -0.5}}), std::domain_error);
  for (const State bad : {State{1, -1}, State{not_a_number, 1}, State{infinity, 1}, State{1, infinity}}) {
    CHECK_THROWS_AS(Flow(system).orbit(bad), std::domain_error);
  }
}

TEST_CASE("threads that share an orbit, and copies of it, find the same instants", "[orbit][threads]") {
  const Flow flow(ReducedSystem(HertzLaw{}, 0.1));
  const Orbit alone = flow.orbit({1, 1}), shared = flow.orbit({1, 1}), copy = shared;
  const Eigen::ArrayXd times = Eigen::ArrayXd::LinSpaced(50, 0, 0.99 * alone.stop_time());
  const OrbitColumns wanted = alone.at_times(times);
  std::vector<std::future<OrbitColumns>> asked;
  for (int i = 0; i < 4; ++i) asked.push_back(std::async(std::launch::async, [&] { return shared.at_times(times); }));
  for (auto& each : asked) CHECK((each.get().ln_v == wanted.ln_v).all());
  CHECK((copy.at_times(times).ln_v == wanted.ln_v).all());
  CHECK((Orbit(shared).at_times(times).ln_v == wanted.ln_v).all());
}
