#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/given_start.hpp"
#include "answers/table/answer.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/stop_time_gradient.hpp"
#include "contensou/si/spreads.hpp"

namespace contensou::answers {

/// A number of a start that is known to so much.
struct Spread {
  std::string name;
  double value;
  double standard = 0;  ///< standard deviation of value, in its unit
};

/// A number that may be given a spread.
struct Spreadable {
  Spread number;
  std::string_view unit;         ///< as of a Quantity
  std::string_view corner = {};  ///< what has a corner, and so no first order, where it is 0; empty: nothing
};

/// Numbers that are known to so much, and how their errors go together.
struct Spreads {
  std::vector<Spread> numbers;
  Eigen::MatrixXd correlation;  ///< 1 on the diagonal

  /// The standard deviation of a sum of the numbers, each times what is given here over its own.
  double standard_of(const Eigen::VectorXd& shares) const {
    const double largest = shares.size() > 0 ? shares.cwiseAbs().maxCoeff() : 0;
    if (!(largest > 0)) return 0;
    const Eigen::VectorXd unit = shares / largest;  // its squares are doubles still
    return largest * std::sqrt(std::max(0.0, unit.dot(correlation * unit)));
  }
};

/// Reads "slip=1%, spin=2 rad/s, ...". A % is of the value. "fit" is what the ball itself is known to, which numbers that are
/// named beside it replace: those are independent of the others.
/// @param known  by their names, with an underscore
/// @param own    of the ball
/// @throws BadInput  naming what is wrong, what is allowed, and for a value that is 0: there may be a corner
Spreads read_spreads(const std::string& typed, const std::vector<Spreadable>& known, const si::Spreads& own);

/// How many samples were taken, and the share of those that no start can have (a friction below 0, say), left out.
struct Sampled {
  long samples = 0;
  double outside = 0;
};

/// Samples of numbers that are normal: the same ones each time, on every machine.
/// @param take  is given the numbers, and says whether there is such a start
/// @throws BadInput  if there is none at all
Sampled sample(const Spreads& spreads, long wanted, const std::function<bool(const Eigen::VectorXd& numbers)>& take);

/// Solutions of one system but for its mu: of those a step of ln mu apart, and linear between two of them.
class FlowsOfMu {
 public:
  /// @param step  of ln mu, an eighth of what it is known to leaves 1e-3 of a standard deviation; 0: mu is always the same
  FlowsOfMu(const reduction::ReducedSystem& system, double step) : system_(system), step_(step) {}

  /// @param value  of a flow: a number, or an array
  template <class Value>
  auto operator()(double mu, const Value& value) {
    const double steps = step_ > 0 ? std::log(mu / system_.mu()) / step_ : 0, before = std::floor(steps);
    const double beyond = steps - before;
    auto result = value(at(static_cast<long>(before)));
    if (beyond > 0) result = (1 - beyond) * result + beyond * value(at(static_cast<long>(before) + 1));
    return result;
  }

 private:
  const reduction::Flow& at(long steps);

  reduction::ReducedSystem system_;
  double step_;
  std::map<long, reduction::Flow> flows_;
};

/// What a number is known to that follows from others, which are normal.
struct KnownTo {
  double standard = 0;  ///< to first order
  /// Of each of them alone, with the sign of the derivative: where they are independent, standard is the root of the sum of squares.
  std::vector<std::pair<std::string, double>> shares = {};
  std::array<double, 5> quantiles = {};  ///< of samples, at probabilities
  bool holds =
      true;  ///< whether the first order says the same as the quantiles, to a tenth of standard, and of few samples to what they tell

  static constexpr std::array<double, 5> probabilities{0.025, 0.16, 0.5, 0.84, 0.975};

  /// The first order.
  void set_shares(const Spreads& spreads, const Eigen::VectorXd& share);

  /// @param value    where all numbers are what they are given as
  /// @param samples  one or more
  void compare(double value, std::vector<double> samples);
};

/// {standard, quantiles, shares, first_order_holds}
Json members_of(const KnownTo& known);

/// As read_spreads: of a ball its quantities, with slip and spin whatever its start is given by; else u0, v0 and mu.
Spreads read_uncertain(const std::string& typed, const GivenStart& start);

/// What a stop time is known to, its first order by the exact gradient.
struct Uncertainty : KnownTo, Sampled {};

/// @param spreads  as read_uncertain has them
/// @param stop     the stop time; standard and quantiles are in its unit
/// @throws BadInput  as sample
Uncertainty uncertainty_of(const GivenStart& start, const Spreads& spreads, double stop,
                           const reduction::StopTimeGradient& gradient);

}  // namespace contensou::answers
