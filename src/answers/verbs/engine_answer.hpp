#pragma once

#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/engine.hpp"

namespace contensou::answers {

/// What `engine` prints: of a ball, and of each engine or of one, what to type in and what that does. CSV has a row for
/// each setting.
Answer engine_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Engine* only = nullptr);

/// The fields of that answer.
std::vector<FieldText> engine_fields();

}  // namespace contensou::answers
