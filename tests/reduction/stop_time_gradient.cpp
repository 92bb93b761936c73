// Tests the derivatives of the stop time: (R10) of reduction/theory.md, (R34) and (R35) of numerics.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/laws.hpp"

using namespace contensou::reduction;

namespace {

struct Question {
  double u, v, mu, chi, gamma, drive;

  Flow flow(const Law& law) const { return ReducedSystem(law, mu, {.chi = chi, .gamma = gamma}, drive); }
  double tau(const Law& law) const { return flow(law).stop_time({u, v}).tau; }
  std::string text() const {
    return fmt::format("u = {}, v = {}, mu = {}, chi = {}, gamma = {}, drive = {}", u, v, mu, chi, gamma, drive);
  }
};

/// Returns d tau/d ln x by central differences of order 4, to 1e-10 of tau.
double by_differences(const Law& law, const Question& asked, double Question::*x) {
  constexpr double step = 2e-3;
  const auto tau = [&](double times) {
    Question changed = asked;
    changed.*x *= 1 + times * step;
    return changed.tau(law);
  };
  return (8 * (tau(1) - tau(-1)) - (tau(2) - tau(-2))) / (12 * step);
}

/// Returns the largest error of a logarithmic derivative, divided by the stop time.
double error_of(const Law& law, const Question& asked) {
  const StopTimeGradient found = asked.flow(law).stop_time_gradient({asked.u, asked.v});
  const auto error = [&](double derivative, double Question::*x) {
    return asked.*x == 0 ? 0 : std::abs(asked.*x * derivative - by_differences(law, asked, x)) / found.tau;
  };
  return std::max({error(found.by_u, &Question::u), error(found.by_v, &Question::v), error(found.by_mu, &Question::mu),
                   error(found.by_chi, &Question::chi), error(found.by_gamma, &Question::gamma),
                   error(found.by_drive, &Question::drive)});
}

using Precise = long double;
using Quantities = std::array<Precise, 4>;  ///< u, v, slip length, turned

/// Returns Phi and Psi at the speeds v and w = mu |u|.
using PreciseLaw = std::array<Precise, 2> (*)(Precise v, Precise w);

constexpr Precise precise_pi = std::numbers::pi_v<Precise>;

/// Integrates (2.6) with the drive by 3000 Runge-Kutta steps of order 8 in long double, without code of the library.
Quantities integrated(PreciseLaw law, const ReducedSystem& system, Precise u, Precise v, Precise tau) {
  const Precise mu = system.mu(), chi = system.inertia().chi, gamma = system.inertia().gamma, rho = system.drive();
  Quantities x{u, v, 0, 0};
  constexpr int steps = 3000;
  boost::numeric::odeint::runge_kutta_fehlberg78<Quantities, Precise> stepper;
  const auto equations = [&](const Quantities& at, Quantities& rate, Precise) {
    const auto [force, moment] = law(at[1], mu * std::abs(at[0]));
    rate = {-std::copysign(2 * gamma * mu / (3 * precise_pi) * moment, at[0]),
            2 * chi / (3 * precise_pi) * (rho - force), at[1], at[0]};
  };
  for (int i = 0; i < steps; ++i) stepper.do_step(equations, x, 0, tau / steps);
  return x;
}

}  // namespace

TEST_CASE("the gradient of the Pade ball", "[gradient][formula]") {
  const StopTimeGradient found = Flow(PadeLaw{}, 0.3).stop_time_gradient({1, 1});
  CHECK(found.tau == Flow(PadeLaw{}, 0.3).stop_time({1, 1}).tau);
  CHECK(found.by_v == Approx(1.52868423111).epsilon(1e-11));
  CHECK(found.by_u == Approx(10.9679009161).epsilon(1e-11));
}

