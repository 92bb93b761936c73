// Notation (README (R1) to (R7)): w = mu |u|, s = scaled time, and with the curve's ln w, m, b at k:
//   s left    = w/(r Psi(0)) + v m                                (R4)
//   s elapsed = (w0 - w)/(r Psi(0)) + v0 m0 - v m                 (R5)
//   slip left = v (v/2 + n w)                                     (R13)
//   beta      = (3 pi/(2 chi)) (b/w - b0/w0)                      (R7)
#include "contensou/reduction/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/quadrature_curve.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Below this ln k the curve is its limit (QuadratureCurve), and so is the slope of time.
constexpr double limit_ln_k = -40;

/// Above the one, k b(k) is its limit 1/(45 pi^2) to the last bit; above the other, b or w may underflow.
constexpr double sliding_ln_k = 44;
constexpr double faint_ln_k = 600;

/// ln k from speeds that may differ by more than a double holds, w = mu |u|.
double log_ratio(double v, double mu, double u, double v_scaled, double w_scaled) {
  const double k = v_scaled / w_scaled;
  return std::isnormal(k) && std::isnormal(w_scaled) ? std::log(k) : std::log(v) - std::log(mu) - std::log(u);
}

/// a/b, and 0 for a = 0 where b has underflowed.
double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

/// The root of an increasing function in [low, high] by Newton's method, kept inside by bisection.
template <class Function>
double increasing_root(Function value_and_slope, double guess, double low, double high) {
  double x = std::clamp(guess, low, high);
  for (int i = 0; i < 300; ++i) {
    const auto [value, slope] = value_and_slope(x);
    if (value == 0) return x;
    (value > 0 ? high : low) = x;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (std::abs(next - x) <= 2 * std::numeric_limits<double>::epsilon() * std::abs(x) || next == low || next == high) {
      return next;
    }
    x = next;
  }
  return x;
}

}  // namespace

OrbitColumns::OrbitColumns(Eigen::Index rows) : tau(rows), u(rows), v(rows), ln_v(rows), k(rows), beta(rows) {}

void OrbitColumns::set(Eigen::Index row, const OrbitPoint& point) {
  tau[row] = point.tau;
  u[row] = point.u;
  v[row] = point.v;
  ln_v[row] = point.ln_v;
  k[row] = point.k;
  beta[row] = point.beta;
}

OrbitPoint OrbitColumns::row(Eigen::Index row) const {
  return {tau[row], u[row], v[row], ln_v[row], k[row], beta[row]};
}

Orbit::Orbit(const ReducedSystem& system, State start)
    : Orbit(system, start, similarity_curve(system.law(), system.r())) {}

Orbit::Orbit(const ReducedSystem& system, State start, std::shared_ptr<const SimilarityCurve> curve)
    : system_(system),
      curve_(std::move(curve)),
      u0_(start.u),
      v0_(start.v),
      exponent_(0),
      w_(0),
      v_(0),
      pivoting_(0),
      ln_k0_(0),
      pivoting_rate_(system.r() * system.law().pivoting_moment()) {
  require_state("Orbit", start);
  const double largest = std::max(std::abs(u0_), v0_);
  if (largest > 0) exponent_ = std::ilogb(largest);
  const double u = std::ldexp(std::abs(u0_), -exponent_);
  w_ = system.mu() * u;
  pivoting_ = system.scaled_time_rate() * system.pivoting_limit(u);
  v_ = std::ldexp(v0_, -exponent_);
  if (on_axis()) {
    ln_k0_ = u0_ == 0 ? infinity : -infinity;
    return;
  }
  ln_k0_ = log_ratio(v0_, system.mu(), std::abs(u0_), v_, w_);
  log_rim0_ = curve_->log_rim(ln_k0_);
  share0_ = curve_->sliding_share(ln_k0_);
  slip0_ = slip_left(ln_k0_);
}

double Orbit::tau_of(double scaled) const { return std::ldexp(scaled / system_.scaled_time_rate(), exponent_); }

