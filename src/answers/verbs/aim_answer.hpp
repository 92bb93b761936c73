#pragma once

#include <variant>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/aim.hpp"

namespace contensou::answers {

using AimGoal = std::variant<si::Goal, si::RollingGoal>;

/// What `aim` says: the start that comes to the goal, what it comes to, and how a cue makes it. Throws as si::aimed.
Answer aim_answer(si::Experiment experiment, const reduction::Law& law, const AimGoal& goal);

/// The fields of that answer.
std::vector<FieldText> aim_fields();

}  // namespace contensou::answers
