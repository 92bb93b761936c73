#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "contensou/reduction/pade_curve.hpp"
#include "contensou/reduction/pade_law.hpp"

namespace contensou::tests {

/// What a curve tells instead of the truth.
struct CurveLie {
  using Lie = std::function<double(double ln_k, double truth)>;
  Lie log_rim = [](double, double truth) { return truth; };
  Lie sliding_share = [](double, double truth) { return truth; };
  Lie regularised_age = [](double, double truth) { return truth; };
};

/// The closed curve of the Pade law with functions that are not its own.
class LyingCurve final : public reduction::SimilarityCurve {
 public:
  // It never comes to its limit: every ln k is asked for.
  LyingCurve(double r, CurveLie lie)
      : SimilarityCurve(r, reduction::Approach::to_zero(), -1e6), truth_(r), lie_(std::move(lie)) {}
  double log_rim(double ln_k) const override { return lie_.log_rim(ln_k, truth_.log_rim(ln_k)); }
  double sliding_share(double ln_k) const override { return lie_.sliding_share(ln_k, truth_.sliding_share(ln_k)); }
  double slip_excess(double ln_k) const override { return truth_.slip_excess(ln_k); }
  double regularised_age(double ln_k) const override {
    return lie_.regularised_age(ln_k, truth_.regularised_age(ln_k));
  }
  double time_rate(double ln_k) const override { return truth_.time_rate(ln_k); }
  double accuracy() const override { return truth_.accuracy(); }

 private:
  reduction::PadeCurve truth_;
  CurveLie lie_;
};

struct CurveLiar : reduction::PadeLaw {
  CurveLie lie;
  explicit CurveLiar(CurveLie told) : lie(std::move(told)) {}
  reduction::SimilaritySolution closed_solution(double r) const { return std::make_shared<LyingCurve>(r, lie); }
};

}  // namespace contensou::tests
