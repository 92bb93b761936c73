// Notation (theory.md and numerics.md (R1) to (R4), (R32), (R39)): w = mu |u|, s: scaled time, index 0: start; m, n, o,
// b and c: SimilarityCurve, at xi:
//   s left    = w/(r Psi(0)) + v m                                (R4)
//   s elapsed = (w0 - w)/(r Psi(0)) + v0 m0 - v m                 (R32)
//   slip left = v (v/(2 (1 - rho)) + n w)                         (R30), (R26)
//   angle left = w (w/(2 r Psi(0)) + o v)                         (R8)
//   beta      = (3 pi/(2 chi)) (b/(w + v) - b0/(w0 + v0))         (R39)
//   d(s left)/d xi = c (w + v)                                    (R3)
#include "contensou/reduction/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

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

namespace {

using std::numbers::pi;

/// Returns ln k, even if k = v/w overflows or underflows; w = mu |u|. v_scaled, w_scaled are v and w times one factor.
double log_ratio(double v, double mu, double u, double v_scaled, double w_scaled) {
  const double k = v_scaled / w_scaled;
  return std::isnormal(k) && std::isnormal(w_scaled) ? std::log(k) : std::log(v) - std::log(mu) - std::log(u);
}

/// Returns a/b, but 0 for a = 0, even if b has underflowed.
double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

/// Returns the root of an increasing function of xi in [low, high] by Newton's method, with bisection if a step leaves
/// the interval. The function's slope changes by a moderate factor over a unit of xi. The error is then about the
/// square of the last step: negligible after a small_step.
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
    m0_ = 1 / (1 - system.drive());
    return;
  }
  if (v0_ > 0) ln_k0_ = log_ratio(v0_, system.mu(), std::abs(u0_), v_, w_);
  if (system.drive() > 0) {
    const double least = least_log_ratio(system.law(), system.r(), system.drive());
    if (v0_ == 0 || ln_k0_ < least) {
      creeps_ = true;
      ln_k0_ = least;
      v_ = w_ * std::exp(least);
    }
  }
  curve_ = solution.through(ln_k0_);
  xi0_ = curve_->chart().coordinate(ln_k0_);
  m0_ = curve_->sliding_coefficient(xi0_);
}

/// Computes ln w at the start at the first use of ln w, because a stop time and a slip length do not need its panels.
double Orbit::log_start() const {
  double ln_w = ln_w0_.value.load(std::memory_order_relaxed);
  if (std::isnan(ln_w)) ln_w0_.value.store(ln_w = curve_->ln_w(xi0_), std::memory_order_relaxed);
  return ln_w;
}

const SimilarityCurve& Orbit::curve() const {
  if (on_axis()) throw std::domain_error("Orbit::curve: on an axis k does not change");
  return *curve_;
}

double Orbit::tau_of(double scaled) const { return std::ldexp(scaled / system_.scaled_time_rate(), exponent_); }

double Orbit::scaled_of(double tau) const { return std::ldexp(tau, -exponent_) * system_.scaled_time_rate(); }

double Orbit::stop_time() const {
  const double pivoting = system_.pivoting_limit(std::ldexp(u0_, -exponent_));
  return std::ldexp(v_ == 0 ? pivoting : pivoting + m0_ * system_.sliding_limit(v_), exponent_);
}

double Orbit::accuracy() const { return on_axis() ? rounding_of_stop_time(0) : curve_->accuracy(); }

long Orbit::evaluations() const { return on_axis() ? 0 : curve_->evaluations(); }

double Orbit::sliding(const Progress& now) const { return creeps_ ? std::ldexp(v_ * now.v, exponent_) : v0_ * now.v; }

double Orbit::log_sliding(const Progress& now) const {
  const double ln_v = creeps_ ? std::log(v_) + exponent_ * std::numbers::ln2 : std::log(v0_);
  return ln_v + now.ln_v;
}

Orbit::Progress Orbit::fallen(double xi) const {
  const double ln_w = curve_->ln_w(xi) - log_start();
  return {ln_w, ln_w + (curve_->chart().log_ratio(xi) - ln_k0_), 0, 0};
}

Orbit::Progress Orbit::progress(double xi) const {
  const Progress now = fallen(xi);
  return {now.ln_w, now.ln_v, std::exp(now.ln_w), std::exp(now.ln_v)};
}

