#pragma once

#include <optional>
#include <utility>

#include <Eigen/Core>

#include "contensou/reduction/symmetries.hpp"

namespace contensou::reduction {

/// Returns the value of a field; empty if the field has no value at x.
std::optional<Eigen::Vector2d> value_of(const PlanarField& field, const Eigen::Vector2d& x);

/// The field f on the section, the closed curve x_0 + S n(q), which the scaling moves over the plane (planar.md (R64)).
class SectionField {
 public:
  /// The rates p' = R (radial) and q' = T (angular) of the canonical coordinates in the time sigma.
  struct Rates {
    double radial, angular;
    double size;                         ///< |S^-1 f|
    double radial_terms, angular_terms;  ///< sums of the absolute values of the terms of R and of T; terms can cancel
  };

  /// @throws std::domain_error  unless all eigenvalues of the scaling's matrix have positive real parts
  SectionField(PlanarField field, const Generator& scaling, const Eigen::Vector2d& around);

  /// Returns the rates at a unit vector n; empty if the field has no value there.
  std::optional<Rates> operator()(const Eigen::Vector2d& n) const;

  /// True if the field has a value other than 0 at the centre.
  bool regular() const;

  const PlanarField& field() const { return field_; }
  double time_degree() const { return time_; }  ///< c: dt = exp(c p) d sigma
  const Eigen::Vector2d& centre() const { return centre_; }
  const Eigen::Matrix2d& frame() const { return frame_; }  ///< S

  /// Returns n and p of a point x other than the centre.
  std::pair<Eigen::Vector2d, double> canonical(const Eigen::Vector2d& x) const;
  /// Returns n of the point at which the curve meets a ray from the centre in the given direction.
  Eigen::Vector2d on_section(const Eigen::Vector2d& direction) const;
  Eigen::Vector2d point(const Eigen::Vector2d& n, double p) const;

 private:
  PlanarField field_;
  double time_;
  Eigen::Vector2d centre_;
  Eigen::Matrix2d frame_, frame_inverse_, matrix_;  ///< S, S^-1, A' = S^-1 A S
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Returns n turned counter-clockwise. Also for small angles each component is accurate to its last bits.
Eigen::Vector2d turned(const Eigen::Vector2d& n, double angle);

}  // namespace contensou::reduction
