#pragma once

#include <vector>

#include <Eigen/Core>

namespace contensou::fit {

/// Dependence of the errors of one column on each other.
struct Dependence {
  double neighbours = 0;  ///< correlation of an error with the next one
  double growth = 1;      ///< growth of the variance of a mean; n values are worth n/growth independent ones
};

/// Estimates neighbours and growth from the residuals r of a fit, without the bias that the fitted parameters cause.
///
/// Let J be the derivatives of the residuals, C = (J^T J)^-1, and A = J C^1/2 with the rows a_i. Errors e give r = (1 -
/// A A^T) e. If the n errors are independent with variance s^2, the expectation E r_i r_j is s^2 (delta_ij - a_i a_j).
/// The rows z_i = (r_i, s a_i) then satisfy E z_i z_j = s^2 delta_ij. Therefore
///   sum z_i z_(i+1) / (n s^2)  estimates the correlation of neighbours; without correlation it is 0 +- 1/sqrt(n). The
///   estimate equals 1 minus half of J. von Neumann's quotient (1941, doi:10.1214/aoms/1177731677).
/// The sum of m successive errors has the variance g m s^2 with g = 1 + 2 sum (1 - j/m) c_j, where c_j is the
/// correlation of errors that are j apart (the kernel of M. S. Bartlett, 1950, doi:10.1093/biomet/37.1-2.1). The fit
/// removes the part g s^2 |a_i + ... + a_(i+m-1)|^2 of this variance, because J also changes slowly from value to
/// value. Therefore
///   sum (r_i + ... + r_(i+m-1))^2 / sum (m s^2 - s^2 |a_i + ... + a_(i+m-1)|^2)  over all windows of m values
///   estimates g.
/// m is sqrt(n): longer films show longer dependence, and the relative error of g, sqrt(4 m/(3 n)), falls with n.
/// @param runs  for each track, a matrix with the rows z_i
Dependence dependence_of(const std::vector<Eigen::MatrixXd>& runs);

}  // namespace contensou::fit
