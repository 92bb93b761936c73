// Notation (README (R1) to (R7)): w = mu |u|, s = scaled time, and with the curve's ln w, m, n, b, c at xi:
//   s left    = w/(r Psi(0)) + v m                                (R4)
//   s elapsed = (w0 - w)/(r Psi(0)) + v0 m0 - v m                 (R5)
//   slip left = v (v/2 + n w)                                     (R13)
//   beta      = (3 pi/(2 chi)) (b/(w + v) - b0/(w0 + v0))         (R7)
//   d(s left)/d xi = c (w + v)                                    (R3)
#include "contensou/reduction/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "numerics/infinity.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;

/// ln k from speeds that may differ by more than a double holds, w = mu |u|.
double log_ratio(double v, double mu, double u, double v_scaled, double w_scaled) {
  const double k = v_scaled / w_scaled;
  return std::isnormal(k) && std::isnormal(w_scaled) ? std::log(k) : std::log(v) - std::log(mu) - std::log(u);
}

/// a/b, and 0 for a = 0 where b has underflowed.
double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

/// The root of an increasing function of xi in [low, high] by Newton's method, kept inside by bisection. The function
/// changes by a factor over a unit of xi, and so a step that small leaves an error of its square: none.
template <class Function>
double increasing_root(Function value_and_slope, double guess, double low, double high) {
  double x = std::clamp(guess, low, high);
  for (int i = 0; i < 300; ++i) {
    const auto [value, slope] = value_and_slope(x);
    if (value == 0) return x;
    (value > 0 ? high : low) = x;
    constexpr double small_step = 1e-9;
    const double rounding = 2 * std::numeric_limits<double>::epsilon() * std::abs(x);
    double next = x - value / slope;
    const bool inside = next > low && next < high;
    if (inside && std::abs(next - x) <= small_step) return next;
    if (!inside) next = low + (high - low) / 2;
    if (std::abs(next - x) <= rounding || next == low || next == high) return next;
    x = next;
  }
  return x;
}

}  // namespace

Orbit::Orbit(const ReducedSystem& system, State start, const SimilaritySolution& solution)
    : system_(system),
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
  curve_ = solution.through(ln_k0_);
  xi0_ = curve_->chart().coordinate(ln_k0_);
  m0_ = curve_->sliding_coefficient(xi0_);
}

Orbit&& Orbit::begun() && {
  if (!on_axis()) ln_w0_ = curve_->ln_w(xi0_);
  return std::move(*this);
}

const SimilarityCurve& Orbit::curve() const {
  if (on_axis()) throw std::domain_error("Orbit::curve: on an axis k does not change");
  return *curve_;
}

double Orbit::tau_of(double scaled) const { return std::ldexp(scaled / system_.scaled_time_rate(), exponent_); }

double Orbit::scaled_of(double tau) const { return std::ldexp(tau, -exponent_) * system_.scaled_time_rate(); }

double Orbit::stop_time() const { return tau_of(whole()); }

double Orbit::accuracy() const { return on_axis() ? rounding_of_stop_time(0) : curve_->accuracy(); }

long Orbit::evaluations() const { return on_axis() ? 0 : curve_->evaluations(); }

Orbit::Progress Orbit::progress(double xi) const {
  const double ln_w = curve_->ln_w(xi) - ln_w0_;
  const double ln_v = ln_w + (curve_->chart().log_ratio(xi) - ln_k0_);
  return {ln_w, ln_v, std::exp(ln_w), std::exp(ln_v)};
}

Orbit::Progress Orbit::progress(double xi, double left) const {
  // Both speeds from k and  left = P w/w0 + S m v/v0.  With the ratio of their fractions that is at most 1:
  const double change = curve_->chart().log_ratio(xi) - ln_k0_;
  const double ratio = std::exp(-std::abs(change));
  const double sliding = v_ * curve_->sliding_coefficient(xi);
  const double larger = left / (change < 0 ? pivoting_ + sliding * ratio : pivoting_ * ratio + sliding);
  const double ln_larger = std::log(larger);
  if (change < 0) return {ln_larger, ln_larger + change, larger, larger * ratio};
  return {ln_larger - change, ln_larger, larger * ratio, larger};
}