TEST_CASE("the gradient agrees with differences, for every law", "[gradient][route]") {
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution(std::log(low), std::log(high))(random));
  };
  for (const Law& law : CONTENSOU_FULL_TESTS ? named_laws() : paper_laws()) {
    for (int i = 0; i < 2; ++i) {
      Question asked{.u = between(1e-2, 1e2),
                     .v = 1,
                     .mu = between(1e-3, 3),
                     .chi = between(1, 4),
                     .gamma = between(2, 3),
                     .drive = i % 2 == 0 ? 0 : between(1e-3, 0.5)};
      if (i > 0) asked.u = -asked.u;
      INFO(law.name() << ": " << asked.text());
      CHECK(error_of(law, asked) < 2e-9);
      const StopTimeGradient found = asked.flow(law).stop_time_gradient({asked.u, asked.v});
      CHECK(asked.u * found.by_u + asked.v * found.by_v == Approx(found.tau).epsilon(1e-9));  // Euler's theorem
    }
  }
}

TEST_CASE("derivatives by the speeds have all digits beside kinks, with a drive, too", "[gradient][drive]") {
  // s = tau (scaled) gives k m = (s - w/(r Psi(0)))/w, and ds/dv = (Delta - r Psi k m)/D needs no slopes of the law.
  std::mt19937_64 random(7);
  const auto between = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution(std::log(low), std::log(high))(random));
  };
  for (const char* name : {"annulus:0.5", "soft:1", "uniform"}) {
    const Law law = *find_law(name);
    for (int i = 0; i < (CONTENSOU_FULL_TESTS ? 30 : 6); ++i) {
      const Question asked{.u = 1,
                           .v = 0,
                           .mu = between(1e-2, 1),
                           .chi = i % 2 == 0 ? 3.5 : 1,
                           .gamma = 2.5,
                           .drive = i % 3 == 0 ? 0 : between(1e-4, 0.5)};
      const Flow flow = asked.flow(law);
      const double r = flow.system().r(), rate = flow.system().scaled_time_rate();
      for (const double kink : {0.5, 1.0, between(1e-2, 1e2)}) {
        for (const double beside : {0.0, -1e-10, 1e-10, -1e-4, 1e-4}) {
          const double k = kink * (1 + beside), v = k * asked.mu;
          const StopTimeGradient found = flow.stop_time_gradient({1, v});
          const auto [force, moment] = law(slip_of_ratio(k));
          const double difference = force - asked.drive - r * k * moment;
          if (std::abs(difference) < 0.02 * std::max(force, r * k * moment)) continue;  // beside a ray
          const long double km =
              static_cast<long double>(found.tau) * rate / asked.mu - 1 / (r * law.pivoting_moment());
          const auto by_v = static_cast<double>((law.moment_deficit(slip_of_ratio(k)) - r * moment * km) / difference);
          INFO(name << ": k = " << k << ", " << asked.text());
          CHECK(std::abs(v * (found.by_v - by_v / rate)) <= 100 * eps * found.tau);
          CHECK(std::abs(found.by_u + v * found.by_v - found.tau) <= 100 * eps * found.tau);
        }
      }
    }
  }
}

TEST_CASE("the first drive that there is changes the stop time as the gradient says", "[gradient][drive]") {
  // Under the Pade law a drive has a first-order effect even on a body that only spins: the body creeps at once.
  for (const Law& law : paper_laws()) {
    const Question at{.u = 1, .v = 1, .mu = 0.3, .chi = 3.5, .gamma = 2.5, .drive = 0};
    constexpr double step = 1e-5;
    const auto tau = [&](double drive) {
      Question driven = at;
      driven.drive = drive;
      return driven.tau(law);
    };
    const double wanted = (4 * tau(step) - tau(2 * step) - 3 * tau(0)) / (2 * step);
    CHECK(at.flow(law).stop_time_gradient({1, 1}).by_drive == Approx(wanted).epsilon(1e-7));
  }
}

TEST_CASE("on a ray, beside it and on its way the gradient has the same limit", "[gradient][ray]") {
  for (double drive : {0.0, 0.1}) {
    // r = 3 has a ray without a drive. Under a drive every body has a ray, at which it creeps; here a pool ball.
    const Question asked{
        .u = 1, .v = 0, .mu = drive > 0 ? 0.03 : std::sqrt(3.0 * 3.5 / 2.5), .chi = 3.5, .gamma = 2.5, .drive = drive};
    for (const Law& law : paper_laws()) {
      const Flow flow = asked.flow(law);
      REQUIRE(flow.terminal().rays.size() == 1);
      const double k = flow.terminal().rays[0].k;
      for (double beside : CONTENSOU_FULL_TESTS ? std::vector{-1e-3, 0.0, 1e-15, 1e-9} : std::vector{0.0, 1e-9}) {
        Question next = asked;
        next.v = asked.mu * k * (1 + beside);
        INFO(law.name() << ": " << next.text() << ", " << beside << " from the ray");
        CHECK(error_of(law, next) < 2e-9);
      }
    }
  }
}

