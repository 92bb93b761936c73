#include "verbs/stop_times.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include <fmt/format.h>

#include "contensou/reduction/stop_time.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::program {

using reduction::Flow;
using reduction::Route;
using reduction::State;

namespace {

/// Largest numbers of mu whose solutions are kept: curves for rows, tables of stop times for a grid. A curve or a table
/// takes about 300 kB. If each row has its own mu, no curve is used twice. A grid needs one mu after the other.
constexpr std::size_t max_curves = 256;
constexpr std::size_t max_tables = 16;

/// StopTimesOfMu costs as much time as 32 curves. Later one start takes 1 us, or 0.3 us by a Flow for its mu.
constexpr long mus_that_pay = 32;
constexpr std::size_t starts_that_pay = 300;

}  // namespace

void StopTimes::AtMu::row(std::span<const double> u0, double v0, std::span<double> taus) const {
  if (flow) return flow->stop_times(u0, std::vector<double>(u0.size(), v0), taus, 1, starts);
  std::ranges::transform(u0, taus.begin(), [&](double u) { return one({.u = u, .v = v0}); });
}

StopTimes::StopTimes(const reduction::Law& law, reduction::Inertia body, double drive, long starts, long mus)
    : law_(law),
      body_(body),
      drive_(drive),
      starts_(static_cast<std::size_t>(starts)),
      many_mus_(mus >= mus_that_pay && starts_ < starts_that_pay) {}

const reduction::StopTimesOfMu& StopTimes::of_every_mu() {
  const std::lock_guard lock(guard_);
  if (!of_every_mu_) of_every_mu_.emplace(law_, body_, drive_);
  return *of_every_mu_;
}

void StopTimes::resist(const si::Experiment& ball) {
  if (route_.given())
    route_.argument().reject(
        "with rolling friction a motion may be several orbits, which quadrature joins: leave it out");
  resisted_ = ball;
}

StopTimes::AtMu StopTimes::made(double mu) {
  if (resisted_) {
    const auto one = [ball = *resisted_, shots = si::Shots(*resisted_, law_)](State start) {
      if (start.u == 0 && start.v == 0) return 0.0;
      return shots.from(si::SlipAndSpin{start.v, start.u / ball.ball.radius}).stop_time() / si::seconds(ball, 1);
    };
    return {.flow = {}, .one = one, .starts = starts_};
  }
  const reduction::ReducedSystem system(law_, mu, body_, drive_);
  if (many_mus_)
    return {
        .flow = {}, .one = [mu, every = of_every_mu()](State start) { return every(mu, start); }, .starts = starts_};
  const Route route = route_.read(system);
  std::optional<Flow> flow = flow_of(system, route);
  if (!flow) {
    return {.flow = {},
            .one = [=](State start) { return reduction::stop_time(system, start, route).tau; },
            .starts = starts_};
  }
  if (flow->refused(starts_) > 0 && !told_.exchange(true)) tell_if_refused(*flow, starts_);
  return {.flow = std::move(flow), .one = {}, .starts = starts_};
}

std::shared_ptr<const StopTimes::AtMu> StopTimes::at(double mu) {
  std::shared_future<std::shared_ptr<const AtMu>> made_once;
  {
    const std::lock_guard lock(guard_);
    if (known_.size() == (starts_ > 0 ? max_tables : max_curves) && !known_.contains(mu)) known_.clear();
    auto& place = known_[mu];
    if (!place.valid()) {
      place = std::async(std::launch::deferred, [=, this] { return std::make_shared<const AtMu>(made(mu)); });
    }
    made_once = place;
  }
  return made_once.get();  // the first thread makes the stop times, and other threads wait for it
}

double StopTimes::operator()(double mu, State start, long row) {
  if (row >= mus_that_pay && !route_.given()) return of_every_mu()(mu, start);
  return (*at(mu))(start);
}

void tell_if_refused(const Flow& flow, std::size_t starts) {
  const double refused = flow.refused(starts);
  if (refused == 0) return;
  std::fputs(fmt::format("contensou: the table of stop times misses 4 eps in {:.2g} % of its panels (law {}, mu = {}): "
                         "starts there are computed one by one\n",
                         100 * refused, flow.system().law().name(), flow.system().mu())
                 .c_str(),
             stderr);
}

}  // namespace contensou::program
