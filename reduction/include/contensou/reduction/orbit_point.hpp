#pragma once

#include <Eigen/Core>

namespace contensou::reduction {

/// The state of a motion at one time. At the stop u = v = 0, ln_v = -infinity, beta = infinity.
struct OrbitPoint {
  double tau;   ///< the time tau of ReducedSystem since the start
  double u;     ///< pivoting speed; keeps the sign of u0
  double v;     ///< sliding speed; 0 if it underflows, while ln_v stays finite
  double ln_v;  ///< natural logarithm of v in the unit of the start
  double k;     ///< v/(mu |u|), the ratio of sliding to pivoting; infinity for u = 0
  /// Time beta of the regularised equations (2.7) since the start. Its error is relative to beta + 1/(16 mu |u0| + 15
  /// pi v0).
  double beta;
};

/// The states of a motion at several times: one column for each quantity, one row for each time.
struct OrbitColumns {
  Eigen::ArrayXd tau, u, v, ln_v, k, beta;

  explicit OrbitColumns(Eigen::Index rows = 0);
  Eigen::Index rows() const { return tau.size(); }
  void set(Eigen::Index row, const OrbitPoint& point);
  OrbitPoint row(Eigen::Index row) const;
};

}  // namespace contensou::reduction