TEST_CASE("the gradient on the ellipse is closed, at any spin, with a drive, too", "[gradient][formula]") {
  constexpr double C = 0.8;
  const double r = 1 / (C * C);
  for (double drive : {0.0, 0.3}) {
    const Flow flow(ReducedSystem(EllipticLaw{C}, 1, {.chi = 1, .gamma = r}, drive));
    const double unit = flow.system().scaled_time_rate();
    for (double k : {1e-3, 0.5, 2.0, 900.0, 1.1e3, 1e6, 1e9, 1e12}) {
      const double v = 1, w = 1 / k, E = std::hypot(v, C * w), rest = 1 - drive * drive;
      const StopTimeGradient found = flow.stop_time_gradient({w, v});
      INFO("drive " << drive << ", k = " << k);
      CHECK(unit * found.by_v == Approx((v / E + drive) / rest).epsilon(1e-10));
      CHECK(unit * found.by_u == Approx(C * C * w / E / rest).epsilon(1e-9));
      CHECK(unit * found.by_drive == Approx((v * rest + 2 * drive * (E + drive * v)) / (rest * rest)).epsilon(1e-9));
    }
  }
}

TEST_CASE("the gradient of an instant has its 13 digits against differences in long double", "[gradient][reference]") {
  if (std::numeric_limits<Precise>::digits < 64) return;  // differences need these digits
  constexpr PreciseLaw pade = [](Precise v, Precise w) {
    return std::array{3 * precise_pi * v / (8 * w + 3 * precise_pi * v),
                      3 * precise_pi * w / (16 * w + 15 * precise_pi * v)};
  };
  constexpr PreciseLaw ellipse = [](Precise v, Precise w) {
    constexpr Precise C = static_cast<Precise>(EllipticLaw::hertz_moment);
    const Precise size = std::sqrt(v * v + C * C * w * w);
    return std::array{v / size, C * C * w / size};
  };
  constexpr PreciseLaw hertz = [](Precise v, Precise w) {  // the exact law for k <= 1
    const Precise k = v / w, s = k * k;
    return std::array{3 * precise_pi / 32 * k * (4 - s), 3 * precise_pi / 128 * (8 - 8 * s + 3 * s * s)};
  };
  struct Case {
    Law law;
    PreciseLaw precise;
    double mu, drive, u, v;
  };
  const std::vector<Case> all_cases{
      {PadeLaw{}, pade, 0.2, 0, 1, 1},          {PadeLaw{}, pade, 0.3, 0.05, -1, 0.2},
      {PadeLaw{}, pade, 1.5, 0, 1, 2},          {EllipticLaw{}, ellipse, 0.2, 0, -3, 0.5},
      {EllipticLaw{}, ellipse, 0.5, 0.2, 1, 2}, {EllipticLaw{}, ellipse, 0.1, 0.9, 1, 0.3},
      {HertzLaw{}, hertz, 0.3, 0, 1, 0.25},     {HertzLaw{}, hertz, 0.1, 0.01, -1, 0.05}};
  const std::vector<Case> one_of_each_law{all_cases[1], all_cases[4], all_cases[6]};
  for (const Case& at : CONTENSOU_FULL_TESTS ? all_cases : one_of_each_law) {
    const Flow flow(ReducedSystem(at.law, at.mu, homogeneous_ball, at.drive));
    const double stop = flow.stop_time({at.u, at.v}).tau;
    const Rate first = flow.system().field({at.u, at.v});
    const double larger = std::max(std::abs(at.u * first.v), std::abs(at.v * first.u));
    const double cancels = larger / std::abs(at.u * first.v - at.v * first.u);
    const std::vector<double> all{0.03 * stop, 0.3 * stop, 0.5 * stop}, one{0.3 * stop};
    for (double tau : CONTENSOU_FULL_TESTS ? all : one) {
      const InstantGradient found = instant_gradient(flow, {at.u, at.v}, tau);
      const std::array parts{found.u, found.v, found.slip_length, found.turned};
      const auto slopes = [&](Precise of_u, Precise of_v) {
        constexpr Precise step = 5e-4L;
        const auto moved = [&](Precise times) {
          return integrated(at.precise, flow.system(), at.u * (1 + times * step * of_u),
                            at.v * (1 + times * step * of_v), tau);
        };
        const std::array forth{moved(1), moved(2), moved(3)}, back{moved(-1), moved(-2), moved(-3)};
        Quantities result;
        for (std::size_t i = 0; i < result.size(); ++i) {
          // A slip that has nearly vanished is the exponential of a smooth number, so differences use its logarithm.
          const auto change = [&](std::size_t n) {
            return i == 1 ? std::log(forth[n][1] / back[n][1]) : forth[n][i] - back[n][i];
          };
          result[i] = (45 * change(0) - 9 * change(1) + change(2)) / (60 * step);
        }
        return result;
      };
      const Quantities by_u = slopes(1, 0), by_v = slopes(0, 1);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        CAPTURE(at.law.name(), at.mu, at.drive, tau / stop, i);
        const Precise unit = std::max(std::abs(by_u[i]), std::abs(by_v[i]));
        const auto error = [&](double derivative, Precise wanted) {
          const double own = i == 1 ? derivative / found.v.value : derivative;
          return static_cast<double>(std::abs(own - wanted) / unit) / cancels;
        };
        const double largest = std::max(error(at.u * parts[i].by_u, by_u[i]), error(at.v * parts[i].by_v, by_v[i]));
        CHECK(largest <= 1e-13);
      }
    }
  }
}

