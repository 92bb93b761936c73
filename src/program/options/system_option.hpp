#pragma once

#include <array>
#include <map>
#include <string>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// The option --system: a planar system, given by formulas, in place of the equations of motion (2.6).
class SystemOption {
 public:
  void add(CLI::App& app);
  bool given() const { return system_.given(); }
  Argument& argument() { return system_; }
  const std::string& text() const { return system_.text(); }

  /// @throws BadInput  as parse_planar_system
  reduction::SmoothField read(const std::map<std::string, double>& parameters) const;

  /// Returns the two letters of the equations, such as x and x'.
  /// @throws BadInput  as parse_planar_system
  std::array<std::string, 2> variables(const std::map<std::string, double>& parameters) const;

 private:
  Argument system_, basis_;
};

}  // namespace contensou::program
