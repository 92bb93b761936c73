#include "rivals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>

#ifdef CONTENSOU_SUNDIALS
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#endif

namespace contensou::rivals {

namespace {

namespace odeint = boost::numeric::odeint;
using std::numbers::pi;
using State = std::array<double, 2>;

constexpr double tolerance = 1e-12;

/// Below this fraction of |u0|, |u| is taken to fall linearly in time.
constexpr double rest = 1e-8;

/// Returns a speed that is negligible compared with the speeds of a start.
double negligible(double mu, double u0, double v0) { return 1e-14 * (mu * u0 + v0); }

/// The equations of motion (2.6) of a ball under the Pade law, u >= 0.
struct Field {
  double mu;
  long evaluations = 0;

  void operator()(const double* x, double* rate) {
    ++evaluations;
    rate[0] = -5 * mu * mu * x[0] / (16 * mu * x[0] + 15 * pi * x[1]);
    rate[1] = -7 * x[1] / (8 * mu * x[0] + 3 * pi * x[1]);
  }
};

/// Steps until u is small; halves a step beyond the stop. On success try_step(tau, x, dt) advances tau and x = (u, v).
template <class Step>
double halving(double mu, double u0, double v0, Step try_step) {
  double tau = 0;
  double dt = 1e-6 * (u0 + v0);
  State x{u0, v0};
  while (x[0] > rest * u0) {
    const double before = tau;
    const State start = x;
    const double tried = dt;
    try_step(tau, x, dt);
    x[1] = std::max(x[1], 0.0);
    if (!(x[0] > 0)) {
      tau = before;
      x = start;
      dt = tried / 2;
    }
    if (dt < 1e-18 * (u0 + v0)) return std::nan("");  // no step is small enough
  }
  return tau + 16 * x[0] / (5 * mu) + 3 * pi * x[1] / 7;
}

template <class Stepper>
RivalResult by_odeint(double mu, double u0, double v0) {
  Field field{mu};
  auto stepper = odeint::make_controlled<Stepper>(negligible(mu, std::abs(u0), v0), tolerance);
  const auto system = [&](const State& x, State& rate, double) { field(x.data(), rate.data()); };
  const double tau = halving(mu, std::abs(u0), v0, [&](double& time, State& x, double& dt) {
    stepper.try_step(system, x, time, dt);
    if constexpr (requires { stepper.reset(); }) {
      if (!(x[0] > 0)) stepper.reset();  // the stepper must forget the rate of the last step
    }
  });
  return {tau, field.evaluations};
}

#ifdef CONTENSOU_SUNDIALS
RivalResult by_cvode(double mu, double u0, double v0) {
  struct Data {
    Field field;
    double least;
  } data{Field{mu}, rest * std::abs(u0)};
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  N_Vector x = N_VNew_Serial(2, context);
  N_Vector absolute = N_VNew_Serial(2, context);
  NV_Ith_S(x, 0) = std::abs(u0);
  NV_Ith_S(x, 1) = v0;
  NV_Ith_S(absolute, 0) = negligible(mu, std::abs(u0), v0);
  NV_Ith_S(absolute, 1) = negligible(mu, std::abs(u0), v0);
  void* solver = CVodeCreate(CV_BDF, context);
  CVodeInit(
      solver,
      [](realtype, N_Vector at, N_Vector rate, void* user) {
        // A corrector may try a state beyond the stop. This return value, a recoverable error, makes the step shorter.
        if (!(NV_Ith_S(at, 0) > 0)) return 1;
        static_cast<Data*>(user)->field(NV_DATA_S(at), NV_DATA_S(rate));
        return 0;
      },
      0, x);
  CVodeSVtolerances(solver, tolerance, absolute);
  CVodeSetUserData(solver, &data);
  CVodeSetMaxNumSteps(solver, 10'000'000);
  CVodeSetInitStep(solver, 1e-6 * (std::abs(u0) + v0));
  CVodeSetErrFile(solver, nullptr);
  SUNMatrix matrix = SUNDenseMatrix(2, 2, context);
  SUNLinearSolver linear = SUNLinSol_Dense(x, matrix, context);
  CVodeSetLinearSolver(solver, linear, matrix);
  CVodeRootInit(solver, 1, [](realtype, N_Vector at, realtype* value, void* user) {
    *value = NV_Ith_S(at, 0) - static_cast<Data*>(user)->least;
    return 0;
  });
  realtype tau = 0;
  const int status = CVode(solver, 1e300, x, &tau, CV_NORMAL);
  const double stop = status >= 0 ? tau + 16 * NV_Ith_S(x, 0) / (5 * mu) : std::nan("");
  SUNLinSolFree(linear);
  SUNMatDestroy(matrix);
  N_VDestroy(absolute);
  N_VDestroy(x);
  CVodeFree(&solver);
  SUNContext_Free(&context);
  return {stop, data.field.evaluations};
}
#endif

}  // namespace

std::vector<Rival> all() {
  std::vector<Rival> found{{"Odeint dopri5 on (2.6)", by_odeint<odeint::runge_kutta_dopri5<State>>},
                           {"Odeint Fehlberg 7(8) on (2.6)", by_odeint<odeint::runge_kutta_fehlberg78<State>>}};
#ifdef CONTENSOU_SUNDIALS
  found.push_back({"SUNDIALS CVODE, BDF, on (2.6)", by_cvode});
#endif
  return found;
}

std::string versions() {
  std::string text = fmt::format("Boost {}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000);
#ifdef CONTENSOU_SUNDIALS
  text += fmt::format(", SUNDIALS {}", SUNDIALS_VERSION);
#endif
  return text;
}

}  // namespace contensou::rivals