// Compare with differences: for all laws, both signs of u, with and without a drive, before and long after the end of
// the slip, and after the stop. Compare also two successive time spans with one span.
TEST_CASE("the gradient of an instant is that of differences, and obeys the chain rule", "[gradient][route]") {
  using Part = InstantGradient::Part;
  const auto parts = [](const InstantGradient& all) {
    return std::array<Part, 4>{all.u, all.v, all.slip_length, all.turned};
  };
  struct Start {
    const char* law;
    double mu, drive, u, v;
  };
  // The last but one start lies on a ray, and the last start lies beside this ray.
  for (const Start& start : {Start{"exact", 0.1, 0, 1, 1},
                             {"exact", 0.3, 0.05, -1, 0.2},
                             {"pade", 0.3, 0, 1, 1},
                             {"ring", 0.8, 0, -2, 1},
                             {"elliptic", 0.5, 0.2, 1, 2},
                             {"exact", 2.0, 0, 1, 3},
                             {"exact", 2.0, 0, -1, 0.3},
                             {"exact", 2.0, 0, 1, 0},
                             {"exact", 2.0, 0, 1, 1e-7}}) {
    const Flow flow(ReducedSystem(*find_law(start.law), start.mu, homogeneous_ball, start.drive));
    const double ray = flow.terminal().rays.empty() ? 0 : flow.terminal().rays.front().k;
    const bool at_ray = start.v < 0.1;
    const State from{start.u, at_ray ? start.mu * std::abs(start.u) * ray * (1 + start.v) : start.v};
    const double stop = flow.stop_time(from).tau;
    for (double tau : {0.03 * stop, 0.5 * stop, 1.2 * stop}) {
      const auto found = parts(instant_gradient(flow, from, tau));
      const auto at = [&](double u, double v, double t) {
        const Orbit::Instant instant = flow.orbit({u, v}).instant(t);
        return std::array{instant.u, instant.v, instant.slip_length, instant.turned};
      };
      constexpr double step = 1e-4;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const auto slope = [&](auto along) {
          const auto moved = [&](double times) { return along(1 + times * step)[i]; };
          return (8 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12 * step);
        };
        CAPTURE(start.law, start.mu, from.v, tau / stop, i);
        const double unit = std::abs(from.u * found[i].by_u) + std::abs(from.v * found[i].by_v) + 1e-300;
        CHECK(found[i].value == at(from.u, from.v, tau)[i]);
        const double by_u = slope([&](double c) { return at(from.u * c, from.v, tau); });
        const double by_v = slope([&](double c) { return at(from.u, from.v * c, tau); });
        const double by_tau = slope([&](double c) { return at(from.u, from.v, tau * c); });
        CHECK(std::abs(from.u * found[i].by_u - by_u) <= 2e-8 * unit);
        CHECK(std::abs(from.v * found[i].by_v - by_v) <= 2e-8 * unit);
        CHECK(std::abs(tau * found[i].by_tau - by_tau) <= 2e-8 * (unit + std::abs(by_tau)));
      }
    }
    const double first = 0.2 * stop, second = 0.3 * stop;
    const InstantGradient one = instant_gradient(flow, from, first);
    const InstantGradient other = instant_gradient(flow, {one.u.value, one.v.value}, second);
    const InstantGradient both = instant_gradient(flow, from, first + second);
    const double chained = other.u.by_u * one.u.by_v + other.u.by_v * one.v.by_v;
    CHECK(both.u.by_v == Approx(chained).epsilon(1e-8).margin(1e-9));
    CHECK(both.slip_length.by_v - one.slip_length.by_v ==
          Approx(other.slip_length.by_u * one.u.by_v + other.slip_length.by_v * one.v.by_v).epsilon(1e-8).margin(1e-9));
  }
  const Flow flow(HertzLaw{}, 0.1);
  // The ball rolls when the slip has fallen to 1e-3. This time is `rolls`.
  const double rolls = flow.orbit({1, 1}).time_of_v(1e-3);
  const InstantGradient then = instant_gradient(flow, {1, 1}, rolls);
  constexpr double step = 1e-5;
  CHECK(InstantGradient::time_by(then.v.by_v, then.v) ==
        Approx((flow.orbit({1, 1 + step}).time_of_v(1e-3) - flow.orbit({1, 1 - step}).time_of_v(1e-3)) / (2 * step))
            .epsilon(1e-8));
  CHECK_THROWS_WITH(instant_gradient(flow, {0, 1}, 1), Catch::Matchers::Contains("u not 0 and v > 0 is needed"));
}

