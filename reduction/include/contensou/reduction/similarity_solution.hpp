#pragma once

#include <concepts>
#include <memory>
#include <utility>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/similarity_curve.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

/// All motions under a law and an r: one curve for each interval of k between two neighbours of 0, the invariant rays
/// and infinity.
///
/// A value, cheap to copy; empty where somebody has no solution to offer.
class SimilaritySolution {
 public:
  using Curve = std::shared_ptr<const SimilarityCurve>;

  SimilaritySolution() = default;

  /// One curve for every k.
  SimilaritySolution(Curve only)  // NOLINT(google-explicit-constructor)
      : SimilaritySolution(std::vector{std::move(only)}) {}

  template <std::derived_from<SimilarityCurve> C>
  SimilaritySolution(std::shared_ptr<C> only)  // NOLINT(google-explicit-constructor)
      : SimilaritySolution(Curve(std::move(only))) {}

  /// Curves that cover every k.
  explicit SimilaritySolution(std::vector<Curve> curves) : curves_(std::move(curves)) {}

  explicit operator bool() const { return !curves_.empty(); }

  /// The curve of the motions with this k, finite or not; a ray itself belongs to either of its sides.
  /// @throws std::domain_error  if there is none
  const Curve& through(double ln_k) const;

  const std::vector<Curve>& curves() const { return curves_; }

 private:
  std::vector<Curve> curves_;
};

/// By quadrature: for any law and r (README (R2), (R19), (R24), (R31)).
/// @param ratios  terminal_ratios(law, r, drive)
/// @throws std::domain_error   unless r is positive and finite
/// @throws std::runtime_error  if the law has an invariant ray that terminal_ratios did not find
SimilaritySolution quadrature_solution(const Law& law, double r, const TerminalRatios& ratios, double drive = 0);

/// In closed form, found by the law's type: PadeCurve (README (R8) to (R14)) for PadeLaw up to its max_r; else empty. The one
/// place that knows which laws have one.
SimilaritySolution closed_solution(const Law& law, double r, double drive = 0);

}  // namespace contensou::reduction
