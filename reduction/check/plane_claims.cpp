#include "contensou/reduction/plane_claims.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/direct_motion.hpp"
#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/paper_system.hpp"
#include "contensou/reduction/similarity.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;

constexpr double arithmetic = 1e-13;
constexpr double stepping = 1e-9;
constexpr double limit = 1e-6;  ///< a limit read off at a small distance from it

class PlaneExamination {
 public:
  PlaneExamination(const ReducedSystem& system, State start, const PrintedPlane& printed,
                   const SimilaritySolution& solution)
      : system_(system), mu_(system.mu()), start_(start), orbit_(system, start, solution), printed_(printed) {}

  std::vector<PaperClaim> run() {
    equations();
    solutions();
    stop();
    symmetry();
    return std::move(claims_);
  }

 private:
  void add(std::string equation, std::string statement, Evidence evidence) {
    claims_.push_back({std::move(equation), std::move(statement), "", Verdict::holds, std::move(evidence)});
  }
  void add(std::string equation, std::string statement, Evidence evidence, Verdict recorded, std::string correction) {
    claims_.push_back(
        {std::move(equation), std::move(statement), std::move(correction), recorded, std::move(evidence)});
  }

  std::string at_start() const { return fmt::format("mu = {}, u = {}, v = {}", mu_, start_.u, start_.v); }
  std::string at_mu() const { return fmt::format("mu = {}", mu_); }

  State scaled(double factor) const { return {factor * start_.u, factor * start_.v}; }
  State mirrored() const { return {-start_.u, start_.v}; }

  void equations() {
    const Rate here = printed_.field(mu_, start_);
    add("(2.6)", "du/dtau", {here.u, system_.field(start_).u, arithmetic, at_start()});
    add("(2.6)", "dv/dtau", {here.v, system_.field(start_).v, arithmetic, at_start()});
    add("(2.6)", "with |u| it holds for spin of either sign: du/dtau at -u",
        {printed_.field(mu_, mirrored()).u, system_.field(mirrored()).u, arithmetic, at_start()});
    const Rate truth = system_.field(start_);
    add("", "dv/du of the integral curves (Fig. 4)",
        {printed_.slope(mu_, start_), truth.v / truth.u, arithmetic, at_start()});
    add("", "u >= 0 is enough: dv/du is odd in u",
        {printed_.slope(mu_, mirrored()), -truth.v / truth.u, arithmetic, at_start()});
    const Rate regularised = printed_.regularised_field(mu_, start_);
    add("(2.7)", "has the same integral curves",
        {regularised.v / regularised.u, truth.v / truth.u, arithmetic, at_start()});
    add("(2.8)", "dtau/dbeta, from (2.6) and (2.7)",
        {printed_.weight(mu_, start_), regularised.u / truth.u, arithmetic, at_start()});
  }

  /// From this share of the stop time left on, a motion is read as its limit.
  OrbitPoint late(double share) const { return orbit_.at_time_left(share * orbit_.stop_time()); }

  void solutions() {
    const OrbitPoint before = late(1e-8);
    const OrbitPoint after = late(1e-12);
    const double beta_growth = std::log(after.beta / before.beta);
    add("(2.7)", "reaches rest in infinite beta only: beta grows without bound, by",
        {1e3, after.beta / before.beta, 0, "tau* - tau from 1e-8 to 1e-12 tau*", {}, true});

    // Along u = u1/beta, v = v1/beta both fall at the same relative rate.
    const Rate rate = printed_.regularised_field(mu_, start_);
    add("(2.7)", "u = u(1)/beta, v = v(1)/beta is a solution: (v'/v)/(u'/u)",
        {1, (rate.v / start_.v) / (rate.u / start_.u), arithmetic, at_start()}, Verdict::not_true,
        terminal_ratio(system_.law(), system_.r()).regime == TerminalRegime::ray
            ? "only on the axes and on the ray v = k* mu u"
            : "only on the axes u = 0 and v = 0");
    add("(2.7)", "every solution has u ~ 1/beta: the exponent",
        {-1, std::log(after.u / before.u) / beta_growth, limit, at_mu()});
    add("(2.7)", "every solution has v ~ 1/beta: the exponent",
        {-1, (after.ln_v - before.ln_v) / beta_growth, limit, at_mu()}, Verdict::not_true,
        fmt::format("v ~ beta^(-14/(5 mu^2)) = beta^({:.6g})", -2 / system_.r()));
  }

