#pragma once

#include <optional>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"
#include "numerics/epsilon.hpp"
#include "planar/inverse_factor.hpp"

namespace contensou::reduction {

/// Returns true if f(R x) = -R f(x) up to rounding at one point, for a linear map R about a centre; empty if the field
/// has no value at x and none at R x.
inline std::optional<bool> reverses(const SmoothField& field, const Eigen::Matrix2d& map, const Eigen::Vector2d& centre,
                                    const Eigen::Vector2d& x) {
  const Eigen::Vector2d image = centre + map * (x - centre);
  const auto here = jet_of(field, x), there = jet_of(field, image);
  if (!here && !there) return std::nullopt;
  if (!here || !there) return false;
  constexpr double roundings = 64;
  const Eigen::Vector2d rounded = roundings * eps * (here->f.cwiseAbs() + here->slopes.cwiseAbs() * x.cwiseAbs());
  const Eigen::Vector2d allowed = map.cwiseAbs() * rounded + roundings * eps * there->f.cwiseAbs();
  return ((there->f + map * here->f).cwiseAbs().array() <= allowed.array()).all();
}

/// The maps that are tried as reversors. Four of them are reflections.
inline const Reversor maps_to_try[]{{"(u, -v)", Eigen::Matrix2d{{1, 0}, {0, -1}}},
                                    {"(-u, v)", Eigen::Matrix2d{{-1, 0}, {0, 1}}},
                                    {"(v, u)", Eigen::Matrix2d{{0, 1}, {1, 0}}},
                                    {"(-v, -u)", Eigen::Matrix2d{{0, -1}, {-1, 0}}},
                                    {"(-u, -v)", Eigen::Matrix2d{{-1, 0}, {0, -1}}}};

inline bool is_reflection(const Reversor& reversor) { return reversor.matrix.determinant() < 0; }

}  // namespace contensou::reduction
