#pragma once

#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::answers {

/// Rows of CSV: one for each limit of k, or one for each singular point.
enum class PlaneRows { limits, points };

/// Returns the answer of `terminal` (rows: limits) and of `portrait --facts` (rows: points): the limits of k at the
/// stop, the invariant rays, the singular points with eigenvalues and kinds, and the way in which orbits enter the
/// origin.
Answer phase_plane_answer(const reduction::ReducedSystem& system, PlaneRows rows);

/// Return the fields of this answer.
std::vector<FieldText> terminal_fields();
std::vector<FieldText> phase_plane_fields();

}  // namespace contensou::answers
