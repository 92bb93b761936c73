// Notation, (R44), (R45), (R54) of reduction/numerics.md: r = gamma mu^2/chi, z = (3 pi/8) k,
//   G = G(p, q; T), m = end + (begin - end) G;  each value is a ball: a number and a radius that covers every error.
#include "certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <arb.h>
#include <arb_hypgeom.h>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"

namespace contensou::reduction {

namespace {

/// A ball of arb with the operators of arithmetic, at one precision that the caller sets.
class Ball {
 public:
  static thread_local slong precision;

  Ball() { arb_init(value_); }
  Ball(double value) : Ball() { arb_set_d(value_, value); }  // NOLINT(google-explicit-constructor): a double is a Ball
  Ball(const Ball& other) : Ball() { arb_set(value_, other.value_); }
  Ball& operator=(const Ball& other) {
    arb_set(value_, other.value_);
    return *this;
  }
  ~Ball() { arb_clear(value_); }

  static Ball pi() {
    Ball result;
    arb_const_pi(result.value_, precision);
    return result;
  }

  arb_ptr get() { return value_; }
  arb_srcptr get() const { return value_; }

  bool is_zero() const { return arb_is_zero(value_) != 0; }
  bool is_negative() const { return arb_is_negative(value_) != 0; }
  double approximately() const { return arf_get_d(arb_midref(value_), ARF_RND_NEAR); }

  /// Returns a lower bound of the number of correct bits of the ball.
  slong accuracy() const { return arb_rel_accuracy_bits(value_); }

  friend Ball operator+(const Ball& a, const Ball& b) { return of(arb_add, a, b, precision); }
  friend Ball operator-(const Ball& a, const Ball& b) { return of(arb_sub, a, b, precision); }
  friend Ball operator*(const Ball& a, const Ball& b) { return of(arb_mul, a, b, precision); }
  friend Ball operator/(const Ball& a, const Ball& b) { return of(arb_div, a, b, precision); }

  static Ball exact_product(const Ball& a, const Ball& b) { return of(arb_mul, a, b, ARF_PREC_EXACT); }
  static Ball exact_difference(const Ball& a, const Ball& b) { return of(arb_sub, a, b, ARF_PREC_EXACT); }

 private:
  static Ball of(void (*function)(arb_t, const arb_t, const arb_t, slong), const Ball& a, const Ball& b, slong bits) {
    Ball result;
    function(result.value_, a.value_, b.value_, bits);
    return result;
  }

