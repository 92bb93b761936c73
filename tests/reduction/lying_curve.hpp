#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "contensou/reduction/flow.hpp"

namespace contensou::tests {

/// The false values that a curve returns.
struct CurveLie {
  using Lie = std::function<double(double ln_k, double truth)>;
  Lie ln_w = [](double, double truth) { return truth; };
  Lie sliding_coefficient = [](double, double truth) { return truth; };
  Lie beta_coefficient = [](double, double truth) { return truth; };
};

/// A curve that returns false values of its functions.
class LyingCurve final : public reduction::SimilarityCurve {
 public:
  LyingCurve(reduction::SimilaritySolution::Curve truth, CurveLie lie)
      : SimilarityCurve(truth->r(), truth->chart()), truth_(std::move(truth)), lie_(std::move(lie)) {}
  double ln_w(double ln_k) const override { return lie_.ln_w(ln_k, truth_->ln_w(ln_k)); }
  double sliding_coefficient(double ln_k) const override {
    return lie_.sliding_coefficient(ln_k, truth_->sliding_coefficient(ln_k));
  }
  double slip_length_coefficient(double ln_k) const override { return truth_->slip_length_coefficient(ln_k); }
  double angle_coefficient(double ln_k) const override { return truth_->angle_coefficient(ln_k); }
  double beta_coefficient(double ln_k) const override {
    return lie_.beta_coefficient(ln_k, truth_->beta_coefficient(ln_k));
  }
  double linear_below() const override { return -1e6; }  // so low that the curve evaluates every ln k
  double time_rate(double ln_k) const override { return truth_->time_rate(ln_k); }
  double accuracy() const override { return truth_->accuracy(); }

 private:
  reduction::SimilaritySolution::Curve truth_;
  CurveLie lie_;
};

/// Returns the flow of a ball with mu < 1 whose curve returns false values.
inline reduction::Flow lying_flow(const reduction::ReducedSystem& system, CurveLie lie) {
  const auto truth = reduction::Flow(system).solution().through(0);
  return {system, std::make_shared<LyingCurve>(truth, std::move(lie))};
}

}  // namespace contensou::tests
