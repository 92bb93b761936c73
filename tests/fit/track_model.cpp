#include "fit/track_model.hpp"

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "films.hpp"

using namespace contensou;
using namespace contensou::fit;
using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Compares the derivatives of a model with differences of its values.
void check_derivatives(const TrackModel& model, const VectorXd& parameters, Index of_series, double tolerance) {
  std::vector<Index> all(static_cast<std::size_t>(model.parameters()));
  std::iota(all.begin(), all.end(), 0);
  const Eigen::MatrixXd derivatives = model.derivatives(parameters, all);
  for (Index place : all) {
    const double size = std::abs(parameters[place]);
    // For a number with the lower limit 0, the step is a share of the number.
    const bool bounded = size > 0 && model.range(place).low == 0;
    const double step = 1e-4 * (bounded ? size : std::max(1.0, size));
    const VectorXd more = parameters + step * VectorXd::Unit(parameters.size(), place);
    const VectorXd less = parameters - step * VectorXd::Unit(parameters.size(), place);
    const VectorXd expected = (model.values(more) - model.values(less)) / (2 * step);
    INFO("parameter " << place);
    // Compare each series alone, because the patch affects one series much less than another.
    for (Index first = 0; first < model.rows();) {
      const Index count = first % (7 * of_series + 1) == 7 * of_series ? 1 : of_series;
      INFO("rows from " << first);
      const VectorXd part = expected.segment(first, count);
      CHECK((derivatives.col(place).segment(first, count) - part).norm() <= tolerance * part.norm() + 1e-8);
      first += count;
    }
  }
}

/// Returns a track with all observables at thirty instants from 0.3 s on.
Track all_seen_until(double last) {
  Track track{.name = "model", .t = ArrayXd::LinSpaced(30, 0.3, last), .start = 0.3};
  for (const ObservableKind& kind : observable_kinds()) track.series.push_back({kind.observable, track.t, {}});
  track.stop_time = Measured{9, 0.1};
  return track;
}

}  // namespace

TEST_CASE("derivatives of all that is seen are those of differences", "[route]") {
  const Track track = all_seen_until(1.3);
  const std::vector<Track> tracks{track, track};
  for (const reduction::Law& law : reduction::paper_laws()) {
    for (const auto& [slip, spin] :
         std::vector<std::pair<double, double>>{{1, 100}, {-0.4, -70}, {0.02, 60}, {1, 0.5}, {1, 0}, {0, 60}}) {
      // On an axis the step of a difference crosses a kink of |u| or |v|.
      const double tolerance = slip == 0 || spin == 0 ? 1e-4 : 3e-6;
      const TrackModel model(pool_ball(), law, tracks, FilmOrbit::standard_accuracy);
      VectorXd parameters(model.parameters());
      parameters << std::log(0.2), std::log(2e-3), 0, slip, spin, 0.7, 0.3, -0.2, 4, 5, 6, 0, 0.5, 50, -2, 0.1, 0.2,
          0.3, 0.4, 0.5, 0;
      INFO(law.name() << ", slip " << slip << ", spin " << spin);
      check_derivatives(model, parameters, track.t.size(), tolerance);
    }
  }
}

TEST_CASE("derivatives of a ball with rolling friction are those of differences, also when it no longer turns",
          "[route]") {
  // The centre rests after about 7 s. The spin ends later.
  const Track track = all_seen_until(8.7);
  const std::vector<Track> tracks{track};
  for (const reduction::Law& law : reduction::paper_laws()) {
    for (const auto& [slip, spin, rolling] : std::vector<std::tuple<double, double, double>>{
             {1, 100, 0.01}, {0.4, -70, 0.3}, {0.002, 60, 0.1}, {1, 5, 0.2}}) {
      const TrackModel model(pool_ball(), law, tracks, 1e-12, true);
      VectorXd parameters(model.parameters());
      parameters << std::log(0.2), std::log(2e-3), 0.01, slip, spin, 0.7, 0, 0, 4, 5, 6, rolling;
      INFO(law.name() << ", slip " << slip << ", spin " << spin << ", rolling " << rolling);
      // After the ball has ceased to turn, its slip vanishes within a hundredth of a second.
      check_derivatives(model, parameters, track.t.size(), 3e-4);
    }
  }
}

TEST_CASE("derivatives of the motion of a puck are those of differences, on its ray and on the axes, too", "[route]") {
  const Track track = all_seen_until(3.1);
  const std::vector<Track> tracks{track};
  const si::Experiment puck = si::find_ball("puck")->experiment;
  for (const char* name : {"uniform", "exact", "annulus:0.5"}) {
    const TrackModel model(puck, *reduction::find_law(name), tracks, FilmOrbit::standard_accuracy);
    const double R = puck.ball.radius;
    for (const auto& [slip, spin, patch] :
         std::vector<std::tuple<double, double, double>>{{5, 100, 0.9 * R},
                                                         {-2, 30, 0.5 * R},
                                                         {3, -300, 0.9 * R},
                                                         {0.6530017892055 * 0.9, 0.9 / R, 0.999 * R},
                                                         {4, 0, R / 2},
                                                         {0, 60, R / 2}}) {
      INFO(name << ", slip " << slip << ", spin " << spin);
      VectorXd parameters(model.parameters());
      parameters << std::log(0.1), std::log(patch), 0, slip, spin, 0.7, 0, 0, 4, 5, 6, 0;
      check_derivatives(model, parameters, track.t.size(), slip == 0 || spin == 0 ? 1e-4 : 3e-6);
    }
  }
}
