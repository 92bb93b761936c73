#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::tests {

/// The worst of many comparisons, and the case in which it occurred.
///
/// Errors are given in eps = 2^-52 of the wanted number (or of a scale that the caller gives), like the bounds in the
/// headers. The option -s makes the test print the measured errors.
class WorstCase {
 public:
  explicit WorstCase(std::string what) : what_(std::move(what)) {}

  /// Adds a comparison with a number that is known to more digits than a double has.
  void add(long double wanted, double got, const std::string& where) { add(wanted, got, std::abs(wanted), where); }

  /// Adds a comparison whose error is relative to a given scale >= 0.
  void add(long double wanted, double got, long double scale, const std::string& where) {
    const double error = in_eps(wanted, got, scale);
    sum_ += error;
    ++count_;
    if (count_ > 1 && error <= worst_) return;
    worst_ = error;
    worst_where_ = fmt::format("{}: wanted {:.21Lg}, got {:.17g}", where, wanted, got);
  }

  /// Returns the worst error in eps; infinity if any number was NaN.
  double worst() const { return worst_; }
  double mean() const { return sum_ / static_cast<double>(count_); }
  long count() const { return count_; }

  std::string sentence() const {
    return fmt::format("{}: worst {:.3g} eps, mean {:.2g} eps of {}; worst at {}", what_, worst_, mean(), count_,
                       worst_where_);
  }

 private:
  static double in_eps(long double wanted, double got, long double scale) {
    constexpr double largest = std::numeric_limits<double>::max();
    if (std::abs(wanted) > static_cast<long double>(largest)) {
      return std::isinf(got) && std::signbit(got) == std::signbit(wanted) ? 0 : infinity;
    }
    if (static_cast<long double>(got) == wanted) return 0;
    const long double unit = std::max<long double>(scale * std::numeric_limits<double>::epsilon(),
                                                   std::numeric_limits<double>::denorm_min());
    const auto error = static_cast<double>(std::abs(static_cast<long double>(got) - wanted) / unit);
    return std::isfinite(error) ? error : infinity;
  }

  std::string what_;
  double worst_ = 0;
  double sum_ = 0;
  long count_ = 0;
  std::string worst_where_ = "nowhere";
};

}  // namespace contensou::tests

/// Fails, with the worst case in the message, if an error is above `bound` eps, or if nothing was compared.
#define CHECK_WITHIN_EPS(worst_case, bound) \
  do {                                      \
    INFO((worst_case).sentence());          \
    CHECK((worst_case).count() > 0);        \
    CHECK((worst_case).worst() <= (bound)); \
  } while (false)
