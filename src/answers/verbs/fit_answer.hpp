#pragma once

#include <string>
#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/fit/fit.hpp"

namespace contensou::answers {

/// Returns the answer of `fit`: the fit by the best law, and the criteria of the other laws.
/// @param fits     fits of the tracks, the best first
/// @param planned  true for the plan of a film that is not made yet
Answer answer_of(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned);

/// Returns the answer as text on one screen, including the numbers that the data do not determine.
std::string report_on(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned,
                      const Digits& digits);

/// Returns the fields of the answer of `fit`.
std::vector<FieldText> fit_fields();

}  // namespace contensou::answers
