#pragma once

#include <concepts>
#include <memory>
#include <utility>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/similarity_curve.hpp"

namespace contensou::reduction {

/// All motions under a law and an r: one curve, or, where there is an invariant ray, one for either side of it.
///
/// A value, cheap to copy; empty where somebody has no solution to offer.
class SimilaritySolution {
 public:
  using Curve = std::shared_ptr<const SimilarityCurve>;

  SimilaritySolution() = default;

  /// One curve for every k.
  SimilaritySolution(Curve only) : above_(std::move(only)) {}  // NOLINT(google-explicit-constructor)

  template <std::derived_from<SimilarityCurve> C>
  SimilaritySolution(std::shared_ptr<C> only) : above_(std::move(only)) {}  // NOLINT(google-explicit-constructor)

  /// Two curves that end on one ray.
  SimilaritySolution(Curve above, Curve below) : above_(std::move(above)), below_(std::move(below)) {}

  explicit operator bool() const { return above_ != nullptr || below_ != nullptr; }

  /// The curve of the motions with this k, finite or not; the ray itself belongs to either.
  /// @throws std::domain_error  if there is none
  const Curve& through(double ln_k) const;

 private:
  Curve above_;
  Curve below_;
};

/// By quadrature: for any law and r.
/// @throws std::domain_error  as QuadratureCurve
SimilaritySolution quadrature_solution(const Law& law, double r);

/// In closed form, found by the law's type: PadeCurve for PadeLaw up to PadeCurve::largest_r; empty for all else.
SimilaritySolution closed_solution(const Law& law, double r);

/// What the library uses: the closed form where there is one, quadrature otherwise.
SimilaritySolution similarity_solution(const Law& law, double r);

}  // namespace contensou::reduction
