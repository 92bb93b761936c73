// Tests intervals and standard errors: random errors are added to films of a known ball, and each film is fitted.
#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "scores.hpp"

using namespace contensou;
using namespace contensou::fit;
using Eigen::ArrayXd;

constexpr int trials_with_rolling_friction = 1000;

TEST_CASE("intervals of 95 % hold the truth in 95 of 100 films", "[invariant]") {
  SECTION("errors known") { check(scores({track_of({pool_ball()}, half_second, slip_and_spin), slip_and_spin})); }
  SECTION("errors estimated") {
    check(scores({track_of({pool_ball()}, half_second, slip_and_spin, false), slip_and_spin}));
  }
  SECTION("friction and patch radius hardly told apart") {
    // Only two of these instants show the slip, which ends after 0.2 s. Errors of f and eps have the correlation -0.99.
    check(scores({track_of({pool_ball()}, ArrayXd::LinSpaced(90, 0, 9), slip_and_spin), slip_and_spin}));
  }
  SECTION("positions and angles") {
    const std::vector<Seen> seen{{Observable::x, 1e-4}, {Observable::y, 1e-4}, {Observable::angle, 0.02}};
    check(scores({track_of({pool_ball()}, half_second, seen), seen}));
  }
  SECTION("three instants") {
    // Errors of the patch radius are skewed, so no single standard error describes them.
    check_covered(scores({track_of({pool_ball()}, Eigen::Array3d(0, 0.1, 0.5), slip_and_spin), slip_and_spin}));
  }
  SECTION("a fifth of the pictures dropped, the others at their times") {
    const auto drop = [](Track& track, std::mt19937_64& random) {
      for (Series& series : track.series) {
        for (double& value : series.value) {
          if (random() % 5 == 0) value = NAN;
        }
      }
    };
    check(scores({track_of({pool_ball()}, half_second, slip_and_spin), slip_and_spin, false, drop}));
  }
}

TEST_CASE("of a ball with rolling friction the intervals hold the truth as often, of all three numbers",
          "[invariant][.full]") {
  // A fit without rolling friction finds an f that is 4 % too low here.
  si::Experiment ball = pool_ball();
  ball.contact.rolling_friction = 0.01;
  using enum Observable;
  const std::vector<Seen> positions{{x, 5e-4}, {y, 5e-4}, {spin, 1}};
  for (const auto& [seen, length] : {std::pair(slip_and_spin, 0.5), std::pair(positions, 1.0)}) {
    const Track film = track_of({ball}, ArrayXd::LinSpaced(60, 0, length), seen);
    std::mt19937_64 random(3);
    int held[3] = {};
    double bias[3] = {};
    for (int i = 0; i < trials_with_rolling_friction; ++i) {
      const Fit found = fit::fit({.ball = ball,
                                  .law = reduction::HertzLaw{},
                                  .tracks = {noisy(film, seen, random)},
                                  .free = usually_free(ball)});
      const double truth[]{0.2, 2.827e-3, 0.01};
      for (std::size_t place = 0; place < 3; ++place) {
        const Estimate& estimate = found.estimates[place];
        held[place] += estimate.interval.low <= truth[place] && truth[place] <= estimate.interval.high ? 1 : 0;
        bias[place] += (estimate.value - truth[place]) / estimate.standard_error / trials_with_rolling_friction;
      }
    }
    for (std::size_t place = 0; place < 3; ++place) {
      UNSCOPED_INFO(seen.size() << " columns, " << kind_of(static_cast<Parameter>(place)).name << ": held in "
                                << held[place] << " of " << trials_with_rolling_friction << ", bias " << bias[place]);
      CHECK(held[place] >=
            (0.95 - 3 * std::sqrt(0.95 * 0.05 / trials_with_rolling_friction)) * trials_with_rolling_friction);
      // The second film starts without rolling. A fit allows no rolling below 0, so its estimates are biased.
      if (seen.size() == 2) CHECK(std::abs(bias[place]) < 3 / std::sqrt(trials_with_rolling_friction) + 0.1);
    }
  }
}

