#pragma once

namespace contensou::reduction {

/// Li2(-z), the dilogarithm of a negative number: the integral of -ln(1 + t)/t over (0, z).
///
/// @param ln_z  logarithm of z > 0, so that z may overflow; -inf gives 0
/// Accuracy     4 eps relative (tests/reference/dilogarithm.csv), with ln_z taken as exact
double dilogarithm_of_minus_exp(double ln_z);

}  // namespace contensou::reduction
