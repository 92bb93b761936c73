#pragma once

#include <optional>

#include "argument.hpp"
#include "contensou/reduction/inertia.hpp"

namespace contensou::program {

/// An axisymmetric body as --body names it.
struct Body {
  reduction::Inertia inertia;
  std::optional<double> patch_ratio;    ///< where the body itself decides it: a flat puck rests on its whole face
  bool rolls_on_a_small_patch = false;  ///< mu <= 1
};

/// --body.
class BodyOption {
 public:
  void add(CLI::App& app);

  /// The body; a homogeneous ball if none was given.
  /// @throws BadInput  for an unknown name, or numbers that are not two positive ones
  Body read() const;

 private:
  Argument body_;
};

}  // namespace contensou::program
