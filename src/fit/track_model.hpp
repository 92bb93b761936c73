#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "contensou/reduction/flow.hpp"

namespace contensou::fit {

/// The motion of tracks under a law as a function of parameters, and its derivatives by them.
///
/// A vector of parameters has ln f and ln eps, then, for each track, the numbers of its start in the order of Parameter.
/// The slip may be negative: the same slip in the opposite direction.
class TrackModel {
 public:
  /// @param tracks    checked; they are kept by reference
  /// @param accuracy  of orbits, in speeds at their start
  TrackModel(const si::Experiment& ball, const reduction::Law& law, const std::vector<Track>& tracks, double accuracy);

  Eigen::Index parameters() const {
    return shared_parameters + start_parameters * static_cast<Eigen::Index>(tracks_.size());
  }

  /// One for each value of each series, and one for each stop time.
  Eigen::Index rows() const { return rows_; }

  static Eigen::Index place(Parameter parameter, std::size_t track = 0) {
    const int number = static_cast<int>(parameter);
    return number < shared_parameters ? number : number + start_parameters * static_cast<Eigen::Index>(track);
  }

  /// What the motion gives, row by row: the series of the first track, its stop time, then the next.
  Eigen::VectorXd values(const Eigen::VectorXd& free) const;

  /// Derivatives of the values by these of the parameters, a column each. By friction and by the size of the start they
  /// are exact, by scaling; by the patch radius and by the ratio of slip to spin central differences of orbits.
  Eigen::MatrixXd derivatives(const Eigen::VectorXd& free, const std::vector<Eigen::Index>& wanted) const;

  /// The parameters within what they may be: eps <= R.
  Eigen::VectorXd limited(Eigen::VectorXd parameters) const;

 private:
  struct Motion;
  reduction::Flow solved_flow(double ln_patch_radius) const;
  const reduction::Flow& flow(double ln_patch_radius) const;

  double radius_, gravity_, accuracy_;
  reduction::Law law_;
  const std::vector<Track>& tracks_;
  Eigen::Index rows_ = 0;
  mutable std::optional<std::pair<double, reduction::Flow>> last_;  ///< values and derivatives are asked for in turn
};

}  // namespace contensou::fit
