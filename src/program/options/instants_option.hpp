#pragma once

#include <string>

#include <Eigen/Core>

#include "options/argument.hpp"

namespace contensou::program {

/// --at and --samples: the instants of a motion, or their number.
class InstantsOption {
 public:
  /// @param time    its name, as of a column in the file of --at
  /// @param unit    "" or " in UNIT"
  /// @param extent  of equidistant instants: "" or " from WHERE to WHERE"
  /// @return        --at
  CLI::Option* add(CLI::App& app, const std::string& time, const std::string& unit, const std::string& extent);

  bool given() const { return at_.given() || samples_.given(); }

  /// Those of --at, in the order given; null without it.
  const Eigen::ArrayXd* at() const { return at_.given() ? &*at_ : nullptr; }

  /// How many equidistant ones are wanted.
  Eigen::Index samples() const { return samples_.value_or(standard_samples); }

 private:
  static constexpr long standard_samples = 200;

  ArgumentOf<Eigen::ArrayXd> at_;
  ArgumentOf<long> samples_;
};

}  // namespace contensou::program