  void stop() {
    // On v = 0 the solution ~ 1/beta of (2.7) is u1/beta with 1/u1 = -u'/u^2.
    const auto time_from = [&](double lower) {
      const double u1 = -1 / printed_.regularised_field(mu_, {1, 0}).u;
      if (lower == 0) return std::numeric_limits<double>::infinity();
      boost::math::quadrature::exp_sinh<double> rule;
      return rule.integrate(
                 [&](double beta) {
                   return printed_.weight(mu_, {u1 / beta, 0});
                 },
                 lower, std::numeric_limits<double>::infinity(), 1e-10) /
             u1;
    };
    add("(2.8)", "the lower limit 0, along the solution ~ 1/beta with v = 0: tau*/u",
        {time_from(0), system_.pivoting_limit(1), 1e-8, at_mu(), time_from(1)}, Verdict::slip,
        "the lower limit 1, where that solution starts");
    const double stop = orbit_.stop_time();
    add("(2.8)", "with beta = 0 at the start it converges, to the stop time",
        {stop_time(system_, start_, Route::regularised).tau, stop, stepping, at_start()});
    // The axis that is reached last: tau* <= 16 u0/(5 mu) + (15 pi/14) v0, README (R6).
    add("", "every curve arrives in finite time: a bound over tau*",
        {1, system_.stop_time_bounds(start_).upper / stop, 0, at_start(), {}, true});
    // Both speeds fall like powers of the time left; where these vanish, found from each.
    const OrbitPoint before = late(1e-2);
    const OrbitPoint after = late(1e-3);
    const auto vanishes = [&](double ln_before, double ln_after, double power) {
      const double ratio = std::exp((ln_after - ln_before) / power);
      return (after.tau - ratio * before.tau) / (1 - ratio) / stop;
    };
    add("", "u and v vanish at the same time: that of v over that of u",
        {1, vanishes(before.ln_v, after.ln_v, 2 / system_.r()) / vanishes(std::log(before.u), std::log(after.u), 1),
         limit, at_start()});
    add("", "and that is the stop time", {1, vanishes(std::log(before.u), std::log(after.u), 1), limit, at_start()});
  }

  void symmetry() {
    constexpr double a = 2;
    // u' = a u, v' = a v in the same time: the velocity would have to be a times as large.
    const double slowed = printed_.field(mu_, start_).v;
    add("", "(u, v) -> (a u, a v) is a symmetry of (2.6): dv/dtau there, a = 2",
        {a * slowed, system_.field(scaled(a)).v, arithmetic, at_start(), slowed}, Verdict::slip,
        "with tau -> a tau (and beta -> beta/a in (2.7))");
    const Rate there = system_.field(scaled(a));
    add("", "of dv/du it is one as it stands",
        {printed_.slope(mu_, start_), there.v / there.u, arithmetic, at_start()});

    // dp/dq along two orbits with one q, p apart by ln a, from the printed field.
    const double q = start_.v / start_.u;
    const auto dp_dq = [&](State state) {
      const Rate rate = printed_.field(mu_, state);
      const double dq = rate.v / state.u - state.v * rate.u / (state.u * state.u);
      return rate.v / state.v / dq;
    };
    add("", "(u, v) -> (q, p), q = v/u, p = ln v, separates: dp/dq for two p",
        {dp_dq(start_), dp_dq(scaled(a)), arithmetic, at_start()});
    add("", "dp/dq, from the law", {dp_dq(start_), separated_slope(system_, q), arithmetic, at_start()});
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    const double bottom = std::log(q) - 1;
    const double change = Rule::integrate(
        [&](double ln_q) {
          const double here = std::exp(ln_q);
          return here * dp_dq({start_.u, here * start_.u});
        },
        bottom, std::log(q), 8, 1e-13);
    add("", "it is reduced to quadratures: the change of p over one of ln q",
        {change,
         orbit_.at_log_ratio(orbit_.start_log_ratio()).ln_v - orbit_.at_log_ratio(orbit_.start_log_ratio() - 1).ln_v,
         1e-11, at_start()});
    add("", "tau*, by quadrature and by steps",
        {stop_time(system_, start_, Route::quadrature).tau, integrate_directly(system_, start_).stop_time, stepping,
         at_start()});

    const auto error = [&](double mu) {
      const ReducedSystem small(system_.law(), mu, system_.inertia());
      return std::abs(small_mu_estimates(small, start_).back().tau / stop_time(small, start_).tau - 1);
    };
    add("", "for small mu there are asymptotics: order in mu of the error of E2",
        {5, std::log2(error(0.05) / error(0.025)), 0, "mu = 0.05, 0.025", {}, true});
  }

  ReducedSystem system_;
  double mu_;
  State start_;
  Orbit orbit_;
  PrintedPlane printed_;
  std::vector<PaperClaim> claims_;
};

}  // namespace

PrintedPlane printed_plane() {
  return {paper::field, paper::slope, paper::regularised_field, paper::regularising_weight};
}

std::vector<PaperClaim> plane_claims(const ReducedSystem& system, State start, const PrintedPlane& printed) {
  return plane_claims(system, start, printed, similarity_solution(system.law(), system.r()));
}

std::vector<PaperClaim> plane_claims(const ReducedSystem& system, State start, const PrintedPlane& printed,
                                     const SimilaritySolution& solution) {
  return PlaneExamination(system, start, printed, solution).run();
}

}  // namespace contensou::reduction
