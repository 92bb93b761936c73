#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/planar_system.hpp"
#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::answers {

/// The instants of an orbit: times since the start, or values of x for y' = F(x, y).
struct SystemInstants {
  Eigen::ArrayXd at = {};            ///< empty: equidistant instants from the start to `until`
  std::optional<double> until = {};  ///< empty: the end of the orbit, or one period
  Eigen::Index samples = 2;
};

/// A typed system with a start.
struct StartedSystem {
  reduction::SmoothField field;  ///< field of the formulas, perhaps with a basis
  FormulaField formulas;
  std::string text;  ///< the equations as typed
  Eigen::Vector2d start;

  /// Returns true for y' = F(x, y): the first coordinate takes the place of the time.
  bool is_first_order() const { return formulas.equations == FormulaField::Equations::first; }
};

/// Returns the states of an orbit at instants before and after the start: by quadrature where the system is solved,
/// else by steps in time.
/// @throws BadInput  for an instant beyond the end of the orbit, with the place of the end; if the orbit has no end and
///                   no instants are given
Answer orbit_system_answer(const StartedSystem& system, const SystemInstants& instants);

/// Adds the state at one instant to the text and to the member `until` of an answer. Throws as orbit_system_answer.
void add_state_at(Answer& answer, const StartedSystem& system, double until);

/// Returns the fields of the answer.
std::vector<FieldText> orbit_system_fields();

}  // namespace contensou::answers
