#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "answers/asked/planar_system.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "values.hpp"

namespace contensou::python {

/// A signal during a call of a field. It is not a std::exception, which would mean a point without value.
struct Interrupted {
  py::error_already_set error;
};

/// Calls a function that uses a field of Python, which a signal such as Ctrl-C may end.
template <class Function>
auto interruptible(Function compute) {
  try {
    return compute();
  } catch (Interrupted& interrupted) {
    throw py::error_already_set(interrupted.error);
  }
}

/// A planar system, its symmetries, and its motions if one of them is a scaling.
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
