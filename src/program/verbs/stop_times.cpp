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

}  // namespace

void StopTimes::AtMu::row(std::span<const double> u0, double v0, std::span<double> taus) const {
  if (table) return table->evaluate_row(u0, v0, taus);
  std::ranges::transform(u0, taus.begin(), [&](double u) { return one({.u = u, .v = v0}); });
}

StopTimes::StopTimes(const reduction::Law& law, reduction::Inertia body, long starts)
    : law_(law), body_(body), by_table_(starts >= starts_that_pay) {}

StopTimes::AtMu StopTimes::made(double mu) {
  const reduction::ReducedSystem system(law_, mu, body_);
  if (by_table_) {
    reduction::StopTimeTable table(system);
    if (!table.proved() && !told_.exchange(true)) tell_if_not_proved(table);
    return {.table = std::move(table), .one = {}};
  }
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

double StopTimes::operator()(double mu, State start) {
  const bool by_function = law_.as<reduction::PadeLaw>() != nullptr && route_.value_or(Route::closed) == Route::closed;
  return by_function ? reduction::pade_stop_time(mu, start, body_) : at(mu)->one(start);
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
