#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/verification.hpp"
#include "paper/statements.hpp"
#include "paper/zh98.hpp"

namespace contensou::program {

namespace {

using namespace reduction;
using namespace zh98;

constexpr double limit = 1e-6;  ///< allowed error of a number that is computed near a limit, in place of this limit
constexpr double a = 2;         ///< factor of the similarity (u, v) -> (a u, a v)

constexpr State start{1, 0.5}, mirrored{-1, 0.5}, scaled{a * start.u, a*start.v};

ReducedSystem system(double mu) { return {PadeLaw{}, mu}; }
Orbit orbit(double mu) { return Flow(system(mu)).orbit(start); }

double slope_of(Rate rate) { return rate.v / rate.u; }

/// Returns the state at which the given fraction of the stop time is left. A small fraction stands for the limit.
OrbitPoint late(const Orbit& motion, double fraction) { return motion.at_time_left(fraction * motion.stop_time()); }

/// Returns the exponent of the power of beta with which y falls next to the stop.
template <class Logarithm>
double exponent(const Orbit& motion, Logarithm ln_y) {
  const OrbitPoint before = late(motion, 1e-8), after = late(motion, 1e-12);
  return (ln_y(after) - ln_y(before)) / std::log(after.beta / before.beta);
}
double ln_u(const OrbitPoint& at) { return std::log(at.u); }
double ln_v(const OrbitPoint& at) { return at.ln_v; }

/// Returns the time (2.8) from beta = lower on, for u = u1/beta of (2.7) with v = 0; u1 = -u^2/u', u' = du/dbeta.
double time_from(double mu, double lower) {
  if (lower == 0) return infinity;  // the integrand grows like 1/beta^2 at beta = 0
  const double u1 = -1 / regularised_field(mu, {1, 0}).u;
  boost::math::quadrature::exp_sinh<double> rule;
  const auto along = [&](double beta) { return weight(mu, {u1 / beta, 0}); };
  return rule.integrate(along, lower, infinity, 1e-10) / u1;
}

/// Returns the tau at which a speed vanishes, divided by the stop time. At the end the speed is a power of time left.
template <class Logarithm>
double vanishes(const Orbit& motion, Logarithm ln_y, double power) {
  const OrbitPoint before = late(motion, 1e-2), after = late(motion, 1e-3);
  const double ratio = std::exp((ln_y(after) - ln_y(before)) / power);
  return (after.tau - ratio * before.tau) / (1 - ratio) / motion.stop_time();
}

/// Returns dp/dq with q = v/u and p = ln v, computed from the printed field.
double dp_dq(double mu, State state) {
  const Rate rate = field(mu, state);
  return rate.v / state.v / (rate.v / state.u - state.v * rate.u / (state.u * state.u));
}

/// Returns the change of p = ln v while ln q grows by 1 up to its value at the start.
double change_by_quadrature(double mu) {
  const double top = std::log(start.v / start.u);
  const auto integrand = [&](double ln_q) {
    const double q = std::exp(ln_q);
    return q * dp_dq(mu, {start.u, q * start.u});
  };
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(integrand, top - 1, top, 8, 1e-13);
}
double change_of_orbit(const Orbit& motion) {
  const double top = motion.start_log_ratio();
  return motion.at_log_ratio(top).ln_v - motion.at_log_ratio(top - 1).ln_v;
}

/// Returns the relative error of the estimate E2 of the stop time for small mu (reduction/small_mu.hpp).
double estimate_error(double mu) {
  return std::abs(small_mu_estimates(system(mu), start).back().tau / orbit(mu).stop_time() - 1);
}

}  // namespace

std::vector<Statement> plane_statements(double mu) {
  const ReducedSystem reduced = system(mu);
  const Orbit motion = orbit(mu);
  const double true_slope = slope_of(reduced.field(start));
  std::vector<Statement> statements{
      {"(2.6)", "du/dtau", field(mu, start).u, reduced.field(start).u, arithmetic},
      {"(2.6)", "dv/dtau", field(mu, start).v, reduced.field(start).v, arithmetic},
      {"(2.6)", "with |u| it holds for spin of either sign: du/dtau at -u", field(mu, mirrored).u,
       reduced.field(mirrored).u, arithmetic},
      {"", "dv/du of the integral curves (Fig. 4)", slope(mu, start), true_slope, arithmetic},
      {"", "u >= 0 is enough: dv/du is odd in u", slope(mu, mirrored), -true_slope, arithmetic},
      {"(2.7)", "has the same integral curves", slope_of(regularised_field(mu, start)), true_slope, arithmetic},
      {"(2.8)", "dtau/dbeta, from (2.6) and (2.7)", weight(mu, start),
       regularised_field(mu, start).u / reduced.field(start).u, arithmetic},
      {"(2.7)", "reaches rest in infinite beta only: beta grows without bound, by", 1000.,
       late(motion, 1e-12).beta / late(motion, 1e-8).beta, lower_bound, 0, "tau* - tau from 1e-8 to 1e-12 tau*"},
      // On u = u1/beta, v = v1/beta the rates u'/u and v'/v are both -1/beta.
      {"(2.7)", "u = u(1)/beta, v = v(1)/beta is a solution: (v'/v)/(u'/u)", 1.,
       slope_of(regularised_field(mu, start)) * start.u / start.v, arithmetic, 0, "", Verdict::not_true,
       "only on the axes u = 0 and v = 0"},
      {"(2.7)", "every solution has u ~ 1/beta: the exponent", -1., exponent(motion, ln_u), limit},
      {"(2.7)", "every solution has v ~ 1/beta: the exponent", -1., exponent(motion, ln_v), limit, 0, "",
       Verdict::not_true, "v ~ beta^(-14/(5 mu^2)) = beta^({computed:.6g})"},
      {"(2.8)", "the lower limit 0, along the solution ~ 1/beta with v = 0: tau*/u", time_from(mu, 0),
       reduced.pivoting_limit(1), 1e-8, 0, "", Verdict::erratum, "the lower limit 1, where that solution starts",
       time_from(mu, 1)},
      {"(2.8)", "with beta = 0 at the start it converges, to the stop time",
       stop_time(reduced, start, Route::regularised).tau, motion.stop_time(), stepping},
      // Bound of the stop time: tau* <= 16 u0/(5 mu) + (15 pi/14) v0, (R6) in reduction/README.md.
      {"", "every curve arrives in finite time: a bound over tau*", 1.,
       reduced.stop_time_bounds(start).upper / motion.stop_time(), lower_bound},
      {"", "u and v vanish at the same time: that of v over that of u", 1.,
       vanishes(motion, ln_v, 2 / reduced.r()) / vanishes(motion, ln_u, 1), limit},
      {"", "and that is the stop time", 1., vanishes(motion, ln_u, 1), limit},
      // If times stayed equal, multiplying the state by a would multiply the rate dv/dtau by a.
      {"", "(u, v) -> (a u, a v) is a symmetry of (2.6): dv/dtau there, a = 2", a * field(mu, start).v,
       reduced.field(scaled).v, arithmetic, 0, "", Verdict::erratum, "with tau -> a tau (and beta -> beta/a in (2.7))",
       field(mu, start).v},
      {"", "of dv/du it is one as it stands", slope(mu, start), slope_of(reduced.field(scaled)), arithmetic},
      {"", "(u, v) -> (q, p), q = v/u, p = ln v, separates: dp/dq for two p", dp_dq(mu, start), dp_dq(mu, scaled),
       arithmetic},
      {"", "dp/dq, from the law", dp_dq(mu, start), separated_slope(reduced, start.v / start.u), arithmetic},
      {"", "it is reduced to quadratures: the change of p over one of ln q", change_by_quadrature(mu),
       change_of_orbit(motion), 1e-11},
      {"", "tau*, by quadrature and by steps", stop_time(reduced, start, Route::quadrature).tau,
       integrate_directly(reduced, start).stop_time, stepping},
      {"", "for small mu there are asymptotics: order in mu of the error of E2", 5.,
       std::log2(estimate_error(0.02) / estimate_error(0.01)), lower_bound, 0, "mu = 0.02, 0.01"},
  };
  for (Statement& statement : statements) {
    statement.at = mu;
    if (statement.where.empty()) statement.where = "mu = {}, u = 1, v = 0.5";
  }
  return statements;
}

}  // namespace contensou::program
