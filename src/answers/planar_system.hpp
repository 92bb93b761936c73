#pragma once

#include <map>
#include <optional>
#include <string>

#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::answers {

/// The field of "u' = F; v' = G", formulas in u, v and parameters as answers/formulas.hpp has them. Its copies share their
/// variables: one thread.
///
/// @throws BadInput  as Formulas
reduction::PlanarField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters);

/// Whether a start is the centre of the scaling, but for rounding.
bool is_centre(const reduction::Generator& scaling, const Eigen::Vector2d& start);

/// A system solved by its scaling; or why it is not.
struct SolvedPlane {
  std::optional<reduction::PlanarReduction> plane;
  std::string why_not;
};

/// @param found  of the same start
SolvedPlane solve_planar(const reduction::PlanarField& field, const reduction::PlanarSymmetries& found,
                         const Eigen::Vector2d& start);

}  // namespace contensou::answers
