#pragma once

namespace contensou::reduction {

/// The two numbers of inertia of an axisymmetric body of mass m and radius R. They multiply the body's decelerations.
struct Inertia {
  double chi = 3.5;  ///< factor of sliding: 1 + m R^2/J_h, J_h about a horizontal axis; 1 for a puck, which cannot roll
  double gamma = 2.5;  ///< factor of pivoting: m R^2/J_z, J_z about the vertical axis
};

/// The homogeneous ball of the paper (V. F. Zhuravlev, 1998): chi = 7/2, gamma = 5/2.
inline constexpr Inertia homogeneous_ball{};

}  // namespace contensou::reduction
