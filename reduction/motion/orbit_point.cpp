#include "contensou/reduction/orbit.hpp"

namespace contensou::reduction {

OrbitColumns::OrbitColumns(Eigen::Index rows) : tau(rows), u(rows), v(rows), ln_v(rows), k(rows), beta(rows) {}

void OrbitColumns::set(Eigen::Index row, const OrbitPoint& point) {
  tau[row] = point.tau;
  u[row] = point.u;
  v[row] = point.v;
  ln_v[row] = point.ln_v;
  k[row] = point.k;
  beta[row] = point.beta;
}

OrbitPoint OrbitColumns::row(Eigen::Index row) const {
  return {tau[row], u[row], v[row], ln_v[row], k[row], beta[row]};
}

}  // namespace contensou::reduction