double Orbit::scaled_of(double tau) const { return std::ldexp(tau, -exponent_) * system_.scaled_time_rate(); }

double Orbit::stop_time() const { return tau_of(pivoting_ + v_ * share0_); }

double Orbit::scaled_left(double ln_k) const {
  const double change = rim_change(ln_k);
  return pivoting_ * std::exp(change) + v_ * std::exp(change + (ln_k - ln_k0_)) * curve_->sliding_share(ln_k);
}

double Orbit::scaled_elapsed(double ln_k) const {
  const double change = rim_change(ln_k);
  const double v = v_ * std::exp(change + (ln_k - ln_k0_));
  return -pivoting_ * std::expm1(change) + (v_ * share0_ - v * curve_->sliding_share(ln_k));
}

double Orbit::slip_left(double ln_k) const {
  const double change = rim_change(ln_k);
  const double v = v_ * std::exp(change + (ln_k - ln_k0_));
  return v * (v / 2 + curve_->slip_excess(ln_k) * (w_ * std::exp(change)));
}

double Orbit::scaled_left_slope(double ln_k) const {
  // ds = v d ln k/(Phi - r k Psi), README (R3).
  const double change = rim_change(ln_k);
  if (ln_k < limit_ln_k) return w_ * std::exp(change) / (system_.law().force_slope() - pivoting_rate_);
  const double k = std::exp(ln_k);
  const auto [force, moment] = system_.law()(slip_of_ratio(k));
  return v_ * std::exp(change + (ln_k - ln_k0_)) / (force - system_.r() * (k * moment));
}

double Orbit::log_ratio_at_left(double left) const {
  const auto residual = [&](double ln_k) {
    const double here = scaled_left(ln_k);
    return std::pair{std::log(here / left), scaled_left_slope(ln_k) / here};
  };
  // In the limit k -> 0 all of the time left is pivoting: w = r Psi(0) left, and ln w has slope a.
  const double slope = pivoting_rate_ / (system_.law().force_slope() - pivoting_rate_);
  const double limit = limit_ln_k + (std::log(left / pivoting_) - rim_change(limit_ln_k)) / slope;
  const double low = std::min(limit, limit_ln_k) - 2;
  return increasing_root(residual, std::min(limit, ln_k0_), low + low * 1e-15, ln_k0_);
}

double Orbit::log_ratio_at_elapsed(double elapsed) const {
  const auto residual = [&](double ln_k) { return std::pair{elapsed - scaled_elapsed(ln_k), scaled_left_slope(ln_k)}; };
  const double slope = pivoting_rate_ / (system_.law().force_slope() - pivoting_rate_);
  const double left = pivoting_ + v_ * share0_ - elapsed;
  const double limit = limit_ln_k + (std::log(left / pivoting_) - rim_change(limit_ln_k)) / slope;
  const double low = std::min({limit, limit_ln_k, ln_k0_}) - 2;
  const double sliding = elapsed < v_ ? ln_k0_ + std::log1p(-elapsed / v_) : limit_ln_k;
  return increasing_root(residual, std::max(limit, sliding), low + low * 1e-15, ln_k0_);
}

OrbitPoint Orbit::rest(double tau) const {
  return {tau, 0, 0, -infinity, u0_ == 0 && v0_ > 0 ? infinity : 0.0, infinity};
}

OrbitPoint Orbit::on_axis_at(double tau, double left_share) const {
  // One speed alone falls linearly. On either axis dtau = weight dbeta with the weight of the one speed squared.
  if (left_share == 0) return rest(tau);
  const double rate = system_.scaled_time_rate();
  const double spent = (1 - left_share) / left_share;
  if (u0_ == 0) {
    const double v = v0_ * left_share;
    return {tau, 0, v, std::log(v), infinity, quotient(spent / (45 * pi * pi * rate), v0_)};
  }
  const double beta = quotient(spent / (128 * rate * pivoting_rate_), system_.mu() * std::abs(u0_));
  return {tau, u0_ * left_share, 0, -infinity, 0, beta};
}

