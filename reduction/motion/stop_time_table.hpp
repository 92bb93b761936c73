#pragma once

#include <memory>
#include <span>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// The stop times of one system for very many starts: at fixed law, mu and body
///   tau* = P + m(k0) S,  k0 = v0/(mu |u0|)
/// (theory.md (R4)), with m as a table of polynomials. For an array the cost is about that of reading and writing it.
///
/// A start (u0, v0) has u0 of either sign and v0 >= 0, both of any size. A stop time above all doubles is infinity.
/// A start that Flow::stop_time rejects becomes NaN.
///
/// The constructor tests the table: it compares some stop times of each panel with those of the flow. If an error in a
/// panel is above 4 eps, the flow computes all starts of this panel one by one. The flow computes all starts if P/|u0|
/// or S/v0 of the system is above 2^100 or below 2^-100.
///
/// Source    theory.md (R5): m from the flow's curves.
/// Accuracy  4 eps relative, plus the error of the curve.
/// Cost      10 ms to make; then 3 ns a start in an array (AVX2; 6 ns without), 20 ns for a single start.
/// Bits      equal for one start and for many, for any division of the starts into arrays and threads.
class StopTimeTable {
 public:
  explicit StopTimeTable(const Flow& flow);

  /// Returns the largest relative error that the test found in the panels that are used.
  double worst_error() const;

  /// Returns the share of unused panels: 0 if every panel is within 4 eps, 1 if the flow computes every start.
  double refused() const;

  /// Returns the stop time of one start.
  /// @throws std::domain_error  if u0 or v0 is not finite, or v0 < 0
  double operator()(double u0, double v0) const;

  /// Computes stop times for many starts, as Flow::stop_times.
  void evaluate(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                unsigned threads = 1) const;

 private:
  struct Stored;
  std::shared_ptr<const Stored> stored_;
};

}  // namespace contensou::reduction
