#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "answers/input/errors.hpp"
#include "answers/table/answer.hpp"
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

/// Returns the field with its functions interruptible: each of them looks for signals such as Ctrl-C.
/// @param interruption  shared by all functions of a field
inline reduction::SmoothField with_signals(reduction::SmoothField field,
                                           const std::shared_ptr<Interruption>& interruption) {
  const auto checked = [&](auto function) {
    return [function = std::move(function), interruption](const Eigen::Vector2d& x) {
      try {
        interruption->check();
      } catch (const py::error_already_set& error) {
        throw Interrupted{error};
      }
      return function(x);
    };
  };
  field.value = checked(std::move(field.value));
  if (field.jacobian) field.jacobian = checked(std::move(field.jacobian));
  if (field.branch) {
    field.branch = [branch = std::move(field.branch), interruption](const Eigen::Vector2d& x) {
      return with_signals(branch(x), interruption);
    };
  }
  return field;
}

/// A planar system with its symmetries, and with its motions if it is solved.
class Planar {
 public:
  /// @param known  solution, if there is one
  Planar(reduction::SmoothField given, const Eigen::Vector2d& around,
         const std::optional<reduction::PlanarReduction>& known = {})
      : field(std::move(given)),
        start(interruptible([&] { return reduction::sampled_about(field, around); })),
        symmetries(interruptible([&] { return reduction::find_symmetries(field, start); })),
        plane(known ? *known : interruptible([&] { return reduction::reduce(field, around, symmetries); })) {}

  const reduction::PlanarReduction& solved() const {
    if (plane.solved()) return plane;
    throw std::domain_error("reduce: this field is not solved: " + answers::words_of(plane.why_not()));
  }

  /// Returns the equilibria and reversors, which are sought at the first call.
  const reduction::Equilibria& equilibria() const {
    if (!equilibria_) {
      equilibria_ = interruptible([&] {
        auto found = reduction::find_equilibria(field, start);
        compare_kinds(found, plane);
        return found;
      });
    }
    return *equilibria_;
  }

  reduction::SmoothField field;
  Eigen::Vector2d start;  ///< point whose coordinates set the scale of the samples
  reduction::PlanarSymmetries symmetries;
  reduction::PlanarReduction plane;
  std::array<std::string, 2> variables{"u", "v"};  ///< letters of the equations
  std::map<std::string, double> parameters = {};   ///< values of other letters
  std::function<answers::Answer()> answer = {};    ///< answer of the program; empty for a function

 private:
  mutable std::optional<reduction::Equilibria> equilibria_;
};

}  // namespace contensou::python
