#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/given_start.hpp"
#include "answers/asked/planar_system.hpp"
#include "answers/input/errors.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::answers {

/// Reduces the equations of motion (2.6), and adds the results of the other routes to the stop time. The answer
/// contains symmetries, canonical coordinates and the solution at the start.
/// @throws BadInput  for a start at rest
Answer reduce_answer(const GivenStart& given);

/// Reduces a typed system. The text shows the steps as formulas: kinds of equation, symmetry, coordinates, separated
/// equation, solution, check and end. The answer has not passed if neither a generator, nor an inverse integrating
/// factor, nor a formula of H was found, or if steps in time contradict the solution.
/// @param field    field of the system, perhaps with a basis
/// @param text     formulas of the field, for the answer
/// @param start    if empty, the answer explains the equation alone
/// @param details  true: the text also shows the numbers of the search
Answer reduce_answer(const FormulaField& system, const reduction::SmoothField& field, const std::string& text,
                     const std::optional<Eigen::Vector2d>& start, bool details);

/// Returns every name that the member `end` of an answer can contain. For an orbit whose end has no name, it is null.
std::vector<std::string_view> named_ends();

/// Returns the fields of the answer for the equations of motion (2.6).
std::vector<FieldText> reduce_fields();

/// Fields of the answer for another system.
std::vector<FieldText> reduce_system_fields();

}  // namespace contensou::answers
