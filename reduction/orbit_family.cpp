// Notation (README (R4), (R7), (R25)): the functions of xi are sampled once, with w = mu |u| and, for each start,
//   w/w0 = exp(ln w - ln w of the start),   v/v0 = (w/w0)(k/k0)
//   time left = P w/w0 + S m v/v0,          beta = b/(w + v) - b0/(w0 + v0), times a constant
#include "contensou/reduction/orbit_family.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace contensou::reduction {

namespace {

/// Speeds that start no further than this below the first row's are scaled from it; an underflow there is one here.
constexpr double most_scaled = 0x1p100;

}  // namespace

/// One curve at falling xi.
struct OrbitFamily::Sampling {
  SimilaritySolution::Curve curve;
  Eigen::ArrayXd xi, log_rim, ln_k, k, sliding_share, regularised_age;
  Eigen::ArrayXd w, v;  ///< the speeds of one orbit, in those of its first row
};

OrbitFamily::OrbitFamily(const ReducedSystem& system, std::span<const State> starts, Eigen::Index count)
    : OrbitFamily(system, similarity_solution(system.law(), system.r()), starts, count) {}

OrbitFamily::OrbitFamily(const ReducedSystem& system, const SimilaritySolution& solution, std::span<const State> starts,
                         Eigen::Index count)
    : system_(system), solution_(solution), count_(count) {
  if (count < 4) throw std::domain_error(fmt::format("OrbitFamily: 4 or more instants are needed, got {}", count));
  std::vector<std::pair<SimilaritySolution::Curve, double>> highest;  // xi of the starts on each curve
  for (const State& start : starts) {
    const Orbit orbit(system_, start, solution_);
    if (orbit.on_axis()) continue;
    const SimilaritySolution::Curve& curve = solution_.through(orbit.start_log_ratio());
    const auto known = std::ranges::find(highest, curve, &std::pair<SimilaritySolution::Curve, double>::first);
    if (known == highest.end()) {
      highest.emplace_back(curve, orbit.start_coordinate());
    } else {
      known->second = std::max(known->second, orbit.start_coordinate());
    }
  }
  for (const auto& [curve, xi] : highest) samplings_.push_back(sampling(curve, xi));
}

std::shared_ptr<const OrbitFamily::Sampling> OrbitFamily::sampling(const SimilaritySolution::Curve& curve,
                                                                   double highest) const {
  const Eigen::Index along = count_ / 2;
  const Eigen::Index over = count_ - along;
  Sampling at{};
  at.curve = curve;
  for (Eigen::ArrayXd* column : {&at.xi, &at.log_rim, &at.ln_k, &at.sliding_share, &at.regularised_age}) {
    column->resize(count_);
  }
  const double limit = std::min(curve->limit(), highest);
  at.xi.head(along) = Eigen::ArrayXd::LinSpaced(along, highest, limit);
  // Below the limit the time left is a power of exp(xi), that of w or of v: the slower.
  const double change = curve->approach().log_ratio(limit) - curve->approach().log_ratio(limit - 1);
  const double slope = curve->log_rim(limit) - curve->log_rim(limit - 1) + std::min(change, 0.0);
  for (Eigen::Index i = 0; i < over; ++i) {
    const double share = 1 - static_cast<double>(i + 1) / static_cast<double>(over + 1);
    at.xi[along + i] = limit + std::log(share) / slope;
  }
  for (Eigen::Index i = 0; i < count_; ++i) {
    const double xi = at.xi[i];
    at.log_rim[i] = curve->log_rim(xi);
    at.ln_k[i] = curve->approach().log_ratio(xi);
    at.sliding_share[i] = curve->sliding_share(xi);
    at.regularised_age[i] = curve->regularised_age(xi);
  }
  at.k = at.ln_k.exp();
  at.w = (at.log_rim - at.log_rim[0]).exp();
  at.v = (at.log_rim - at.log_rim[0] + (at.ln_k - at.ln_k[0])).exp();
  return std::make_shared<const Sampling>(std::move(at));
}

OrbitColumns OrbitFamily::orbit(State start) const {
  const Orbit orbit(system_, start, solution_);
  const double stop = orbit.stop_time();
  if (orbit.on_axis()) {
    OrbitColumns ends(2);
    ends.set(0, orbit.at_time(0));
    ends.set(1, orbit.at_time(stop));
    return ends;
  }
  const auto known =
      std::ranges::find(samplings_, &orbit.curve(), [](const auto& sampling) { return sampling->curve.get(); });
  if (known == samplings_.end()) {
    throw std::domain_error("OrbitFamily::orbit: on this side of the invariant ray there was no start");
  }
  const Sampling& at = **known;
  const auto first = std::ranges::upper_bound(at.xi, orbit.start_coordinate(), std::greater{}) - at.xi.begin();
  const Eigen::Index rows = count_ - first;
  OrbitColumns columns(rows + 2);
  columns.set(0, orbit.at_time(0));
  columns.set(rows + 1, orbit.at_time(stop));

  const SimilarityCurve& curve = orbit.curve();
  const double xi0 = orbit.start_coordinate();
  const double ln_k0 = orbit.start_log_ratio();
  const double ln_w0 = curve.log_rim(xi0);
  const double ln_v0 = ln_w0 + ln_k0;
  const double w0 = system_.mu() * std::abs(start.u);
  const double age0 = curve.regularised_age(xi0) / (w0 + start.v);
  const double pivoting = system_.pivoting_limit(start.u);
  const double sliding = system_.sliding_limit(start.v);
  const double beta_unit = 1 / system_.scaled_time_rate();

  const auto sampled = [&](const Eigen::ArrayXd& all) { return all.tail(rows); };
  const auto column = [&](Eigen::ArrayXd& all) { return all.segment(1, rows); };
  // From the shares of w0 and v0.
  const auto fill = [&](const auto& w, const auto& v) {
    column(columns.tau) = (stop - pivoting * w - sliding * v * sampled(at.sliding_share)).max(0);
    column(columns.u) = start.u * w;
    column(columns.v) = start.v * v;
    column(columns.ln_v) = sampled(at.log_rim) + sampled(at.ln_k) - (ln_v0 - std::log(start.v));
    column(columns.k) = sampled(at.k);
    column(columns.beta) = beta_unit * (sampled(at.regularised_age) / (w0 * w + start.v * v) - age0).max(0);
  };
  const double w_scale = std::exp(at.log_rim[0] - ln_w0);
  const double v_scale = std::exp(at.log_rim[0] + at.ln_k[0] - ln_v0);
  if (std::max(w_scale, v_scale) <= most_scaled) {
    fill(w_scale * sampled(at.w), v_scale * sampled(at.v));
  } else {
    const Eigen::ArrayXd w = (sampled(at.log_rim) - ln_w0).exp();
    const Eigen::ArrayXd v = (sampled(at.log_rim) + sampled(at.ln_k) - ln_v0).exp();
    fill(w, v);
  }
  return columns;
}

}  // namespace contensou::reduction
