#pragma once

#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::answers {

/// Returns the answer of `terminal`: the limits of k, and the invariant rays. CSV contains one row for each limit.
Answer terminal_answer(const reduction::ReducedSystem& system);

/// Returns the answer of `portrait --facts`: regime, singular points with eigenvalues and kind, and the way in which
/// orbits enter the origin. CSV contains one row for each singular point.
Answer phase_plane_answer(const reduction::ReducedSystem& system);

/// Returns the fields of each of these answers.
std::vector<FieldText> terminal_fields();
std::vector<FieldText> phase_plane_fields();

}  // namespace contensou::answers
