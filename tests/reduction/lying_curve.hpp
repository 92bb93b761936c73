#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "contensou/reduction/flow.hpp"

namespace contensou::tests {

/// What a curve tells instead of the truth.
struct CurveLie {
  using Lie = std::function<double(double ln_k, double truth)>;
  Lie log_rim = [](double, double truth) { return truth; };
  Lie sliding_share = [](double, double truth) { return truth; };
  Lie regularised_age = [](double, double truth) { return truth; };
};

/// A curve with functions that are not its own.
class LyingCurve final : public reduction::SimilarityCurve {
 public:
  LyingCurve(reduction::SimilaritySolution::Curve truth, CurveLie lie)
      : SimilarityCurve(truth->r(), truth->approach()), truth_(std::move(truth)), lie_(std::move(lie)) {}
  double log_rim(double ln_k) const override { return lie_.log_rim(ln_k, truth_->log_rim(ln_k)); }
  double sliding_share(double ln_k) const override { return lie_.sliding_share(ln_k, truth_->sliding_share(ln_k)); }
  double slip_excess(double ln_k) const override { return truth_->slip_excess(ln_k); }
  double regularised_age(double ln_k) const override {
    return lie_.regularised_age(ln_k, truth_->regularised_age(ln_k));
  }
  double limit() const override { return -1e6; }  // it never comes there: every ln k is asked for
  double time_rate(double ln_k) const override { return truth_->time_rate(ln_k); }
  double accuracy() const override { return truth_->accuracy(); }

 private:
  reduction::SimilaritySolution::Curve truth_;
  CurveLie lie_;
};

/// The flow of a ball with mu < 1, lied about.
inline reduction::Flow lying_flow(const reduction::ReducedSystem& system, CurveLie lie) {
  const auto truth = reduction::Flow(system).solution().through(0);
  return {system, std::make_shared<LyingCurve>(truth, std::move(lie))};
}

}  // namespace contensou::tests
