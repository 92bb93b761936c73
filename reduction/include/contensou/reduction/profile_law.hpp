#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Coulomb friction of a circular patch whose pressure is given as a table.
///
/// Between the rows the pressure is linear in rho^2. Such a profile is a sum of paraboloids (1 - rho^2/a^2) of the
/// radii a of the rows and a uniform disc, and friction is additive: a sum of members of the family (1 - rho^2)^p, in
/// closed form. It keeps Psi' = -k Phi' and the table's pressures as they are; no quadrature is needed.
///
/// Accuracy  of the sum: rounding, some eps times the number of rows. A smooth pressure in n rows is met within about
///           1/n^2, and 1/n^(3/2) where it falls like a root at the edge.
/// Cost      12 ns for each row and slip (the paraboloid is tabulated once for all): a stop time takes 0.04 s with 100
///           rows, and 0.5 s with 1000.
class ProfileLaw {
 public:
  static constexpr SlidingShare sliding_share{0, 1};

  /// @param name      for messages and tables
  /// @param rho       distance from the centre over eps: from 0 to 1, increasing
  /// @param pressure  at each rho, in any unit: finite, >= 0, not all 0
  /// @throws std::domain_error  naming the row (from 1) that breaks these rules
  ProfileLaw(std::string name, const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure);

  const std::string& name() const { return name_; }

  /// @throws std::domain_error  for a slip that no law can answer (require_slip)
  Resistance operator()(Slip slip) const;

  /// 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;

 private:
  struct Disc {
    double radius;
    double load;    ///< negative where the pressure bends upwards
    double moment;  ///< of pure pivoting
  };

  std::string name_;
  std::shared_ptr<const std::vector<Disc>> discs_;  ///< paraboloids; the last is the uniform disc
  double load_ = 0;
  double pivoting_moment_ = 0;
};

}  // namespace contensou::reduction
