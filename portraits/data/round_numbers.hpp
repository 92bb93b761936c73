#pragma once

#include <initializer_list>
#include <vector>

#include "contensou/portraits/text.hpp"

namespace contensou::portraits {

/// Returns the largest of 1, 2, 5 times a power of ten that is at most x > 0.
double round_down(double x);

/// Returns a round step that divides a range into about the given number of pieces (0.6 to 1.5 times this number).
double round_step(double range, double pieces);

/// Returns a step that is one of the digits times a power of ten. The number of its multiples between 0 and x is as
/// near to count as possible. If several steps are equally near, the earliest digit wins.
/// @param x      > 0
/// @param count  > 0
double step_for(double x, int count, std::initializer_list<double> digits);

/// Returns the multiples of a step between two numbers, both excluded.
std::vector<double> multiples(double low, double high, double step);

/// Returns round numbers between two positive numbers, both excluded. For many decades they are every second or third
/// power of ten. Otherwise they are powers of ten; for fewer decades than few_decades also 2 and 5 times these; for
/// less than 0.7 decades the multiples of a step.
std::vector<double> round_ratios(double low, double high, double few_decades);

/// Returns a number as text, as people write it. Large and small numbers have a power of ten.
/// @param digits  most digits shown; up to 5 without and 3 with a power of ten
Text number(double value, int digits = 5);

/// Returns powers of ten in one notation: without exponents if number() writes all of them without exponents.
std::vector<Text> powers_of_ten(const std::vector<double>& values);

}  // namespace contensou::portraits
