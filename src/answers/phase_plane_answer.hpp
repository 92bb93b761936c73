#pragma once

#include "answers/answer.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::answers {

/// What `terminal` prints: the ratios that k tends to, and the invariant rays. CSV has a row for each ratio.
Answer terminal_answer(const reduction::ReducedSystem& system);

/// What `portrait --facts` prints: regime, singular points with eigenvalues and kind, how orbits enter the origin. CSV
/// has a row for each singular point.
Answer phase_plane_answer(const reduction::ReducedSystem& system);

}  // namespace contensou::answers
