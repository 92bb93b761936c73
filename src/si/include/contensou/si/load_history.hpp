#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace contensou::si {

/// A time or a load that no LoadHistory can have.
struct WrongLoad : std::domain_error {
  WrongLoad(std::size_t wrong, const std::string& message) : std::domain_error(message), row(wrong) {}
  std::size_t row;  ///< its place among the times, counted from 0
};

/// A load that changes in time: linear between given times, and constant after the last.
///
/// Friction is proportional to the load. The motion therefore passes through the same states as under a constant load,
/// at other times: its state at t is the state at the time clock(t) under the load nominal().
class LoadHistory {
 public:
  /// @param t     times, s, from 0 on, not decreasing; two equal times are a jump
  /// @param load  load at each time, N, >= 0
  /// @throws WrongLoad          for the first time or load that is not allowed
  /// @throws std::domain_error  unless there are two or more times, each with a load, and one load is positive
  LoadHistory(std::vector<double> t, std::vector<double> load);

  /// Returns the first positive load, N.
  double nominal() const { return nominal_; }

  /// Returns the time, s, at which a motion under the nominal load has the state that this motion has at t.
  double clock(double t) const;

  /// Returns the first t at which clock(t) has a given value; infinity if there is none.
  double time_of(double clock) const;

  /// Returns the times at which the load has a corner or a jump.
  const std::vector<double>& instants() const { return t_; }
  const std::vector<double>& loads() const { return load_; }

 private:
  std::vector<double> t_, load_;
  std::vector<double> clock_;  ///< value of the clock at each time
  double nominal_ = 0;
};

}  // namespace contensou::si
