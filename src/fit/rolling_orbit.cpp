#include "fit/rolling_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/root.hpp"

namespace contensou::fit {

namespace {

constexpr double to_either_side = 1e-4;  // of the numbers
constexpr double least_drive = 0.01;     // that counts as large beside a step

}  // namespace

RollingOrbit::RollingOrbit(const reduction::Law& law, double mu, reduction::State start, double rolling_at_start,
                           double by_drive, reduction::Inertia inertia, double accuracy)
    : RollingOrbit(law,
                   {std::log(mu), start.v, start.u, rolling_at_start,
                    std::min(by_drive, ScaledOrbit::greatest_drive(law, mu, inertia))},
                   inertia, accuracy) {}

RollingOrbit::RollingOrbit(reduction::Law law, const Numbers& at, reduction::Inertia inertia, double accuracy)
    : law_(std::move(law)), at_(at), inertia_(inertia), accuracy_(accuracy) {
  const double share = 1 - 1 / inertia.chi, mu = std::exp(at_[ln_mu]), v = at_[slip], w = mu * std::abs(at_[spin]);
  rests_ = at_[drive] > 0 ? (at_[rolling] + share * v) / at_[drive] : infinity;
  const double force = v > 0 || w > 0 ? law_({v, w}).force : 0;
  const Speeds start{v, at_[spin], 0, 0, v, 0};
  if (at_[rolling] == 0 && share * force <= at_[drive]) {
    hold(0, start);
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
  reached_ = std::max(reached_, T);
  if (!held_) {
    turns_->reach(std::min(T, rests_));
    const double last = std::min(T, rests_);
    const auto turning_at = [&](double at) {
      std::size_t cell = 0;
      return turning(at, turns_->speeds_at(at, cell).v);
    };
    // Rolling grows, then falls, and at rests_ it is what the slip is, negative.
    constexpr double first = 1e-9;
    if (std::isfinite(last) && turning_at(last) < -1e-13 * (at_[slip] + at_[rolling])) {
      const double from = at_[rolling] > 0 ? 0 : first * last;
      const double ends = turning_at(from) > 0 ? reduction::root_between(turning_at, from, last) : from;
      hold(ends, speeds_at(ends));
    }
  }
  if (held_) held_->reach(T - held_from_);
  if (!differences_) return;
  for (Difference& each : *differences_) {
    each.first->reach(reached_);
    each.second->reach(reached_);
  }
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
  Speeds now = turns_->speeds_at(T, turns_cell_);
  const double rolls = std::min(T, rests_), v0 = at_[slip], W0 = at_[rolling], rho = at_[drive];
  now.centre = T < rests_ ? now.v + turning(T, now.v) : 0;
  now.way = (v0 + W0) * rolls - (v0 * rolls - now.slid) / inertia_.chi - rho * rolls * rolls / 2;
  return now;
}

Speeds RollingOrbit::speeds_at(double T, std::size_t& /*cell*/) const { return speeds_at(T); }

const std::array<RollingOrbit::Difference, RollingOrbit::numbers>& RollingOrbit::differences() const {
  if (differences_) return *differences_;
  const double speed = at_[slip] + std::exp(at_[ln_mu]) * std::abs(at_[spin]);
  Numbers steps{to_either_side, to_either_side * speed, to_either_side * std::abs(at_[spin]),
                to_either_side * (at_[rolling] + at_[slip]), to_either_side * std::max(at_[drive], least_drive)};
  if (at_[spin] == 0) steps[spin] = to_either_side * speed;
  for (double& each : steps) {
    if (each == 0) each = to_either_side;
  }
  const double greatest = ScaledOrbit::greatest_drive(law_, std::exp(at_[ln_mu] + to_either_side), inertia_);
  differences_.emplace();
  for (std::size_t number = 0; number < numbers; ++number) {
    const double h = steps[number];
    // To both sides; from the least value that can be, to one.
    const bool bounded = number == slip || number == rolling || number == drive;
    const bool low = bounded && at_[number] < h, high = number == drive && at_[number] + h > greatest;
    const double first = low ? h : -h, second = low ? 2 * h : high ? -2 * h : h;
    const auto orbit = [&](double by) {
      Numbers beside = at_;
      beside[number] += by;
      std::unique_ptr<RollingOrbit> result(new RollingOrbit(law_, beside, inertia_, accuracy_));
      result->reach(reached_);
      return result;
    };
    Difference& each = (*differences_)[number];
    each.first = orbit(first);
    each.second = orbit(second);
    // Of the parabola through the three.
    each.of_here = -(first + second) / (first * second);
    each.of_first = second / (first * (second - first));
    each.of_second = -first / (second * (second - first));
  }
  return *differences_;
}

FilmOrbit::Moment RollingOrbit::at(double T, std::size_t& /*cell*/) const {
  Moment result{};
  result.now = speeds_at(T);
  const bool is_held = held_ && T >= held_from_;
  const double mu = std::exp(at_[ln_mu]), w = mu * std::abs(result.now.u);
  if (result.now.v > 0 || w > 0) {
    const auto [force, moment] = law_({result.now.v, w});
    result.dv = is_held ? -force : -inertia_.chi * (force - at_[drive]);
    result.du = -inertia_.gamma * mu * moment * (result.now.u > 0 ? 1 : result.now.u < 0 ? -1 : 0);
    result.dcentre = -force;
  } else if (!is_held && T < rests_) {
    result.dcentre = -at_[drive];
  }
  const auto& all = differences();
  const auto by = [&](std::size_t number) {
    const Difference& each = all[number];
    return each.of_here * result.now + each.of_first * each.first->speeds_at(T) +
           each.of_second * each.second->speeds_at(T);
  };
  result.by_ln_mu = by(ln_mu);
  result.by_v = by(slip);
  result.by_u = by(spin);
  result.by_rolling = by(rolling);
  result.by_drive = by(drive);
  return result;
}

double RollingOrbit::stop_T() const { return held_ ? held_from_ + held_->stop().T : turns_->stop().T; }

FilmOrbit::Stop RollingOrbit::stop() const {
  const auto& all = differences();
  const double here = stop_T();
  const auto by = [&](std::size_t number) {
    const Difference& each = all[number];
    return each.of_here * here + each.of_first * each.first->stop_T() + each.of_second * each.second->stop_T();
  };
  return {here, by(ln_mu), by(slip), by(spin), by(rolling), by(drive)};
}

}  // namespace contensou::fit
