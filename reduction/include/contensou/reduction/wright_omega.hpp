#pragma once

namespace contensou::reduction {

/// The Wright omega function: the w > 0 that solves w + ln w = x. It is the Lambert function W(exp(x)) without exp(x),
/// which overflows where a patch slides faster than 700 times its rim.
///
/// @param x  any real number; -inf gives 0, inf gives inf
/// @throws std::domain_error  if x is not a number
///
/// Accuracy  4 eps relative for every x (tests/reference/wright_omega.csv); below x = -708.4 the result is subnormal,
/// and
///           below -745.2 it is 0. Its logarithm is x - w.
double wright_omega(double x);

}  // namespace contensou::reduction
