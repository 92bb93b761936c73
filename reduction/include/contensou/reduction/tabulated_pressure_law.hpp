#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Coulomb friction of a circular patch whose pressure is given as a table: linear in rho^2 between two rows, with a
/// step where two rows have the same rho.
///
/// Source    README (R32) to (R34): a sum over thin rings, with the pressure as their weight.
/// Accuracy  12 eps for every table, however steep, and every k where Phi and Psi do not underflow. A smooth pressure
///           in n rows is met within about 1/n^2, and 1/n^(3/2) where it falls like a root at the edge.
/// Cost      2 to 10 us a slip, whether the table has 10 rows or 10 000: rows far from rho = k count in groups.
class TabulatedPressureLaw {
 public:
  static constexpr SlidingBounds sliding_bounds{0, 1};

  /// @param name      for messages and tables
  /// @param rho       distance from the centre over eps: from 0 to 1, not decreasing; a step has two rows
  /// @param pressure  at each rho, in any unit: finite, >= 0, not all 0
  /// @throws std::domain_error   naming the row (from 1) that breaks these rules
  /// @throws std::runtime_error  if the patch is so small a part of the table that no k of the library sees it
  TabulatedPressureLaw(std::string name, const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure);

  const std::string& name() const { return name_; }

  /// How many rows the table has.
  Eigen::Index rows() const;

  /// The law of a table with every other row left out, but for the first, the last and both rows of a step: what it
  /// changes bounds what interpolation between the rows costs, if they sample a smooth curve. Empty if no row can go.
  std::optional<TabulatedPressureLaw> coarser() const;

  /// k = rho of the steps and of the sharpest bends of the pressure, growing; at most 32.
  const std::vector<double>& kinks() const { return kinks_; }

  /// @throws std::domain_error  for a slip that no law can answer (require_slip)
  Resistance operator()(Slip slip) const;

  /// 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;

  /// 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;

 private:
  class Rings;

  std::string name_;
  std::vector<double> kinks_;
  std::shared_ptr<const Rings> rings_;
};

}  // namespace contensou::reduction
