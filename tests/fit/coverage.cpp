// What intervals and standard errors are worth: films of a known ball with random errors, fitted one after the other.
#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "films.hpp"

using namespace contensou;
using namespace contensou::fit;
using Eigen::ArrayXd;

namespace {

constexpr int trials = CONTENSOU_FULL_TESTS ? 1000 : 100;

/// Of a parameter over many films: how often the 95 % interval has its true value, the error over the standard error on
/// the average, and its root mean square.
struct Score {
  double covered = 0, bias = 0, spread = 0;
};
struct Scores {
  Score friction, patch;
};

/// @param spoil  what else happens to a film
Scores scores(const Track& film, const std::vector<Seen>& seen, bool robust = false,
              const std::function<void(Track&, std::mt19937_64&)>& spoil = {}) {
  std::mt19937_64 random(7);
  const si::Experiment ball = pool_ball();
  const double truth[] = {0.2, 2.827e-3};
  Scores result;
  for (int i = 0; i < trials; ++i) {
    Track track = noisy(film, seen, random);
    if (spoil) spoil(track, random);
    const Fit found =
        fit::fit({.ball = ball, .law = reduction::HertzLaw{}, .tracks = {track}, .free = {}, .robust = robust});
    for (int place : {0, 1}) {
      Score& score = place == 0 ? result.friction : result.patch;
      const Estimate& estimate = found.estimates[static_cast<std::size_t>(place)];
      const double error = std::log(estimate.value / truth[place]) * estimate.value / estimate.standard_error;
      score.covered += estimate.interval.low <= truth[place] && truth[place] <= estimate.interval.high;
      score.bias += error;
      score.spread += error * error;
    }
  }
  for (Score* score : {&result.friction, &result.patch}) {
    score->covered /= trials;
    score->bias /= trials;
    score->spread = std::sqrt(score->spread / trials);
    UNSCOPED_INFO("covered " << score->covered << ", bias " << score->bias << " and spread " << score->spread
                             << " in standard errors");
  }
  return result;
}

/// The share is 95 %, and the errors are as large as they are said to be, as far as so many films can tell: to three
/// standard deviations.
void check(const Scores& scores) {
  const double n = trials;
  for (const Score& score : {scores.friction, scores.patch}) {
    CHECK(score.covered == Approx(0.95).margin(3 * std::sqrt(0.95 * 0.05 / n)));
    CHECK(std::abs(score.bias) < 3 / std::sqrt(n) + 0.05);
    CHECK(score.spread == Approx(1).margin(3 / std::sqrt(2 * n) + 0.02));
  }
}

}  // namespace

TEST_CASE("intervals of 95 % hold the truth in 95 of 100 films, whose errors are known or estimated", "[invariant]") {
  const ArrayXd t = ArrayXd::LinSpaced(60, 0, 0.5);
  SECTION("known") { check(scores(track_of({pool_ball()}, t, slip_and_spin), slip_and_spin)); }
  SECTION("estimated") { check(scores(track_of({pool_ball()}, t, slip_and_spin, false), slip_and_spin)); }
}

TEST_CASE("intervals hold where friction and patch radius are hardly told apart", "[invariant][.full]") {
  // Two of these instants are of the slip, which ends after 0.2 s; the correlation is -0.99.
  const ArrayXd t = ArrayXd::LinSpaced(90, 0, 9);
  check(scores(track_of({pool_ball()}, t, slip_and_spin), slip_and_spin));
}

TEST_CASE("of positions and angles the intervals hold, too", "[invariant][.full]") {
  si::Experiment ball = pool_ball();
  const std::vector<Seen> seen{{Observable::x, 1e-4}, {Observable::y, 1e-4}, {Observable::angle, 0.02}};
  check(scores(track_of({ball}, ArrayXd::LinSpaced(60, 0, 0.5), seen), seen));
}

TEST_CASE("with Huber's loss one value in twenty may be wrong by far", "[invariant][.full]") {
  const Track film = track_of({pool_ball()}, ArrayXd::LinSpaced(60, 0, 0.5), slip_and_spin, false);
  const auto spoil = [](Track& track, std::mt19937_64& random) {
    for (int i = 0; i < 3; ++i) {
      track.series[0].value[static_cast<Eigen::Index>(random() % 60)] += 0.3;
      track.series[1].value[static_cast<Eigen::Index>(random() % 60)] -= 30;
    }
  };
  const Scores robust = scores(film, slip_and_spin, true, spoil);
  const Scores plain = scores(film, slip_and_spin, false, spoil);
  CHECK(robust.friction.covered > 0.85);
  CHECK(robust.patch.covered > 0.85);
  CHECK(plain.friction.covered + plain.patch.covered < robust.friction.covered + robust.patch.covered);
}
