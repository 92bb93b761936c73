#pragma once

#include <string>
#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/fit/fit.hpp"

namespace contensou::answers {

/// The best law's fit, with the others by their criterion.
/// @param fits     of tracks, the best first
/// @param planned  of a film that is not made yet
Answer answer_of(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned);

/// The answer as text on one screen, and what the data do not decide.
std::string report_on(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned,
                      const Digits& digits);

/// The fields of that answer.
std::vector<FieldText> fit_fields();

}  // namespace contensou::answers
