#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/reduction/planar_symmetry.hpp"
#include "options/start_options.hpp"
#include "output/answer.hpp"

namespace contensou::program {

/// Symmetries, canonical coordinates and solution of a system at a start.
struct ReduceAnswer {
  Answer answer;
  bool found;  ///< a generator
};

/// Of (2.6), beside what the other routes say.
/// @throws BadInput  for a start at rest
ReduceAnswer reduce_answer(const GivenStart& start);

/// Of any field.
/// @param text  of the field, for the answer
ReduceAnswer reduce_answer(const reduction::PlanarField& field, const std::string& text, const Eigen::Vector2d& start);

}  // namespace contensou::program