  arb_t value_;
};

thread_local slong Ball::precision = 128;

/// Smallest number of correct bits of an enclosure, enough for 25 decimals and for a thousandth of an ulp.
constexpr slong wanted_bits = 90;
constexpr slong max_bits = 1 << 16;

/// The numbers of (R45) in ball arithmetic. begin is m at T = 0, end is m at T = infinity; both are exact, or 5/r.
struct Relaxation {
  Ball begin, end, p, q, excess, T;
};

/// Returns the relaxation of a start with both speeds positive. alpha = 2 chi - gamma mu^2 and beta = 5 chi - gamma
/// mu^2 are exact, so the regime is certain.
Relaxation relaxation(const ReducedSystem& system, State start) {
  const Ball chi = system.inertia().chi;
  const Ball g = Ball::exact_product(system.inertia().gamma, Ball::exact_product(system.mu(), system.mu()));
  const Ball alpha = Ball::exact_difference(Ball::exact_product(2, chi), g);
  const Ball beta = Ball::exact_difference(Ball::exact_product(5, chi), g);
  const Ball z = Ball::pi() * 3 * start.v / (Ball::exact_product(8, system.mu()) * std::abs(start.u));
  if (!alpha.is_negative()) {
    return {2.5,
            1,
            alpha / (Ball(2) * chi),
            Ball(5) * chi / beta,
            Ball(3) * g / (Ball(2) * beta),
            beta * z / (Ball(2) * chi)};
  }
  if (beta.is_negative() || beta.is_zero()) {
    return {1,
            2.5,
            beta / (Ball(-5) * chi),
            Ball(-2) * chi / alpha,
            Ball(-3) * g / (Ball(5) * alpha),
            alpha / (Ball(-5) * chi * z)};
  }
  const Ball ray = Ball(5) * chi / g;
  const Ball p = Ball(-1) * alpha * beta / (Ball(3) * g * chi);
  const Ball beyond = beta * z + alpha;
  const Ball distance = beyond / (Ball(3) * g * chi);
  if (!beyond.is_negative()) {
    return {ray, 1, p, Ball(5) * chi / beta, Ball(2) * beta / (Ball(3) * g), beta * distance};
  }
  return {ray, 2.5, p, Ball(-2) * chi / alpha, Ball(-5) * alpha / (Ball(3) * g), alpha * distance / z};
}

/// Returns G by the continued fraction (R54). All its terms are positive. Therefore the first two approximations of the
/// omitted part enclose this part, and every later step keeps the enclosure.
Ball by_fraction(const Relaxation& at) {
  const auto b = [&](slong n) { return Ball(1) + at.p * static_cast<double>(n); };
  const auto a = [&](slong n) {
    const auto j = static_cast<double>(n / 2);
    return (n % 2 == 1 ? (at.q + j) * (Ball(1) + at.p * j) : (at.excess + at.p * j) * j) * at.T;
  };
  Ball G;
  for (slong depth = 64; depth < (1 << 22); depth *= 2) {
    Ball rest;
    const Ball nearest = b(depth);
    const Ball farthest = nearest + a(depth + 1) / b(depth + 1);
    arb_union(rest.get(), nearest.get(), farthest.get(), Ball::precision);
    for (slong n = depth - 1; n >= 0; --n) rest = b(n) + a(n + 1) / rest;
    G = Ball(1) / rest;
    if (G.accuracy() >= wanted_bits + 8) break;  // m and the stop time lose some bits
  }
  return G;
}

/// Returns G by a function of Arb: 2F1, or Tricomi's U if p = 0.
Ball by_hypergeometric(const Relaxation& at) {
  Ball G;
  if (at.p.is_zero()) {
    const Ball s = Ball(1) / at.T;
    arb_hypgeom_u(G.get(), at.q.get(), at.q.get(), s.get(), Ball::precision);
    Ball power;
    arb_pow(power.get(), s.get(), at.q.get(), Ball::precision);
    return G * power;
  }
  const Ball c = Ball(1) / at.p + 1;
  const Ball x = Ball(-1) * at.T / at.p;
  arb_hypgeom_2f1(G.get(), Ball(1).get(), at.q.get(), c.get(), x.get(), 0, Ball::precision);
  return G;
}

/// Returns the sliding coefficient m for a start with both speeds positive.
Ball sliding_coefficient(const ReducedSystem& system, State start) {
  const Relaxation at = relaxation(system, start);
  const double T = at.T.approximately();
  const bool near = T <= 1 || T <= 16 * at.p.approximately();
  const Ball G = near ? by_fraction(at) : by_hypergeometric(at);
  return at.end + (at.begin - at.end) * G;
}

Ball enclosure(const ReducedSystem& system, State start) {
  const Ball pivoting = Ball(8) * std::abs(start.u) / (Ball(system.inertia().gamma) * system.mu());
  const Ball sliding = Ball::pi() * 3 * start.v / (Ball(2) * system.inertia().chi);
  if (start.u == 0 || start.v == 0) return pivoting + sliding;
  return pivoting + sliding * sliding_coefficient(system, start);
}

/// Returns log2 of the unit in the last place of doubles as large as a number.
int last_place(const Ball& truth) {
  if (truth.is_zero()) return std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
  const slong exponent = arf_abs_bound_lt_2exp_si(arb_midref(truth.get()));
  constexpr int digits = std::numeric_limits<double>::digits;
  return static_cast<int>(std::clamp<slong>(exponent, std::numeric_limits<double>::min_exponent,
                                            std::numeric_limits<double>::max_exponent)) -
         digits;
}

/// Returns |tau + more - truth| in units in the last place; infinity counts as 2^1024.
double error_in_ulps(const Ball& truth, double tau, double more = 0) {
  Ball value = std::isinf(tau) ? Ball(1) : Ball(tau) + more;
  if (std::isinf(tau)) arb_mul_2exp_si(value.get(), value.get(), std::numeric_limits<double>::max_exponent);
  Ball error = value - truth;
  if (std::isinf(tau) && error.is_negative()) return 0;
  arb_abs(error.get(), error.get());
  arb_mul_2exp_si(error.get(), error.get(), -last_place(truth));
  return error.approximately();
}

}  // namespace

double certify_stop_time(const ReducedSystem& system, State start, double tau, double more) {
  require_state("certify_stop_time", start);
  if (!system.law().as<PadeLaw>()) {
    throw std::domain_error(
        fmt::format("certify_stop_time: only law pade has a closed form, got {}", system.law().name()));
  }
  for (Ball::precision = 160; Ball::precision <= max_bits; Ball::precision *= 2) {
    const Ball truth = enclosure(system, start);
    if (truth.is_zero() || truth.accuracy() >= wanted_bits) return error_in_ulps(truth, tau, more);
  }
  throw std::runtime_error(fmt::format("certify_stop_time: no narrow enclosure at u = {}, v = {}", start.u, start.v));
}

double certify_sliding_share(double r, double k, double m) {
  const ReducedSystem system(PadeLaw{}, 1, {.chi = 1, .gamma = r});
  for (Ball::precision = 160; Ball::precision <= max_bits; Ball::precision *= 2) {
    const Ball truth = sliding_coefficient(system, {1, k});
    if (truth.accuracy() >= wanted_bits) return error_in_ulps(truth, m);
  }
  throw std::runtime_error(fmt::format("certify_sliding_share: no narrow enclosure at r = {}, k = {}", r, k));
}

ResistanceError certify_hertz_law(double k, Resistance computed) {
  if (!(k > 0) || !std::isfinite(k)) {
    throw std::domain_error(fmt::format("certify_hertz_law: k must be positive and finite, got {}", k));
  }
  Ball::precision = 160;
  const Ball s = Ball::exact_product(k, k);
  if (k <= 1) {
    const Ball force = Ball::pi() * 3 * k * (Ball(4) - s) / 32;
    const Ball moment = Ball::pi() * 3 * (Ball(8) - Ball(8) * s + Ball(3) * s * s) / 128;
    return {error_in_ulps(force, computed.force), error_in_ulps(moment, computed.moment)};
  }
  const auto gauss = [&](double a, double c) {
    Ball value;
    const Ball x = Ball(1) / s;
    arb_hypgeom_2f1(value.get(), Ball(a).get(), Ball(0.5).get(), Ball(c).get(), x.get(), 0, Ball::precision);
    return value;
  };
  const Ball force = gauss(-0.5, 2.5);
  const Ball moment = gauss(0.5, 3.5) / (Ball(5) * k);
  if (force.accuracy() < wanted_bits || moment.accuracy() < wanted_bits) {
    throw std::runtime_error(fmt::format("certify_hertz_law: no narrow enclosure at k = {}", k));
  }
  return {error_in_ulps(force, computed.force), error_in_ulps(moment, computed.moment)};
}

}  // namespace contensou::reduction
