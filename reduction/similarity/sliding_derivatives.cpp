// Notation (README (R10), (R57), (R58)): F = Phi - rho, D = F - r k Psi, ' = d/d ln k, s = w/(r Psi(0)) + m v
//   ds/dv = m + m',  ds/dw = 1/(r Psi(0)) - k m' = 1/(r Psi(0)) + k (m - ds/dv),  m' = (Delta - F m)/D
#include "similarity/sliding_derivatives.hpp"

#include <algorithm>
#include <cmath>

#include "contensou/reduction/infinity.hpp"

namespace contensou::reduction {

namespace {

/// The k above which 1/(r Psi(0)) - k m' loses more and more digits of ds/dw.
constexpr double fast_slide = 1e3;

/// The value of |D| divided by its larger term below which m' has too few digits.
constexpr double clear = 0.01;

}  // namespace

SlidingDerivatives::SlidingDerivatives(const Law& law, double r, const TerminalChart& chart, double drive)
    : law_(law),
      r_(r),
      drive_(drive),
      to_rest_(reaches_rest(chart, drive)),
      m_(sliding_solution(law, r, chart, drive)),
      by_v_(by_sliding_speed(law, r, chart, drive)),
      by_r_(sliding_equation(law, r, chart, drive, to_rest_,
                             [&](double k) {
                               const double m = m_(std::log(k)), by_v = by_speeds(k, m / share(k)).v;
                               return k * law(slip_of_ratio(k)).moment * (share(k) * by_v - m);
                             })),
      // At v = 0 any drive, however small, moves the body, so dm/drho may grow like 1/k as k -> 0.
      by_drive_(sliding_equation(law, r, chart, drive, true,
                                 [&](double k) { return k / (1 + k) * by_speeds(k, m_(std::log(k)) / share(k)).v; })),
      solved_from_(infinity) {
  const double from = chart.log_terminal_ratio(), to = chart.log_far_ratio();
  if (std::max(from, to) < infinity || std::min(from, to) > std::log(fast_slide)) return;
  // With a drive k falls to a ray, at which ds/dw is regular. So ds/dw is solved from the ray on.
  const bool from_ray = drive > 0 && from > -infinity && from < infinity;
  const double solved_from = from_ray ? std::exp(from) : fast_slide;
  std::optional<double> start;
  if (!from_ray && from < to) start = at(fast_slide, {}).by_w;
  by_w_.emplace(by_pivoting_speed(law, r, chart, drive, solved_from, start));
  solved_from_ = solved_from;
}

SlidingDerivatives::BySpeeds SlidingDerivatives::by_speeds(double k, double m) const {
  const Slip slip = slip_of_ratio(k);
  const auto [force, moment] = law_(slip);
  const double drag = r_ * (k * moment);
  if (drive_ == 0 && std::abs(force - drag) > clear * std::max(force, drag)) {
    const double slope = (law_.moment_deficit(slip) - force * m) / (force - drag);
    return {1 / (r_ * law_.pivoting_moment()) - k * slope, m + slope};
  }
  const double by_v = by_v_(std::log(k));
  return {1 / (r_ * law_.pivoting_moment()) + k * (m - by_v), by_v};
}

SlidingDerivatives::Values SlidingDerivatives::at(double k, std::optional<double> closed_m) const {
  const double ln_k = std::log(k);
  const BySpeeds by = by_speeds(k, closed_m ? *closed_m : m_(ln_k) / share(k));
  return {.by_w = k > solved_from_ ? (*by_w_)(ln_k) : by.w,
          .by_v = by.v,
          .by_r = by_r_(ln_k) * (to_rest_ ? 1 : k / (1 + k)),
          .by_drive = by_drive_(ln_k)};
}

}  // namespace contensou::reduction
