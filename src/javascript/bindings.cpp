// The functions of the library that only the package for npm calls.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <fmt/format.h>

#include "contensou/reduction/detail/stop_times_of_mu.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/verification.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/wrench.hpp"
#include "page/javascript.hpp"
#include "text/nearest_name.hpp"

namespace contensou::page {

namespace {

using reduction::Flow;

std::vector<double> numbers(const val& array) { return emscripten::convertJSArrayToNumberVector<double>(array); }

/// Returns the flow of a system. The last one is kept.
const Flow& flow_of(const std::string& law, double mu, double chi, double gamma, double drive) {
  static std::string known;
  static std::optional<Flow> flow;
  const std::string key = fmt::format("{} {} {} {} {}", law, mu, chi, gamma, drive);
  if (key != known) flow = Flow(reduction::ReducedSystem(law_of(law), mu, {.chi = chi, .gamma = gamma}, drive));
  known = key;
  return *flow;
}

double stop_time(const std::string& law, double mu, double chi, double gamma, double drive, double u, double v) {
  return flow_of(law, mu, chi, gamma, drive).orbit({.u = u, .v = v}).stop_time();
}

/// Returns the stop times of the starts in two arrays of one length; NaN for a value that is no start.
val stop_times(const std::string& law, double mu, double chi, double gamma, double drive, const val& us,
               const val& vs) {
  const std::vector<double> u = numbers(us), v = numbers(vs);
  std::vector<double> taus(u.size());
  flow_of(law, mu, chi, gamma, drive).stop_times(u, v, taus);
  return column(taus);
}

/// Returns the stop times of starts with a mu each; also NaN where mu is NaN. As in Python, up to 31 values of mu are
/// solved one by one, and more of them share tables. The last tables are kept.
val stop_times_of_mu(const std::string& law, const val& mus, double chi, double gamma, double drive, const val& us,
                     const val& vs) {
  constexpr std::size_t many = 32;
  static std::string known;
  static std::optional<reduction::StopTimesOfMu> tables;
  const std::vector<double> mu = numbers(mus), u = numbers(us), v = numbers(vs);
  std::vector<double> taus(mu.size(), std::numeric_limits<double>::quiet_NaN());
  std::map<double, std::vector<std::size_t>> rows;
  for (std::size_t i = 0; i < mu.size(); ++i) {
    if (!std::isnan(mu[i]) && is_state(reduction::State{u[i], v[i]})) rows[mu[i]].push_back(i);
  }
  const std::string key = fmt::format("{} {} {} {}", law, chi, gamma, drive);
  const bool shares = rows.size() >= many;
  if (shares && key != known) {
    tables = reduction::StopTimesOfMu(law_of(law), {.chi = chi, .gamma = gamma}, drive);
    known = key;
  }
  for (const auto& [value, indices] : rows) {
    for (std::size_t i : indices) {
      const reduction::State start{u[i], v[i]};
      taus[i] = shares ? (*tables)(value, start) : stop_time(law, value, chi, gamma, drive, u[i], v[i]);
    }
  }
  return column(taus);
}

/// Returns the table of checks of one start.
val checks(const std::string& law, double mu, double chi, double gamma, double drive, double u, double v) {
  const auto row = [](const reduction::Check& check) {
    return object("name", check.name, "measured", check.measured, "allowed", check.allowed, "passed", check.passed());
  };
  return list(reduction::verify(flow_of(law, mu, chi, gamma, drive), reduction::State{u, v}), row);
}

/// Returns vx, vy, omega after a time step, then the mean Fx, Fy and moment of this step (PatchFriction::step).
val step(const std::string& law, double vx, double vy, double omega, double load, double friction, double radius,
         double by_force, double by_moment, double dt) {
  static std::map<std::string, std::unique_ptr<const si::PatchFriction>> known;
  auto& patch = known[law];
  if (!patch) patch = std::make_unique<si::PatchFriction>(law_of(law));
  kernel::Step<double> after;
  if (const char* fault = patch->step({vx, vy, omega}, {by_force, by_moment}, load, {friction, radius, 0}, dt, after)) {
    throw std::domain_error(fmt::format("step: {}", fault));
  }
  return column(std::array{after.vx, after.vy, after.w, after.fx, after.fy, after.m});
}

/// Returns the end of a message about an unknown name: the most similar name of the array, or nothing.
std::string suggestion_of(const std::string& typed, const val& names) {
  return suggestion(typed, emscripten::vecFromJSArray<std::string>(names));
}

/// Returns the reason why a body cannot have this mu; empty if the body can.
std::string complaint(const std::string& body, double mu) {
  return std::ranges::find(si::bodies(), body, &si::Body::name)->complaint(mu);
}

}  // namespace

}  // namespace contensou::page

EMSCRIPTEN_BINDINGS(contensou_npm) {
  using namespace contensou::page;
  emscripten::function("stopTime", answering<stop_time>);
  emscripten::function("stopTimes", answering<stop_times>);
  emscripten::function("stopTimesOfMu", answering<stop_times_of_mu>);
  emscripten::function("checks", answering<checks>);
  emscripten::function("step", answering<step>);
  emscripten::function("suggestion", &suggestion_of);
  emscripten::function("complaint", answering<complaint>);
}
