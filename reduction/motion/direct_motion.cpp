// Equations in scaled units (theory.md (R1)): d ln w/ds = -r Psi/w, d ln v/ds = -(Phi - rho)/v, dbeta/ds = 1/W. W is
// the weight (16 w + 15 pi v)(8 w + 3 pi v) of (2.8).
#include "contensou/reduction/detail/stepped_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "motion/stepping.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
namespace odeint = boost::numeric::odeint;

using Values = std::array<double, 3>;  // ln w, ln v, ln(1 + beta/beta_unit)
using Fehlberg = odeint::runge_kutta_fehlberg78<Values>;

/// Largest change of x in one step next to a kink, divided by |x|, where x = ln k - ln k of the kink. A law can have
/// a term x ln|x| there. Fehlberg's error estimate uses only stages at the ends of a step and does not detect this
/// term.
constexpr double fraction_of_distance = 0.5;
/// Distance |x| below which x^2 is negligible and steps need not shrink any more.
constexpr double nearest_kink = 1e-8;

/// Distance |x| below which the previous step counts as having ended on the kink.
constexpr double on_kink = 16 * std::numeric_limits<double>::epsilon();

struct DirectEquations {
  const ReducedSystem& system;
  double beta_unit;
  long evaluations = 0;

  void operator()(const Values& x, Values& rate, double /*s*/) {
    ++evaluations;
    const auto [larger, of_spin, of_slip, weight] = braking(system, x[0], x[1]);
    rate[0] = -system.r() * (of_spin / larger);
    rate[1] = -(of_slip / larger);
    rate[2] = std::exp(-x[2]) / (beta_unit * weight);
  }
};

}  // namespace

Motion integrate_directly(const ReducedSystem& system, State start, const Eigen::ArrayXd& times,
                          const StepperSettings& stepping) {
  MotionRecorder report("integrate_directly", system, start, times);
  if (start.u == 0 && start.v == 0) return report.finish_at_rest();

  LogState here = report.start();
  // beta grows without bound. The variable ln(1 + beta/beta_unit) starts at 0 and is about as large as the others.
  const double speed = 16 * std::exp(here.ln_w) + 15 * pi * std::exp(here.ln_v);
  const double beta_unit = 1 / speed;
  DirectEquations equations{system, beta_unit};
  auto stepper = odeint::make_controlled(stepping.tolerance, 0.0, Fehlberg());

  std::vector<double> kinks;  // kinks in ln k
  for (double k : system.law().kinks()) kinks.push_back(std::log(k));

  Values x{here.ln_w, here.ln_v, 0};
  double s = 0;
  double step = 1e-3 * std::max(std::exp(here.ln_w), std::exp(here.ln_v)) / std::max(1.0, 0.01 * system.r());
  // While a body begins to creep, ln v changes at the rate rho/v.
  if (system.drive() > 0) step = std::min(step, 0.1 * std::exp(here.ln_v) / system.drive());
  const auto log_state = [&] { return LogState{x[0], x[1], s, beta_unit * std::expm1(x[2])}; };

  for (long steps = 0; steps < stepping.step_limit; ++steps) {
    if (const auto tail = AsymptoticTail::at(system, here)) return report.finish(*tail, steps, equations.evaluations);

    // The step ends at the next time to report. The steps after it must not become shorter for this reason.
    const double wanted = report.next_time();
    Values rate;
    equations(x, rate, s);
    double distance = infinity;
    for (double kink : kinks) distance = std::min(distance, std::abs(x[1] - x[0] - kink));
    distance = std::max(distance, nearest_kink);
    const double limit = std::min(wanted - s, fraction_of_distance * distance / std::abs(rate[1] - rate[0]));
    double trial = std::min(step, limit);
    const Values before = x;
    const double s_before = s;
    double taken = trial;  // the difference s - s_before would lose all digits near the stop
    while (stepper.try_step(std::ref(equations), x, s, trial) == odeint::fail) {
      if (!(trial > std::numeric_limits<double>::min())) {
        return report.fail(Outcome::Kind::not_finite, steps, equations.evaluations);
      }
      taken = trial;
    }
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) {
      return report.fail(Outcome::Kind::not_finite, steps, equations.evaluations);
    }
    const bool shortened = taken == limit;
    step = shortened ? std::max(step, trial) : trial;

    const auto crossed = std::ranges::find_if(kinks, [&](double kink) {
      const double side = before[1] - before[0] - kink;
      return std::abs(side) > on_kink && (side > 0) != (x[1] - x[0] > kink);
    });
    if (crossed != kinks.end()) {
      // Find the length of the step that ends on the kink.
      const auto gap_of = [&](const Values& at) { return at[1] - at[0] - *crossed; };
      Fehlberg base;
      Values landed = x;
      const auto gap_after = [&](double length) {
        base.do_step(std::ref(equations), before, s_before, landed, length);
        return gap_of(landed);
      };
      const double length = root_between(gap_after, 0, taken, gap_of(before), gap_of(x));
      gap_after(length);
      x = landed;
      x[1] = x[0] + *crossed;
      s = s_before + length;
    }
    here = log_state();
    if (report.every_step()) {
      report.add(here);
    } else {
      while (report.next_time() <= s) report.add(here);
    }
  }
  return report.fail(Outcome::Kind::step_limit, stepping.step_limit, equations.evaluations);
}

}  // namespace contensou::reduction
