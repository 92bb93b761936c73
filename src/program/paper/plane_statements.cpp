#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/direct_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/similarity.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "paper/statements.hpp"
#include "paper/zh98.hpp"

namespace contensou::program {

namespace {

using namespace reduction;
using namespace zh98;

constexpr double arithmetic = 1e-13;
constexpr double stepping = 1e-9;
constexpr double limit = 1e-6;  ///< a limit read off at a small distance from it
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double a = 2;  ///< the factor of the similarity

constexpr State start{1, 0.5}, mirrored{-1, 0.5}, scaled{a * start.u, a*start.v};

ReducedSystem system(double mu) { return {PadeLaw{}, mu}; }
Orbit orbit(double mu) { return Flow(system(mu)).orbit(start); }

double slope_of(Rate rate) { return rate.v / rate.u; }
double true_slope(double mu) { return slope_of(system(mu).field(start)); }

/// When this fraction of the stop time is left, or less, a motion is read as its limit.
OrbitPoint late(double mu, double fraction) {
  const Orbit motion = orbit(mu);
  return motion.at_time_left(fraction * motion.stop_time());
}

/// The exponent of beta by which ln y falls next to the stop.
template <class Logarithm>
double exponent(double mu, Logarithm ln_y) {
  const OrbitPoint before = late(mu, 1e-8), after = late(mu, 1e-12);
  return (ln_y(after) - ln_y(before)) / std::log(after.beta / before.beta);
}
double ln_u(const OrbitPoint& at) { return std::log(at.u); }
double ln_v(const OrbitPoint& at) { return at.ln_v; }

/// The integral of (2.8) from beta = lower along the solution u = u1/beta of (2.7) with v = 0, where 1/u1 = -u'/u^2.
double time_from(double mu, double lower) {
  if (lower == 0) return infinity;  // 1/beta^2 there
  const double u1 = -1 / regularised_field(mu, {1, 0}).u;
  boost::math::quadrature::exp_sinh<double> rule;
  const auto along = [&](double beta) { return weight(mu, {u1 / beta, 0}); };
  return rule.integrate(along, lower, infinity, 1e-10) / u1;
}

/// Next to the stop a speed is a power of the time left; the tau at which it vanishes, over the stop time.
template <class Logarithm>
double vanishes(double mu, Logarithm ln_y, double power) {
  const OrbitPoint before = late(mu, 1e-2), after = late(mu, 1e-3);
  const double ratio = std::exp((ln_y(after) - ln_y(before)) / power);
  return (after.tau - ratio * before.tau) / (1 - ratio) / orbit(mu).stop_time();
}

/// dp/dq with q = v/u, p = ln v, from the printed field.
double dp_dq(double mu, State state) {
  const Rate rate = field(mu, state);
  return rate.v / state.v / (rate.v / state.u - state.v * rate.u / (state.u * state.u));
}

/// The change of p = ln v while ln q grows by 1 to that of the start.
double change_by_quadrature(double mu) {
  const double top = std::log(start.v / start.u);
  const auto integrand = [&](double ln_q) {
    const double q = std::exp(ln_q);
    return q * dp_dq(mu, {start.u, q * start.u});
  };
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(integrand, top - 1, top, 8, 1e-13);
}
double change_of_orbit(double mu) {
  const double top = orbit(mu).start_log_ratio();
  return orbit(mu).at_log_ratio(top).ln_v - orbit(mu).at_log_ratio(top - 1).ln_v;
}

/// Relative error of the estimate E2 of the stop time for small mu.
double estimate_error(double mu) {
  return std::abs(small_mu_estimates(system(mu), start).back().tau / orbit(mu).stop_time() - 1);
}

}  // namespace

std::vector<Statement> plane_statements(double at_mu) {
  std::vector<Statement> statements{
      {"(2.6)", "du/dtau", [](double mu) { return field(mu, start).u; },
       [](double mu) { return system(mu).field(start).u; }, arithmetic},
      {"(2.6)", "dv/dtau", [](double mu) { return field(mu, start).v; },
       [](double mu) { return system(mu).field(start).v; }, arithmetic},
      {"(2.6)", "with |u| it holds for spin of either sign: du/dtau at -u",
       [](double mu) { return field(mu, mirrored).u; }, [](double mu) { return system(mu).field(mirrored).u; },
       arithmetic},
      {"", "dv/du of the integral curves (Fig. 4)", [](double mu) { return slope(mu, start); }, true_slope, arithmetic},
      {"", "u >= 0 is enough: dv/du is odd in u", [](double mu) { return slope(mu, mirrored); },
       [](double mu) { return -true_slope(mu); }, arithmetic},
      {"(2.7)", "has the same integral curves", [](double mu) { return slope_of(regularised_field(mu, start)); },
       true_slope, arithmetic},
      {"(2.8)", "dtau/dbeta, from (2.6) and (2.7)", [](double mu) { return weight(mu, start); },
       [](double mu) { return regularised_field(mu, start).u / system(mu).field(start).u; }, arithmetic},
      {"(2.7)", "reaches rest in infinite beta only: beta grows without bound, by", constant<1000>,
       [](double mu) { return late(mu, 1e-12).beta / late(mu, 1e-8).beta; }, lower_bound, 0,
       "tau* - tau from 1e-8 to 1e-12 tau*"},
      // Along u = u1/beta, v = v1/beta both fall at the same relative rate.
      {"(2.7)", "u = u(1)/beta, v = v(1)/beta is a solution: (v'/v)/(u'/u)", constant<1>,
       [](double mu) { return slope_of(regularised_field(mu, start)) * start.u / start.v; }, arithmetic, 0, "",
       Verdict::not_true, "only on the axes u = 0 and v = 0"},
      {"(2.7)", "every solution has u ~ 1/beta: the exponent", constant<-1>,
       [](double mu) { return exponent(mu, ln_u); }, limit},
      {"(2.7)", "every solution has v ~ 1/beta: the exponent", constant<-1>,
       [](double mu) { return exponent(mu, ln_v); }, limit, 0, "", Verdict::not_true,
       "v ~ beta^(-14/(5 mu^2)) = beta^({computed:.6g})"},
      {"(2.8)", "the lower limit 0, along the solution ~ 1/beta with v = 0: tau*/u",
       [](double mu) { return time_from(mu, 0); }, [](double mu) { return system(mu).pivoting_limit(1); }, 1e-8, 0, "",
       Verdict::erratum, "the lower limit 1, where that solution starts", [](double mu) { return time_from(mu, 1); }},
      {"(2.8)", "with beta = 0 at the start it converges, to the stop time",
       [](double mu) { return stop_time(system(mu), start, Route::regularised).tau; },
       [](double mu) { return orbit(mu).stop_time(); }, stepping},
      // The axis that is reached last: tau* <= 16 u0/(5 mu) + (15 pi/14) v0, README (R6).
      {"", "every curve arrives in finite time: a bound over tau*", constant<1>,
       [](double mu) { return system(mu).stop_time_bounds(start).upper / orbit(mu).stop_time(); }, lower_bound},
      {"", "u and v vanish at the same time: that of v over that of u", constant<1>,
       [](double mu) { return vanishes(mu, ln_v, 2 / system(mu).r()) / vanishes(mu, ln_u, 1); }, limit},
      {"", "and that is the stop time", constant<1>, [](double mu) { return vanishes(mu, ln_u, 1); }, limit},
      // u' = a u, v' = a v in the same time: the velocity would have to be a times as large.
      {"", "(u, v) -> (a u, a v) is a symmetry of (2.6): dv/dtau there, a = 2",
       [](double mu) { return a * field(mu, start).v; }, [](double mu) { return system(mu).field(scaled).v; },
       arithmetic, 0, "", Verdict::erratum, "with tau -> a tau (and beta -> beta/a in (2.7))",
       [](double mu) { return field(mu, start).v; }},
      {"", "of dv/du it is one as it stands", [](double mu) { return slope(mu, start); },
       [](double mu) { return slope_of(system(mu).field(scaled)); }, arithmetic},
      {"", "(u, v) -> (q, p), q = v/u, p = ln v, separates: dp/dq for two p",
       [](double mu) { return dp_dq(mu, start); }, [](double mu) { return dp_dq(mu, scaled); }, arithmetic},
      {"", "dp/dq, from the law", [](double mu) { return dp_dq(mu, start); },
       [](double mu) { return separated_slope(system(mu), start.v / start.u); }, arithmetic},
      {"", "it is reduced to quadratures: the change of p over one of ln q", change_by_quadrature, change_of_orbit,
       1e-11},
      {"", "tau*, by quadrature and by steps",
       [](double mu) { return stop_time(system(mu), start, Route::quadrature).tau; },
       [](double mu) { return integrate_directly(system(mu), start).stop_time; }, stepping},
      {"", "for small mu there are asymptotics: order in mu of the error of E2", constant<5>,
       [](double) { return std::log2(estimate_error(0.05) / estimate_error(0.025)); }, lower_bound, 0,
       "mu = 0.05, 0.025"},
  };
  for (Statement& statement : statements) {
    statement.at = at_mu;
    if (statement.where.empty()) statement.where = "mu = {}, u = 1, v = 0.5";
  }
  return statements;
}

}  // namespace contensou::program