OrbitPoint Orbit::point(double tau, double ln_k) const {
  if (ln_k == ln_k0_) return {tau, u0_, v0_, std::log(v0_), v_ / w_, 0};
  const double change = rim_change(ln_k);
  const double ln_v = std::log(v0_) + (change + (ln_k - ln_k0_));
  const double v = v0_ * std::exp(change + (ln_k - ln_k0_));
  return {tau, u0_ * std::exp(change), v, ln_v, std::exp(ln_k), beta(ln_k, change, v)};
}

double Orbit::beta(double ln_k, double change, double v) const {
  const double w0 = system_.mu() * std::abs(u0_);
  if (ln_k0_ < faint_ln_k) {
    const double age = curve_->regularised_age(ln_k) * std::exp(-change) - curve_->regularised_age(ln_k0_);
    return quotient(std::max(0.0, age), system_.scaled_time_rate() * w0);
  }
  // b/w = k b/v.
  constexpr double limit = 1 / (45 * pi * pi);
  const double age = ln_k > sliding_ln_k ? limit / v : curve_->regularised_age(ln_k) / (w0 * std::exp(change));
  return std::max(0.0, age - limit / v0_) / system_.scaled_time_rate();
}

OrbitPoint Orbit::at_time(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::at_time: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  if (tau >= stop) return rest(tau);
  if (on_axis()) return on_axis_at(tau, 1 - tau / stop);
  return point(tau, log_ratio_at_time(tau));
}

double Orbit::log_ratio_at_time(double tau) const {
  if (tau == 0) return ln_k0_;
  const double stop = stop_time();
  if (tau > stop / 2) return log_ratio_at_left(scaled_of(stop - tau));
  return log_ratio_at_elapsed(scaled_of(tau));
}

double Orbit::slip_length(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::slip_length: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  double slip = 0;
  if (on_axis()) {
    const double v = u0_ == 0 && tau < stop ? v_ * (1 - tau / stop) : 0;
    slip = (v_ - v) * (v_ + v) / 2;
  } else {
    slip = slip0_ - (tau < stop ? slip_left(log_ratio_at_time(tau)) : 0);
  }
  return std::ldexp(slip / system_.scaled_time_rate(), 2 * exponent_);
}

OrbitPoint Orbit::at_time_left(double time_left) const {
  const double stop = stop_time();
  if (!(time_left >= 0 && time_left <= stop)) {
    throw std::domain_error(
        fmt::format("Orbit::at_time_left: 0 <= time_left <= stop time {} required, got {}", stop, time_left));
  }
  if (time_left == 0) return rest(stop);
  const double tau = stop - time_left;
  if (on_axis()) return on_axis_at(tau, time_left / stop);
  if (tau == 0) return point(0, ln_k0_);
  return point(tau, log_ratio_at_left(scaled_of(time_left)));
}

OrbitPoint Orbit::at_log_ratio(double ln_k) const {
  if (on_axis() || !(ln_k <= ln_k0_)) {
    throw std::domain_error(fmt::format(
        "Orbit::at_log_ratio: ln k must be at most that of the start, {}, and the start not on an axis; got {}", ln_k0_,
        ln_k));
  }
  return point(tau_of(scaled_elapsed(ln_k)), ln_k);
}

OrbitColumns Orbit::at_times(const Eigen::ArrayXd& times) const {
  OrbitColumns columns(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at_time(times[i]));
  return columns;
}

OrbitColumns Orbit::sample(Eigen::Index count) const {
  if (count < 2) throw std::domain_error(fmt::format("Orbit::sample: 2 or more instants are needed, got {}", count));
  OrbitColumns columns(count);
  const double stop = stop_time();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index to_go = count - 1 - i;
    const double last = static_cast<double>(count - 1);
    // The nearer end sets the scale: no digit of the time left is lost near the stop.
    columns.set(i, i < to_go ? at_time(stop * (static_cast<double>(i) / last))
                             : at_time_left(stop * (static_cast<double>(to_go) / last)));
  }
  return columns;
}

}  // namespace contensou::reduction
