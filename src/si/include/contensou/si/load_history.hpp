#pragma once

#include <vector>

namespace contensou::si {

/// A load that changes in time, linear from instant to instant, and the last one from then on.
///
/// Friction is proportional to it, and so the motion goes through the states that it has under a constant load, at
/// other times: after t under this load it is where it would be after clock(t) under nominal().
class LoadHistory {
 public:
  /// @param t     s, from 0 on, not decreasing: two of one t are a jump
  /// @param load  N, >= 0, as many
  /// @throws std::domain_error  unless there are two or more, finite, of which one load is positive
  LoadHistory(std::vector<double> t, std::vector<double> load);

  /// N, the first that is positive.
  double nominal() const { return nominal_; }

  /// s under the nominal load, within which friction does what it does until t under this one.
  double clock(double t) const;

  /// The first t at which clock(t) is that; infinity if it never is.
  double time_of(double clock) const;

  /// Where it bends.
  const std::vector<double>& instants() const { return t_; }
  const std::vector<double>& loads() const { return load_; }

 private:
  std::vector<double> t_, load_;
  std::vector<double> clock_;  ///< at each
  double nominal_ = 0;
};

}  // namespace contensou::si
