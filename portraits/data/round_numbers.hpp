#pragma once

#include <initializer_list>
#include <vector>

#include "contensou/portraits/text.hpp"

namespace contensou::portraits {

/// The largest of 1, 2, 5 times a power of ten that is at most x > 0.
double round_down(double x);

/// A round step that a range is cut by into about so many pieces: 0.6 to 1.5 times as many.
double round_step(double range, double pieces);

/// The step, one of the digits times a power of ten, that has the number of multiples between 0 and x nearest to count;
/// of equally near ones that of the first digit.
/// @param x      > 0
/// @param count  > 0
double step_for(double x, int count, std::initializer_list<double> digits);

/// The multiples of a step between two numbers, without these.
std::vector<double> multiples(double low, double high, double step);

/// Round numbers between two positive ones, without these: powers of ten, every second or third of them where there
/// are many, with 2 and 5 between them over fewer decades than given, and multiples of a step over less than 0.7.
std::vector<double> round_ratios(double low, double high, double few_decades);

/// A number as people write it; large and small ones with their power of ten.
/// @param digits  at most so many are shown; up to 5 of them, 3 before a power of ten
Text number(double value, int digits = 5);

/// Powers of ten, all written in one way: plainly where number() writes each of them so.
std::vector<Text> powers_of_ten(const std::vector<double>& values);

}  // namespace contensou::portraits
