// The implicit step of wrench_kernel.h is compared with the friction at its end, with the limit surface, and with
// closed forms.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "contensou/wrench_kernel.h"

namespace contensou::kernel {

namespace {

template <class T>
struct Stepping {
  T vx, vy, w, by_force, by_moment, limit, radius, dt;
};

template <class Law, class T>
Step<T> stepped(const Stepping<T>& at, const Law& law = {}, int max_newton = 60) {
  return step(at.vx, at.vy, at.w, at.by_force, at.by_moment, at.limit, at.radius, at.dt, law, max_newton);
}

/// Counts the calls of a law.
template <class Law>
struct Counted {
  long* calls;

  template <class T>
  Friction<T> operator()(const Slip<T>& at) const {
    ++*calls;
    return Law{}(at);
  }
};

/// Returns slip, spin and step of random sizes. Some speeds are 0, and some bodies cannot be moved.
/// @param decades  half of the decades between the largest and the smallest number of each kind
template <class T>
Stepping<T> random_stepping(std::mt19937_64& generator, double decades) {
  std::uniform_real_distribution<double> power(-decades, decades), angle(0, 2 * std::numbers::pi);
  const auto size = [&] { return std::pow(10, power(generator)); };
  const auto size_or_0 = [&] { return generator() % 16 == 0 ? 0 : size(); };
  const double v = size_or_0(), turn = angle(generator), rim = size_or_0(), radius = size(), limit = size(),
               dt = size();
  const double by_force = size_or_0() / (limit * dt), by_moment = size_or_0() / (limit * dt * radius * radius);
  return {T(v * std::cos(turn)),
          T(v * std::sin(turn)),
          T((turn < 3 ? rim : -rim) / radius),
          T(by_force),
          T(by_moment),
          T(limit),
          T(radius),
          T(dt)};
}

/// Returns twice the energy in long double. The energy of a body that cannot be moved is left out.
template <class T, class State>
long double energy(const Stepping<T>& at, const State& of) {
  const auto part = [](long double square, T by) { return by > 0 ? square / by : 0; };
  const long double vx = of.vx, vy = of.vy, w = of.w;
  return part(vx * vx + vy * vy, at.by_force) + part(w * w, at.by_moment);
}

template <class Law, class T>
void check_passive(int count, double decades) {
  std::mt19937_64 generator(5);
  long calls = 0, worst = 0;
  double gain = -1;
  for (int i = 0; i < count; ++i) {
    const Stepping<T> at = random_stepping<T>(generator, decades);
    const long double before = energy(at, at);
    for (int max_newton : {0, 1, 3, 60}) {
      long of_step = 0;
      const Step<T> after = stepped(at, Counted<Law>{&of_step}, max_newton);
      gain = std::max(gain, before > 0 ? double(energy(at, after) / before - 1) : 0);
      const bool stays =
          (at.by_force > 0 || (after.vx == at.vx && after.vy == at.vy)) && (at.by_moment > 0 || after.w == at.w);
      const bool finite = std::isfinite(after.fx) && std::isfinite(after.fy) && std::isfinite(after.m);
      const bool follows = std::abs(at.vx + at.by_force * at.dt * after.fx - after.vx) <=
                           4 * std::numeric_limits<T>::epsilon() * std::abs(at.vx);
      if (!stays || !finite || !follows || of_step > max_newton + 1) {
        CAPTURE(at.vx, at.vy, at.w, at.by_force, at.by_moment, at.limit, at.radius, at.dt, max_newton);
        FAIL_CHECK(stays << finite << follows << of_step);
      }
      if (max_newton == 60) calls += of_step, worst = std::max(worst, of_step);
    }
  }
  CAPTURE(decades, gain, calls, worst);
  CHECK(gain <= 4 * std::numeric_limits<T>::epsilon());
  if (decades <= 2) CHECK((calls <= 5L * count && worst <= 16));
}

/// Returns Phi and Psi at an angle: 0 for spin alone, pi/2 for slip alone.
template <class Law>
Wrench<double> on_limit_surface(double angle) {
  return wrench<Law>(-std::sin(angle), 0.0, -std::cos(angle), 1.0, 1.0);
}

}  // namespace

TEMPLATE_TEST_CASE("no step adds energy, wherever Newton's method stops", "[invariant]", Exact, Uniform, Elliptic,
                   Pade) {
  constexpr int states = CONTENSOU_FULL_TESTS ? 100'000 : 10'000;  // of one kind; in all 10^6
  check_passive<TestType, double>(states, 2);
  check_passive<TestType, float>(states, 2);
  check_passive<TestType, double>(states / 2, 12);
}

TEMPLATE_TEST_CASE("the friction of a step is the friction at its end", "[analytic]", Exact, Uniform, Elliptic, Pade) {
  std::mt19937_64 generator(6);
  int moving = 0;
  for (int i = 0; i < 50000; ++i) {
    const Stepping<double> at = random_stepping<double>(generator, 1.5);
    const Step<double> after = stepped(at, TestType{});
    const double size = std::max(std::hypot(after.vx, after.vy), at.radius * std::abs(after.w));
    if (size == 0 || at.by_force == 0 || at.by_moment == 0) continue;
    ++moving;
    const auto [fx, fy, m] = wrench<TestType>(after.vx, after.vy, after.w, at.limit, at.radius);
    const double start = std::max(std::hypot(at.vx, at.vy), at.radius * std::abs(at.w));
    const double allowed = 200 * std::numeric_limits<double>::epsilon() * at.limit * std::max(1.0, start / size);
    const bool same = std::abs(after.fx - fx) <= allowed && std::abs(after.fy - fy) <= allowed &&
                      std::abs(after.m - m) <= allowed * at.radius;
    if (same) continue;
    CAPTURE(at.vx, at.vy, at.w, at.by_force, at.by_moment, at.limit, at.radius, at.dt, after.fx / fx - 1);
    FAIL_CHECK(after.m / m - 1);
  }
  CHECK(moving > 10000);
}

TEMPLATE_TEST_CASE("a contact rests if and only if its impulse lies within the limit surface", "[analytic]", Exact,
                   Uniform, Elliptic, Pade) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> ln_k(-12, 12), power(-2, 2);
  for (int i = 0; i < 20000; ++i) {
    const auto [phi, unused, psi] = on_limit_surface<TestType>(std::atan(std::exp(ln_k(generator))));
    const double b = std::pow(10, power(generator)), c = std::pow(10, power(generator));
    for (double share : {0.5, 1 - 1e-9, 1 + 1e-9, 2.0}) {
      const Step<double> after = step<TestType>(0.6 * share * b * phi, -0.8 * share * b * phi, share * c * psi, b / 3,
                                                c, 3.0, 1 / 3.0, 1.0, TestType{});
      CAPTURE(b, c, phi, psi, share);
      if ((after.vx == 0 && after.vy == 0 && after.w == 0) != (share < 1)) FAIL_CHECK(after.vx << " " << after.w);
    }
  }
}

