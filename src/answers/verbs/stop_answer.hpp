#pragma once

#include <optional>

#include "answers/asked/given_start.hpp"
#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "answers/verbs/uncertainty.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/si/load_history.hpp"

namespace contensou::answers {

/// Returns the answer of `stop` for one start.
/// @param estimate  true: include the estimates for small mu
/// @param gradient  true: include the derivatives of the stop time
/// @param uncertainty  uncertainty of the stop time, from stop_uncertainty
/// @param load      changing load of a ball; tau belongs to its nominal load, seconds belong to the changing load
/// @throws BadInput, std::domain_error  for options that rolling friction excludes; for a load that ends before the
///                                      motion
Answer stop_answer(const GivenStart& start, reduction::Route route, bool estimate, bool gradient = false,
                   const std::optional<Uncertainty>& uncertainty = {}, const std::optional<si::LoadHistory>& load = {});

/// Returns the fields of the answer of `stop`.
std::vector<FieldText> stop_fields();

}  // namespace contensou::answers
