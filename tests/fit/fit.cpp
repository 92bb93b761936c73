#include "contensou/fit/fit.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "films.hpp"

using namespace contensou;
using namespace contensou::fit;
using Catch::Matchers::Contains;
using Eigen::ArrayXd;

namespace {

/// Returns a ball whose friction and patch radius are unknown, as first guesses.
si::Experiment unknown_ball() {
  si::Experiment ball = pool_ball();
  ball.contact = {.friction = 0.5, .patch = si::PatchRadius{1e-3}};
  ball.start = si::SlipAndSpin{.slip = 0, .spin = 0};
  return ball;
}

Fit fit_of(const std::vector<Track>& tracks, const reduction::Law& law = reduction::HertzLaw{}) {
  return fit::fit({.ball = unknown_ball(), .law = law, .tracks = tracks});
}

}  // namespace

TEST_CASE("a track without errors gives the ball that it is of, under every law", "[route]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    INFO(law.name());
    const Film film{pool_ball(), law};
    const Fit found = fit_of({track_of(film, ArrayXd::LinSpaced(60, 0, 0.5), slip_and_spin)}, law);
    CHECK(found.estimate(Parameter::friction).value == Approx(0.2).epsilon(1e-6));
    CHECK(found.estimate(Parameter::patch_radius).value == Approx(2.827e-3).epsilon(1e-6));
    CHECK(found.estimate(Parameter::slip).value == Approx(1).epsilon(1e-7));
    CHECK(found.estimate(Parameter::spin).value == Approx(100).epsilon(1e-7));
    CHECK(found.chi2 < 1e-8);
  }
}

TEST_CASE("positions and the angle alone give the ball, in any axes", "[route]") {
  si::Experiment ball = pool_ball();
  ball.start = si::Velocities{{0.8, -0.5}, {30, 5, -60}};
  const Film film{ball};
  const ArrayXd t = ArrayXd::LinSpaced(50, 0, 0.6);
  for (const std::vector<Seen>& seen :
       {std::vector<Seen>{{Observable::x, 1e-4}, {Observable::y, 1e-4}, {Observable::angle, 1e-3}},
        std::vector<Seen>{{Observable::vx, 1e-3}, {Observable::vy, 1e-3}, {Observable::spin, 1e-2}}}) {
    Track track = track_of(film, t, seen);
    for (Series& series : track.series) {
      if (series.observable == Observable::x) series.value += 7;  // the origin is the corner of the picture
      // A mark on the ball shows its angle only up to whole turns.
      if (series.observable == Observable::angle) {
        series.value = series.value.unaryExpr([](double angle) { return std::remainder(angle, 2 * std::numbers::pi); });
      }
    }
    const Fit found = fit_of({track});
    INFO(static_cast<int>(seen.back().observable));
    CHECK(found.chi2 < 1e-6);
    CHECK(found.estimate(Parameter::friction).value == Approx(0.2).epsilon(1e-5));
    CHECK(found.estimate(Parameter::patch_radius).value == Approx(2.827e-3).epsilon(1e-4));
    CHECK(found.estimate(Parameter::slip).value == Approx(si::slip_at_start(ball)).epsilon(1e-5));
    const Eigen::Vector2d slip = si::slip_velocity_at_start(ball);
    CHECK(found.estimate(Parameter::direction).value == Approx(std::atan2(slip.y(), slip.x())).epsilon(1e-5));
    const auto& start = std::get<si::Velocities>(found.ball.start);
    CHECK(start.velocity.x() == Approx(0.8).epsilon(1e-5));
    CHECK(start.velocity.y() == Approx(-0.5).epsilon(1e-5));
    CHECK(start.angular_velocity.x() == Approx(30).epsilon(1e-4));
    CHECK(start.angular_velocity.y() == Approx(5).epsilon(1e-3));
    CHECK(start.angular_velocity.z() == Approx(-60).epsilon(1e-5));
  }
}

namespace {

/// Returns a hockey puck, a curling stone on its band, or a ball, with another moment of inertia.
si::Experiment body_named(const char* name, double factor) {
  si::Experiment body = si::find_ball(name)->experiment;
  body.ball.body = body.ball.body.with_factor(factor);
  return body;
}

}  // namespace

TEST_CASE("a film without errors gives any body that it is of", "[route]") {
  for (const auto& [name, factor, law] : {std::tuple{"puck", 0.5, "uniform"},
                                          {"puck", 0.4, "exact"},
                                          {"curling-stone", 0.5, "ring"},
                                          {"basketball", 2.0 / 3, "uniform"},
                                          {"gel", 0.6, "exact"}}) {
    CAPTURE(name, factor);
    const si::Experiment body = body_named(name, factor);
    const Film film{body, *reduction::find_law(law)};
    const double stop = si::Motion::reduced(body, film.law).stop_time();
    si::Experiment unknown = body;
    unknown.contact.friction *= 1.7;
    unknown.start = si::SlipAndSpin{.slip = 0, .spin = 0};
    const ArrayXd t = ArrayXd::LinSpaced(60, 0, 0.8 * stop);
    const Fit found = fit::fit({.ball = unknown,
                                .law = film.law,
                                .tracks = {track_of(film, t, slip_and_spin)},
                                .free = usually_free(unknown)});
    CHECK(found.chi2 < 1e-6);
    CHECK(found.estimate(Parameter::friction).value == Approx(body.contact.friction).epsilon(1e-5));
    CHECK(found.estimate(Parameter::patch_radius).value == Approx(si::patch_radius_of(body, film.law)).epsilon(1e-4));
    CHECK(found.estimate(Parameter::slip).value == Approx(si::slip_at_start(body)).epsilon(1e-6));
    CHECK(found.estimate(Parameter::spin).value == Approx(si::spin_at_start(body)).epsilon(1e-6));
    CHECK(found.ball.ball.body.factor == factor);
    CHECK(si::Motion::reduced(found.ball, film.law).stop_time() == Approx(stop).epsilon(1e-5));
  }
}

