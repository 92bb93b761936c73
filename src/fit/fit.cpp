#include "contensou/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "fit/report.hpp"
#include "fit/search.hpp"
#include "fit/turns.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

bool of_all_tracks(Parameter parameter) { return static_cast<int>(parameter) < shared_parameters; }

/// Replaces a negative slip by a positive one in the opposite direction, if no series shows the slip. If no series
/// shows the sense of the spin, the spin gets the sense of the spin of request.ball.
VectorXd with_signs(const FitRequest& request, VectorXd parameters) {
  for (std::size_t i = 0; i < request.tracks.size(); ++i) {
    const auto sees = [&](Observable observable) { return series_of(request.tracks[i], observable) != nullptr; };
    double& slip = parameters[TrackModel::place(Parameter::slip, i)];
    double& spin = parameters[TrackModel::place(Parameter::spin, i)];
    double& direction = parameters[TrackModel::place(Parameter::direction, i)];
    if (slip < 0 && !sees(Observable::slip)) {
      slip = -slip;
      direction += std::numbers::pi;
    }
    direction = std::remainder(direction, 2 * std::numbers::pi);
    if (request.free.spin && !sees(Observable::spin) && !sees(Observable::angle))
      spin = std::copysign(spin, si::spin_at_start(request.ball));
  }
  return parameters;
}

void require(const FitRequest& request) {
  si::require_experiment(request.ball);
  const auto& [ball, contact, start, environment, spreads] = request.ball;
  if (environment.slope != 0)
    throw std::domain_error(
        fmt::format("fit: a film is of a ball on a level plane: slope must be 0, got {} degrees", environment.slope));
  if (ball.body.lies_flat() && (contact.rolling_friction > 0 || request.free.rolling_friction))
    throw std::domain_error(fmt::format("fit: a {} does not roll: rolling_friction must be 0", ball.body.name));
  if (request.tracks.empty()) throw std::domain_error("fit: there is no track");
  for (const Track& track : request.tracks) require(track);
}

/// Throws if friction or patch radius of the ball is outside the limits of the model. Only values that are not free, or
/// that a plan uses, are tested: a search may start from values outside the limits.
void require_limits(const Search& search, bool planned) {
  const si::Contact& contact = search.request.ball.contact;
  const Free& free = search.request.free;
  const bool held = planned || (!free.friction && !free.rolling_friction);
  if (held && contact.rolling_friction >= contact.friction)
    throw std::domain_error(fmt::format("fit: rolling friction below friction, {}, is required; got {}",
                                        contact.friction, contact.rolling_friction));
  const VectorXd given = search.given(), limited = search.model.limited(given);
  for (Index place = 0; place < contact_parameters; ++place) {
    const bool searched = !planned && std::ranges::find(search.free, place) != search.free.end();
    if (searched || limited[place] == given[place]) continue;
    const ParameterKind& kind = kind_of(static_cast<Parameter>(place));
    const auto [low, high] = search.model.range(place);
    throw std::domain_error(fmt::format("fit: {} from {:.3g} to {:.3g}{}{} is required under the law {}; got {:.6g}",
                                        kind.name, std::exp(low), std::exp(high), kind.unit.empty() ? "" : " ",
                                        kind.unit, search.request.law.name(), std::exp(given[place])));
  }
}

}  // namespace

Free usually_free(const si::Experiment& ball) {
  const bool whole_face = std::holds_alternative<si::WholeFace>(ball.contact.patch);
  return {
      .patch_radius = !whole_face, .rolling_friction = ball.contact.rolling_friction > 0, .patch_if_seen = whole_face};
}

const ParameterKind& kind_of(Parameter parameter) {
  static const ParameterKind all[]{
      {"friction", "", "coefficient of dry friction"},
      {"patch_radius", "m", "radius of the contact patch"},
      {"rolling_friction", "", "coefficient of rolling friction"},
      {"slip", "m/s", "sliding speed at the start"},
      {"spin", "rad/s", "angular velocity about the vertical at the start"},
      {"direction", "rad", "of the slip, from the x axis"},
      {"vx", "m/s", "velocity of the centre at the start"},
      {"vy", "m/s", "velocity of the centre at the start"},
      {"x", "m", "place of the centre at the start"},
      {"y", "m", "place of the centre at the start"},
      {"angle", "rad", "at the start"},
      {"rolling", "m/s", "at which it rolls along the slip at the start"},
  };
  return all[static_cast<std::size_t>(parameter)];
}

