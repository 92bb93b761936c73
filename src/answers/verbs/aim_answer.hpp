#pragma once

#include <variant>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/aim.hpp"

namespace contensou::answers {

using AimGoal = std::variant<si::Goal, si::RollingGoal>;

/// Returns the answer of `aim`: the start that reaches the goal, the result of this start, and the stroke of a cue that
/// causes it. Throws as si::aimed.
Answer aim_answer(si::Experiment experiment, const reduction::Law& law, const AimGoal& goal);

/// Returns the fields of the answer of `aim`.
std::vector<FieldText> aim_fields();

}  // namespace contensou::answers
