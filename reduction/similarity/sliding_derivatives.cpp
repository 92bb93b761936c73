// Notation (theory.md and numerics.md (R10), (R34), (R35)): F = Phi - rho, D = F - r k Psi, ' = d/d ln k, s = w/(r
// Psi(0)) + m v
//   ds/dv = m + m',  ds/dw = 1/(r Psi(0)) - k m' = 1/(r Psi(0)) + k (m - ds/dv),  m' = (Delta - F m)/D
#include "similarity/sliding_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/tangent.hpp"

namespace contensou::reduction {

SlidingDerivatives::Place SlidingDerivatives::Place::at(const Law& law, double k) {
  const Slip slip = slip_of_ratio(k);
  return {k, std::log(k), law(slip), law.moment_deficit(slip)};
}

SlidingDerivatives::SlidingDerivatives(const Law& law, double r, const TerminalChart& chart, double drive)
    : law_(law),
      r_(r),
      drive_(drive),
      chart_(chart),
      to_rest_(reaches_rest(chart, drive)),
      by_differences_(tangent_error(law) > 0),
      m_(sliding_solution(law, r, chart, drive)),
      by_v_(std::make_unique<const Later<RegularSolution>>()),
      by_r_(sliding_equation(law, r, chart, drive, to_rest_,
                             [&](double k) {
                               const Place place = Place::at(law, k);
                               const double m = m_(place.ln_k), by_v = by_speeds(place, m / share(k), k_m(k, m)).v;
                               return k * place.friction.moment * (share(k) * by_v - m);
                             })),
      // At v = 0 any drive, however small, moves the body, so dm/drho can grow like 1/k as k -> 0.
      by_drive_(sliding_equation(law, r, chart, drive, true,
                                 [&](double k) {
                                   const Place place = Place::at(law, k);
                                   const double m = m_(place.ln_k);
                                   return k / (1 + k) * by_speeds(place, m / share(k), k_m(k, m)).v;
                                 })),
      solved_from_(infinity) {
  const double from = chart.log_terminal_ratio(), to = chart.log_far_ratio();
  if (std::max(from, to) < infinity || std::min(from, to) > std::log(fast_slide)) return;
  // Under a drive k falls to a ray, at which ds/dw is regular. Therefore ds/dw is solved from this ray on.
  const bool from_ray = drive > 0 && from > -infinity && from < infinity;
  const double solved_from = from_ray ? std::exp(from) : fast_slide;
  std::optional<double> start;
  if (!from_ray && from < to) start = at(Place::at(law, fast_slide), {}).by_w;
  by_w_.emplace(by_pivoting_speed(law, r, chart, drive, solved_from, start));
  solved_from_ = solved_from;
}

bool SlidingDerivatives::is_clear(double force, double drag, double drive) {
  constexpr double clear = 0.01;
  return std::abs(force - drive - drag) > clear * std::max(force, drag);
}

SlidingDerivatives::BySpeeds SlidingDerivatives::by_m(const Place& place, double r, double moment, double m) {
  const double force = place.friction.force, drag = r * (place.k * place.friction.moment);
  const double slope = (place.moment_deficit - force * m) / (force - drag);
  return {1 / (r * moment) - place.k * slope, m + slope};
}

SlidingDerivatives::BySpeeds SlidingDerivatives::by_speeds(const Place& place, double m, double k_m) const {
  const double moment = law_.pivoting_moment(), drag = r_ * (place.k * place.friction.moment);
  const bool algebraic = is_algebraic(place);
  if (drive_ == 0 && algebraic) return by_m(place, r_, moment, m);
  // m + m' = (Delta - r Psi k m)/D, in which k m has a limit at k = 0
  const double by_v =
      algebraic ? (place.moment_deficit - r_ * place.friction.moment * k_m) / (place.friction.force - drive_ - drag)
                : by_v_->made([&] { return by_sliding_speed(law_, r_, chart_, drive_); })(place.ln_k);
  return {1 / (r_ * moment) + (k_m - place.k * by_v), by_v};
}

bool SlidingDerivatives::is_algebraic(const Place& place) const {
  return (drive_ == 0 || by_differences_) &&
         is_clear(place.friction.force, r_ * (place.k * place.friction.moment), drive_);
}

SlidingDerivatives::Values SlidingDerivatives::at(const Place& place, std::optional<double> closed_m) const {
  const auto [k, ln_k, friction, deficit] = place;
  const double m = closed_m ? *closed_m : m_(ln_k) / share(k);
  const BySpeeds by = by_speeds(place, m, to_rest_ ? k_m(k, m_(ln_k)) : k * m);
  const double solved_from = is_algebraic(place) ? std::max(solved_from_, fast_slide) : solved_from_;
  return {.by_w = k > solved_from ? (*by_w_)(ln_k) : by.w,
          .by_v = by.v,
          .by_r = by_r_(ln_k) * (to_rest_ ? 1 : k / (1 + k)),
          .by_drive = by_drive_(ln_k)};
}

StopTimeGradient stop_time_gradient(const ReducedSystem& system, State start, double tau,
                                    const std::function<SlidingDerivatives::Values(double k)>& off_axes) {
  if (start.u == 0 && start.v == 0) {
    throw std::domain_error("Flow::stop_time_gradient: at rest there is none: the stop time has a corner there");
  }
  // Derivatives by speeds have degree 0 in the speeds; all others have degree 1.
  const int exponent = std::ilogb(std::max(std::abs(start.u), start.v));
  const double u = std::ldexp(std::abs(start.u), -exponent), v = std::ldexp(start.v, -exponent);
  const auto [chi, gamma] = system.inertia();
  const double mu = system.mu(), r = system.r(), drive = system.drive(), w = mu * u;
  const double pivoting = r * system.law().pivoting_moment();

  SlidingDerivatives::Values s{};  // derivatives of the scaled stop time
  if (u == 0) {
    s = {.by_w = 0, .by_v = 1 / (1 - drive), .by_r = 0, .by_drive = 1 / ((1 - drive) * (1 - drive))};
  } else if (v == 0 && drive == 0) {
    s = {.by_w = 1 / pivoting, .by_v = 0, .by_r = 0, .by_drive = 0};
  } else {
    s = off_axes(std::exp(std::log(v) - std::log(w)));
  }
  const double by_r = (w + v) * s.by_r - w / (r * pivoting);
  const double tau_of = std::ldexp(1 / system.scaled_time_rate(), exponent);
  return {.tau = tau,
          .by_u = std::copysign(mu * s.by_w, start.u) / system.scaled_time_rate(),
          .by_v = s.by_v / system.scaled_time_rate(),
          .by_mu = tau_of * (u * s.by_w + 2 * r / mu * by_r),
          .by_chi = -(tau / chi + tau_of * by_r * r / chi),
          .by_gamma = tau_of * by_r * r / gamma,
          .by_drive = tau_of * (w + v) * s.by_drive};
}

}  // namespace contensou::reduction
