#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "options/argument.hpp"

namespace contensou::program {

/// Returns instants from 0 to the end, both included. Half of the instants lie before `busy`, because most of the
/// motion happens before that time. All are equidistant unless count >= 4 and 0 < busy < end/2.
Eigen::ArrayXd instants(Eigen::Index count, double busy, double end);

/// The options --at, --samples and --equidistant, which set the instants of a motion or their number.
class InstantsOption {
 public:
  /// @param time    name of the time, and of its column in a file that --at names
  /// @param unit    symbol of the unit of the time; empty for tau
  /// @param extent  time span of the instants of --samples: "" or " from WHERE to WHERE"
  /// @param signs   true: times before the start are read, too
  void add(CLI::App& app, const std::string& time, const std::string& unit, const std::string& extent,
           bool signs = false);

  /// Times, >= 0 unless those of either sign are read, with their unit.
  struct Times {
    Eigen::ArrayXd values;
    bool in_seconds = false;
  };

  /// Reads a list of times, or the column of a file that has the name of the time.
  /// @param unit  unit of the list, as in parse_quantity; if empty, the list has no unit, or is in seconds
  static Times read_times(const std::string& typed, const std::string& time, std::string_view unit = "",
                          bool signs = false);
  /// @throws NotAllowed  for a time before the start
  static void require_not_negative(const Times& times, const std::string& time);

  const Argument& at_argument() const { return at_; }
  Arguments all() const { return {&at_, &samples_, &equidistant_}; }
  bool given() const { return at_.given() || samples_.given() || equidistant_; }

  /// Returns the instants of --at, in the order given; null without --at.
  const Times* at() const { return at_.given() ? &*at_ : nullptr; }

  /// Returns the number of instants that --samples sets; empty without --samples.
  std::optional<Eigen::Index> asked() const { return samples_.optional(); }

  /// Returns the number of instants if --at is not given.
  Eigen::Index samples() const { return samples_.value_or(standard_samples); }
  bool equidistant() const { return equidistant_; }

  /// Returns the instants of --at, or else the result of instants().
  Eigen::ArrayXd between(double busy, double end) const {
    return at_.given() ? at_->values : instants(samples(), equidistant_ ? 0 : busy, end);
  }

 private:
  static constexpr long standard_samples = 200;

  ArgumentOf<Times> at_;
  ArgumentOf<long> samples_;
  Flag equidistant_;
};

}  // namespace contensou::program