TEST_CASE("the gradient of one speed alone, and of none", "[gradient][errors]") {
  const Flow flow(HertzLaw{}, 0.1);
  const StopTimeGradient pivots = flow.stop_time_gradient({-2, 0});
  CHECK(pivots.by_u == Approx(pivots.tau / -2));
  CHECK(pivots.by_v == 0);
  CHECK(pivots.by_mu == Approx(-pivots.tau / 0.1));
  CHECK(pivots.by_gamma == Approx(-pivots.tau / homogeneous_ball.gamma));
  const StopTimeGradient slides = flow.stop_time_gradient({0, 3});
  CHECK(slides.by_u == 0);
  CHECK(slides.by_v == Approx(slides.tau / 3));
  CHECK(slides.by_chi == Approx(-slides.tau / homogeneous_ball.chi));
  CHECK_THROWS_WITH(flow.stop_time_gradient({0, 0}), Catch::Matchers::Contains("at rest there is none"));
  CHECK_THROWS_AS(flow.stop_time_gradient({1, -1}), std::domain_error);
}

TEST_CASE("the gradient is of degree 0 by the speeds and 1 by all else", "[gradient][invariant]") {
  const Flow flow({HertzLaw{}, 0.1, homogeneous_ball, 0.05});
  const StopTimeGradient one = flow.stop_time_gradient({1, 2});
  for (double c : {1e-290, 1e-8, 1e8, 1e290}) {
    const StopTimeGradient scaled = flow.stop_time_gradient({c, 2 * c});
    CHECK(scaled.by_u == Approx(one.by_u).epsilon(1e-13));
    CHECK(scaled.by_v == Approx(one.by_v).epsilon(1e-13));
    CHECK(scaled.by_mu / c == Approx(one.by_mu).epsilon(1e-13));
    CHECK(scaled.by_drive / c == Approx(one.by_drive).epsilon(1e-13));
  }
}
