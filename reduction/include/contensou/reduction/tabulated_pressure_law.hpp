#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Coulomb friction of a circular patch whose pressure is given as a table. Between two rows the pressure is linear in
/// rho^2, rho = (distance from the centre)/(patch radius). Two rows with the same rho are a step of the pressure.
///
/// Source    numerics.md (R48), (R49), (R56): a sum over thin rings, weighted by the pressure.
/// Accuracy  12 eps for every table, however steep, and every k for which Phi and Psi do not underflow. A table of n
///           rows approximates a smooth pressure to about 1/n^2; to 1/n^(3/2) if it has a square root at the edge.
/// Cost      2 to 10 us a slip for 10 to 10 000 rows, because distant rows (rho far from k) are grouped.
class TabulatedPressureLaw {
 public:
  static constexpr SlidingBounds sliding_bounds{0, 1};

  /// @param name      name for messages and tables
  /// @param rho       distance from the centre in patch radii: from 0 to 1, not decreasing; a step has two rows
  /// @param pressure  pressure at each rho, in any unit: finite, >= 0, not all 0
  /// @throws std::domain_error   if a row breaks these rules; the message contains its number, counted from 1
  /// @throws std::runtime_error  if the loaded part of the table is too small to have an effect at any k of the library
  TabulatedPressureLaw(std::string name, const Eigen::ArrayXd& rho, const Eigen::ArrayXd& pressure);

  const std::string& name() const { return name_; }
  Eigen::Index rows() const;

  /// Returns the law of the table without every other row. The first row, the last row and both rows of a step are
  /// kept. If the rows sample a smooth curve, the difference of the two laws bounds the interpolation error. The result
  /// is empty if no row can be left out.
  std::optional<TabulatedPressureLaw> coarser() const;

  /// Returns the values of k that equal the rho of a step or of one of the sharpest bends, increasing; at most 32.
  const std::vector<double>& kinks() const { return kinks_; }

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;

 private:
  class Rings;

  std::string name_;
  std::vector<double> kinks_;
  std::shared_ptr<const Rings> rings_;
};

}  // namespace contensou::reduction
