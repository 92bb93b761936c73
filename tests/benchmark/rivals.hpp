#pragma once

#include <string>
#include <vector>

namespace contensou::rivals {

/// A stop time of the Pade ball by somebody else's program.
struct RivalResult {
  double tau;
  long evaluations;  ///< of the right side of (2.6) or of the integrand; 0 for a closed form
};

/// What a careful user of a library would write.
struct Rival {
  std::string name;
  RivalResult (*stop_time)(double mu, double u0, double v0);
};

/// Steppers on (2.6) as printed, at 1e-12 relative and 1e-14 of the start absolute, steps that overshoot the stop
/// halved until |u| is 1e-8 of its start and the linear rest added; and 2F1 in (C1) where GSL is there.
std::vector<Rival> all();

/// Fehlberg 7(8) by Odeint on (2.6) with |u| as printed, at 1e-12: the step that it accepts across the stop, over the
/// time that was left.
double fehlberg_step_at_the_stop(double mu, double u0, double v0, double stop);

/// The separated integral as it stands, by Boost's tanh-sinh, and the relative error that it claims.
struct Quadrature {
  double tau;
  double claimed;
};
Quadrature raw_tanh_sinh(double mu, double u0, double v0);

/// Versions of the libraries.
std::string versions();

}  // namespace contensou::rivals