double Orbit::scaled_left(double xi, const Progress& now) const {
  return pivoting_ * now.w + v_ * now.v * curve_->sliding_coefficient(xi);
}

double Orbit::scaled_elapsed(double xi, const Progress& now) const {
  return -pivoting_ * std::expm1(now.ln_w) + v_ * (m0_ - now.v * curve_->sliding_coefficient(xi));
}

double Orbit::slip_left(double xi, const Progress& now) const {
  return v_ * now.v * (v_ * now.v / 2 + curve_->slip_length_coefficient(xi) * w_ * now.w);
}

double Orbit::scaled_left_slope(double xi, const Progress& now) const {
  return curve_->time_rate(xi) * (w_ * now.w + v_ * now.v);
}

double Orbit::coordinate_at_left(double left) const {
  // Below the curve's limit the time left is a power of exp(xi).
  const double limit = std::min(curve_->limit(), xi0_);
  const Progress last = progress(limit);
  const double at_limit = scaled_left(limit, last);
  if (left <= at_limit) return limit + std::log(left / at_limit) * (at_limit / scaled_left_slope(limit, last));
  const auto residual = [&](double xi) {
    const Progress now = progress(xi);
    const double here = scaled_left(xi, now);
    return std::pair{std::log(here / left), scaled_left_slope(xi, now) / here};
  };
  const double guess = xi0_ + std::log(left / whole()) * (whole() / scaled_left_slope(xi0_, at_start));
  return increasing_root(residual, guess, limit, xi0_);
}

double Orbit::coordinate_at_elapsed(double elapsed) const {
  const double limit = std::min(curve_->limit(), xi0_);
  const Progress last = progress(limit);
  const double beyond = elapsed - scaled_elapsed(limit, last);
  if (beyond >= 0) {
    const double at_limit = scaled_left(limit, last);
    return limit + std::log1p(-beyond / at_limit) * (at_limit / scaled_left_slope(limit, last));
  }
  const auto residual = [&](double xi) {
    const Progress now = progress(xi);
    return std::pair{elapsed - scaled_elapsed(xi, now), scaled_left_slope(xi, now)};
  };
  return increasing_root(residual, xi0_ - elapsed / scaled_left_slope(xi0_, at_start), limit, xi0_);
}

OrbitPoint Orbit::rest(double tau) const {
  return {tau, 0, 0, -infinity, u0_ == 0 && v0_ > 0 ? infinity : 0.0, infinity};
}

OrbitPoint Orbit::on_axis_at(double tau, double fraction_left) const {
  // One speed alone falls linearly. On either axis dtau = weight dbeta with the weight of the one speed squared.
  if (fraction_left == 0) return rest(tau);
  const double rate = system_.scaled_time_rate();
  const double spent = (1 - fraction_left) / fraction_left;
  if (u0_ == 0) {
    const double v = v0_ * fraction_left;
    return {tau, 0, v, std::log(v), infinity, quotient(spent / (45 * pi * pi * rate), v0_)};
  }
  const double beta = quotient(spent / (128 * rate * pivoting_rate_), system_.mu() * std::abs(u0_));
  return {tau, u0_ * fraction_left, 0, -infinity, 0, beta};
}

