#include "verbs/stop_times.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace contensou::program {

namespace {

/// A curve by quadrature takes some 300 kB, and a table as much. In rows that each have a mu of their own nothing is
/// used twice, and of a grid one mu at a time.
constexpr std::size_t max_curves = 256;
constexpr std::size_t max_tables = 16;

/// A table takes about as long to make as so many calls of a closed form or a curve.
constexpr long starts_that_pay = 1 << 15;

}  // namespace

PatchStopTimes::PatchStopTimes(const reduction::ReducedSystem& system, const RouteOption& route)
    : system_(system), route_(route.read(system_)) {
  if (route_ == reduction::Route::quadrature) flow_ = reduction::Flow::by_quadrature(system_);
}

PatchStopTimes::PatchStopTimes(reduction::StopTimeTable table)
    : system_(table.system()), route_(reduction::routes(system_).front()), table_(std::move(table)) {}

double PatchStopTimes::operator()(reduction::State start) const {
  if (table_) return (*table_)(start.u, start.v);
  if (flow_) return flow_->stop_time(start).tau;
  return reduction::stop_time(system_, start, route_).tau;
}

void PatchStopTimes::row(std::span<const double> u0, double v0, std::span<double> taus) const {
  if (table_) return table_->evaluate_row(u0, v0, taus);
  std::ranges::transform(u0, taus.begin(), [&](double u) { return (*this)({.u = u, .v = v0}); });
}

StopTimes::StopTimes(reduction::Law law, reduction::Inertia body, long starts)
    : law_(std::move(law)), body_(body), by_table_(starts >= starts_that_pay) {}

StopTimes::Patch StopTimes::made(double mu) {
  const reduction::ReducedSystem system(law_, mu, body_);
  if (!by_table_) return std::make_shared<const PatchStopTimes>(system, route_);
  reduction::StopTimeTable table(system);
  if (!table.proved() && !told_.exchange(true)) tell_if_not_proved(table);
  return std::make_shared<const PatchStopTimes>(std::move(table));
}

std::shared_ptr<const PatchStopTimes> StopTimes::of_patch(double mu) {
  std::shared_future<Patch> patch;
  {
    const std::lock_guard lock(guard_);
    if (const auto known = patches_.find(mu); known != patches_.end()) {
      patch = known->second;
    } else {
      if (patches_.size() == (by_table_ ? max_tables : max_curves)) patches_.clear();
      patch = patches_.emplace(mu, std::async(std::launch::deferred, [this, mu] { return made(mu); })).first->second;
    }
  }
  return patch.get();  // the first thread makes it, and others wait
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
