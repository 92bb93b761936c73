#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/given_start.hpp"
#include "answers/input/errors.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/integrating_factor.hpp"

namespace contensou::answers {

/// Symmetries, canonical coordinates and solution of a system at a start.
struct ReduceAnswer {
  Answer answer;
  bool found;  ///< true if a generator or an inverse integrating factor was found
};

/// Reduces the equations of motion (2.6), and adds the results of the other routes to the stop time.
/// @throws BadInput  for a start at rest
ReduceAnswer reduce_answer(const GivenStart& given);

/// Reduces any planar field.
/// @param text  formulas of the field, for the answer
ReduceAnswer reduce_answer(const reduction::SmoothField& field, const std::string& text, const Eigen::Vector2d& start);

/// Returns every name that the member `end` of an answer can contain. For an orbit whose end has no name, it is null.
std::vector<std::string_view> named_ends();

/// Returns the fields of the answer for the equations of motion (2.6).
std::vector<FieldText> reduce_fields();

/// Fields of the answer for another system.
std::vector<FieldText> reduce_system_fields();

}  // namespace contensou::answers
