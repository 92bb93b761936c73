#pragma once

#include <concepts>
#include <memory>
#include <utility>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/similarity_curve.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

/// All motions of a law and an r = gamma mu^2/chi: one curve for each interval of k between two neighbours among 0, the
/// invariant rays and infinity. A solution never changes and is cheap to copy. It is empty if it has no curves.
class SimilaritySolution {
 public:
  using Curve = std::shared_ptr<const SimilarityCurve>;

  SimilaritySolution() = default;

  /// Makes a solution of one curve that covers every k.
  SimilaritySolution(Curve only)  // NOLINT(google-explicit-constructor)
      : SimilaritySolution(std::vector{std::move(only)}) {}

  template <std::derived_from<SimilarityCurve> C>
  SimilaritySolution(std::shared_ptr<C> only)  // NOLINT(google-explicit-constructor)
      : SimilaritySolution(Curve(std::move(only))) {}

  /// Makes a solution of curves that together cover every k.
  explicit SimilaritySolution(std::vector<Curve> curves) : curves_(std::move(curves)) {}

  explicit operator bool() const { return !curves_.empty(); }

  /// Returns the curve of the motions with this k; ln_k may be infinite. For a ray the result is a curve beside it.
  /// @throws std::domain_error  if no curve covers this k
  const Curve& through(double ln_k) const;

  const std::vector<Curve>& curves() const { return curves_; }

 private:
  std::vector<Curve> curves_;
};

/// Finds the solution by quadrature, for any law and r (README (R2), (R19), (R24), (R31)).
/// @param ratios  terminal_ratios(law, r, drive)
/// @throws std::domain_error   unless r is positive and finite
/// @throws std::runtime_error  if the law has an invariant ray that terminal_ratios did not find
SimilaritySolution quadrature_solution(const Law& law, double r, const TerminalRatios& ratios, double drive = 0);

/// Returns the solution in closed form, by the type of the law: PadeCurve (README (R8) to (R14)) for PadeLaw if r <=
/// PadeCurve::max_r; else empty. No other code depends on which laws have a closed form.
SimilaritySolution closed_solution(const Law& law, double r, double drive = 0);

}  // namespace contensou::reduction
