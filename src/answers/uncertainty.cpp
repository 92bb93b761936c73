#include "answers/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <ranges>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/errors.hpp"
#include "answers/parse.hpp"
#include "contensou/reduction/stop_times_of_mu.hpp"
#include "contensou/si/description.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/scaling.hpp"
#include "text/nearest_name.hpp"

namespace contensou::answers {

namespace {

/// The quantities of a ball that a stop time goes with by powers, and that it is given by. Those of the start are in them.
std::vector<std::pair<const si::Quantity*, double>> numbers_of(const si::Experiment& experiment) {
  std::vector<std::pair<const si::Quantity*, double>> all;
  for (const auto& [quantity, values] : si::given_by(experiment)) {
    const bool other = quantity == &si::inertia_factor || quantity == &si::counter_radius || values.size() != 1;
    if (!other && quantity->section != si::slip.section) all.emplace_back(quantity, values[0]);
  }
  all.emplace_back(&si::slip, si::slip_at_start(experiment));
  all.emplace_back(&si::spin, si::spin_at_start(experiment));
  return all;
}

/// The powers with which a quantity acts, from the experiment with a little less of it: they are exact, since mu and the
/// unit of time are products of powers of what they are given by.
Uncertain powers_of(const si::Quantity& quantity, double value, const GivenStart& start) {
  Uncertain number{{std::string(quantity.name), value}};
  if (&quantity == &si::slip) number.of_v = 1;
  if (&quantity == &si::spin) number.of_u = 1;
  if (quantity.section == si::slip.section) return number;
  constexpr double less = 0.875;
  const si::Experiment& experiment = *start.experiment;
  si::Description described = si::describe(experiment);
  described.set(quantity, {value * less}, {"", number.name, ""});
  const si::Experiment changed = si::experiment_of(described);
  const auto power = [&](double now, double before) { return std::log(now / before) / std::log(less); };
  number.of_time = power(si::seconds(changed, 1), si::seconds(experiment, 1));
  number.of_u = power(changed.ball.radius, experiment.ball.radius);
  number.of_mu = power(si::patch_ratio(changed, start.system.law()), start.system.mu());
  return number;
}

std::string key(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace

double Normal::operator()() {
  if (has_second_) {
    has_second_ = false;
    return second_;
  }
  const double radius = std::sqrt(-2 * std::log(uniform())), angle = 2 * std::numbers::pi * uniform();
  second_ = radius * std::sin(angle);
  has_second_ = true;
  return radius * std::cos(angle);
}

const reduction::Flow& FlowsOfMu::at(long steps) {
  auto found = flows_.find(steps);
  if (found == flows_.end()) {
    const double mu = system_.mu() * std::exp(step_ * static_cast<double>(steps));
    const reduction::Flow made(reduction::ReducedSystem(system_.law(), mu, system_.inertia(), system_.drive()));
    found = flows_.emplace(steps, made).first;
  }
  return found->second;
}

void KnownTo::add_share(const std::string& name, double share) {
  shares.emplace_back(name, share);
  standard = std::hypot(standard, share);
}

void KnownTo::compare(double value, std::vector<double> samples) {
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double p = probabilities[i];
    const auto at = samples.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(samples.size() - 1));
    std::ranges::nth_element(samples, at);
    quantiles[i] = *at;
    constexpr std::array<double, 5> normal_quantiles{-1.959963984540054, -0.994457883209753, 0, 0.994457883209753,
                                                     1.959963984540054};
    if (std::abs(*at - (value + normal_quantiles[i] * standard)) > 0.1 * standard) holds = false;
  }
}

Json members_of(const KnownTo& known) {
  Json quantiles = Json::array(), shares = Json::object();
  for (std::size_t i = 0; i < known.quantiles.size(); ++i)
    quantiles.push_back({{"probability", KnownTo::probabilities[i]}, {"value", known.quantiles[i]}});
  for (const auto& [name, share] : known.shares) shares[name] = share;
  return {
      {"standard", known.standard}, {"quantiles", quantiles}, {"shares", shares}, {"first_order_holds", known.holds}};
}

std::vector<Spread> read_spreads(const std::string& typed, const std::vector<Spreadable>& known) {
  std::vector<std::string> names;
  for (const Spreadable& each : known) names.push_back(each.number.name);

  std::vector<Spread> numbers;
  for (const std::string& part : split(typed, ',')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
      throw BadInput(fmt::format("{}: NAME=SPREAD is needed, such as {}=1%", quotation(part), names.back()));
    const std::size_t first = std::min(part.find_first_not_of(' '), equals);
    const std::string name = key(part.substr(first, part.find_last_not_of(' ', equals - 1) + 1 - first));
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      throw BadInput(fmt::format("no such number {}{}; numbers of this start: {}", quotation(name),
                                 suggestion(name, names), fmt::join(names, ", ")));
    }
    if (std::ranges::find(numbers, name, &Spread::name) != numbers.end())
      throw BadInput(fmt::format("{} is given twice", name));
    auto [number, unit, corner] = known[static_cast<std::size_t>(found - names.begin())];
    if (number.value == 0 && !corner.empty())
      throw BadInput(fmt::format("{} is 0, where {} and no first order: leave it out", name, corner));
    std::string spread = part.substr(equals + 1);
    if (const std::size_t end = spread.find_last_not_of(' '); end != std::string::npos && spread[end] == '%') {
      if (number.value == 0) throw BadInput(fmt::format("{} is 0, of which there is no %: give a number", name));
      number.standard = parse_number(spread.substr(0, end)) / 100 * std::abs(number.value);
    } else if (const si::Dimension* dimension = si::find_dimension(unit); dimension && !is_number(spread)) {
      const auto value = si::parse_quantity(spread, *dimension);
      if (!value)
        throw BadInput(
            fmt::format("{}: {} is no number with %, {} behind it", name, quotation(spread), si::units_of(*dimension)));
      number.standard = *value;
    } else {
      number.standard = parse_number(spread);
    }
    if (!(number.standard >= 0))
      throw BadInput(fmt::format("{}: a spread must be >= 0, got {}", name, quotation(spread)));
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<Uncertain> read_uncertain(const std::string& typed, const GivenStart& start) {
  constexpr std::string_view corner = "the stop time has a corner";
  std::vector<Spreadable> known;
  if (start.experiment) {
    for (const auto& [quantity, value] : numbers_of(*start.experiment))
      known.push_back({{std::string(quantity->name), value}, quantity->unit, corner});
  } else {
    known = {{{"u0", start.state.u}, "", corner}, {{"v0", start.state.v}, "", corner}, {{"mu", start.system.mu()}, ""}};
  }
  std::vector<Uncertain> numbers;
  for (const Spread& number : read_spreads(typed, known)) {
    Uncertain by{number};
    if (start.experiment) {
      const auto* const quantity =
          *std::ranges::find_if(si::quantities(), [&](const auto* of) { return of->name == number.name; });
      by = powers_of(*quantity, number.value, start);
      by.standard = number.standard;
    } else {
      by.of_u = number.name == "u0" ? 1 : 0;
      by.of_v = number.name == "v0" ? 1 : 0;
      by.of_mu = number.name == "mu" ? 1 : 0;
    }
    numbers.push_back(by);
  }
  return numbers;
}

Uncertainty uncertainty_of(const GivenStart& start, const std::vector<Uncertain>& numbers, double stop,
                           const reduction::StopTimeGradient& gradient) {
  const reduction::ReducedSystem& system = start.system;
  const double by_u = start.state.u * gradient.by_u / gradient.tau, by_v = start.state.v * gradient.by_v / gradient.tau;
  const double by_mu = system.mu() * gradient.by_mu / gradient.tau;
  Uncertainty result;
  double ln_mu_standard = 0;
  for (const Uncertain& number : numbers) {
    const double power = number.of_time + number.of_u * by_u + number.of_v * by_v + number.of_mu * by_mu;
    result.add_share(number.name, stop * power * number.standard / number.value);
    ln_mu_standard = std::hypot(ln_mu_standard, number.of_mu * number.standard / number.value);
  }

  const bool one_mu = std::ranges::all_of(numbers, [](const Uncertain& number) { return number.of_mu == 0; });
  std::optional<reduction::StopTimesOfMu> stop_times;
  if (!one_mu) stop_times.emplace(system.law(), system.inertia());
  constexpr double few_refused = 0.05;
  const double max_mu = std::sqrt(reduction::StopTimesOfMu::max_r * system.inertia().chi / system.inertia().gamma);
  const bool fast = one_mu || (stop_times->refused() < few_refused && system.mu() < max_mu);
  const long wanted = fast ? 1'000'000 : 100'000;
  FlowsOfMu flows(system, ln_mu_standard / 8);
  const auto tau_of = [&](double mu, reduction::State state) {
    if (fast) return (*stop_times)(mu, state);
    return flows(mu, [&](const reduction::Flow& flow) { return flow.stop_time(state).tau; });
  };
  const double unit = stop / gradient.tau;
  const bool rolls = start.experiment && !start.experiment->ball.body.lies_flat();
  Normal normal;
  std::vector<double> u, v, samples;
  for (long i = 0; i < wanted; ++i) {
    double ln_time = 0, ln_u = 0, ln_v = 0, ln_mu = 0;
    bool possible = true;
    for (const Uncertain& number : numbers) {
      const double factor = 1 + number.standard / number.value * normal();
      const bool either_sign = number.name == si::spin.name || number.name == "u0";
      possible = possible && (factor > 0 || either_sign);
      const double ln = std::log(std::abs(factor));
      ln_time += number.of_time * ln, ln_u += number.of_u * ln, ln_v += number.of_v * ln, ln_mu += number.of_mu * ln;
    }
    const double mu = system.mu() * std::exp(ln_mu);
    if (!possible || (rolls && mu > 1)) continue;
    u.push_back(start.state.u * std::exp(ln_u));
    v.push_back(start.state.v * std::exp(ln_v));
    samples.push_back(unit * std::exp(ln_time) * (one_mu ? 1 : tau_of(mu, {u.back(), v.back()})));
  }
  if (one_mu) {
    std::vector<double> tau(u.size());
    reduction::Flow(system).stop_times(u, v, tau);
    std::ranges::transform(samples, tau, samples.begin(), std::multiplies());
  }
  result.samples = static_cast<long>(samples.size());
  result.outside = 1 - static_cast<double>(samples.size()) / static_cast<double>(wanted);
  if (samples.empty()) throw BadInput("no sample of these spreads is a start: make them smaller");
  result.compare(stop, std::move(samples));
  return result;
}

}  // namespace contensou::answers
