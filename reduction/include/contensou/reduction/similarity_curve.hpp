#pragma once

namespace contensou::reduction {

/// The one orbit that every motion under a law and an r is a scaled copy of, as four functions of ln k (README (R2),
/// (R4), (R7), (R13)); k = v/w, w = mu |u|.
///
/// Scaling symmetry leaves nothing else to compute: orbits, stop times, the state at a given time and the regularised
/// time follow by exponentials and sums (Orbit). All four functions are regular for every r in the domain, however
/// small, and ln_k may be any finite number: v underflows long before ln v does.
class SimilarityCurve {
 public:
  virtual ~SimilarityCurve() = default;

  /// ln w along the curve, up to a constant; grows with k from slope a (k -> 0) to slope e (k -> infinity).
  virtual double log_rim(double ln_k) const = 0;

  /// m(k): the time left is  P + m S  (README (R4)); 1 in the limit of pure sliding.
  virtual double sliding_share(double ln_k) const = 0;

  /// n(k): the length of slip that is left, the integral of v ds, is  v (v/2 + n w)  (README (R13)).
  virtual double slip_excess(double ln_k) const = 0;

  /// b(k): w times the regularised time since k = infinity, without its constant (README (R7)).
  virtual double regularised_age(double ln_k) const = 0;

  /// r = gamma mu^2/chi.
  double r() const { return r_; }

  SimilarityCurve(const SimilarityCurve&) = delete;
  SimilarityCurve& operator=(const SimilarityCurve&) = delete;

 protected:
  explicit SimilarityCurve(double r) : r_(r) {}

 private:
  double r_;
};

}  // namespace contensou::reduction
