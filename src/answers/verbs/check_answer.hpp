#pragma once

#include <string>
#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "answers/verbs/check_against.hpp"
#include "contensou/reduction/verification.hpp"

namespace contensou::answers {

/// A check of a law.
struct CheckedLaw {
  std::string law;
  reduction::Check check;
  std::optional<Deviation> deviation = {};  ///< deviation of a table, if one is checked
};

/// Returns the checks of a law over a set of starts whose k0 runs from almost pure pivoting to almost pure sliding, and
/// of the same with drives the routes to the stop time: the worst of each.
std::vector<reduction::Check> built_in_checks(const reduction::Law& law);

/// Replaces each check by the worse of it and the other result of the same check. NaN is the worst.
void take_worse(std::vector<reduction::Check>& worst, const std::vector<reduction::Check>& others);

/// Returns the answer of `check` with these rows.
/// @param built_in  true for rows of built_in_checks; the text then names their starts
Answer check_answer(const std::vector<CheckedLaw>& rows, bool built_in);

/// A table beside the motions of a ball: two checks of the law's own motion, and how far the others are.
struct BesideAnswer {
  Answer answer;
  bool passed;
};

/// @param law        the first of the models
/// @param tolerance  a share of the start
BesideAnswer check_against_answer(const MotionsBeside& motions, const std::string& law, double tolerance);

/// The fields of these answers.
std::vector<FieldText> check_fields();

}  // namespace contensou::answers
