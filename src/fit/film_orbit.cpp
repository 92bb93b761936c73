#include "fit/film_orbit.hpp"

#include <algorithm>
#include <cmath>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"

namespace contensou::fit {

FilmOrbit::FilmOrbit(const reduction::Law& law, reduction::Inertia inertia, Kind kind, const Numbers& at,
                     double accuracy)
    : law_(law), inertia_(inertia), kind_(kind), at_(at), accuracy_(accuracy) {
  const double mu = std::exp(at[ln_mu]), share = 1 - 1 / inertia.chi;
  const double v = std::abs(at[slip]), u = std::abs(at[spin]), w = mu * u;
  if (kind == Kind::resisted) at_[drive] = std::min(at[drive], OrbitCells::greatest_drive(law, mu, inertia));
  rests_ = at_[drive] > 0 ? (at_[rolling] + share * v) / at_[drive] : infinity;
  const double force = v > 0 || w > 0 ? law({v, w}).force : 0;
  if (at_[drive] > 0 && at_[rolling] == 0 && share * force <= at_[drive])
    hold(0, {.v = v, .u = u, .centre = v});
  else
    turns_.emplace(law, mu, inertia, kind, reduction::State{.u = u, .v = v}, at_[drive], accuracy);
}

void FilmOrbit::hold(double T, const Speeds& then) {
  held_from_ = T;
  then_ = then;
  held_.emplace(law_, std::exp(at_[ln_mu]), reduction::Inertia{.chi = 1, .gamma = inertia_.gamma}, Kind::ball,
                reduction::State{.u = then.u, .v = then.v}, 0, accuracy_);
}

void FilmOrbit::reach(double T) {
  reached_ = std::max(reached_, T);
  if (!held_) {
    const double last = std::min(T, rests_);
    turns_->reach(last);
    const auto state_at = [&](double at) { return with_centre(turns_->speeds_at(at), at_, at); };
    const auto rolling_at = [&](double at) { return state_at(at).centre - state_at(at).v; };
    // The rolling grows, then falls. At the time rests_ the centre is at rest, and the rolling is minus the slip.
    constexpr double first = 1e-9;
    if (at_[drive] > 0 && rolling_at(last) < -1e-13 * (at_[slip] + at_[rolling])) {
      const double from = at_[rolling] > 0 ? 0 : first * last;
      const double ends = rolling_at(from) > 0 ? reduction::root_between(rolling_at, from, last) : from;
      hold(ends, state_at(ends));
    }
  }
  if (held_) held_->reach(T - held_from_);
}

Speeds FilmOrbit::mirrored(const Speeds& speeds) const {
  const double of_v = at_[slip] < 0 ? -1 : 1, of_u = at_[spin] < 0 ? -1 : 1;
  const auto& [v, u, slid, turned, centre, way] = speeds;
  return {of_v * v, of_u * u, of_v * slid, of_u * turned, centre, way};
}

Speeds FilmOrbit::with_centre(Speeds speeds, const Numbers& at, double T) const {
  const double first = at[rolling] + (kind_ == Kind::ball ? 0 : at[slip]), rolls = std::min(T, rests_);
  speeds.centre = T < rests_ ? first - (at[slip] - speeds.v) / inertia_.chi - at[drive] * T : 0;
  speeds.way = first * rolls - (at[slip] * rolls - speeds.slid) / inertia_.chi - at[drive] * rolls * rolls / 2;
  return speeds;
}

Speeds FilmOrbit::speeds_at(double T) const {
  if (!is_held(T)) return with_centre(mirrored(turns_->speeds_at(T)), at_, T);
  const Speeds since = held_->speeds_at(T - held_from_);
  return mirrored(
      {since.v, since.u, then_.slid + since.slid, then_.turned + since.turned, since.v, then_.way + since.slid});
}

Speeds FilmOrbit::by_T(double T) const {
  const Speeds now = speeds_at(T);
  const double mu = std::exp(at_[ln_mu]), v = std::abs(now.v), w = mu * std::abs(now.u);
  const bool held = is_held(T);
  const double chi = held ? 1 : inertia_.chi, rho = held ? 0 : at_[drive];
  Speeds rate{};
  if (v > 0 || w > 0) {
    const auto [force, moment] = law_({v, w});
    rate = mirrored({.v = -chi * (force - rho), .u = -inertia_.gamma * mu * moment});
  }
  return {rate.v, rate.u, now.v, now.u, held || T < rests_ ? rate.v / chi - rho : 0, now.centre};
}

FilmOrbit::Number FilmOrbit::smaller_speed() const {
  return std::abs(at_[slip]) > std::exp(at_[ln_mu]) * std::abs(at_[spin]) ? spin : slip;
}

std::array<double, 2> FilmOrbit::steps(Number number) const {
  constexpr double small = 1e-4, least = 1e-3;  // relative step, least size; truncation and rounding each err by 1e-8
  const double mu = std::exp(at_[ln_mu]), v = std::abs(at_[slip]), w = mu * std::abs(at_[spin]);
  double size = number == drive ? std::max(at_[drive], least) : 1;
  if (number == slip) size = std::max(v, least * w);
  if (number == spin) size = std::max(w, least * v) / mu;
  if (number == rolling) size = std::max(at_[rolling], least * (v + w));
  const double step = small * size;
  // A number that must be >= 0 and is next to 0 takes both steps upwards.
  const bool bounded = number == drive || number == rolling || (number == slip && kind_ == Kind::resisted);
  if (bounded && at_[number] < step) return {step, 2 * step};
  if (number == drive && at_[drive] + step > OrbitCells::greatest_drive(law_, mu, inertia_)) return {-step, -2 * step};
  return {-step, step};
}

const FilmOrbit::Beside& FilmOrbit::beside(Number number) const {
  std::optional<Beside>& found = beside_[number];
  if (!found) {
    const auto [first, second] = steps(number);
    found.emplace(Beside{{},
                         -(first + second) / (first * second),
                         second / (first * (second - first)),
                         -first / (second * (second - first))});
    for (const double step : {first, second}) {
      Numbers changed = at_;
      changed[number] += step;
      found->orbits.emplace_back(law_, inertia_, kind_, changed, accuracy_);
    }
  }
  for (FilmOrbit& orbit : found->orbits) {
    if (orbit.reached_ < reached_) orbit.reach(reached_);
  }
  return *found;
}

Speeds FilmOrbit::by(Number number, double T) const {
  if (!depends_on(number)) return {};
  const bool at_rest = at_[slip] == 0 && at_[spin] == 0;
  if (at_rest || (number == rolling && !is_held(T))) {
    Numbers unit{};
    unit[number] = 1;
    const double begins = T == 0 ? 1 : 0;
    return with_centre({.v = unit[slip] * begins, .u = unit[spin] * begins}, unit, T);
  }
  if (number == larger_speed()) {
    const Speeds now = speeds_at(T);
    Speeds rest = Speeds{now.v, now.u, 2 * now.slid, 2 * now.turned, now.centre, 2 * now.way} + -T * by_T(T);
    for (const Number each : {smaller_speed(), rolling}) {
      if (at_[each] != 0) rest = rest + -at_[each] * by(each, T);
    }
    return 1 / at_[number] * rest;
  }
  const auto& [orbits, of_here, of_first, of_second] = beside(number);
  const Speeds sides = of_first * orbits[0].speeds_at(T) + of_second * orbits[1].speeds_at(T);
  return of_here == 0 ? sides : sides + of_here * speeds_at(T);
}

double FilmOrbit::stop() const { return held_ ? held_from_ + held_->stop() : turns_->stop(); }

double FilmOrbit::stop_by(Number number) const {
  const bool at_rest = at_[slip] == 0 && at_[spin] == 0;
  if (!depends_on(number) || at_rest || (number == rolling && !held_)) return 0;
  if (number == larger_speed()) {
    double rest = stop();
    for (const Number each : {smaller_speed(), rolling}) {
      if (at_[each] != 0) rest -= at_[each] * stop_by(each);
    }
    return rest / at_[number];
  }
  const auto& [orbits, of_here, of_first, of_second] = beside(number);
  return of_here * stop() + of_first * orbits[0].stop() + of_second * orbits[1].stop();
}

}  // namespace contensou::fit
