#pragma once

#include <random>
#include <vector>

#include "contensou/fit/fit.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/motion.hpp"

/// A film of a ball without errors.
struct Film {
  contensou::si::Experiment ball;
  contensou::reduction::Law law = contensou::reduction::HertzLaw{};

  double value(contensou::fit::Observable observable, double t) const {
    using enum contensou::fit::Observable;
    const contensou::si::Motion motion = contensou::si::Motion::reduced(ball, law);
    const contensou::si::MotionPoint at = motion.at(t);
    switch (observable) {
      case slip:
        return at.slip;
      case spin:
        return at.angular_velocity.z();
      case x:
        return at.position.x();
      case y:
        return at.position.y();
      case vx:
        return at.velocity.x();
      case vy:
        return at.velocity.y();
      case angle:
        break;
    }
    // Integrate from the start by Simpson's rule.
    constexpr int steps = 2000;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
      sum += (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) * motion.at(t * i / steps).angular_velocity.z();
    }
    return sum * t / (3 * steps);
  }
};

/// The pool ball of the tables in src/fit/README.md.
inline contensou::si::Experiment pool_ball() {
  return {.ball = {.name = "pool", .mass = 0.17, .radius = 0.028575},
          .contact = {.friction = 0.2, .patch = contensou::si::PatchRadius{2.827e-3}},
          .start = contensou::si::SlipAndSpin{.slip = 1, .spin = 100}};
}

/// A gel ball, whose patch is wide.
inline contensou::si::Experiment gel_ball() {
  return {.ball = {.name = "gel", .mass = 0.113, .radius = 0.03},
          .contact = {.friction = 0.5, .patch = contensou::si::PatchRadius{7.2e-3}},
          .start = contensou::si::SlipAndSpin{.slip = 0.5, .spin = 30}};
}

struct Seen {
  contensou::fit::Observable observable;
  double sd;
};

inline const std::vector<Seen> slip_and_spin{{contensou::fit::Observable::slip, 0.01},
                                             {contensou::fit::Observable::spin, 1}};

/// Returns a track of a ball without errors.
/// @param with_sd  true: the track contains its standard deviations
inline contensou::fit::Track track_of(const Film& film, const Eigen::ArrayXd& t, const std::vector<Seen>& seen,
                                      bool with_sd = true) {
  contensou::fit::Track track{.name = "film", .t = t};
  for (const auto& [observable, sd] : seen) {
    Eigen::ArrayXd values(t.size());
    for (Eigen::Index i = 0; i < t.size(); ++i) values[i] = film.value(observable, t[i]);
    track.series.push_back({observable, values, with_sd ? Eigen::ArrayXd::Constant(t.size(), sd) : Eigen::ArrayXd()});
  }
  return track;
}

/// Returns the same track with normal errors.
inline contensou::fit::Track noisy(contensou::fit::Track track, const std::vector<Seen>& seen,
                                   std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (double& value : track.series[i].value) value += seen[i].sd * normal(random);
  }
  return track;
}
