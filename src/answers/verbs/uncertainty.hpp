#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "answers/asked/given_start.hpp"
#include "answers/table/answer.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::answers {

/// Uncertainty of a number that is a function of normally distributed numbers.
struct KnownTo {
  double standard = 0;  ///< standard deviation to first order
  /// Standard deviation due to each number alone, with the sign of the derivative. If the numbers are independent,
  /// `standard` is the square root of the sum of the squares of these shares.
  std::vector<std::pair<std::string, double>> shares = {};
  std::array<double, 5> quantiles = {};  ///< quantiles of the samples at `probabilities`
  bool holds = true;                     ///< true if first order and quantiles agree within a tenth of `standard`

  static constexpr std::array<double, 5> probabilities{0.025, 0.16, 0.5, 0.84, 0.975};
};

/// The uncertainty of the numbers of a motion's events.
struct Uncertainty {
  struct Part {
    si::EventNumber number;  ///< its function `value` is not used
    double value;
    KnownTo known = {};
  };
  std::vector<Part> parts;
  long samples = 0;
  double outside = 0;  ///< share of samples left out because no start has such values, e.g. a friction below 0
};

/// Returns the label of a number of an event, such as "rolls after t" or "path".
std::string label_of(const si::EventNumber& number);

/// Returns the place of a number of an event in an object of JSON: members.rolls_after.t, or members.path.
Json& place_of(const si::EventNumber& number, Json& members);

/// Returns the uncertainty of all events of `roll`.
/// @param rolling_below  slip below which the ball rolls, m/s, as in si::Motion::rolls
/// @param typed          spreads such as "slip=1%, spin=2 rad/s, fit", for numbers of the ball and of its start: slip,
///                       spin or vx, vy, wx, wy, wz
/// @param before_each    called before each sample; it may throw
/// @throws BadInput  with the mistake and the allowed values; for a ball at rest; and if all samples are outside
Uncertainty roll_uncertainty(
    const si::Experiment& experiment, const reduction::Law& law, double rolling_below, const std::string& typed,
    const std::function<void()>& before_each = [] {});

/// Returns the uncertainty of the stop time alone: in s for a ball, otherwise in tau.
/// @param typed  for a ball as in roll_uncertainty, but only slip and spin for the start; otherwise spreads of u0, v0,
///               mu
Uncertainty stop_uncertainty(const GivenStart& start, const std::string& typed);

/// Returns {standard, quantiles, shares, first_order_holds}.
Json members_of(const KnownTo& known);

/// Returns {rolls_after: {t, x, y}, spin_ends: {t, x, y}, slip_length, turns, path, t_stop, samples, outside}.
Json members_of(const Uncertainty& uncertainty);

/// Returns the uncertainty of all numbers as a table.
std::string text_of(const Uncertainty& uncertainty, const Digits& digits);

/// Returns the remarks below the table of text_of: numbers for which the first order fails, and samples left out.
std::string remarks_on(const Uncertainty& uncertainty);

}  // namespace contensou::answers
