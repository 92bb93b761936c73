#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

struct StopTimeTable;

/// The stop times of one system, for very many starts: at fixed law, mu and body
///   tau* = D G(y),  D = |u0| + lever v0,  y = |u0|/D,
/// with a lever that belongs to the system, and G is a smooth function of one variable: a table of polynomials whose
/// panels are the exponent and four bits of the mantissa of a fraction in k0, so that an array costs some half as much
/// again as reading and writing it.
///
/// A start (u0, v0) is as for stop_time: u0 of either sign, v0 >= 0, any size: a result that a double cannot hold is
/// infinity. An array may hold others, too, and each that stop_time rejects becomes NaN.
///
/// Source    README (R18) to (R20): Taylor series for Pade's law and r <= 7/4, any ball with mu <= 1 among them;
///           collocation for other laws, smooth on either side of k = 1, and every r.
/// Accuracy  Pade 4 ulp for mu <= 3; the other laws of laws.hpp 4 eps relative, every r; a law with kinks or noise,
///           somewhat more.
/// Cost      built in 1 ms (Pade, r <= 7/4), 20 ms (others).
/// Bits      the same for one start and for many, however they are cut into arrays and threads, and on processors of
///           different instruction sets (baseline, AVX2 with FMA, AVX-512: chosen at run time).
class StopTimeProfile {
 public:
  /// Assumes  of the law what terminal_ratio does
  explicit StopTimeProfile(const ReducedSystem& system);

  const ReducedSystem& system() const { return system_; }

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
  void evaluate_row(std::span<const double> u0, double v0, std::span<double> tau, unsigned threads = 1) const;

  /// What evaluate runs on here: "baseline", "AVX2" or "AVX-512".
  static std::string_view instruction_set();

  /// What the loops of the instruction sets read; of no use without the library's sources.
  const StopTimeTable& table() const { return *table_; }

 private:
  ReducedSystem system_;
  std::shared_ptr<const StopTimeTable> table_;
};

}  // namespace contensou::reduction
