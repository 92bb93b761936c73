#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "answers/given_start.hpp"
#include "contensou/reduction/stop_time_gradient.hpp"

namespace contensou::answers {

/// A number of a start that is known to so much, and what of a stop time follows from it. Radius, friction, a patch and
/// all else act through these by powers: time, u, v and mu go like the number to so much.
struct Uncertain {
  std::string name;
  double value;
  double standard;  ///< standard deviation of value, in its unit
  double of_time = 0, of_u = 0, of_v = 0, of_mu = 0;
};

/// Reads "slip=1%, spin=2 rad/s, ...": of a ball its quantities, else u0, v0 and mu. A % is of the value.
/// @throws BadInput  naming what is wrong, what is allowed, and for a value that is 0: there a stop time has a corner
std::vector<Uncertain> read_uncertain(const std::string& typed, const GivenStart& start);

/// What a stop time is known to, where its numbers are independent and normal.
struct Uncertainty {
  double standard;                                     ///< to first order, by the exact gradient
  std::vector<std::pair<std::string, double>> shares;  ///< of each number, with the sign of its derivative
  std::array<double, 5> quantiles;                     ///< of the samples, at probabilities
  long samples;
  double outside;  ///< the share of samples that no start can have (a friction below 0, say), left out
  bool holds;      ///< whether the first order says the same as the quantiles, to a tenth of standard

  static constexpr std::array<double, 5> probabilities{0.025, 0.16, 0.5, 0.84, 0.975};
};

/// The samples are the same ones each time.
/// @param stop    the stop time; standard and quantiles are in its unit
Uncertainty uncertainty_of(const GivenStart& start, const std::vector<Uncertain>& numbers, double stop,
                           const reduction::StopTimeGradient& gradient);

}  // namespace contensou::answers
