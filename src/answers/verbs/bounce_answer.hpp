#pragma once

#include <optional>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/bounce.hpp"

namespace contensou::answers {

/// What `bounce` says about one ball.
/// @param height         m, from which it was dropped, if it was
/// @param rolling_below  m/s of slip
Answer bounce_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Impact& impact,
                     std::optional<double> height, double rolling_below);

/// The fields of that answer.
std::vector<FieldText> bounce_fields();

}  // namespace contensou::answers
