// Estimates from films that differ from their description: outliers, wrong times, lost pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "fit/dependence.hpp"
#include "scores.hpp"

using namespace contensou;
using namespace contensou::fit;
using Eigen::ArrayXd;

namespace {

/// Counts those films of a motion for which the fit reports a misfit, or determines neither friction nor patch radius
/// nor a combination of both.
struct Told {
  int misfits = 0, open = 0;
};

/// @param values  returns the values of the columns at a time, with their errors
template <class Values>
Told told(const char* name, const std::vector<Observable>& columns, int films, Values values) {
  const si::Experiment ball = si::find_ball(name)->experiment;
  Told result;
  for (int film = 0; film < films; ++film) {
    Track track{.name = "film", .t = ArrayXd::LinSpaced(120, 0, 119 / 120.0)};
    for (Observable observable : columns) track.series.push_back({observable, ArrayXd(track.t.size()), {}});
    for (Eigen::Index i = 0; i < track.t.size(); ++i) {
      const auto at = values(track.t[i]);
      for (std::size_t column = 0; column < columns.size(); ++column) track.series[column].value[i] = at[column];
    }
    const Fit found = fit::fit(
        {.ball = ball, .law = *reduction::find_law(ball.ball.body.law), .tracks = {track}, .free = usually_free(ball)});
    const auto is_found = [&](const Estimate& each) { return each.free && each.determined(); };
    if (!found.fits()) {
      ++result.misfits;
    } else if (!is_found(found.estimates[0]) && !is_found(found.estimates[1]) && !found.only) {
      ++result.open;
    }
  }
  return result;
}

}  // namespace

TEST_CASE("films of other motions do not fit, or leave friction and patch radius open", "[invariant]") {
  constexpr int films = CONTENSOU_FULL_TESTS ? 50 : 3;
  using enum Observable;
  const std::vector<Observable> place{x, y};
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto with_errors = [&](double first, double sd, double second, double other_sd) {
    return std::array{first + sd * normal(random), second + other_sd * normal(random)};
  };
  SECTION("air drag, v' = -v^2/2") {
    const Told drag =
        told("puck", place, films, [&](double t) { return with_errors(2 * std::log1p(t), 1e-3, 0, 1e-3); });
    CHECK(drag.misfits == films);
  }
  SECTION("a random walk of 1 cm a picture") {
    for (const char* ball : {"pool", "puck"}) {
      std::array<double, 2> at{};
      const Told walk = told(ball, place, films, [&](double t) {
        if (t == 0) at = {};
        return at = with_errors(at[0], 0.01, at[1], 0.01);
      });
      CHECK(walk.misfits == films);
    }
  }
  SECTION("a speed that falls as exp(-2 t): x and y alone do not tell it from a ball whose patch is wide") {
    const Told slowing =
        told("pool", place, films, [&](double t) { return with_errors(1 - std::exp(-2 * t), 1e-3, 0, 1e-3); });
    // In the model a fast spin makes v fall like exp(-2 t), too. Some films determine this spin by a combination.
    // A count of films may lie two standard deviations below its mean.
    CHECK(slowing.misfits + slowing.open >= 0.85 * films - 2 * std::sqrt(0.85 * 0.15 * films));
  }
  SECTION("a slip 2/(1 + t) beside a spin that falls as exp(-t/2)") {
    const Told hyperbolic = told("pool", {slip, spin}, films,
                                 [&](double t) { return with_errors(2 / (1 + t), 0.01, 50 * std::exp(-t / 2), 1); });
    CHECK(hyperbolic.misfits == films);
  }
}

TEST_CASE("a film of a puck on a part of its face gives this patch, or proposes it", "[invariant]") {
  // A puck that stands on its whole face keeps it.
  using enum Observable;
  std::mt19937_64 random(3);
  const std::vector<Seen> seen{{x, 3e-4}, {y, 3e-4}, {spin, 0.3}};
  const reduction::Law law = *reduction::find_law("uniform");
  si::Experiment puck = si::find_ball("puck")->experiment;
  puck.ball.radius = 0.02;
  for (int film = 0; film < (CONTENSOU_FULL_TESTS ? 40 : 5); ++film) {
    const auto among = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const double part = film % 5 == 0 ? 1 : among(0.4, 0.8);
    si::Experiment seen_puck = puck;
    if (part < 1) seen_puck.contact.patch = si::PatchRadius{part * puck.ball.radius};
    seen_puck.contact.friction = among(0.1, 0.3);
    seen_puck.start = si::SlipAndSpin{among(0.4, 0.8), among(15, 30)};
    const double end = si::Motion::reduced(seen_puck, law).stop_time();
    const Track track = noisy(track_of({seen_puck, law}, ArrayXd::LinSpaced(110, 0, end), seen, false), seen, random);
    const Fit found = fit::fit({.ball = puck, .law = law, .tracks = {track}, .free = usually_free(puck)});
    INFO("film " << film << ", patch " << part);
    CHECK(found.fits());
    REQUIRE(found.estimates[1].free == (part < 1));
    Free held = usually_free(puck);
    held.patch_if_seen = false;
    const Fit whole = fit::fit({.ball = puck, .law = law, .tracks = {track}, .free = held});
    REQUIRE(whole.patch_seen.has_value() == (part < 1));
    if (part == 1) continue;
    CHECK_FALSE(whole.fits());
    CHECK(found.estimates[1].value == Approx(part * puck.ball.radius).epsilon(0.02));
    CHECK(whole.patch_seen->radius == Approx(part * puck.ball.radius).epsilon(0.02));
    CHECK(whole.patch_seen->friction == Approx(seen_puck.contact.friction).epsilon(0.02));
  }
}

