#pragma once

#include <string>
#include <utility>
#include <vector>

#include "answers/verbs/uncertainty.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/event_gradient.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::answers {

/// What the events of a motion are known to: its first order by si::EventNumbers::slopes.
struct RollUncertainty : Sampled {
  /// A number of an event.
  struct Part {
    std::string event, of;  ///< as in JSON: rolls_after and t; slip_length and nothing
    std::string unit;
    double value;
    KnownTo known;
  };
  std::vector<Part> parts = {};
};

/// @param rolling_below  as of si::Motion::rolls
/// @param typed          as read_spreads has it: of the ball's numbers, and of the start slip, spin or vx, vy, wx, wy, wz
/// @throws BadInput  as read_spreads, of a motion that is at rest, and where all samples are outside
RollUncertainty roll_uncertainty(const si::Experiment& experiment, const reduction::Law& law, double rolling_below,
                                 const std::string& typed);

/// {rolls_after: {t: {NAME: slope, ...}, x, y}, ...}, by the names of components.
Json members_of(const si::EventGradient& gradient);

/// A table of them.
std::string text_of(const si::EventGradient& gradient, const Digits& digits);

/// {rolls_after: {t, x, y}, spin_ends: {t, x, y}, slip_length, turns, path, t_stop, samples, outside}
Json members_of(const RollUncertainty& uncertainty);

std::string text_of(const RollUncertainty& uncertainty, const Digits& digits);

}  // namespace contensou::answers
