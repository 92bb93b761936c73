#include "answers/verbs/ball_answers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Eigenvalues>
#include <boost/math/special_functions/erf.hpp>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"
#include "contensou/reduction/detail/stop_times_of_mu.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/si/quantity.hpp"
#include "text/nearest_name.hpp"

namespace contensou::answers {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// A number of a start and its standard deviation.
struct Spread {
  std::string name;
  double value;
  double standard = 0;  ///< standard deviation of `value`, in the unit of `value`
};

/// A number for which a user may give a standard deviation.
struct Spreadable {
  Spread number;
  std::string_view unit;         ///< unit, as in si::Quantity
  std::string_view corner = {};  ///< words for a result without a derivative if the number is 0; empty: all have one
};

/// Numbers with their standard deviations and the correlations of their errors.
struct Spreads {
  std::vector<Spread> numbers;
  Eigen::MatrixXd correlation;  ///< 1 on the diagonal

  /// Returns the standard deviation of a sum; shares[i] is the standard deviation of summand i, with a sign.
  double standard_of(const Eigen::VectorXd& shares) const {
    const double largest = shares.size() > 0 ? shares.cwiseAbs().maxCoeff() : 0;
    if (!(largest > 0)) return 0;
    const Eigen::VectorXd unit = shares / largest;  // a square of the quotient does not overflow
    return largest * std::sqrt(std::max(0.0, unit.dot(correlation * unit)));
  }
};

std::string key(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Reads "slip=1%, spin=2 rad/s, ...", where % means per cent of the value. "fit" stands for the spreads of the ball.
/// A number that is named beside "fit" replaces the spread of the ball; its error is independent of all others.
/// @param known  numbers that a user may name; their names contain underscores
/// @param own    spreads of the ball
/// @throws BadInput  with the mistake and the allowed values; also for a number that is 0 and has a `corner`
Spreads read_spreads(const std::string& typed, const std::vector<Spreadable>& known, const si::Spreads& own) {
  std::vector<std::string> names;
  for (const Spreadable& each : known) names.push_back(each.number.name);

  const auto require_smooth = [](const Spreadable& each) {
    if (each.number.value == 0 && !each.corner.empty())
      throw BadInput("{1} no derivative at {0} = 0; leave {0} out", each.number.name, each.corner);
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
      throw BadInput("{}: NAME=SPREAD is needed, such as {}=1%, or fit", quotation(part), names.back());
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      throw BadInput("no such number {}{}; numbers of this start: {}", quotation(name), suggestion(name, names),
                     fmt::join(names, ", "));
    }
    if (std::ranges::find(named, name, &Spread::name) != named.end()) throw BadInput("{} is given twice", name);
    const Spreadable& of = known[static_cast<std::size_t>(found - names.begin())];
    require_smooth(of);
    Spread number = of.number;
    const std::string spread = part.substr(equals + 1);
    try {
      const auto read = is_number(spread) ? parse_number(spread) : si::parse_spread(spread, of.unit, number.value);
      if (!read) {
        const si::Dimension* const dimension = si::find_dimension(of.unit);
        throw BadInput("{}: {} is no number with %{}{} behind it", name, quotation(spread), dimension ? ", " : "",
                       dimension ? si::units_of(*dimension) : "");
      }
      number.standard = *read;
    } catch (const BadInput&) {
      throw;
    } catch (const std::domain_error& error) {
      throw BadInput("{} {}", name, error.what());
    }
    if (!(number.standard >= 0)) throw BadInput("{}: a spread must be >= 0, got {}", name, quotation(spread));
    named.push_back(number);
  }
  const si::Spreads rest = own.of([&](const si::Component& of) {
    return with_own && std::ranges::find(named, of.name(), &Spread::name) == named.end();
  });
  for (const auto& [of, standard] : rest.numbers) {
    const auto found = std::ranges::find(names, of.name());
    if (found == names.end())
      throw BadInput("fit: {} is not among the numbers of this start: {}", of.name(), fmt::join(names, ", "));
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

/// Numbers of events as functions of other numbers, which have spreads.
struct Varied {
  /// Indices of some entries of `numbers`.
  using Places = std::vector<std::size_t>;

  std::vector<Spreadable> numbers;       ///< all numbers that may have a spread
  std::vector<Uncertainty::Part> parts;  ///< numbers of events, still without their uncertainty
  long samples;
  /// Returns the derivatives of all parts by a number; empty if they do not exist.
  std::function<std::optional<VectorXd>(std::size_t place)> slopes;
  /// Returns the parts for other values of some numbers.
  /// @throws std::domain_error  if there is no start with these values
  std::function<VectorXd(const Places&, const VectorXd& values)> at;
};

/// Returns `count` independent standard normal numbers for a point of a lattice, which fills the space more evenly than
/// random points. The coordinates are the fractions of 1/2 + point/x^i, i = 1 ... count, with x^(count + 1) = x + 1.
/// Source: M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018.
VectorXd normal_numbers(Index count, long point) {
  // Boost computes tables of long double at the start of the program. Under valgrind this aborts the program.
  constexpr boost::math::policies::policy<boost::math::policies::promote_double<false>> plain;
  double x = 2;
  for (int i = 0; i < 30; ++i) x = std::pow(1 + x, 1 / static_cast<double>(count + 1));
  VectorXd numbers(count);
  double step = static_cast<double>(point);
  for (double& number : numbers) {
    step /= x;
    number = std::sqrt(2.0) * boost::math::erf_inv(2 * (0.5 + step - std::floor(0.5 + step)) - 1, plain);
  }
  return numbers;
}

/// Quantiles of a standard normal number at KnownTo::probabilities.
constexpr std::array<double, 5> normal_quantiles{-1.959963984540054, -0.994457883209753, 0, 0.994457883209753,
                                                 1.959963984540054};

/// Samples in increasing order. Between two neighbours the share of smaller samples is linear.
class SortedSamples {
 public:
  explicit SortedSamples(std::vector<double> samples) : sorted_(std::move(samples)) { std::ranges::sort(sorted_); }

  double share_below(double value) const {
    const auto above = std::ranges::upper_bound(sorted_, value);
    double place = static_cast<double>(above - sorted_.begin()) - 1;
    if (above != sorted_.begin() && above != sorted_.end()) place += (value - above[-1]) / (*above - above[-1]);
    return (place + 0.5) / static_cast<double>(sorted_.size());
  }

  double quantile(double share) const {
    const auto last = static_cast<double>(sorted_.size() - 1);
    const double place = std::clamp(share * (last + 1) - 0.5, 0.0, last), before = std::floor(place);
    const double *const lower = &sorted_[static_cast<std::size_t>(before)], *const upper = lower + (before < last);
    return *lower + (place - before) * (*upper - *lower);
  }

 private:
  std::vector<double> sorted_;
};

/// Sets the quantiles of a part from samples. They are taken at the shares of the first-order samples below the normal
/// quantiles, and not at `probabilities`. This removes most of the sampling error. If only one number varies, and the
/// part rises or falls with it, they are the values of the part at the normal quantiles of this number.
/// @param samples      samples of the part
/// @param first_order  deviations by the first-order model at all points, also at those without a sample
void set_quantiles(Uncertainty::Part& part, std::vector<double> samples, std::vector<double> first_order) {
  KnownTo& known = part.known;
  const SortedSamples sorted(std::move(samples)), model(std::move(first_order));
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < known.quantiles.size(); ++i) {
    const double off = normal_quantiles[i] * known.standard;
    double& quantile = known.quantiles[i];
    quantile = sorted.quantile(known.standard > 0 ? model.share_below(off) : KnownTo::probabilities[i]);
    if (std::abs(quantile - (part.value + off)) > 0.1 * known.standard + rounding * std::abs(part.value))
      known.holds = false;
  }
}

/// @throws BadInput  if a derivative does not exist, or if too few samples are possible starts
Uncertainty uncertainty_of(const Varied& varied, const Spreads& spreads, std::string_view corner) {
  Uncertainty result{varied.parts};
  const auto count = static_cast<Index>(spreads.numbers.size()), parts = static_cast<Index>(result.parts.size());
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(parts, count);
  VectorXd values(count), standards(count);
  Varied::Places places;
  for (Index i = 0; i < count; ++i) {
    const auto& [name, value, standard] = spreads.numbers[static_cast<std::size_t>(i)];
    const auto found = std::ranges::find(varied.numbers, name, [](const Spreadable& each) { return each.number.name; });
    const std::size_t place = places.emplace_back(found - varied.numbers.begin());
    values[i] = value;
    standards[i] = standard;
    if (standard == 0) continue;
    const auto slopes = varied.slopes(place);
    if (!slopes) throw BadInput("{2} no derivative at {0} = {1}; leave {0} out", name, value, corner);
    shares.col(i) = standard * *slopes;
  }
  for (Index j = 0; j < parts; ++j) {
    KnownTo& known = result.parts[static_cast<std::size_t>(j)].known;
    known.standard = spreads.standard_of(shares.row(j));
    for (Index i = 0; i < count; ++i)
      known.shares.emplace_back(spreads.numbers[static_cast<std::size_t>(i)].name, shares(j, i));
  }

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(spreads.correlation);
  const Eigen::MatrixXd root = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
                               solver.eigenvectors().transpose();
  std::vector<std::vector<double>> samples(result.parts.size()), first_order(result.parts.size());
  for (long i = 0; i < varied.samples; ++i) {
    const VectorXd errors = root * normal_numbers(count, i);
    const VectorXd to_first_order = shares * errors;
    for (std::size_t j = 0; j < first_order.size(); ++j)
      first_order[j].push_back(to_first_order[static_cast<Index>(j)]);
    try {
      const VectorXd there = varied.at(places, values + standards.cwiseProduct(errors));
      for (std::size_t j = 0; j < samples.size(); ++j) samples[j].push_back(there[static_cast<Index>(j)]);
      ++result.samples;
    } catch (const std::domain_error&) {
      // no start has these numbers: the sample counts as outside
    }
  }
  constexpr long fewest = 200;  // 5 samples below the quantile of 2.5 %
  if (result.samples < fewest) {
    throw BadInput("{} of {} samples are possible starts, {} are needed for quantiles; make the spreads smaller",
                   result.samples, varied.samples, fewest);
  }
  result.outside = 1 - static_cast<double>(result.samples) / static_cast<double>(varied.samples);
  for (std::size_t j = 0; j < samples.size(); ++j)
    set_quantiles(result.parts[j], std::move(samples[j]), std::move(first_order[j]));
  return result;
}

/// @param rolling_below  as for si::EventNumbers
/// @param before_each    called before each sample
Uncertainty event_uncertainty(
    const si::Experiment& experiment, const reduction::Law& law, std::optional<double> rolling_below,
    const std::string& typed, std::string_view corner, const std::function<void()>& before_each = [] {}) {
  std::optional<si::EventNumbers> made;
  try {
    made.emplace(experiment, law, rolling_below);
  } catch (const std::domain_error& error) {
    throw BadInput("{}: leave it out", error.what());
  }
  const si::EventNumbers& events = *made;
  const auto moved = [&](const Varied::Places& places, const VectorXd& values) {
    std::vector<si::Component> components;
    for (const std::size_t place : places) components.push_back(events.components()[place]);
    return events.with(components, values);
  };
  Varied varied{.numbers = {},
                .parts = {},
                .samples = 10'000,
                .slopes =
                    [&](std::size_t place) {
                      before_each();
                      return events.slopes(events.components()[place]);
                    },
                .at =
                    [&](const auto& places, const VectorXd& values) {
                      before_each();
                      return events.of(moved(places, values));
                    }};
  for (const si::Component& each : events.components()) {
    const bool vector = each.quantity->count() > 1, about_vertical = each.name() == "wz";
    varied.numbers.push_back({{each.name(), events.value(each)},
                              each.quantity->unit,
                              !vector || about_vertical ? corner : std::string_view()});
  }
  for (const si::EventNumber& number : events.names())
    varied.parts.push_back({number, events.values()[static_cast<Index>(varied.parts.size())]});
  const Spreads spreads = read_spreads(typed, varied.numbers, experiment.spreads);
  const auto changes_mu = [&](const Spread& number) {
    const auto found = std::ranges::find(events.components(), number.name, &si::Component::name);
    const Varied::Places place{static_cast<std::size_t>(found - events.components().begin())};
    try {
      const si::Experiment other = moved(place, VectorXd::Constant(1, number.value + number.standard));
      return si::patch_ratio(other, law) != si::patch_ratio(experiment, law);
    } catch (const std::domain_error&) {
      return true;
    }
  };
  // Stop times of many mu share solutions. All other samples with a drive or with a mu of their own are solved alone.
  if (events.resisted() || (rolling_below && std::ranges::any_of(spreads.numbers, changes_mu))) varied.samples = 1'000;
  return uncertainty_of(varied, spreads, corner);
}

/// Returns the spreads of a ball. Spreads of slip and spin stand in place of the spreads of its velocities.
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

}  // namespace

std::string label_of(const si::EventNumber& number) {
  std::string label = fmt::format("{}{}{}", number.event, number.of.empty() ? "" : " ", number.of);
  std::ranges::replace(label, '_', ' ');
  return label;
}

Json& place_of(const si::EventNumber& number, Json& members) {
  Json& event = members[std::string(number.event)];
  return number.of.empty() ? event : event[std::string(number.of)];
}

Uncertainty roll_uncertainty(const si::Experiment& experiment, const reduction::Law& law, double rolling_below,
                             const std::string& typed, const std::function<void()>& before_each) {
  Uncertainty result = event_uncertainty(experiment, law, rolling_below, typed, "the events have", before_each);
  if (si::spin_at_start(experiment) == 0)
    std::erase_if(result.parts,
                  [](const auto& part) { return part.number.event == "spin_ends" || part.number.event == "turns"; });
  return result;
}

Uncertainty stop_uncertainty(const GivenStart& start, const std::string& typed) {
  constexpr std::string_view corner = "the stop time has";
  const reduction::ReducedSystem& system = start.system;
  const reduction::State& state = start.state;
  if (const std::optional<si::Experiment>& given = start.experiment) {
    si::Experiment experiment = *given;
    experiment.spreads = of_slip_and_spin(experiment);
    experiment.start = si::SlipAndSpin{si::slip_at_start(*given), si::spin_at_start(*given)};
    return event_uncertainty(experiment, system.law(), {}, typed, corner);
  }
  if (start.at_rest()) throw BadInput("a body at rest has no stop time to vary; leave it out");
  const reduction::StopTimeGradient by = start.flow().stop_time_gradient(state);
  const reduction::StopTimesOfMu times(system.law(), system.inertia(), system.drive());
  const Varied varied{
      .numbers = {{{"u0", state.u}, "", corner}, {{"v0", state.v}, "", corner}, {{"mu", system.mu()}, ""}},
      .parts = {{{"t_stop", "", ""}, by.tau}},
      .samples = 10'000,
      .slopes = [&](std::size_t place) -> std::optional<VectorXd> {
        return VectorXd::Constant(1, std::array{by.by_u, by.by_v, by.by_mu}[place]);
      },
      .at = [&](const auto& places, const VectorXd& values) -> VectorXd {
        std::array numbers{state.u, state.v, system.mu()};
        for (std::size_t i = 0; i < places.size(); ++i) numbers[places[i]] = values[static_cast<Index>(i)];
        const auto [u, v, mu] = numbers;
        return VectorXd::Constant(1, times(mu, {u, v}));
      }};
  return uncertainty_of(varied, read_spreads(typed, varied.numbers, {}), corner);
}

Json members_of(const KnownTo& known) {
  Json quantiles = Json::array(), shares = Json::object();
  for (std::size_t i = 0; i < known.quantiles.size(); ++i)
    quantiles.push_back({{"probability", KnownTo::probabilities[i]}, {"value", known.quantiles[i]}});
  for (const auto& [name, share] : known.shares) shares[name] = share;
  return {
      {"standard", known.standard}, {"quantiles", quantiles}, {"shares", shares}, {"first_order_holds", known.holds}};
}

Json members_of(const Uncertainty& uncertainty) {
  Json members = Json::object();
  for (const auto& [number, value, known] : uncertainty.parts) place_of(number, members) = members_of(known);
  members.update({{"samples", uncertainty.samples}, {"outside", uncertainty.outside}});
  return members;
}

std::string remarks_on(const Uncertainty& uncertainty) {
  std::string text;
  if (!std::ranges::all_of(uncertainty.parts, [](const auto& part) { return part.known.holds; }))
    text = "the first order fails here: it differs from the samples by more than a tenth of itself; use the samples\n";
  if (uncertainty.outside > 0)
    text += fmt::format("{:.2g} % of the samples were left out: no ball has such numbers\n", 100 * uncertainty.outside);
  return text;
}

std::string text_of(const Uncertainty& uncertainty, const Digits& digits) {
  if (std::ranges::all_of(uncertainty.parts, [](const auto& part) { return part.known.standard == 0; }))
    return "known to: none of these numbers changes it\n" + remarks_on(uncertainty);
  const TextTable::Column column = TextTable::right(digits.width());
  TextTable table({TextTable::left(24), column, column, column, column});
  table.add({"", "value", "+-", "95 % from", "to"});
  for (const auto& [number, value, known] : uncertainty.parts) {
    if (known.standard == 0) continue;
    table.add({label_of(number), digits(value), digits(known.standard), digits(known.quantiles.front()),
               digits(known.quantiles.back()),
               fmt::format("{}{}{}", number.unit.empty() ? "" : "  ", number.unit, known.holds ? "" : "  *")});
  }
  const std::string remarks = remarks_on(uncertainty);
  return fmt::format("known to, one standard deviation to first order; 95 % of {} samples\n{}{}{}", uncertainty.samples,
                     table.text(), remarks.starts_with("the first") ? "* " : "", remarks);
}

}  // namespace contensou::answers