TEST_CASE("gross errors in 30 % of the values hide one another, and are told", "[invariant]") {
  constexpr int films = CONTENSOU_FULL_TESTS ? 100 : 10;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const ArrayXd t = ArrayXd::LinSpaced(120, 0, 0.5);
  const Track film = track_of({pool_ball()}, t, slip_and_spin, false);
  const auto is_told = [](const Track& track) {
    const Fit found = fit::fit({.ball = pool_ball(), .law = reduction::HertzLaw{}, .tracks = {track}});
    return std::ranges::any_of(found.noise,
                               [](const Noise& noise) { return noise.hides_outliers() || !noise.outliers.empty(); });
  };
  int alarms = 0;
  for (int i = 0; i < films; ++i) alarms += is_told(noisy(film, slip_and_spin, random)) ? 1 : 0;
  CHECK(alarms <= films / 50);
  // The errors have one size and one sign, one size and both signs, or are normal.
  for (const int kind : {0, 1, 2}) {
    int told = 0;
    for (int i = 0; i < films; ++i) {
      Track bad = noisy(film, slip_and_spin, random);
      for (std::size_t column = 0; column < 2; ++column) {
        const double size = 20 * slip_and_spin[column].sd;
        for (double& value : bad.series[column].value) {
          if (random() % 10 >= 3) continue;
          value += kind == 0 ? size : kind == 1 ? (random() % 2 == 0 ? size : -size) : size * normal(random);
        }
      }
      told += is_told(bad) ? 1 : 0;
    }
    INFO("kind " << kind);
    CHECK(told >= 0.9 * films);
  }
}

TEST_CASE("films of the ball itself fit, with errors and without", "[invariant]") {
  constexpr int films = CONTENSOU_FULL_TESTS ? 1000 : 10;
  std::mt19937_64 random(1);
  for (Eigen::Index rows : {20, 60, 240}) {
    const Track film = track_of({pool_ball()}, ArrayXd::LinSpaced(rows, 0, 0.5), slip_and_spin, false);
    int alarms = 0;
    for (int i = 0; i < films; ++i) {
      const Fit found =
          fit::fit({.ball = pool_ball(), .law = reduction::HertzLaw{}, .tracks = {noisy(film, slip_and_spin, random)}});
      alarms += found.fits() ? 0 : 1;
    }
    INFO(rows << " rows");
    CHECK(alarms <= films / 1000);
    CHECK(fit::fit({.ball = pool_ball(), .law = reduction::HertzLaw{}, .tracks = {film}}).fits());
  }
}

TEST_CASE("intervals grow where errors depend on their neighbours", "[invariant]") {
  // Errors j rows apart have the correlation c^j. The variance of a mean is therefore (1 + c)/(1 - c) times larger.
  const double c = 0.3;
  const auto spoil = [&](Track& track, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    for (std::size_t column = 0; column < 2; ++column) {
      double error = normal(random);
      for (double& value : track.series[column].value) {
        value += slip_and_spin[column].sd * error;
        error = c * error + std::sqrt(1 - c * c) * normal(random);
      }
    }
  };
  const std::vector<Seen> none{{Observable::slip, 0}, {Observable::spin, 0}};
  const Scores dependent = scores({track_of({pool_ball()}, half_second, none, false), none, false, spoil});
  CHECK(dependent.friction.covered > 0.89);
  CHECK(dependent.patch.covered > 0.89);
  CHECK(dependent.friction.spread < 1.25);
}

