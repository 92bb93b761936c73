#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/answer.hpp"
#include "answers/given_start.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/stop_time_gradient.hpp"

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

/// Reads "slip=1%, spin=2 rad/s, ...". A % is of the value.
/// @param known  by their names, with an underscore
/// @throws BadInput  naming what is wrong, what is allowed, and for a value that is 0: there may be a corner
std::vector<Spread> read_spreads(const std::string& typed, const std::vector<Spreadable>& known);

/// Standard normal numbers, the same on every machine: Box and Muller, from Mersenne's twister.
class Normal {
 public:
  double operator()();

 private:
  double uniform() { return (static_cast<double>(twister_() >> 11) + 0.5) * 0x1p-53; }

  std::mt19937_64 twister_{20260317};
  double second_ = 0;
  bool has_second_ = false;
};

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

/// What a number is known to that follows from others, which are independent and normal.
struct KnownTo {
  double standard = 0;                                      ///< to first order
  std::vector<std::pair<std::string, double>> shares = {};  ///< of each of them, with the sign of the derivative
  std::array<double, 5> quantiles = {};                     ///< of samples, at probabilities
  bool holds = true;  ///< whether the first order says the same as the quantiles, to a tenth of standard

  static constexpr std::array<double, 5> probabilities{0.025, 0.16, 0.5, 0.84, 0.975};

  void add_share(const std::string& name, double share);

  /// @param value    where all numbers are what they are given as
  /// @param samples  one or more
  void compare(double value, std::vector<double> samples);
};

/// {standard, quantiles, shares, first_order_holds}
Json members_of(const KnownTo& known);

/// A number of a start of which stop times go by powers. Radius, friction, a patch and all else act so: time, u, v and mu
/// go like the number to so much.
struct Uncertain : Spread {
  double of_time = 0, of_u = 0, of_v = 0, of_mu = 0;
};

/// As read_spreads: of a ball its quantities, else u0, v0 and mu.
std::vector<Uncertain> read_uncertain(const std::string& typed, const GivenStart& start);

/// What a stop time is known to, its first order by the exact gradient.
struct Uncertainty : KnownTo {
  long samples = 0;
  double outside = 0;  ///< the share of samples that no start can have (a friction below 0, say), left out
};

/// The samples are the same ones each time.
/// @param stop    the stop time; standard and quantiles are in its unit
Uncertainty uncertainty_of(const GivenStart& start, const std::vector<Uncertain>& numbers, double stop,
                           const reduction::StopTimeGradient& gradient);

}  // namespace contensou::answers
