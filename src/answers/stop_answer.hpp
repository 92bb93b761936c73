#pragma once

#include "answers/answer.hpp"
#include "answers/given_start.hpp"
#include "answers/record.hpp"
#include "answers/uncertainty.hpp"
#include "contensou/reduction/stop_time.hpp"

namespace contensou::answers {

/// Everything that `stop` says about one start.
/// @param estimate  also the estimates for small mu
/// @param gradient  also the derivatives of the stop time
/// @param uncertain  the numbers that are known to so much: also what the stop time is known to
Answer stop_answer(const GivenStart& start, reduction::Route route, bool estimate, bool gradient = false,
                   const std::vector<Uncertain>& uncertain = {});

/// The fields of that answer.
std::vector<FieldText> stop_fields();

}  // namespace contensou::answers