TEST_CASE("of a puck by x and y the intervals hold the truth, and every motion that fits as well is told",
          "[invariant][.full]") {
  // Another spin and another friction give nearly the same slip. In one film of six, chance makes the
  // wrong pair fit better than the true pair.
  si::Experiment puck = si::find_ball("puck")->experiment;
  const si::Experiment asked = puck;
  puck.contact.friction = 0.1;
  puck.start = si::SlipAndSpin{.slip = 2, .spin = 30};
  const reduction::Law law = reduction::PressureLaw::uniform();
  using enum Observable;
  const std::vector<Seen> seen{{x, 0.002}, {y, 0.002}};
  const Track film = track_of({puck, law}, ArrayXd::LinSpaced(121, 0, 2), seen);
  constexpr int films = 200;
  constexpr Parameter numbers[]{Parameter::friction, Parameter::slip, Parameter::spin};
  const double truth[]{0.1, 2, 30};
  std::mt19937_64 random(1);
  int held[3] = {}, far_off = 0, told = 0;
  for (int i = 0; i < films; ++i) {
    const Fit found =
        fit::fit({.ball = asked, .law = law, .tracks = {noisy(film, seen, random)}, .free = usually_free(asked)});
    for (std::size_t place = 0; place < 3; ++place) {
      const Interval& interval = found.estimate(numbers[place]).interval;
      held[place] += interval.low <= truth[place] && truth[place] <= interval.high ? 1 : 0;
    }
    if (found.estimate(Parameter::spin).value < 45) continue;
    ++far_off;
    const std::vector<double> others = found.other_spins(0);
    told += std::ranges::any_of(others, [](double spin) { return spin < 40; }) ? 1 : 0;
  }
  for (std::size_t place = 0; place < 3; ++place) {
    INFO(kind_of(numbers[place]).name << ": held in " << held[place] << " of " << films);
    CHECK(held[place] >= 0.92 * films);
    CHECK(held[place] <= 0.98 * films);
  }
  INFO("the farther motion is the better one in " << far_off << ", the true one told in " << told);
  CHECK(told >= 0.8 * far_off);
}

TEST_CASE("where three instants hardly decide friction and patch radius the intervals hold, too", "[invariant]") {
  // Two of the instants come after the slip. The sum of squares is no parabola of f and eps; errors are not normal.
  const Scores found = scores({track_of({pool_ball()}, Eigen::Array3d(0, 0.25, 0.5), slip_and_spin), slip_and_spin});
  CHECK(found.friction.covered > 0.93);
  CHECK(found.patch.covered > 0.93);
}

TEST_CASE("films that decide little: intervals hold the truth, or are open", "[invariant][.full]") {
  const si::Experiment gel = gel_ball();
  si::Experiment fast = pool_ball();
  fast.start = si::SlipAndSpin{.slip = 1, .spin = 300};
  using enum Observable;
  struct Kind {
    const char* name;
    si::Experiment ball;
    double rate, length;
    std::vector<Seen> seen;
    bool with_sd;
  };
  const std::vector<Kind> kinds{
      {"gel, slip alone, 1 cm/s", gel, 120, 1, {{slip, 0.01}}, false},
      {"the same, sd given", gel, 120, 1, {{slip, 0.01}}, true},
      {"gel, slip alone, 2 mm/s", gel, 120, 1, {{slip, 0.002}}, false},
      {"gel, x and y alone, 1 mm", gel, 120, 1, {{x, 0.001}, {y, 0.001}}, false},
      {"pool, angle alone, 0.02 rad", pool_ball(), 240, 0.5, {{angle, 0.02}}, false},
      {"pool, slip alone, 1 cm/s", pool_ball(), 240, 0.5, {{slip, 0.01}}, false},
      {"pool, slip alone, spin 300", fast, 240, 0.8, {{slip, 0.01}}, false},
  };
  constexpr int films = 200;
  // A count of films may lie two standard deviations below its mean.
  const auto least = [](int of, double share = 0.95) {
    return share - 2 * std::sqrt(share * (1 - share) / std::max(of, 1));
  };
  // Chance selects films with one reported combination: for the angle 620 of 1000, and 574 of them have it right.
  constexpr double share_of_only = 0.926;
  constexpr Parameter numbers[]{Parameter::friction, Parameter::patch_radius, Parameter::slip, Parameter::spin};
  for (const auto& [name, ball, rate, length, seen, with_sd] : kinds) {
    const Track film = track_of(
        {ball}, ArrayXd::LinSpaced(static_cast<Eigen::Index>(rate * length), 0, length - 1 / rate), seen, with_sd);
    const double truth[]{ball.contact.friction, std::get<si::PatchRadius>(ball.contact.patch).value,
                         si::slip_at_start(ball), si::spin_at_start(ball)};
    std::mt19937_64 random(5);
    int held[4] = {}, open[4] = {}, held_of_only = 0, only = 0;
    for (int i = 0; i < films; ++i) {
      const Fit found = fit::fit({.ball = ball, .law = reduction::HertzLaw{}, .tracks = {noisy(film, seen, random)}});
      for (std::size_t place = 0; place < 4; ++place) {
        const auto& [low, high] = found.estimates[place].interval;
        held[place] += low <= truth[place] && truth[place] <= high ? 1 : 0;
        open[place] += found.estimates[place].determined() ? 0 : 1;
      }
      if (!found.only) continue;
      const double value = std::pow(truth[0], found.only->friction_power) * std::pow(truth[1], found.only->patch_power);
      ++only;
      held_of_only += found.only->interval.low <= value && value <= found.only->interval.high ? 1 : 0;
    }
    for (std::size_t place = 0; place < 4; ++place) {
      INFO(name << ", " << kind_of(numbers[place]).name << ": held in " << held[place] << ", open in " << open[place]
                << " of " << films);
      CHECK(held[place] >= least(films) * films);
      CHECK((held[place] <= 0.98 * films || 4 * open[place] > films));
    }
    INFO(name << ": the only combination held in " << held_of_only << " of " << only);
    CHECK(held_of_only >= least(only, share_of_only) * only);
  }
}
