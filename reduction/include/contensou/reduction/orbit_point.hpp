#pragma once

#include <Eigen/Core>

namespace contensou::reduction {

/// One instant of a motion. At the stop u = v = 0, ln_v = -inf, beta = inf.
struct OrbitPoint {
  double tau;   ///< the paper's time since the start
  double u;     ///< keeps the sign of u0
  double v;     ///< 0 where it underflows; ln_v does not
  double ln_v;  ///< natural logarithm of v in the unit of the start
  double k;     ///< v/(mu |u|); infinity for u = 0
  /// Regularised time of (2.8) since the start; its error is relative to beta + 1/(16 mu |u0| + 15 pi v0).
  double beta;
};

/// Many instants, one entry of each column for each.
struct OrbitColumns {
  Eigen::ArrayXd tau, u, v, ln_v, k, beta;

  explicit OrbitColumns(Eigen::Index rows = 0);
  Eigen::Index rows() const { return tau.size(); }
  void set(Eigen::Index row, const OrbitPoint& point);
  OrbitPoint row(Eigen::Index row) const;
};

}  // namespace contensou::reduction