TEMPLATE_TEST_CASE("slip alone, spin alone, and other limits of a step", "[limit]", Exact, Uniform, Elliptic, Pade) {
  const double turns = on_limit_surface<TestType>(0).m, nan = NAN;
  using D = double;
  const auto go = [](D vx, D vy, D w, D b, D c, D limit, D radius, D dt) {
    return step<TestType>(vx, vy, w, b, c, limit, radius, dt);
  };
  const auto slides = go(3, -4, 0, 0.5, 2, 2, 0.5, 0.5);
  CHECK(slides.vx == Approx(3 * 0.9).epsilon(1e-15));
  CHECK(slides.vy == Approx(-4 * 0.9).epsilon(1e-15));
  CHECK((slides.w == 0 && slides.m == 0));
  const auto spins = go(0, 0, -4, 0.5, 2, 2, 0.5, 0.5);
  CHECK(spins.w == Approx(-4 + turns).epsilon(1e-15));
  CHECK((spins.vx == 0 && spins.fx == 0 && spins.m == Approx(turns).epsilon(1e-15)));
  const auto stops = go(3, -4, 7, 0.5, 2, 2, 0.5, 1e9);
  CHECK((stops.vx == 0 && stops.vy == 0 && stops.w == 0));
  CHECK(stops.fx == Approx(-3 / 0.5 / 1e9).epsilon(1e-15));
  CHECK(stops.m == Approx(-7 / 2.0 / 1e9).epsilon(1e-15));
  for (double dt : {1e-9, 1e-20, 1e-200, 5e-324}) {
    const auto tiny = go(3, -4, 7, 0.5, 2, 2, 0.5, dt);
    const auto now = wrench<TestType>(3.0, -4.0, 7.0, 2.0, 0.5);
    CAPTURE(dt);
    CHECK(tiny.fx == Approx(now.fx).epsilon(2 * dt + 1e-14));
    CHECK(tiny.fy == Approx(now.fy).epsilon(2 * dt + 1e-14));
    CHECK(tiny.m == Approx(now.m).epsilon(2 * dt + 1e-14));
    CHECK(tiny.w == Approx(7).epsilon(1e-8));
  }
  for (const auto& same : {go(3, -4, 7, 0.5, 2, 0, 0.5, 1), go(3, -4, 7, 0.5, 2, -1, 0.5, 1),
                           go(3, -4, 7, 0, 0, 2, 1, 1), go(3, -4, 7, 0.5, 2, 2, 0.5, 0)}) {
    CHECK((same.vx == 3 && same.vy == -4 && same.w == 7 && same.fx == 0 && same.fy == 0 && same.m == 0));
  }
  const auto rest = go(0, 0, 0, 0.5, 2, 2, 0.5, 1);
  CHECK((rest.vx == 0 && rest.vy == 0 && rest.w == 0 && rest.fx == 0 && rest.m == 0));
  const auto point = go(3, -4, 7, 0.5, 2, 2, 0, 0.5);
  CHECK((point.vx == Approx(3 * 0.9).epsilon(1e-15) && point.w == 7 && point.m == 0));
  const auto held = go(3, -4, 7, 0.5, 2, 2, 0, 1e9);
  CHECK((held.vx == 0 && held.vy == 0 && held.w == 7 && held.m == 0));
  const auto driven = go(1e-200, 0, 7, 0.5, 0, 2, 0.5, 1);  // the spin is prescribed
  CHECK((driven.w == 7 && driven.vx >= 0 && driven.vx <= 1e-200));
  CHECK(driven.m == Approx(-turns).epsilon(1e-15));
  for (int bad = 0; bad < 8; ++bad) {
    D of[]{3, -4, 7, 0.5, 2, 2, 0.5, 0.1};
    of[bad] = nan;
    const auto found = go(of[0], of[1], of[2], of[3], of[4], of[5], of[6], of[7]);
    CAPTURE(bad);
    CHECK(std::isnan(found.vx + found.vy + found.w + found.fx + found.fy + found.m));
  }
  for (double large : {1e-300, 1e300}) {
    const auto found = go(large, -large, large, 0.5, 2, 2, 0.5, 1);
    CHECK(std::isfinite(found.vx + found.w + found.fx + found.m));
    CHECK(std::abs(found.fx) <= 2);
  }
}

}  // namespace contensou::kernel
