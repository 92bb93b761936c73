#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "answers/asked/planar_system.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "values.hpp"

namespace contensou::python {

/// Thrown after a signal during a call of a field. No std::exception, which would mean a missing value.
struct Interrupted {
  py::error_already_set error;
};

/// Calls a function that uses a field of Python. A signal such as Ctrl-C may end this call.
template <class Function>
auto interruptible(Function compute) {
  try {
    return compute();
  } catch (Interrupted& interrupted) {
    throw py::error_already_set(interrupted.error);
  }
}

/// A planar system with its symmetries, and with its motions if it is solved.
class Planar {
 public:
  /// @param known  solution, if there is one
  Planar(reduction::SmoothField given, const Eigen::Vector2d& around,
         const std::optional<reduction::PlanarReduction>& known = {})
      : field(std::move(given)), start(around) {
    interruptible([&] {
      symmetries = reduction::find_symmetries(field.value, around);
      solved_plane = known ? answers::SolvedPlane{known, ""} : answers::solve_planar(field, symmetries, around);
    });
  }

  const reduction::PlanarReduction& solved() const {
    if (solved_plane.plane) return *solved_plane.plane;
    throw std::domain_error("reduce: this field is not solved: " + solved_plane.why_not);
  }

  reduction::SmoothField field;
  Eigen::Vector2d start;
  reduction::PlanarSymmetries symmetries;
  answers::SolvedPlane solved_plane;
};

}  // namespace contensou::python
