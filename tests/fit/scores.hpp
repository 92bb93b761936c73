#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/fit/fit.hpp"
#include "contensou/reduction/laws.hpp"
#include "films.hpp"

namespace contensou::fit {

inline constexpr int trials = CONTENSOU_FULL_TESTS ? 1000 : 40;

/// Score of a parameter over many films: the share of the 95 % intervals that contain the true value; the mean error,
/// relative and in standard errors; the root mean square of the error in standard errors.
struct Score {
  double covered = 0, error = 0, bias = 0, spread = 0;
};
struct Scores {
  Score friction, patch;
  double reduced_chi2 = 0;
};

struct Films {
  Track film;  ///< without errors
  std::vector<Seen> seen;
  bool robust = false;
  std::function<void(Track&, std::mt19937_64&)> spoil = {};  ///< adds another disturbance to a film
};

inline Scores scores(const Films& films) {
  std::mt19937_64 random(7);
  const double truth[] = {0.2, 2.827e-3};
  Scores result;
  for (int i = 0; i < trials; ++i) {
    Track track = noisy(films.film, films.seen, random);
    if (films.spoil) films.spoil(track, random);
    const Fit found = fit::fit(
        {.ball = pool_ball(), .law = reduction::HertzLaw{}, .tracks = {track}, .free = {}, .robust = films.robust});
    result.reduced_chi2 += found.reduced_chi2() / trials;
    for (int place : {0, 1}) {
      Score& score = place == 0 ? result.friction : result.patch;
      const Estimate& estimate = found.estimates[static_cast<std::size_t>(place)];
      const double error = std::log(estimate.value / truth[place]);
      const double in_standard_errors = error * estimate.value / estimate.standard_error;
      score.covered +=
          (estimate.interval.low <= truth[place] && truth[place] <= estimate.interval.high) / double{trials};
      score.error += error / trials;
      score.bias += in_standard_errors / trials;
      score.spread += in_standard_errors * in_standard_errors / trials;
    }
  }
  for (Score* score : {&result.friction, &result.patch}) {
    score->spread = std::sqrt(score->spread);
    UNSCOPED_INFO("covered " << score->covered << ", error " << score->error << ", bias " << score->bias
                             << " and spread " << score->spread << " in standard errors; reduced chi^2 "
                             << result.reduced_chi2);
  }
  return result;
}

inline const Eigen::ArrayXd half_second = Eigen::ArrayXd::LinSpaced(60, 0, 0.5);

/// Checks that intervals contain the truth in 95 % of the films, minus three standard deviations of such a count.
inline void check_covered(const Scores& scores) {
  for (const Score& score : {scores.friction, scores.patch}) {
    CHECK(score.covered == Approx(0.95).margin(3 * std::sqrt(0.95 * 0.05 / trials)));
  }
}

/// Checks the intervals as check_covered does, and checks that the errors are as large as reported.
inline void check(const Scores& scores) {
  check_covered(scores);
  const double n = trials;
  for (const Score& score : {scores.friction, scores.patch}) {
    CHECK(std::abs(score.bias) < 3 / std::sqrt(n) + 0.05);
    CHECK(score.spread == Approx(1).margin(3 / std::sqrt(2 * n) + 0.02));
  }
}

}  // namespace contensou::fit
