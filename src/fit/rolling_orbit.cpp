#include "fit/rolling_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/root.hpp"

namespace contensou::fit {

RollingOrbit::RollingOrbit(const reduction::Law& law, double mu, reduction::State start, double rolling_at_start,
                           double by_drive, reduction::Inertia inertia, double accuracy)
    : law_(law),
      at_{std::log(mu), start.v, start.u, rolling_at_start,
          std::min(by_drive, ScaledOrbit::greatest_drive(law, mu, inertia))},
      inertia_(inertia),
      accuracy_(accuracy) {
  const double share = 1 - 1 / inertia.chi, v = at_[slip], w = mu * std::abs(at_[spin]);
  rests_ = at_[drive] > 0 ? (at_[rolling] + share * v) / at_[drive] : infinity;
  const double force = v > 0 || w > 0 ? law_({v, w}).force : 0;
  if (at_[rolling] == 0 && share * force <= at_[drive]) {
    hold(0, {v, at_[spin], 0, 0, v, 0});
  } else {
    turns_.emplace(law_, mu, reduction::State{.u = at_[spin], .v = v}, accuracy_, inertia_, at_[drive]);
  }
}

double RollingOrbit::turning(double T, double v) const {
  return at_[rolling] + (1 - 1 / inertia_.chi) * (at_[slip] - v) - at_[drive] * T;
}

void RollingOrbit::hold(double T, const Speeds& then) {
  held_from_ = T;
  then_ = then;
  held_.emplace(law_, std::exp(at_[ln_mu]), reduction::State{.u = then.u, .v = then.v}, accuracy_,
                reduction::Inertia{.chi = 1, .gamma = inertia_.gamma});
}

void RollingOrbit::reach(double T) {
  if (!held_) {
    turns_->reach(std::min(T, rests_));
    const double last = std::min(T, rests_);
    const auto rolling_at = [&](double at) {
      std::size_t cell = 0;
      return turning(at, turns_->speeds_at(at, cell).v);
    };
    // Rolling grows, then falls, and at rests_ it is what the slip is, negative.
    constexpr double first = 1e-9;
    if (std::isfinite(last) && rolling_at(last) < -1e-13 * (at_[slip] + at_[rolling])) {
      const double from = at_[rolling] > 0 ? 0 : first * last;
      const double ends = rolling_at(from) > 0 ? reduction::root_between(rolling_at, from, last) : from;
      hold(ends, speeds_at(ends));
    }
  }
  if (held_) held_->reach(T - held_from_);
}

Speeds RollingOrbit::speeds_at(double T) const {
  if (held_ && T >= held_from_) {
    Speeds now = held_->speeds_at(T - held_from_, held_cell_);
    now.slid += then_.slid;
    now.turned += then_.turned;
    now.centre = now.v;
    now.way = then_.way + now.slid - then_.slid;
    return now;
  }
  return turning_at(T, turns_->speeds_at(T, turns_cell_));
}

/// The state with that of the centre.
Speeds RollingOrbit::turning_at(double T, Speeds now) const {
  const double rolls = std::min(T, rests_), v0 = at_[slip], W0 = at_[rolling], rho = at_[drive];
  now.centre = T < rests_ ? now.v + turning(T, now.v) : 0;
  now.way = (v0 + W0) * rolls - (v0 * rolls - now.slid) / inertia_.chi - rho * rolls * rolls / 2;
  return now;
}

Speeds RollingOrbit::speeds_at(double T, std::size_t& /*cell*/) const { return speeds_at(T); }

std::array<Speeds FilmOrbit::Moment::*, RollingOrbit::numbers> RollingOrbit::derivatives() {
  return {&Moment::by_ln_mu, &Moment::by_v, &Moment::by_u, &Moment::by_rolling, &Moment::by_drive};
}

void RollingOrbit::set_rates(Moment& moment, bool is_held) const {
  const double mu = std::exp(at_[ln_mu]), w = mu * std::abs(moment.now.u);
  if (!(moment.now.v > 0 || w > 0)) return;
  const auto [force, torque] = law_({moment.now.v, w});
  moment.dv = is_held ? -force : -inertia_.chi * (force - at_[drive]);
  moment.du = -inertia_.gamma * mu * torque * (moment.now.u > 0 ? 1 : moment.now.u < 0 ? -1 : 0);
  moment.dcentre = -force;
}

FilmOrbit::Moment RollingOrbit::turning_moment(double T) const {
  Moment result = turns_->at(T, turns_cell_);
  result.now = turning_at(T, result.now);
  set_rates(result, false);
  if (result.now.v == 0 && result.now.u == 0) result.dcentre = T < rests_ ? -at_[drive] : 0;
  const double rolls = std::min(T, rests_), share = 1 - 1 / inertia_.chi;
  for (std::size_t number = 0; number < numbers; ++number) {
    Speeds& by = result.*derivatives()[number];
    const double by_v0 = number == slip, by_W0 = number == rolling, by_rho = number == drive;
    by.centre = T < rests_ ? by.v + by_W0 + share * (by_v0 - by.v) - by_rho * T : 0;
    by.way = (by_v0 + by_W0) * rolls - (by_v0 * rolls - by.slid) / inertia_.chi - by_rho * rolls * rolls / 2;
  }
  return result;
}

const std::array<RollingOrbit::Held, RollingOrbit::numbers>& RollingOrbit::held_by() const {
  if (held_by_) return *held_by_;
  Moment then{};
  then.now = then_;
  if (turns_) {
    then = turning_moment(held_from_);
  } else {  // held from the start: rolling alone would let it turn for a while
    set_rates(then, false);
    then.by_v.v = then.by_v.centre = then.by_u.u = then.by_rolling.centre = 1;
  }
  const double turning_rate = -(1 - 1 / inertia_.chi) * then.dv - at_[drive];
  held_by_.emplace();
  for (std::size_t number = 0; number < numbers; ++number) {
    const Speeds& by = then.*derivatives()[number];
    const double dT = -(by.centre - by.v) / turning_rate;
    (*held_by_)[number] = {dT, by + dT * Speeds{then.dv, then.du, then_.v, then_.u, 0, then_.centre}};
  }
  return *held_by_;
}

FilmOrbit::Moment RollingOrbit::at(double T, std::size_t& /*cell*/) const {
  if (!held_ || T < held_from_) return turning_moment(T);
  const Moment held = held_->at(T - held_from_, held_cell_);
  Moment result{};
  result.now = speeds_at(T);
  set_rates(result, true);
  for (std::size_t number = 0; number < numbers; ++number) {
    const auto& [dT, state] = held_by()[number];
    Speeds& by = result.*derivatives()[number];
    by = state.v * held.by_v + state.u * held.by_u + -dT * Speeds{result.dv, result.du, result.now.v, result.now.u};
    if (number == ln_mu) by = by + held.by_ln_mu;
    by.way = state.way + by.slid;
    by.slid += state.slid;
    by.turned += state.turned;
    by.centre = by.v;
  }
  return result;
}

FilmOrbit::Stop RollingOrbit::stop() const {
  if (!held_) return turns_->stop();
  const Stop held = held_->stop();
  const auto by = [&](std::size_t number) {
    const auto& [dT, state] = held_by()[number];
    return dT + held.by_v * state.v + held.by_u * state.u + (number == ln_mu ? held.by_ln_mu : 0);
  };
  return {held_from_ + held.T, by(ln_mu), by(slip), by(spin), by(rolling), by(drive)};
}

}  // namespace contensou::fit
