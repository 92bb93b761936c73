#include "answers/verbs/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <ranges>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Eigenvalues>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"
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

/// A number of a start of which stop times go by powers. Radius, friction, a patch and all else act so: time, u, v and mu
/// go like the number to so much.
struct Powers {
  double of_time = 0, of_u = 0, of_v = 0, of_mu = 0;
};

/// The powers with which a quantity acts, from the experiment with a little less of it: they are exact, since mu and the
/// unit of time are products of powers of what they are given by.
Powers powers_of(const Spread& number, const GivenStart& start) {
  if (number.name == si::slip.name || number.name == "v0") return {.of_v = 1};
  if (number.name == si::spin.name || number.name == "u0") return {.of_u = 1};
  if (!start.experiment) return {.of_mu = 1};
  constexpr double less = 0.875;
  const si::Experiment& experiment = *start.experiment;
  si::Description described = si::describe(experiment);
  described.set(*si::find_component(number.name)->quantity, {number.value * less}, {"", number.name, ""});
  const si::Experiment changed = si::experiment_of(described);
  const auto power = [&](double now, double before) { return std::log(now / before) / std::log(less); };
  return {.of_time = power(si::seconds(changed, 1), si::seconds(experiment, 1)),
          .of_u = power(changed.ball.radius, experiment.ball.radius),
          .of_mu = power(si::patch_ratio(changed, start.system.law()), start.system.mu())};
}

/// What a ball is known to, by slip and spin where its start is given by velocities.
si::Spreads of_slip_and_spin(const si::Experiment& experiment) {
  const si::Spreads& own = experiment.spreads;
  const Eigen::Vector2d along = si::slip_velocity_at_start(experiment).stableNormalized();
  const double radius = experiment.ball.radius;
  std::vector<si::Component> named;
  for (const auto& [of, standard] : own.numbers) {
    if (of.quantity->section != si::slip.section) named.push_back(of);
  }
  named.insert(named.end(), {{&si::slip, 0}, {&si::spin, 0}});
  const auto last = static_cast<Eigen::Index>(named.size()) - 1;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(last + 1, static_cast<Eigen::Index>(own.numbers.size()));
  for (Eigen::Index i = 0; i < slopes.cols(); ++i) {
    const auto& [quantity, index] = own.numbers[static_cast<std::size_t>(i)].of;
    const auto found = std::ranges::find(named, si::Component{quantity, index});
    if (found != named.end()) {
      slopes(found - named.begin(), i) = 1;
    } else if (quantity == &si::velocity) {
      slopes(last - 1, i) = along[static_cast<Eigen::Index>(index)];
    } else {
      const double by[]{radius * along.y(), -radius * along.x(), 1};
      slopes(index == 2 ? last : last - 1, i) = by[index];
    }
  }
  return si::spreads_of(slopes * own.covariance() * slopes.transpose(), named);
}

std::string key(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Standard normal numbers, the same on every machine: Box and Muller, from Mersenne's twister.
class Normal {
 public:
  double operator()() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    const double radius = std::sqrt(-2 * std::log(uniform())), angle = 2 * std::numbers::pi * uniform();
    second_ = radius * std::sin(angle);
    has_second_ = true;
    return radius * std::cos(angle);
  }

 private:
  double uniform() { return (static_cast<double>(twister_() >> 11) + 0.5) * 0x1p-53; }

  std::mt19937_64 twister_{20260317};
  double second_ = 0;
  bool has_second_ = false;
};

}  // namespace

