#pragma once

#include <string_view>

namespace contensou::program {

enum class Steps { linear, logarithmic };

/// Numbers from one to another in equal steps or, logarithmically, in equal ratios; both ends are among them.
class Range {
 public:
  /// @throws BadInput  saying what is allowed, unless count >= 1, least < most for count >= 2, least = most for
  ///                   count = 1; with logarithmic steps, unless least > 0
  Range(double least, double most, long count, Steps steps);

  /// One number alone.
  explicit Range(double only) : Range(only, only, 1, Steps::linear) {}

  double least() const { return least_; }
  double most() const { return most_; }
  long count() const { return count_; }
  Steps steps() const { return steps_; }

  /// The number at a place from 0 to count() - 1, rounded once where long double has digits to spare.
  double operator[](long place) const;

 private:
  double least_, most_;
  long count_;
  Steps steps_;
};

/// MIN:MAX:N, or a number alone.
/// @throws BadInput  quoting what is wrong, and as Range
Range parse_range(std::string_view text, Steps steps);

}  // namespace contensou::program