std::string Combination::name() const {
  if (patch_power == 0) return "friction";
  if (friction_power == 0) return "patch_radius";
  return patch_power > 0 ? "the product friction patch_radius" : "the ratio friction/patch_radius";
}

std::string Combination::unit() const { return patch_power == 0 ? "" : patch_power > 0 ? "m" : "1/m"; }

const Estimate& Fit::estimate(Parameter parameter, std::size_t track) const {
  const auto found = std::ranges::find_if(estimates, [&](const Estimate& each) {
    return each.parameter == parameter && (of_all_tracks(parameter) || each.track == track);
  });
  if (found == estimates.end()) {
    throw std::domain_error(fmt::format("Fit::estimate: track {} has no {}", track, kind_of(parameter).name));
  }
  return *found;
}

std::vector<const Estimate*> Fit::free_estimates() const {
  std::vector<const Estimate*> result;
  for (const Estimate& each : estimates) {
    if (each.free) result.push_back(&each);
  }
  return result;
}

bool Fit::rolls_with_friction() const { return estimates[2].parameter == Parameter::rolling_friction; }

double Fit::correlation_of_contact() const { return estimates[0].free && estimates[1].free ? correlation(0, 1) : 0; }

std::vector<double> Fit::other_spins(std::size_t track) const {
  std::vector<double> spins = turns[track].other_spins;
  for (const OtherMotion& each : other_motions) {
    if (each.track == track) spins.push_back(each.spin);
  }
  return spins;
}

namespace {

/// @param starts  guesses, of which the first is nearly the solution; without guesses the search finds its own
Fit fit_from(std::vector<VectorXd> starts, const FitRequest& asked) {
  require(asked);
  FitRequest request = asked;
  const std::vector<Turns> turns = set_turns(request);
  Search search(request);
  require_limits(search, false);
  search.guesses = std::move(starts);
  VectorXd solution = search.guesses.empty() ? search.solve() : search.settled(search.guesses.front());
  constexpr int most = 10;  // largest number of restarts from a better solution that a likelihood profile found
  for (int i = 0;; ++i) {
    Report report = Reporter(search, with_signs(request, solution), false).report();
    if (report.better && i < most) {
      solution = search.settled(*report.better);
      continue;
    }
    report.fit.turns = turns;
    const bool turning = std::ranges::any_of(request.tracks, [](const Track& track) {
      return series_of(track, Observable::spin) != nullptr || series_of(track, Observable::angle) != nullptr;
    });
    if (report.fit.patch_seen && request.free.patch_if_seen && turning) {
      FitRequest with_patch = asked;
      with_patch.free.patch_radius = true;
      Fit other = fit_from(std::move(report.with_patch), with_patch);
      const Estimate& patch = other.estimates[1];
      if (patch.value + too_rare * patch.standard_error > asked.ball.ball.radius) {
        // Akaike's criterion takes errors for independent. Errors that depend on each other imitate a patch.
        report.fit.patch_seen.reset();
      } else if (patch.standard_error < unknown * patch.value) {
        other.patch_seen = report.fit.patch_seen;
        return other;
      }
    }
    return std::move(report.fit);
  }
}

}  // namespace

Fit fit(const FitRequest& asked) { return fit_from({}, asked); }

std::vector<Fit> fit_laws(const FitRequest& request, const std::vector<reduction::Law>& laws) {
  std::vector<Fit> fits;
  for (const reduction::Law& law : laws) {
    FitRequest one = request;
    one.law = law;
    fits.push_back(fit(one));
  }
  std::ranges::stable_sort(fits, {}, &Fit::aic);
  return fits;
}

Fit plan(const FitRequest& asked) {
  FitRequest request = asked;
  si::require_experiment(request.ball);
  for (Track& track : request.tracks) {
    for (Series& series : track.series) {
      if (series.sd.size() == 0)
        throw std::domain_error(fmt::format("plan: {} needs standard deviations", kind_of(series.observable).name));
      series.value = Eigen::ArrayXd::Zero(track.t.size());
    }
  }
  require(request);
  const Search search(request);
  require_limits(search, true);
  Fit result = Reporter(search, search.given(), true).report().fit;
  for (const Track& track : request.tracks) result.turns.push_back({half_turn_spin(track)});
  return result;
}

}  // namespace contensou::fit
