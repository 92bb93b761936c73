#pragma once

#include <optional>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/bounce.hpp"

namespace contensou::answers {

/// Returns the answer of `bounce` for one ball.
/// @param height         height from which the ball was dropped, m; empty if it was not dropped
/// @param rolling_below  slip below which the ball rolls, m/s, > 0
Answer bounce_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Impact& impact,
                     std::optional<double> height, double rolling_below);

/// Returns the fields of the answer of `bounce`.
std::vector<FieldText> bounce_fields();

}  // namespace contensou::answers
