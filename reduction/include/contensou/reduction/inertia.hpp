#pragma once

namespace contensou::reduction {

/// How easily friction changes the two speeds of an axisymmetric body, both relative to its mass.
struct Inertia {
  double chi = 3.5;    ///< sliding: 1 + m R^2/J_h, J_h about a horizontal axis; 1 for a puck that cannot roll
  double gamma = 2.5;  ///< pivoting: m R^2/J_z, J_z about the vertical axis
};

/// The homogeneous ball of Zh98: chi = 7/2, gamma = 5/2.
inline constexpr Inertia homogeneous_ball{};

}  // namespace contensou::reduction