Orbit::Progress Orbit::progress(double xi, double left) const {
  // Both speeds follow from k and the time left, left = P w/w0 + S m v/v0. `ratio` is the smaller of w/w0 and v/v0
  // divided by the larger one.
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
  const double alone = v_ * now.v / (2 * (1 - system_.drive()));
  return v_ * now.v * (alone + curve_->slip_length_coefficient(xi) * w_ * now.w);
}

double Orbit::turned_left(double xi, const Progress& now) const {
  return w_ * now.w * (pivoting_ * now.w / 2 + curve_->angle_coefficient(xi) * v_ * now.v);
}

double Orbit::scaled_left_slope(double xi, const Progress& now) const {
  return curve_->time_rate(xi) * (w_ * now.w + v_ * now.v);
}

double Orbit::coordinate_at_left(double left) const {
  // Below linear_below() the time left is a power of exp(xi).
  const double limit = std::min(curve_->linear_below(), xi0_);
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
  const double limit = std::min(curve_->linear_below(), xi0_);
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
  // On an axis the speed falls linearly. In dtau = weight dbeta, the weight is proportional to the square of the speed.
  if (fraction_left == 0) return rest(tau);
  const double rate = system_.scaled_time_rate();
  const double spent = (1 - fraction_left) / fraction_left;
  if (u0_ == 0) {
    const double v = v0_ * fraction_left;
    const double fall = rate * (1 - system_.drive());
    return {tau, 0, v, std::log(v), infinity, quotient(spent / (45 * pi * pi * fall), v0_)};
  }
  const double beta = quotient(spent / (128 * rate * pivoting_rate_), system_.mu() * std::abs(u0_));
  return {tau, u0_ * fraction_left, 0, -infinity, 0, beta};
}

double Orbit::beta(double xi, const Progress& now) const {
  // Next to a ray k hardly changes, w falls linearly, and dtau/dbeta falls like w^2. If the law has a term x ln|x|
  // there, the distance from the ray is squared while w is halved. Then xi is inaccurate at distances below sqrt(eps).
  constexpr double beside = 1e-3;
  constexpr double unchanged = 3e-7;
  const TerminalChart& chart = curve_->chart();
  const double ln_k = chart.log_ratio(xi);
  const auto at_ratio = [&](double k, const Progress& from) {
    const double weight = (16 + 15 * pi * k) * (8 + 3 * pi * k);
    const double pivoting_rate = system_.r() * system_.law()(slip_of_ratio(k)).moment;
    return (1 / now.w - 1 / from.w) / (w_ * weight * pivoting_rate);
  };
  const double ln_k_star = chart.log_terminal_ratio();
  if (std::abs(ln_k0_ - ln_k_star) < beside && std::abs(ln_k - ln_k0_) < unchanged) {
    return at_ratio(std::exp(ln_k), at_start);
  }
  const auto elapsed = [&](double there, const Progress& then) {
    return curve_->beta_coefficient(there) / (w_ * then.w + v_ * then.v) - curve_->beta_coefficient(xi0_) / (w_ + v_);
  };
  // On the ray that a drive causes at small k, w falls by any factor while k keeps all its bits.
  constexpr double there_already = 1e-9;
  if (system_.drive() > 0 && std::abs(ln_k - ln_k_star) < there_already) {
    const double xi_then = chart.coordinate(ln_k_star + std::copysign(there_already, ln_k0_ - ln_k_star));
    const Progress then = progress(xi_then);
    return elapsed(xi_then, then) + at_ratio(std::exp(ln_k_star), then);
  }
  return elapsed(xi, now);
}

OrbitPoint Orbit::point(double tau, double xi, const Progress& now) const {
  if (tau == 0) return {tau, u0_, v0_, std::log(v0_), creeps_ ? v0_ / (system_.mu() * std::abs(u0_)) : v_ / w_, 0};
  return {.tau = tau,
          .u = u0_ * now.w,
          .v = sliding(now),
          .ln_v = log_sliding(now),
          .k = std::exp(curve_->chart().log_ratio(xi)),
          .beta = std::ldexp(std::max(0.0, beta(xi, now)) / system_.scaled_time_rate(), -exponent_)};
}

/// Computes the speeds from the time left. Next to a ray the speeds fall while k hardly changes: xi does not suffice.
OrbitPoint Orbit::point_with_left(double tau, double xi, double left) const {
  return point(tau, xi, progress(xi, left));
}

OrbitPoint Orbit::at_time(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::at_time: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  if (tau >= stop) return rest(tau);
  if (on_axis()) return on_axis_at(tau, 1 - tau / stop);
  return point_with_left(tau, coordinate_at_time(tau), left_at(tau));
}

