#pragma once

#include <memory>
#include <span>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// The stop times of one system, for very many starts: at fixed law, mu and body
///   tau* = P + m(k0) S,  k0 = v0/(mu |u0|)
/// (README (R4)) with m as a table of polynomials, so that an array costs about as much as reading and writing it.
///
/// A start (u0, v0) is as for stop_time: u0 of either sign, v0 >= 0, any size; a result that a double cannot hold is
/// infinity. An array may hold others, too, and each that stop_time rejects becomes NaN.
///
/// The table proves itself when it is built: some stop times of each panel are compared with the flow's. Starts in a
/// panel that misses one by more than 4 eps are computed one by one, by the flow; so are those of a system whose P/|u0|
/// or S/v0 is beyond 2^100 or below 2^-100.
///
/// Source    README (R18): m from the flow's curves.
/// Accuracy  4 eps relative, and what the curve misses by.
/// Cost      built in 10 ms; then 3 ns a start in an array (AVX2; 6 ns without), 20 ns one start.
/// Bits      the same for one start and for many, however they are cut into arrays and threads.
class StopTimeTable {
 public:
  explicit StopTimeTable(const Flow& flow);

  /// Of the starts that were compared, whose panels are in use: the largest relative error.
  double worst_error() const;

  /// The panels that are not used, over all: 0 if every panel was within 4 eps, 1 if every start is computed one by one.
  double refused() const;

  /// The stop time of one start.
  /// @throws std::domain_error  if u0 or v0 is not finite, or v0 < 0
  double operator()(double u0, double v0) const;

  /// As Flow::stop_times of many starts.
  void evaluate(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                unsigned threads = 1) const;

 private:
  struct Stored;
  std::shared_ptr<const Stored> stored_;
};

}  // namespace contensou::reduction
