#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/planar_system.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "options/argument.hpp"
#include "options/start_options.hpp"

namespace contensou::program {

/// A field that was typed, perhaps with a basis, and its formulas.
struct TypedSystem {
  reduction::SmoothField field;
  FormulaField formulas;

  /// Returns the two letters of the equations, such as x and x'.
  std::array<std::string, 2> variables() const { return {formulas.variables.at(0), formulas.variables.at(1)}; }
};

/// The option --system: a planar system, given by formulas, in place of the equations of motion (2.6).
class SystemOption {
 public:
  void add(CLI::App& app);
  bool given() const { return system_.given(); }
  Argument& argument() { return system_; }
  const std::string& text() const { return system_.text(); }

  /// @throws BadInput  as parse_planar_system
  TypedSystem read(const std::map<std::string, double>& parameters) const;

  /// Reads the start of a typed system from --u0, --v0, --x0, --y0 and --start; empty if none of them was given.
  /// @throws BadInput  if one of the two numbers is missing or given twice, or if the system has no such letter
  std::optional<Eigen::Vector2d> read_start(const TypedSystem& typed, const StartOptions& options) const;

  /// Reads the start for a verb that needs one. Throws as read_start.
  Eigen::Vector2d require_start(const TypedSystem& typed, const StartOptions& options) const;

 private:
  Argument system_, basis_;
  ArgumentOf<double> x0_, y0_;
  ArgumentOf<std::vector<std::pair<std::string, double>>> start_;
};

}  // namespace contensou::program
