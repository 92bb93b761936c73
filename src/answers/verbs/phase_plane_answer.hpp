#pragma once

#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::answers {

/// Returns the answer of `terminal`: the limits of k at the stop, and the invariant rays. CSV has a row for each limit.
Answer terminal_answer(const reduction::ReducedSystem& system);

/// Returns the answer of `portrait --facts`: the limits of k, the singular points with eigenvalues and kinds, and the
/// way in which orbits enter the origin. CSV has one row for each singular point.
Answer phase_plane_answer(const reduction::ReducedSystem& system);

/// Return the fields of terminal_answer and of phase_plane_answer.
std::vector<FieldText> terminal_fields();
std::vector<FieldText> phase_plane_fields();

}  // namespace contensou::answers