double Orbit::left_at(double tau) const {
  const double stop = stop_time();
  return tau > stop / 2 ? scaled_of(stop - tau) : whole() - scaled_of(tau);
}

double Orbit::coordinate_at_time(double tau) const {
  if (tau == 0) return xi0_;
  const double stop = stop_time();
  if (tau > stop / 2) return coordinate_at_left(scaled_of(stop - tau));
  return coordinate_at_elapsed(scaled_of(tau));
}

double Orbit::length_of(double scaled_square) const {
  return std::ldexp(scaled_square / system_.scaled_time_rate(), 2 * exponent_);
}

double Orbit::slip_length(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::slip_length: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  if (on_axis()) {
    const double v = u0_ == 0 && tau < stop ? v_ * (1 - tau / stop) : 0;
    return length_of((v_ - v) * (v_ + v) / 2 * m0_);
  }
  double slip = slip_left(xi0_, at_start);
  if (tau < stop) {
    const double xi = coordinate_at_time(tau);
    slip -= slip_left(xi, progress(xi, left_at(tau)));
  }
  return length_of(slip);
}

Orbit::Instant Orbit::instant(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::instant: tau must be >= 0, got {}", tau));
  const double stop = stop_time();
  const double turning = std::copysign(1 / system_.mu(), u0_);
  if (on_axis()) {
    const double left = tau < stop ? 1 - tau / stop : 0;
    const double square = (1 - left) * (1 + left) / 2;
    if (u0_ == 0) return {0, v0_ * left, std::log(v0_ * left), length_of(v_ * v_ * square * m0_), 0};
    return {u0_ * left, 0, -infinity, 0, turning * length_of(w_ * pivoting_ * square)};
  }
  const double slip = slip_left(xi0_, at_start);
  const double turned = turned_left(xi0_, at_start);
  if (tau >= stop) return {0, 0, -infinity, length_of(slip), turning * length_of(turned)};
  if (tau == 0) return {u0_, v0_, std::log(v0_), 0, 0};
  const double xi = coordinate_at_time(tau);
  const Progress now = progress(xi, left_at(tau));
  return {u0_ * now.w, sliding(now), log_sliding(now), length_of(slip - slip_left(xi, now)),
          turning * length_of(turned - turned_left(xi, now))};
}

double Orbit::coordinate_of_fall(double Progress::*ln_speed, double ln_fraction, double from) const {
  const auto rest = [&](double xi) { return fallen(xi).*ln_speed - ln_fraction; };
  // Below linear_below() both logarithms, ln w and ln v, are linear.
  const double limit = std::min(curve_->linear_below(), from);
  const double at_limit = rest(limit);
  if (at_limit >= 0) return limit - at_limit / (at_limit - rest(limit - 1));
  const double at_from = from == xi0_ ? -ln_fraction : rest(from);
  return root_between(std::cref(rest), limit, from, at_limit, at_from);
}

double Orbit::coordinate_of_fastest() const {
  const auto excess = [&](double ln_k) {
    return Balance::of(system_.law(), system_.r(), system_.drive(), std::exp(ln_k)).force;
  };
  const double at_begin = on_axis() ? 0 : excess(ln_k0_);
  if (at_begin >= 0) return xi0_;
  // k grows towards its limit at the stop, and there friction exceeds the drive.
  constexpr double far = 60;
  const double end = std::min(chart().log_terminal_ratio(), far);
  const double at_end = excess(end);
  if (at_end <= 0) return chart().coordinate(end);
  return chart().coordinate(root_between(excess, ln_k0_, end, at_begin, at_end));
}

double Orbit::time_of_fall(double Progress::*ln_speed, double speed, double start, double from) const {
  if (start <= speed && from == xi0_) return 0;
  if (speed == 0) return stop_time();
  const double fraction = speed / start;
  if (on_axis()) return stop_time() * (1 - fraction);
  const double ln_fraction = std::isnormal(fraction) ? std::log(fraction) : std::log(speed) - std::log(start);
  if (from != xi0_ && fallen(from).*ln_speed <= ln_fraction) return 0;
  const double xi = coordinate_of_fall(ln_speed, ln_fraction, from);
  // Both speeds follow from k and the speed whose fall is given.
  Progress now = fallen(xi);
  const double correction = ln_fraction - now.*ln_speed;
  now.ln_w += correction;
  now.ln_v += correction;
  now.w = std::exp(now.ln_w);
  now.v = std::exp(now.ln_v);
  const double left = scaled_left(xi, now);
  return 2 * left < whole() ? stop_time() - tau_of(left) : tau_of(scaled_elapsed(xi, now));
}

