#include "verbs/stop_times.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/pade_stop_time.hpp"

namespace contensou::program {

using reduction::Route;
using reduction::State;

namespace {

/// A curve by quadrature takes some 300 kB, and a table as much. In rows that each have a mu of their own nothing is
/// used twice, and of a grid one mu at a time.
constexpr std::size_t max_curves = 256;
constexpr std::size_t max_tables = 16;

/// A table takes about as long to make as so many calls of a closed form or a curve.
constexpr long starts_that_pay = 1 << 15;

/// And StopTimesOfMu as long as so many curves.
constexpr long mus_that_pay = 1000;

}  // namespace

void StopTimes::AtMu::row(std::span<const double> u0, double v0, std::span<double> taus) const {
  if (table) return table->evaluate_row(u0, v0, taus);
  std::ranges::transform(u0, taus.begin(), [&](double u) { return one({.u = u, .v = v0}); });
}

StopTimes::StopTimes(const reduction::Law& law, reduction::Inertia body, long starts, long mus)
    : law_(law),
      body_(body),
      by_table_(starts >= starts_that_pay),
      many_mus_(!by_table_ && mus >= mus_that_pay && !law.as<reduction::PadeLaw>()) {}

const reduction::StopTimesOfMu& StopTimes::of_every_mu() {
  std::call_once(of_every_mu_made_, [this] { of_every_mu_.emplace(law_, body_); });
  return *of_every_mu_;
}

StopTimes::AtMu StopTimes::made(double mu) {
  const reduction::ReducedSystem system(law_, mu, body_);
  if (by_table_) {
    reduction::StopTimeTable table(system);
    if (!table.proved() && !told_.exchange(true)) tell_if_not_proved(table);
    return {.table = std::move(table), .one = {}};
  }
  if (many_mus_) return {.table = {}, .one = [mu, every = of_every_mu()](State start) { return every(mu, start); }};
  const Route route = route_.read(system);
  if (route != Route::quadrature) {
    return {.table = {}, .one = [=](State start) { return reduction::stop_time(system, start, route).tau; }};
  }
  return {.table = {},
          .one = [flow = reduction::Flow::by_quadrature(system)](State start) { return flow.stop_time(start).tau; }};
}

std::shared_ptr<const StopTimes::AtMu> StopTimes::at(double mu) {
  std::shared_future<std::shared_ptr<const AtMu>> made_once;
  {
    const std::lock_guard lock(guard_);
    if (known_.size() == (by_table_ ? max_tables : max_curves) && !known_.contains(mu)) known_.clear();
    auto& place = known_[mu];
    if (!place.valid()) {
      place = std::async(std::launch::deferred, [=, this] { return std::make_shared<const AtMu>(made(mu)); });
    }
    made_once = place;
  }
  return made_once.get();  // the first thread makes it, and others wait
}

double StopTimes::operator()(double mu, State start, long row) {
  const bool is_pade = law_.as<reduction::PadeLaw>() != nullptr;
  if (is_pade && route_.value_or(Route::closed) == Route::closed) return reduction::pade_stop_time(mu, start, body_);
  if (row >= mus_that_pay && !route_.given()) return of_every_mu()(mu, start);
  return at(mu)->one(start);
}

void tell_if_not_proved(const reduction::StopTimeTable& table) {
  if (table.proved()) return;
  std::fputs(fmt::format("contensou: the table of stop times misses 4 eps in {:.2g} % of its panels (law {}, mu = {}): "
                         "starts there are computed one by one\n",
                         100 * table.refused(), table.system().law().name(), table.system().mu())
                 .c_str(),
             stderr);
}

}  // namespace contensou::program
