#pragma once

#include "answers/answer.hpp"
#include "answers/given_start.hpp"
#include "answers/record.hpp"
#include "contensou/reduction/stop_time.hpp"

namespace contensou::answers {

/// Everything that `stop` says about one start.
/// @param estimate  also the estimates for small mu
Answer stop_answer(const GivenStart& start, reduction::Route route, bool estimate);

/// The fields of that answer.
std::vector<FieldText> stop_fields();

}  // namespace contensou::answers