TEST_CASE("how errors depend on each other is found from their residuals", "[route]") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const double c : {0.0, 0.5}) {
    Eigen::MatrixXd errors(200000, 1);
    double error = normal(random);
    for (double& each : errors.reshaped()) {
      each = error;
      error = c * error + std::sqrt(1 - c * c) * normal(random);
    }
    const Dependence found = dependence_of({errors});
    CHECK(found.neighbours == Approx(c).margin(0.01));
    CHECK(found.growth == Approx((1 + c) / (1 - c)).epsilon(0.1));
  }
  // No correlation exceeds 1, even if neighbours are equal.
  CHECK(dependence_of({Eigen::VectorXd::LinSpaced(30, -1, 1)}).neighbours <= 1);
  CHECK(dependence_of({Eigen::VectorXd::Ones(30)}).neighbours == 1);
  Eigen::VectorXd bow = Eigen::VectorXd::LinSpaced(30, -1, 1).array().square() - 1;
  CHECK(dependence_of({bow}).neighbours <= 1);
  // This fit removes only a constant and a slope from the white noise: residuals are nearly the errors themselves.
  double neighbours = 0, growth = 0;
  constexpr int films = 1000;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(100, -1, 1);
  Eigen::MatrixXd A(100, 2);
  A << Eigen::VectorXd::Constant(100, 0.1), t / t.norm();
  for (int i = 0; i < films; ++i) {
    const Eigen::VectorXd errors = t.unaryExpr([&](double) { return normal(random); });
    Eigen::MatrixXd z(100, 3);
    z << errors - A * (A.transpose() * errors), A;
    neighbours += dependence_of({z}).neighbours / films;
    growth += dependence_of({z}).growth / films;
  }
  CHECK(neighbours == Approx(0).margin(0.02));
  CHECK(growth == Approx(1).margin(0.05));
}

TEST_CASE("with Huber's loss one value in twenty may be wrong by far", "[invariant][.full]") {
  const Track film = track_of({pool_ball()}, half_second, slip_and_spin, false);
  const auto spoil = [](Track& track, std::mt19937_64& random) {
    for (int i = 0; i < 3; ++i) {
      track.series[0].value[static_cast<Eigen::Index>(random() % 60)] += 0.3;
      track.series[1].value[static_cast<Eigen::Index>(random() % 60)] -= 30;
    }
  };
  const Scores robust = scores({film, slip_and_spin, true, spoil});
  const Scores plain = scores({film, slip_and_spin, false, spoil});
  CHECK(robust.friction.covered > 0.85);
  CHECK(robust.patch.covered > 0.85);
  CHECK(std::abs(robust.patch.bias) < std::abs(plain.patch.bias));
  CHECK(robust.patch.spread < plain.patch.spread);
}

TEST_CASE("what a film that is wrong makes of friction and patch radius", "[invariant]") {
  const Track film = track_of({pool_ball()}, half_second, slip_and_spin);
  const double frame = half_second[1];
  SECTION("all times are late: only slip and spin are those of another instant") {
    const Scores late = scores({film, slip_and_spin, false, [&](Track& track, auto&) { track.t += frame; }});
    check(late);
  }
  SECTION("the spin is that of the middle between two pictures") {
    Film between{pool_ball()};
    Track track = film;
    for (Eigen::Index i = 0; i < 60; ++i)
      track.series[1].value[i] = between.value(Observable::spin, half_second[i] + frame / 2);
    const Scores shifted = scores({track, slip_and_spin});
    CHECK(std::abs(shifted.friction.error) < 0.005);
    CHECK(std::abs(shifted.patch.error) < 0.01);
  }
  SECTION("one picture in ten is lost and the others are numbered through") {
    const auto lose = [&](Track& track, std::mt19937_64& random) {
      std::vector<Eigen::Index> kept;
      for (Eigen::Index i = 0; i < 60; ++i) {
        if (i == 0 || random() % 10 != 0) kept.push_back(i);
      }
      const auto count = static_cast<Eigen::Index>(kept.size());
      track.t = half_second.head(count).eval();
      for (Series& series : track.series) {
        series.value = ArrayXd(series.value(kept));
        series.sd = ArrayXd(series.sd(kept));
      }
    };
    const Scores lost = scores({film, slip_and_spin, false, lose});
    CHECK(lost.friction.error == Approx(0.107).margin(0.01));
    CHECK(lost.friction.covered < 0.5);
    CHECK(lost.reduced_chi2 > 1.3);  // chi^2 shows that the film is wrong
  }
  SECTION("the law is another one") {
    const Film other{pool_ball(), reduction::PressureLaw::uniform()};
    const Scores wrong = scores({track_of(other, half_second, slip_and_spin), slip_and_spin});
    // This film shows only f and f eps Psi(0). The wrong law can fit both, so the film cannot exclude this law.
    const double factor = other.law.pivoting_moment() / reduction::Law(reduction::HertzLaw{}).pivoting_moment();
    CHECK(std::abs(wrong.friction.error) < 0.01);
    CHECK(wrong.patch.error == Approx(std::log(factor)).margin(0.02));
    CHECK(wrong.reduced_chi2 == Approx(1).margin(0.03));
  }
}