Sampled sample(const Spreads& spreads, long wanted, const std::function<bool(const Eigen::VectorXd& numbers)>& take) {
  const auto count = static_cast<Eigen::Index>(spreads.numbers.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(spreads.correlation);
  const Eigen::MatrixXd root = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
                               solver.eigenvectors().transpose();
  Eigen::VectorXd values(count), standard(count), drawn(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    values[i] = spreads.numbers[static_cast<std::size_t>(i)].value;
    standard[i] = spreads.numbers[static_cast<std::size_t>(i)].standard;
  }
  Normal normal;
  Sampled sampled;
  for (long i = 0; i < wanted; ++i) {
    for (double& each : drawn) each = normal();
    if (take(values + standard.cwiseProduct(root * drawn))) ++sampled.samples;
  }
  if (sampled.samples == 0) throw BadInput("no sample of these spreads is a start: make them smaller");
  sampled.outside = 1 - static_cast<double>(sampled.samples) / static_cast<double>(wanted);
  return sampled;
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

void KnownTo::set_shares(const Spreads& spreads, const Eigen::VectorXd& share) {
  for (Eigen::Index i = 0; i < share.size(); ++i)
    shares.emplace_back(spreads.numbers[static_cast<std::size_t>(i)].name, share[i]);
  standard = spreads.standard_of(share);
}

void KnownTo::compare(double value, std::vector<double> samples) {
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double p = probabilities[i];
    const auto at = samples.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(samples.size() - 1));
    std::ranges::nth_element(samples, at);
    quantiles[i] = *at;
    constexpr std::array<double, 5> normal_quantiles{-1.959963984540054, -0.994457883209753, 0, 0.994457883209753,
                                                     1.959963984540054};
    // What quantiles of so many normal numbers are off by, four times.
    const double density = std::exp(-normal_quantiles[i] * normal_quantiles[i] / 2) / std::sqrt(2 * std::numbers::pi);
    const double by_chance = 4 * std::sqrt(p * (1 - p) / static_cast<double>(samples.size())) / density;
    constexpr double rounding = 1e-12;
    const double allowed = std::max(0.1, by_chance) * standard + rounding * std::abs(value);
    if (std::abs(*at - (value + normal_quantiles[i] * standard)) > allowed) holds = false;
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

Spreads read_spreads(const std::string& typed, const std::vector<Spreadable>& known, const si::Spreads& own) {
  std::vector<std::string> names;
  for (const Spreadable& each : known) names.push_back(each.number.name);

  const auto require_smooth = [](const Spreadable& each) {
    if (each.number.value == 0 && !each.corner.empty())
      throw BadInput(fmt::format("{} is 0, where {} and no first order: leave it out", each.number.name, each.corner));
  };
  std::vector<Spread> named, numbers;
  bool with_own = false;
  for (const std::string& part : split(typed, ',')) {
    const std::size_t equals = part.find('=');
    const std::size_t first = std::min(part.find_first_not_of(' '), part.size());
    const std::size_t end = part.find_last_not_of(' ', equals == std::string::npos ? equals : equals - 1) + 1;
    const std::string name = key(part.substr(first, std::max(end, first) - first));
    if (equals == std::string::npos && name == "fit") {
      if (own.empty()) {
        throw BadInput(
            "fit: the ball has no [uncertainty]; a run file that 'contensou fit FILE -o ball.toml' writes has one, "
            "where the film determines its numbers");
      }
      with_own = true;
      continue;
    }
    if (equals == std::string::npos)
      throw BadInput(fmt::format("{}: NAME=SPREAD is needed, such as {}=1%, or fit", quotation(part), names.back()));
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      throw BadInput(fmt::format("no such number {}{}; numbers of this start: {}", quotation(name),
                                 suggestion(name, names), fmt::join(names, ", ")));
    }
    if (std::ranges::find(named, name, &Spread::name) != named.end())
      throw BadInput(fmt::format("{} is given twice", name));
    const Spreadable& of = known[static_cast<std::size_t>(found - names.begin())];
    require_smooth(of);
    Spread number = of.number;
    const std::string spread = part.substr(equals + 1);
    try {
      const auto read = is_number(spread) ? parse_number(spread) : si::parse_spread(spread, of.unit, number.value);
      if (!read) {
        const si::Dimension* const dimension = si::find_dimension(of.unit);
        throw BadInput(fmt::format("{}: {} is no number with %{}{} behind it", name, quotation(spread),
                                   dimension ? ", " : "", dimension ? si::units_of(*dimension) : ""));
      }
      number.standard = *read;
    } catch (const BadInput&) {
      throw;
    } catch (const std::domain_error& error) {
      throw BadInput(fmt::format("{} {}", name, error.what()));
    }
    if (!(number.standard >= 0))
      throw BadInput(fmt::format("{}: a spread must be >= 0, got {}", name, quotation(spread)));
    named.push_back(number);
  }
  const si::Spreads rest = own.of([&](const si::Component& of) {
    return with_own && std::ranges::find(named, of.name(), &Spread::name) == named.end();
  });
  for (const auto& [of, standard] : rest.numbers) {
    const auto found = std::ranges::find(names, of.name());
    if (found == names.end())
      throw BadInput(
          fmt::format("fit: {} is not among the numbers of this start: {}", of.name(), fmt::join(names, ", ")));
    const Spreadable& each = known[static_cast<std::size_t>(found - names.begin())];
    require_smooth(each);
    numbers.push_back({each.number.name, each.number.value, standard});
  }
  numbers.insert(numbers.end(), named.begin(), named.end());
  const auto count = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(count, count);
  correlation.topLeftCorner(rest.correlation.rows(), rest.correlation.cols()) = rest.correlation;
  return {numbers, correlation};
}

Spreads read_uncertain(const std::string& typed, const GivenStart& start) {
  constexpr std::string_view corner = "the stop time has a corner";
  if (!start.experiment) {
    const std::vector<Spreadable> known{
        {{"u0", start.state.u}, "", corner}, {{"v0", start.state.v}, "", corner}, {{"mu", start.system.mu()}, ""}};
    return read_spreads(typed, known, {});
  }
  std::vector<Spreadable> known;
  for (const auto& [quantity, value] : numbers_of(*start.experiment))
    known.push_back({{std::string(quantity->name), value}, quantity->unit, corner});
  return read_spreads(typed, known, of_slip_and_spin(*start.experiment));
}

Uncertainty uncertainty_of(const GivenStart& start, const Spreads& spreads, double stop,
                           const reduction::StopTimeGradient& gradient) {
  const reduction::ReducedSystem& system = start.system;
  const double by_u = start.state.u * gradient.by_u / gradient.tau, by_v = start.state.v * gradient.by_v / gradient.tau;
  const double by_mu = system.mu() * gradient.by_mu / gradient.tau;
  const auto count = static_cast<Eigen::Index>(spreads.numbers.size());
  std::vector<Powers> powers;
  Eigen::VectorXd shares(count), mu_shares(count);
  for (const Spread& number : spreads.numbers) {
    const auto& [of_time, of_u, of_v, of_mu] = powers.emplace_back(powers_of(number, start));
    const double relative = number.standard / number.value;
    const auto place = static_cast<Eigen::Index>(powers.size()) - 1;
    shares[place] = stop * (of_time + of_u * by_u + of_v * by_v + of_mu * by_mu) * relative;
    mu_shares[place] = of_mu * relative;
  }
  Uncertainty result;
  result.set_shares(spreads, shares);

  const bool one_mu = std::ranges::all_of(powers, [](const Powers& each) { return each.of_mu == 0; });
  std::optional<reduction::StopTimesOfMu> stop_times;
  if (!one_mu) stop_times.emplace(system.law(), system.inertia());
  constexpr double few_refused = 0.05;
  const double max_mu = std::sqrt(reduction::StopTimesOfMu::max_r * system.inertia().chi / system.inertia().gamma);
  const bool fast = one_mu || (stop_times->refused() < few_refused && system.mu() < max_mu);
  FlowsOfMu flows(system, spreads.standard_of(mu_shares) / 8);
  const auto tau_of = [&](double mu, reduction::State state) {
    if (fast) return (*stop_times)(mu, state);
    return flows(mu, [&](const reduction::Flow& flow) { return flow.stop_time(state).tau; });
  };
  const double unit = stop / gradient.tau;
  const bool rolls = start.experiment && !start.experiment->ball.body.lies_flat();
  std::vector<double> u, v, samples;
  static_cast<Sampled&>(result) = sample(spreads, fast ? 1'000'000 : 100'000, [&](const Eigen::VectorXd& numbers) {
    double ln_time = 0, ln_u = 0, ln_v = 0, ln_mu = 0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
      const auto& [name, value, standard] = spreads.numbers[i];
      const double factor = numbers[static_cast<Eigen::Index>(i)] / value;
      const bool either_sign = name == si::spin.name || name == "u0";
      if (!(factor > 0 || either_sign)) return false;
      const double ln = std::log(std::abs(factor));
      const auto& [of_time, of_u, of_v, of_mu] = powers[i];
      ln_time += of_time * ln, ln_u += of_u * ln, ln_v += of_v * ln, ln_mu += of_mu * ln;
    }
    const double mu = system.mu() * std::exp(ln_mu);
    if (rolls && mu > 1) return false;
    u.push_back(start.state.u * std::exp(ln_u));
    v.push_back(start.state.v * std::exp(ln_v));
    samples.push_back(unit * std::exp(ln_time) * (one_mu ? 1 : tau_of(mu, {u.back(), v.back()})));
    return true;
  });
  if (one_mu) {
    std::vector<double> tau(u.size());
    reduction::Flow(system).stop_times(u, v, tau);
    std::ranges::transform(samples, tau, samples.begin(), std::multiplies());
  }
  result.compare(stop, std::move(samples));
  return result;
}

}  // namespace contensou::answers