TEST_CASE("of a puck the way says slip and friction, whose velocity is the slip", "[route]") {
  si::Experiment puck = body_named("puck", 0.5);
  CHECK_FALSE(usually_free(puck).patch_radius);
  puck.start = si::Velocities{{3, -4}, {0, 0, -80}};
  const Film film{puck, *reduction::find_law("uniform")};
  const Track track = track_of(film, ArrayXd::LinSpaced(50, 0, 4),
                               {{Observable::x, 1e-3}, {Observable::y, 1e-3}, {Observable::angle, 1e-2}});
  si::Experiment unknown = puck;
  unknown.contact.friction = 0.2;
  unknown.start = si::SlipAndSpin{.slip = 1, .spin = 1};
  for (bool of_its_patch : {false, true}) {
    Free free = usually_free(unknown);
    if (of_its_patch) free.patch_radius = true;
    const Fit found = fit::fit({.ball = unknown, .law = film.law, .tracks = {track}, .free = free});
    CHECK(found.chi2 < 1e-5);
    CHECK(found.estimate(Parameter::friction).value == Approx(0.1).epsilon(1e-4));
    CHECK(found.estimate(Parameter::slip).value == Approx(5).epsilon(1e-5));
    CHECK(found.estimate(Parameter::direction).value == Approx(std::atan2(-4, 3)).epsilon(1e-5));
    CHECK(found.estimate(Parameter::spin).value == Approx(-80).epsilon(1e-5));
    CHECK(found.estimate(Parameter::patch_radius).value == Approx(0.0381).epsilon(1e-3));
    CHECK_THROWS_AS(found.estimate(Parameter::vx), std::domain_error);
    CHECK(std::holds_alternative<si::WholeFace>(found.ball.contact.patch) != of_its_patch);
    const auto& start = std::get<si::Velocities>(found.ball.start);
    CHECK(start.velocity.x() == Approx(3).epsilon(1e-5));
    CHECK(start.angular_velocity.x() == 0);
  }
}

TEST_CASE("an interval has every value with which a fit anew is as good", "[route]") {
  // Observations of x and y determine little: slip and friction can change together by decades, up to their limits.
  const si::Experiment gel = gel_ball();
  const std::vector<Seen> seen{{Observable::x, 0.001}, {Observable::y, 0.001}};
  const Track film = track_of({gel}, ArrayXd::LinSpaced(120, 0, 119 / 120.0), seen);
  std::mt19937_64 random(7);
  int inside = 0;
  for (int i = 0; i < 3; ++i) {
    FitRequest request{.ball = gel, .law = reduction::HertzLaw{}, .tracks = {noisy(film, seen, random)}};
    const Fit found = fit::fit(request);
    const Interval interval = found.estimate(Parameter::slip).interval;
    request.free = {.slip = false};
    for (double slip : {0.1, 0.2, 0.5, 1.0, 2.0, 4.0}) {
      request.ball.start = si::SlipAndSpin{.slip = slip, .spin = 30};
      if (fit::fit(request).chi2 - found.chi2 > 3.5) continue;
      INFO("film " << i << ", slip " << slip << ", interval " << interval.low << " to " << interval.high);
      CHECK((interval.low <= slip && slip <= interval.high));
      ++inside;
    }
  }
  CHECK(inside >= 6);
}

TEST_CASE("standard errors are Cramer and Rao's bound, for films of every kind", "[table]") {
  // A table by another program: exact law, f = 0.2, eps = 2.827 mm, v0 = 1 m/s, 100 rad/s; errors 1 cm/s and 1 rad/s.
  struct Row {
    double end, rate;
    bool slip, spin;
    double friction, patch, correlation;
  };
  for (const Row& row : {Row{0.5, 250, true, true, 0.008, 0.031, 0.66}, Row{9, 50, true, true, 0.011, 0.011, -0.99},
                         Row{0.1, 250, true, true, 0.029, 0.58, 2}, Row{0.5, 250, false, true, 1.75, 1.79, -0.998},
                         Row{0.5, 250, true, false, 0.011, 9.9, 2}}) {
    const auto rows = static_cast<Eigen::Index>(row.end * row.rate) + 1;
    Track track{.name = "plan", .t = ArrayXd::LinSpaced(rows, 0, row.end)};
    if (row.slip) track.series.push_back({Observable::slip, {}, ArrayXd::Constant(rows, 0.01)});
    if (row.spin) track.series.push_back({Observable::spin, {}, ArrayXd::Constant(rows, 1)});
    const Fit planned = plan({.ball = pool_ball(), .law = reduction::HertzLaw{}, .tracks = {track}});
    INFO(row.end << " s, slip " << row.slip << ", spin " << row.spin);
    CHECK(planned.estimate(Parameter::friction).standard_error / 0.2 == Approx(row.friction).epsilon(0.07));
    CHECK(planned.estimate(Parameter::patch_radius).standard_error / 2.827e-3 == Approx(row.patch).epsilon(0.07));
    if (row.correlation < 1) CHECK(planned.correlation_of_contact() == Approx(row.correlation).margin(0.02));
  }
}
