#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contensou/reduction/inertia.hpp"

namespace contensou::si {

/// An axisymmetric body.
struct Body {
  std::string_view name = "ball";  ///< empty for one that has none
  reduction::Inertia inertia = reduction::homogeneous_ball;
  std::optional<double> patch_ratio{};  ///< where the body itself decides it: a flat puck rests on its whole face
  bool rolls_on_a_small_patch = true;   ///< mu <= 1
  std::string_view law = "exact";       ///< of the pressure that it brings
  std::optional<double> factor = {};    ///< of m R^2 in its moment of inertia, where it was given: with_factor

  /// Whether it turns about the vertical only, and never rolls.
  bool lies_flat() const { return inertia.chi == 1; }

  /// The same with a moment of inertia of factor m R^2: of a ball about any axis, of a body that lies flat about the
  /// vertical. R is the radius beyond which there is no mass, so that at most all of it is on that sphere or rim.
  /// @throws std::domain_error  unless 0 < factor <= 2/3, of a body that lies flat 0 < factor <= 1
  Body with_factor(double of_m_R2) const;

  /// What is wrong with a mu for this body; empty if nothing is.
  std::string complaint(double mu) const;
};

/// The bodies that have a name.
const std::vector<Body>& bodies();

}  // namespace contensou::si
