// Equations in scaled units (theory.md (R1)), with W = (16 w + 15 pi v)(8 w + 3 pi v), the weight of beta in (2.8):
//   d ln w/dbeta = -W r Psi/w,  d ln v/dbeta = -W (Phi - rho)/v,  ds/dbeta = W
#include "contensou/reduction/detail/stepped_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boost/numeric/odeint/stepper/generation/generation_dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include "contensou/reduction/detail/root.hpp"
#include "motion/stepping.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;
namespace odeint = boost::numeric::odeint;

using Values = std::array<double, 3>;  // ln w, ln v, s in units of the whole time
using DormandPrince = odeint::runge_kutta_dopri5<Values>;

struct RegularisedEquations {
  const ReducedSystem& system;
  double time_scale;
  long evaluations = 0;

  void operator()(const Values& x, Values& rate, double /*beta*/) {
    ++evaluations;
    const auto [larger, of_spin, of_slip, weight] = braking(system, x[0], x[1]);
    rate[0] = -(weight / larger * of_spin) * system.r();
    rate[1] = -(weight / larger * of_slip);
    rate[2] = weight / time_scale;
  }
};

}  // namespace

Motion integrate_regularised(const ReducedSystem& system, State start, const Eigen::ArrayXd& times,
                             const StepperSettings& stepping) {
  MotionRecorder report("integrate_regularised", system, start, times);
  if (start.u == 0 && start.v == 0) return report.finish_at_rest();

  LogState here = report.start();
  RegularisedEquations equations{system, report.time_scale()};
  const auto log_state = [&](const Values& x, double beta) {
    return LogState{x[0], x[1], x[2] * report.time_scale(), beta};
  };

  auto stepper = odeint::make_dense_output(stepping.tolerance, 0.0, DormandPrince());
  Values x{here.ln_w, here.ln_v, 0};
  const double speed = 16 * std::exp(x[0]) + 15 * pi * std::exp(x[1]);
  double step = 1e-3 / (speed * std::max(1.0, 0.01 * system.r()));
  // While a body begins to creep, ln v changes at the rate rho W/v.
  if (system.drive() > 0) {
    const double other = 8 * std::exp(x[0]) + 3 * pi * std::exp(x[1]);
    step = std::min(step, 0.1 * std::exp(x[1]) / (system.drive() * speed * other));
  }
  bool fresh = true;

  for (long steps = 0; steps < stepping.step_limit; ++steps) {
    if (const auto tail = AsymptoticTail::at(system, here)) return report.finish(*tail, steps, equations.evaluations);
    if (fresh) stepper.initialize(x, here.beta, step);
    fresh = false;

    std::pair<double, double> interval;
    try {
      interval = stepper.do_step(std::ref(equations));
    } catch (const odeint::odeint_error&) {
      return report.fail(Outcome::Kind::not_finite, steps, equations.evaluations);
    }
    x = stepper.current_state();
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) {
      return report.fail(Outcome::Kind::not_finite, steps, equations.evaluations);
    }

    // Returns the beta in this step at which a function of the state passes 0.
    const auto locate = [&](auto function) {
      Values at{};
      const auto along = [&](double beta) {
        stepper.calc_state(beta, at);
        return function(at);
      };
      return root_between(along, interval.first, interval.second);
    };

    double end = interval.second;
    const bool crosses = (here.ln_v > here.ln_w) != (x[1] > x[0]) && here.ln_v != here.ln_w;
    if (crosses) {
      end = locate([](const Values& at) { return at[1] - at[0]; });
      stepper.calc_state(end, x);
      x[1] = x[0];
      step = interval.second - end + 1e-3 * (end - interval.first);
      fresh = true;
    }
    while (report.next_time() <= x[2] * report.time_scale()) {
      const double wanted = report.next_time() / report.time_scale();
      const double beta = locate([&](const Values& at) { return at[2] - wanted; });
      Values at{};
      stepper.calc_state(beta, at);
      report.add(log_state(at, beta));
    }
    here = log_state(x, end);
    if (report.every_step()) report.add(here);
  }
  return report.fail(Outcome::Kind::step_limit, stepping.step_limit, equations.evaluations);
}

}  // namespace contensou::reduction
