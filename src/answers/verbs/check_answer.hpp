#pragma once

#include <string>
#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "answers/verbs/check_against.hpp"
#include "contensou/reduction/verification.hpp"

namespace contensou::answers {

/// The result of a check of a law.
struct CheckedLaw {
  std::string law;  ///< empty for a typed system
  reduction::Check check;
  std::optional<Deviation> deviation = {};  ///< deviation from a table, if the check uses one
};

/// Returns the worst results of the checks of a law over a set of starts. Over this set k0 = v0/(mu u0) runs from
/// almost pure pivoting to almost pure sliding. The routes to the stop time are also compared for starts with a drive.
std::vector<reduction::Check> built_in_checks(const reduction::Law& law);

/// Replaces each check by the same check in `others` if that one is worse. NaN is the worst.
void take_worse(std::vector<reduction::Check>& worst, const std::vector<reduction::Check>& others);

/// Returns the answer of `check` with the given rows.
/// @param built_in  true for rows of built_in_checks; the text then names the starts of built_in_checks
Answer check_answer(const std::vector<CheckedLaw>& rows, bool built_in);

/// Returns the answer for the motion of a typed system from a start.
/// @throws BadInput  if the system has no motion there
Answer check_system_answer(const reduction::SmoothField& field, const Eigen::Vector2d& start);

/// Returns the answer for a table and the motions of a ball: two checks of the motion under the law, and the errors of
/// other models.
/// @param law        name of the law, the first of the models
/// @param tolerance  largest error that passes, as a share of the start
Answer check_against_answer(const MotionsBeside& motions, const std::string& law, double tolerance);

/// Returns the fields of both answers, of check_answer and of check_against_answer.
std::vector<FieldText> check_fields();

}  // namespace contensou::answers
