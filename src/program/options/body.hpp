#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contensou/reduction/inertia.hpp"

namespace contensou::program {

/// An axisymmetric body as --body names it.
struct Body {
  reduction::Inertia inertia = reduction::homogeneous_ball;
  std::optional<double> patch_ratio{};  ///< where the body itself decides it: a flat puck rests on its whole face
  bool rolls_on_a_small_patch = true;   ///< mu <= 1
  std::string_view law = "exact";       ///< of the pressure that it brings

  /// What is wrong with a mu for this body; empty if nothing is.
  std::string complaint(double mu) const;
};

/// Those that have a name.
const std::vector<std::pair<std::string, Body>>& bodies();

}  // namespace contensou::program
