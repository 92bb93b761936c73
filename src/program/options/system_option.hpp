#pragma once

#include <array>
#include <map>
#include <string>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// A field that was typed, and the two letters of its equations, such as x and x'.
struct TypedSystem {
  reduction::SmoothField field;
  std::array<std::string, 2> variables;
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

 private:
  Argument system_, basis_;
};

}  // namespace contensou::program
