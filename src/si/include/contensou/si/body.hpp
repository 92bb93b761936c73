#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contensou/reduction/inertia.hpp"

namespace contensou::si {

/// An axisymmetric body.
struct Body {
  std::string_view name = "ball";  ///< empty for a body without a name
  reduction::Inertia inertia = reduction::homogeneous_ball;
  std::optional<double> patch_ratio{};  ///< patch ratio if the body fixes it: a flat puck rests on its whole face
  bool rolls_on_a_small_patch = true;   ///< true: mu must be at most 1
  std::string_view law = "exact";       ///< name of the law that its pressure gives
  std::optional<double> factor = {};    ///< moment of inertia divided by m R^2, if given (with_factor)

  /// Returns true if the body turns about the vertical only, and never rolls.
  bool lies_flat() const { return inertia.chi == 1; }

  /// Returns the body with the moment of inertia factor m R^2: for a ball about any axis, for a body that lies flat
  /// about the vertical. R is the largest radius with mass, which bounds the factor.
  /// @throws std::domain_error  unless 0 < factor <= 2/3, or 0 < factor <= 1 for a body that lies flat
  Body with_factor(double of_m_R2) const;

  /// Returns the reason why the body cannot have this mu; empty if it can.
  std::string complaint(double mu) const;
};

/// Returns the bodies with a name.
const std::vector<Body>& bodies();

}  // namespace contensou::si
