// What becomes of estimates where a film is not what it says: outliers, times that are late, pictures that are lost.
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "scores.hpp"

using namespace contensou;
using namespace contensou::fit;
using Eigen::ArrayXd;

TEST_CASE("with Huber's loss one value in twenty may be wrong by far", "[invariant]") {
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
  CHECK(plain.friction.covered + plain.patch.covered < robust.friction.covered + robust.patch.covered);
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
    CHECK(lost.reduced_chi2 > 1.3);  // the film tells that something is wrong
  }
  SECTION("the law is another one") {
    const Film other{pool_ball(), reduction::PressureLaw::uniform()};
    const Scores wrong = scores({track_of(other, half_second, slip_and_spin), slip_and_spin});
    // What this film shows is f and f eps Psi(0), which is kept; so it does not tell that the law is wrong.
    const double factor = other.law.pivoting_moment() / reduction::Law(reduction::HertzLaw{}).pivoting_moment();
    CHECK(std::abs(wrong.friction.error) < 0.01);
    CHECK(wrong.patch.error == Approx(std::log(factor)).margin(0.02));
    CHECK(wrong.reduced_chi2 == Approx(1).margin(0.03));
  }
}
