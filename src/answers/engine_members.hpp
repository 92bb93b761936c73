#pragma once

#include <nlohmann/json.hpp>

#include "contensou/si/engine.hpp"

namespace contensou::answers {

/// What a ball and its law are to engines, and under `engines` what one engine, or each, makes of that: the members of
/// the document that `engine` writes.
/// @param only  null: all engines
/// @throws std::domain_error  as si::fade_times
nlohmann::ordered_json engine_members(const si::Experiment& experiment, const reduction::Law& law,
                                      const si::Engine* only);

}  // namespace contensou::answers
