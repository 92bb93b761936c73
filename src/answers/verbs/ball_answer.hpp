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

/// The ball of an answer in SI units: its name and values, its patch radius under the law and what that follows from.
Json members_of_ball(const si::Experiment& experiment, const reduction::Law& law);

/// {t, x, y}
Json members_of(const si::Event& event);

/// {t: [...], load: [...]}
Json members_of(const si::LoadHistory& load);

/// The ball of an answer for people, in two lines.
std::string ball_heading(const si::Experiment& experiment, const reduction::Law& law, const Digits& digits);

}  // namespace contensou::answers
