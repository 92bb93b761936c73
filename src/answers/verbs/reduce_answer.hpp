#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/given_start.hpp"
#include "answers/input/errors.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::answers {

/// Reduces the equations of motion (2.6), and adds the results of the other routes to the stop time. The answer
/// contains symmetries, canonical coordinates and the solution at the start.
/// @throws BadInput  for a start at rest
Answer reduce_answer(const GivenStart& given);

/// Reduces any planar field. The answer has not passed if neither a generator nor an inverse integrating factor was
/// found.
/// @param text  formulas of the field, for the answer
Answer reduce_answer(const reduction::SmoothField& field, const std::string& text, const Eigen::Vector2d& start);

/// Returns every name that the member `end` of an answer can contain. For an orbit whose end has no name, it is null.
std::vector<std::string_view> named_ends();

/// Returns the fields of the answer for the equations of motion (2.6).
std::vector<FieldText> reduce_fields();

/// Fields of the answer for another system.
std::vector<FieldText> reduce_system_fields();

}  // namespace contensou::answers
