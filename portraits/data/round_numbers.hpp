#pragma once

#include <initializer_list>
#include <vector>

#include "contensou/portraits/text.hpp"

namespace contensou::portraits {

/// Returns the largest of 1, 2, 5 times a power of ten that is at most x > 0.
double round_down(double x);

/// Returns a round step that divides a range into about the given number of pieces: 0.6 to 1.5 times as many.
double round_step(double range, double pieces);

/// Returns the step, one of the digits times a power of ten, whose number of multiples between 0 and x is nearest to
/// count. Among equally near steps the one with the earliest digit wins.
/// @param x      > 0
/// @param count  > 0
double step_for(double x, int count, std::initializer_list<double> digits);

/// Returns the multiples of a step between two numbers, both excluded.
std::vector<double> multiples(double low, double high, double step);

/// Returns round numbers between two positive ones, both excluded. These are powers of ten; every second or third of
/// them for many decades; also 2 and 5 for fewer decades than given; multiples of a step for less than 0.7 decades.
std::vector<double> round_ratios(double low, double high, double few_decades);

/// Returns a number as people write it; large and small numbers with their power of ten.
/// @param digits  most digits shown; up to 5 without and 3 with a power of ten
Text number(double value, int digits = 5);

/// Returns powers of ten, all written in one way: without exponents if number() writes each of them so.
std::vector<Text> powers_of_ten(const std::vector<double>& values);

}  // namespace contensou::portraits
