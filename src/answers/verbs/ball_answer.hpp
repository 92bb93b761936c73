#pragma once

#include <string>

#include "answers/table/answer.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {
struct Event;
class LoadHistory;
}  // namespace contensou::si

namespace contensou::answers {

/// Returns the ball of an answer in SI units: name, values, patch radius under the law, and the source of this radius.
Json members_of_ball(const si::Experiment& experiment, const reduction::Law& law);

/// Returns {t, x, y}.
Json members_of(const si::Event& event);

/// Returns {t: [...], load: [...]}.
Json members_of(const si::LoadHistory& load);

/// Returns the ball of an answer in two lines of text.
std::string ball_heading(const si::Experiment& experiment, const reduction::Law& law, const Digits& digits);

}  // namespace contensou::answers