double Orbit::beta(double xi, const Progress& now) const {
  // Beside a ray k hardly changes: w falls linearly, and dtau/dbeta like w^2. At a law's kink x ln|x| the distance from
  // the ray is squared while w is halved: beyond sqrt(eps) of it xi would not do.
  constexpr double beside = 1e-3;
  constexpr double unchanged = 3e-7;
  const TerminalChart& chart = curve_->chart();
  if (std::abs(ln_k0_ - chart.log_terminal_ratio()) < beside && std::abs(chart.log_ratio(xi) - ln_k0_) < unchanged) {
    const double k = std::exp(chart.log_ratio(xi));
    const double weight = (16 + 15 * pi * k) * (8 + 3 * pi * k);
    const double pivoting_rate = system_.r() * system_.law()(slip_of_ratio(k)).moment;
    return (1 / now.w - 1) / (w_ * weight * pivoting_rate);
  }
  return curve_->beta_coefficient(xi) / (w_ * now.w + v_ * now.v) - curve_->beta_coefficient(xi0_) / (w_ + v_);
}

OrbitPoint Orbit::point(double tau, double xi, const Progress& now) const {
  if (tau == 0) return {tau, u0_, v0_, std::log(v0_), v_ / w_, 0};
  return {.tau = tau,
          .u = u0_ * now.w,
          .v = v0_ * now.v,
          .ln_v = std::log(v0_) + now.ln_v,
          .k = std::exp(curve_->chart().log_ratio(xi)),
          .beta = std::ldexp(std::max(0.0, beta(xi, now)) / system_.scaled_time_rate(), -exponent_)};
}

/// Beside an invariant ray the speeds fall while k hardly changes, and the time that is left tells more of them than
/// xi.
OrbitPoint Orbit::point_with_left(double tau, double xi, double left) const {
  return point(tau, xi, progress(xi, left));
}

OrbitPoint Orbit::at_time(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::at_time: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  if (tau >= stop) return rest(tau);
  if (on_axis()) return on_axis_at(tau, 1 - tau / stop);
  const double left = tau > stop / 2 ? scaled_of(stop - tau) : whole() - scaled_of(tau);
  return point_with_left(tau, coordinate_at_time(tau), left);
}

double Orbit::coordinate_at_time(double tau) const {
  if (tau == 0) return xi0_;
  const double stop = stop_time();
  if (tau > stop / 2) return coordinate_at_left(scaled_of(stop - tau));
  return coordinate_at_elapsed(scaled_of(tau));
}

double Orbit::slip_length(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::slip_length: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  double slip = 0;
  if (on_axis()) {
    const double v = u0_ == 0 && tau < stop ? v_ * (1 - tau / stop) : 0;
    slip = (v_ - v) * (v_ + v) / 2;
  } else {
    slip = slip_left(xi0_, at_start);
    if (tau < stop) {
      const double xi = coordinate_at_time(tau);
      slip -= slip_left(xi, progress(xi));
    }
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
  if (tau == 0) return point_with_left(0, xi0_, whole());
  return point_with_left(tau, coordinate_at_left(scaled_of(time_left)), scaled_of(time_left));
}

void Orbit::require_coordinate(const char* function, double xi) const {
  if (!on_axis() && xi <= xi0_) return;
  throw std::domain_error(fmt::format(
      "Orbit::{}: xi must be at most that of the start, {}, and the start not on an axis; got {}", function, xi0_, xi));
}

Orbit::Remaining Orbit::remaining_at_coordinate(double xi) const {
  require_coordinate("remaining_at_coordinate", xi);
  const Progress now = progress(xi);
  return {u0_ * now.w, v0_ * now.v, std::log(v0_) + now.ln_v, tau_of(scaled_left(xi, now))};
}

OrbitPoint Orbit::at_coordinate(double xi) const {
  require_coordinate("at_coordinate", xi);
  const Progress now = progress(xi);
  return point(tau_of(scaled_elapsed(xi, now)), xi, now);
}

OrbitPoint Orbit::at_log_ratio(double ln_k) const {
  if (on_axis() || !chart().reaches(ln_k) || !(chart().coordinate(ln_k) <= xi0_)) {
    throw std::domain_error(
        fmt::format("Orbit::at_log_ratio: ln k must be between that of the start, {}, and that of the stop, and the "
                    "start not on an axis; got {}",
                    ln_k0_, ln_k));
  }
  return at_coordinate(chart().coordinate(ln_k));
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