double Orbit::time_of_v(double v) const {
  if (!(v >= 0)) throw std::domain_error(fmt::format("Orbit::time_of_v: v must be >= 0, got {}", v));
  return time_of_fall(&Progress::ln_v, v, sliding(at_start), system_.drive() > 0 ? coordinate_of_fastest() : xi0_);
}

double Orbit::time_of_u(double u) const {
  if (!(u >= 0)) throw std::domain_error(fmt::format("Orbit::time_of_u: u must be >= 0, got {}", u));
  return time_of_fall(&Progress::ln_w, u, std::abs(u0_), xi0_);
}

double Orbit::integral(const std::function<double(double)>& of_v, double tau, const std::vector<double>& edges) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("Orbit::integral: tau must be >= 0, got {}", tau));
  // Split into the integral of the value at v = 0 and the integral of the difference from it, which vanishes with v.
  const double end = std::min(tau, stop_time());
  const double last_value = of_v(0);
  const double at_rest = last_value * end;
  if (end == 0 || v_ == 0) return at_rest;
  std::vector<double> panels, kinks;
  std::function<double(double)> integrand;
  if (on_axis()) {
    panels = {0, end};
    for (double v : edges) panels.push_back(std::min(time_of_v(std::max(v, 0.0)), end));
    integrand = [&](double at) { return of_v(v0_ * (1 - at / stop_time())) - last_value; };
  } else {
    // The variable of integration is xi, because v and the time follow from xi without a search for a root.
    constexpr double ln_nothing = -50;
    constexpr double width = 3;
    constexpr double most = 64;
    double last = coordinate_of_fall(&Progress::ln_v, ln_nothing, xi0_);
    if (end < stop_time()) last = std::max(coordinate_at_time(end), last);
    for (double edge = xi0_; edge > last; edge -= std::max(width, (xi0_ - last) / most)) panels.push_back(edge);
    panels.push_back(last);
    for (double v : edges) {
      if (v > 0 && v < v0_)
        panels.push_back(std::max(coordinate_of_fall(&Progress::ln_v, std::log(v / v0_), xi0_), last));
    }
    for (double k : system_.law().kinks()) {
      if (chart().reaches(std::log(k))) kinks.push_back(std::clamp(chart().coordinate(std::log(k)), last, xi0_));
    }
    panels.insert(panels.end(), kinks.begin(), kinks.end());
    integrand = [&](double xi) {
      const Progress now = progress(xi);
      return (of_v(sliding(now)) - last_value) * tau_of(scaled_left_slope(xi, now));
    };
  }
  std::ranges::sort(panels);
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  constexpr unsigned depth = 12;
  constexpr double tolerance = 1e-10;
  double sum = at_rest;
  for (std::size_t i = 1; i < panels.size(); ++i) {
    const double left = panels[i - 1], width = panels[i] - left;
    if (width == 0) continue;
    // Next to a kink the integrand has square roots of the distance; 3 s^2 - 2 s^3 in place of s makes them smooth.
    const bool bends = std::ranges::any_of(kinks, [&](double kink) { return kink == left || kink == panels[i]; });
    const auto along = [&](double s) {
      return bends ? integrand(left + width * s * s * (3 - 2 * s)) * 6 * s * (1 - s) : integrand(left + width * s);
    };
    sum += width * Rule::integrate(along, 0.0, 1.0, depth, tolerance);
  }
  return sum;
}

OrbitPoint Orbit::at_time_left(double time_left) const {
  const double stop = stop_time();
  if (!(time_left >= 0 && time_left <= stop)) {
    throw std::domain_error(
        fmt::format("Orbit::at_time_left: 0 <= time_left <= stop time {} required, got {}", stop, time_left));
  }
  // Nearer to the stop than the smallest double the speeds are 0.
  if (time_left == 0 || !(scaled_of(time_left) / whole() > 0)) return rest(stop);
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
  return {u0_ * now.w, sliding(now), log_sliding(now), tau_of(scaled_left(xi, now))};
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
    // Times count from the nearer end, so that the time left keeps its digits near the stop.
    columns.set(i, i < to_go ? at_time(stop * (static_cast<double>(i) / last))
                             : at_time_left(stop * (static_cast<double>(to_go) / last)));
  }
  return columns;
}

}  // namespace contensou::reduction
