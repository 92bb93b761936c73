#pragma once

#include "contensou/reduction/flow.hpp"
#include "options/start_options.hpp"
#include "output/answer.hpp"

namespace contensou::program {

/// Everything that `stop` says about one start.
/// @param estimate  also the estimates for small mu
Answer stop_answer(const GivenStart& start, reduction::Route route, bool estimate);

}  // namespace contensou::program
