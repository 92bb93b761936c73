#pragma once

#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/engine.hpp"

namespace contensou::answers {

/// Returns the answer of `engine` for a ball: the settings of all engines, or of one engine, and the resulting motion.
/// CSV contains one row for each setting.
/// @param only  the only engine; null: all
Answer engine_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Engine* only = nullptr);

/// Returns the fields of the answer of `engine`.
std::vector<FieldText> engine_fields();

}  // namespace contensou::answers
