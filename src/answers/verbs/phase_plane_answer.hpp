#pragma once

#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::answers {

/// What `terminal` prints: the ratios that k tends to, and the invariant rays. CSV has a row for each ratio.
Answer terminal_answer(const reduction::ReducedSystem& system);

/// What `portrait --facts` prints: regime, singular points with eigenvalues and kind, how orbits enter the origin. CSV
/// has a row for each singular point.
Answer phase_plane_answer(const reduction::ReducedSystem& system);

/// The fields of these answers.
std::vector<FieldText> terminal_fields();
std::vector<FieldText> phase_plane_fields();

}  // namespace contensou::answers
