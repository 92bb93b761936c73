#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::si {

/// An axisymmetric body.
struct Body {
  std::string_view name = "ball";  ///< empty for a body without a name
  reduction::Inertia inertia = reduction::homogeneous_ball;
  std::optional<double> patch_ratio{};  ///< patch radius/R if the body fixes it: a puck rests on its whole face
  bool rolls_on_a_small_patch = true;   ///< true: a ball, whose mu = patch radius/R must be at most 1
  std::string_view law = "exact";       ///< name of the friction law that follows from the body's pressure
  std::optional<double> factor = {};    ///< moment of inertia divided by m R^2, if given (with_factor)

  /// Returns true if the body turns about the vertical only, and never rolls.
  bool lies_flat() const { return inertia.chi == 1; }

  /// Returns the body with a moment of inertia of factor m R^2, about any axis of a ball or about the vertical of a
  /// body that lies flat. R is the largest radius with mass; this bounds the factor.
  /// @param of_m_R2  factor, above 0; at most 2/3, or 1 for a body that lies flat. A factor beyond this limit by up to
  ///                 0.1 % is the limit, rounded
  /// @throws std::domain_error  for any other factor
  Body with_factor(double of_m_R2) const;

  /// Returns the reason why mu is impossible for the body; empty if it is possible.
  std::string complaint(double mu) const;
};

/// Returns all bodies that have a name.
const std::vector<Body>& bodies();

}  // namespace contensou::si
