#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// The stop times of one system, for very many starts: at fixed law, mu and body
///   tau* = P + m(k0) S,  k0 = v0/(mu |u0|)
/// (README (R4)) with m as a table of polynomials, so that an array costs about as much as reading and writing it.
///
/// A start (u0, v0) is as for stop_time: u0 of either sign, v0 >= 0, any size; a result that a double cannot hold is
/// infinity. An array may hold others, too, and each that stop_time rejects becomes NaN.
///
/// The table proves itself when it is built: some stop times of each panel are compared with those of the closed form
/// or curve that it was made from. Starts in a panel that misses one by more than 4 eps are computed one by one, from
/// that closed form or curve; so are those of a system whose P/|u0| or S/v0 is beyond 2^100 or below 2^-100.
///
/// Source    README (R18): m from pade_sliding_coefficient (Pade) or the flow's curves (other laws).
/// Accuracy  Pade 4 ulp for mu <= 3; other laws 4 eps relative, and what their curve misses by.
/// Cost      built in 10 ms; then 3 ns a start in an array (AVX2; 6 ns without), 20 ns one start.
/// Bits      the same for one start and for many, however they are cut into arrays and threads.
class StopTimeTable {
 public:
  explicit StopTimeTable(const Flow& flow);

  const ReducedSystem& system() const;

  /// Whether every panel was within 4 eps. If not, the table is right all the same, and slow for some starts.
  bool proved() const;

  /// Of the starts that were compared, whose panels are in use: the largest relative error.
  double worst_error() const;

  /// The panels that are not used, over all: 0 if proved(), 1 if every start is computed one by one.
  double refused() const;

  /// The stop time of one start.
  /// @throws std::domain_error  if u0 or v0 is not finite, or v0 < 0
  double operator()(double u0, double v0) const;

  /// The stop times of starts (u0[i], v0[i]).
  ///
  /// @param tau      as many as there are starts; may be u0 or v0 itself, but must not overlap them otherwise
  /// @param threads  how many share the work, >= 1; the calling thread is one of them
  /// @throws std::domain_error  if the three sizes differ, or threads is 0
  void evaluate(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                unsigned threads = 1) const;

  /// A row of a grid: the stop times of starts (u0[i], v0), the same bits as evaluate's.
  void evaluate_row(std::span<const double> u0, double v0, std::span<double> tau) const;

 private:
  struct Stored;
  std::shared_ptr<const Stored> stored_;
};

}  // namespace contensou::reduction
