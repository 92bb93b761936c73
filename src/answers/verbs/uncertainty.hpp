#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/asked/given_start.hpp"
#include "answers/table/answer.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::answers {

/// What a number is known to that follows from others, which are normal.
struct KnownTo {
  double standard = 0;  ///< to first order
  /// Of each of them alone, with the sign of the derivative: where they are independent, standard is the root of the sum of squares.
  std::vector<std::pair<std::string, double>> shares = {};
  std::array<double, 5> quantiles = {};  ///< of samples, at probabilities
  bool holds = true;                     ///< whether the first order agrees with the quantiles to a tenth of standard

  static constexpr std::array<double, 5> probabilities{0.025, 0.16, 0.5, 0.84, 0.975};
};

/// The uncertainty of the numbers of a motion's events.
struct Uncertainty {
  /// A number of an event.
  struct Part {
    std::string event, of;  ///< as in JSON: rolls_after and t; slip_length and nothing
    std::string unit;
    double value;
    KnownTo known = {};
  };
  std::vector<Part> parts;
  long samples = 0;
  double outside = 0;  ///< share of the samples that no start can have (a friction below 0, say), left out
};

/// "rolls after t"; "path".
std::string label_of(std::string_view event, std::string_view of);

/// The uncertainty of all events of `roll`.
/// @param rolling_below  as of si::Motion::rolls
/// @param typed          "slip=1%, spin=2 rad/s, fit": of the ball's numbers, and of the start slip, spin or vx, vy, wx, wy, wz
/// @throws BadInput  naming what is wrong and what is allowed, of a motion that is at rest, and where all samples are outside
Uncertainty roll_uncertainty(const si::Experiment& experiment, const reduction::Law& law, double rolling_below,
                             const std::string& typed);

/// The same of the stop time alone, in seconds of a ball, otherwise in tau.
/// @param typed  of a ball as of roll_uncertainty, with slip and spin whatever its start is given by; else of u0, v0, mu
Uncertainty stop_uncertainty(const GivenStart& start, const std::string& typed);

/// {standard, quantiles, shares, first_order_holds}
Json members_of(const KnownTo& known);

/// {rolls_after: {t, x, y}, spin_ends: {t, x, y}, slip_length, turns, path, t_stop, samples, outside}
Json members_of(const Uncertainty& uncertainty);

/// A table of all numbers.
std::string text_of(const Uncertainty& uncertainty, const Digits& digits);

/// The remarks below such a table: where the first order does not hold, and samples that were left out.
std::string remarks_on(const Uncertainty& uncertainty);

}  // namespace contensou::answers
