#pragma once

#include <string>
#include <vector>

#include "contensou/fit/fit.hpp"
#include "output/answer.hpp"

namespace contensou::program {

/// The best law's fit, with the others by their criterion.
/// @param fits     of tracks, the best first
/// @param planned  of a film that is not made yet
Answer answer_of(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned);

/// The same on one screen, and what the data do not decide.
std::string report_on(const std::vector<fit::Fit>& fits, const std::vector<fit::Track>& tracks, bool planned,
                      const Digits& digits);

}  // namespace contensou::program
