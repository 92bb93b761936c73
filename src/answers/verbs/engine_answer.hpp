#pragma once

#include <string>
#include <vector>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/engine.hpp"

namespace contensou::answers {

/// A value that is typed into an engine in place of the right one.
struct TypedValue {
  const si::EngineParameter* parameter;
  double value;  ///< SI, >= 0; above 0 for a parameter on which the force depends
};

/// Reads NAME=VALUE, where NAME is the name of a parameter or a part of it that no other parameter of the engine has.
/// The case of letters does not matter.
/// @throws BadInput  for another name, or a value that is not allowed
TypedValue parse_typed_value(const std::string& typed, const si::EngineUse& use);

/// Returns the answer of `engine` for a ball: the settings of all engines, or of one engine, and the resulting motion.
/// CSV contains one row for each setting.
/// @param only   the only engine, which may be si::unknown_engine(); null: all
/// @param typed  values in place of the right ones; with `only`. They are one more setting of the engine, the last.
Answer engine_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Engine* only = nullptr,
                     const std::vector<TypedValue>& typed = {});

/// Returns the fields of the answer of `engine`.
std::vector<FieldText> engine_fields();

}  // namespace contensou::answers
