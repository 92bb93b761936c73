#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/given_start.hpp"
#include "answers/asked/planar_system.hpp"
#include "answers/input/errors.hpp"
#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "contensou/reduction/reduced_system.hpp"

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
/// @param given    the start; if empty, the answer explains the equation alone
/// @param details  true: the text also shows the numbers of the search
Answer reduce_answer(const FormulaField& system, const reduction::SmoothField& field, const std::string& text,
                     const std::optional<Eigen::Vector2d>& given, bool details);

/// Returns every name that the member `end` of an answer can contain. For an orbit whose end has no name, it is null.
std::vector<std::string_view> named_ends();

/// Returns the fields of the answer for the equations of motion (2.6).
std::vector<FieldText> reduce_fields();

/// Fields of the answer for another system.
std::vector<FieldText> reduce_system_fields();

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
Answer orbit_system_answer(const StartedSystem& system, const SystemInstants& asked);

/// Adds the state at one instant to the text and to the member `until` of an answer. Throws as orbit_system_answer.
void add_state_at(Answer& answer, const StartedSystem& system, double until);

/// Returns the fields of the answer.
std::vector<FieldText> orbit_system_fields();

/// Rows of CSV: one for each limit of k, or one for each singular point.
enum class PlaneRows { limits, points };

/// Returns the answer of `terminal` (rows: limits) and of `portrait --facts` (rows: points): the limits of k at the
/// stop, the invariant rays, the singular points with eigenvalues and kinds, and the way in which orbits enter the
/// origin.
Answer phase_plane_answer(const reduction::ReducedSystem& system, PlaneRows rows);

/// Return the fields of this answer.
std::vector<FieldText> terminal_fields();
std::vector<FieldText> phase_plane_fields();

}  // namespace contensou::answers
