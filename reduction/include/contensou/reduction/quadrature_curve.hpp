#pragma once

#include <memory>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/similarity_curve.hpp"

namespace contensou::reduction {

/// The similarity curve of any friction law, by quadrature of the separated equation.
///
/// The nested integrals (R2), (R4), (R7), (R13) are done panel by panel in ln k: on each, the integrands are sampled at
/// Gauss points (Boost.Math) and their Legendre series integrated term by term, so that the inner integral is known
/// wherever the outer one needs it. Panels meet at k = 1 and are halved until the series has converged. Outside k =
/// 4e-18 .. 1e19 the limits hold to the last bit.
///
/// Accuracy  1e-13 or better for a law that is smooth on either side of k = 1 (measured: tests/reference/README.md).
/// Cost      about 5000 evaluations of the law, once; then some 30 ns for each value. Noise in the law costs up to a
///           million, and shows in truncation().
class QuadratureCurve final : public SimilarityCurve {
 public:
  /// @param r  gamma mu^2/chi
  /// @throws std::domain_error  unless r > 0 and Phi > r k Psi for every k: beyond, the plane has an invariant ray or k
  ///                            grows, and the curve is not this one
  QuadratureCurve(const Law& law, double r);

  double log_rim(double ln_k) const override;
  double sliding_share(double ln_k) const override;
  double slip_excess(double ln_k) const override;
  double regularised_age(double ln_k) const override;

  /// Estimate of the relative error of sliding_share from the last terms of the series; rounding is not in it.
  double truncation() const { return truncation_; }

  /// How often the law was called.
  long evaluations() const { return evaluations_; }

 private:
  struct Panel;
  const Panel* find(double ln_k) const;

  void split(const Law& law, double left, double right, int depth);
  void integrate_forwards();
  void integrate_backwards(double age_at_top);

  std::vector<Panel> panels_;
  double lower_slope_ = 0;  ///< d log_rim/d ln k as k -> 0
  double upper_slope_ = 0;  ///< the same as k -> infinity
  double final_age_ = 0;    ///< b(0)
  double truncation_ = 0;
  long evaluations_ = 0;

 public:
  ~QuadratureCurve() override;
};

/// The curve that the library uses for a law: its own closed form where it has one, quadrature otherwise.
std::shared_ptr<const SimilarityCurve> similarity_curve(const Law& law, double r);

}  // namespace contensou::reduction
