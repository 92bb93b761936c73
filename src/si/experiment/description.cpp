#include "contensou/si/description.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "text/nearest_name.hpp"

namespace contensou::si {

namespace {

using Way = Ways::value_type;

/// Returns the names in one text. A section that all names have follows them once; else each name has its section.
std::string joined(const std::vector<Source>& sources) {
  const bool together =
      std::ranges::all_of(sources, [&](const Source& source) { return source.section == sources.front().section; });
  std::vector<std::string> names;
  for (const auto& [place, name, section] : sources) {
    names.push_back(together || section.empty() ? name : fmt::format("{} in {}", name, section));
  }
  const std::string& section = sources.front().section;
  return fmt::format("{}{}", fmt::join(names, " and "), together && !section.empty() ? " in " + section : "");
}

std::string ways_out(const Description& described, const Ways& ways) {
  std::vector<std::string> texts;
  for (const Way& way : ways) {
    std::vector<Source> sources;
    for (const Quantity* quantity : needed_of(way)) sources.push_back(described.home_of(*quantity));
    texts.push_back(joined(sources));
  }
  return fmt::format("give {}", fmt::join(texts, ", or "));
}

/// Returns the first given quantity of a way; null if none is given.
const Quantity* given_of(const Description& described, const Way& way) {
  const auto found = std::ranges::find_if(way, [&](const Quantity* quantity) { return described.find(*quantity); });
  return found == way.end() ? nullptr : *found;
}

bool has_all(const Description& described, const Way& way) {
  return std::ranges::all_of(needed_of(way), [&](const Quantity* quantity) { return described.find(*quantity); });
}

const std::vector<double>& numbers_of(const Description& described, const Quantity& quantity) {
  if (const Description::Values* given = described.find(quantity)) return given->numbers;
  described.source_of(quantity).fail(fmt::format("{} is missing: {}{}{}", joined({described.source_of(quantity)}),
                                                 quantity.meaning, quantity.unit.empty() ? "" : ", in ",
                                                 quantity.unit));
}

Body body_of(const Description& described) {
  const Body body = described.body().value_or(Body{});
  const Description::Values* given = described.find(inertia_factor);
  if (!given) return body;
  try {
    return body.with_factor(given->numbers[0]);
  } catch (const std::domain_error& error) {
    given->source.fail(error.what());
  }
}

PatchSource patch_of(const Description& described, const Body& body) {
  if (described.find(patch_radius)) return PatchRadius{numbers_of(described, patch_radius)[0]};
  if (described.find(spin_deceleration)) return SpinDeceleration{numbers_of(described, spin_deceleration)[0]};
  if (described.find(youngs_modulus) || described.find(poisson_ratio) || described.find(counter_radius)) {
    const std::vector<double>& moduli = numbers_of(described, youngs_modulus);
    const std::vector<double>& ratios = numbers_of(described, poisson_ratio);
    HertzModuli hertz{.youngs_modulus = {moduli[0], moduli[1]}, .poisson_ratio = {ratios[0], ratios[1]}};
    if (const Description::Values* given = described.find(counter_radius)) hertz.counter_radius = given->numbers[0];
    return hertz;
  }
  if (body.lies_flat()) return WholeFace{};
  described.source_of(patch_radius).fail("the patch is missing: " + ways_out(described, alternatives()[0]));
}

Start start_of(const Description& described) {
  if (!described.find(velocity) && !described.find(angular_velocity))
    return SlipAndSpin{.slip = numbers_of(described, slip)[0], .spin = numbers_of(described, spin)[0]};
  return Velocities{Eigen::Vector2d(numbers_of(described, velocity).data()),
                    Eigen::Vector3d(numbers_of(described, angular_velocity).data())};
}

}  // namespace

void Source::fail(const std::string& message) const {
  if (place.empty()) throw std::domain_error(message);
  throw RunFileError(fmt::format("{}: {}", place, message));
}

void Description::set(const Quantity& quantity, std::vector<double> numbers, Source source) {
  if (numbers.size() != quantity.count()) {
    source.fail(fmt::format("{} must be {} number{}: {}; got {}", joined({source}), quantity.count(),
                            quantity.count() == 1 ? "" : "s", quantity.meaning, numbers.size()));
  }
  try {
    for (double number : numbers) require(quantity, number);
  } catch (const std::domain_error& error) {
    source.fail(error.what());
  }
  values_[&quantity] = {std::move(numbers), std::move(source)};
}

void Description::set_body(const std::string& name, const Source& source) {
  std::vector<std::string> names;
  for (const Body& known : bodies()) {
    if (known.name == name) return set_body(known);
    names.emplace_back(known.name);
  }
  source.fail(no_such("body", name, names));
}

void Description::add_spread(const Component& of, double standard, const Source& source) {
  if (!(standard >= 0) || !std::isfinite(standard))
    source.fail(fmt::format("{}: a standard deviation is finite and >= 0, got {}", of.name(), standard));
  spreads_.add(of, standard);
}

void Description::require_given(const Component& of, const Source& source) const {
  if (find(*of.quantity)) return;
  source.fail(
      fmt::format("{} has a standard deviation and no value here: give its value, too, or leave it out", of.name()));
}

void Description::correlate(const Component& one, const Component& other, double correlation, const Source& source) {
  const auto i = spreads_.place(one), j = spreads_.place(other);
  if (!i || !j) {
    source.fail(fmt::format("{} has no standard deviation: give it one, or no correlation", (i ? other : one).name()));
  }
  if (*i == *j) source.fail(fmt::format("{} with itself is always 1: leave it out", one.name()));
  if (!(std::abs(correlation) <= 1))
    source.fail(fmt::format("a correlation is at least -1 and at most 1, got {}", correlation));
  double &of_row = spreads_.correlation(*i, *j), &of_column = spreads_.correlation(*j, *i);
  if (of_row != 0)
    source.fail(fmt::format("{} and {} are correlated twice: once is allowed", one.name(), other.name()));
  of_row = of_column = correlation;
}

const Description::Values* Description::find(const Quantity& quantity) const {
  const auto found = values_.find(&quantity);
  return found == values_.end() ? nullptr : &found->second;
}

void Description::start_along_x(const Values* other_radius) {
  const Values &centre = values_.at(&velocity), &body = values_.at(&angular_velocity);
  const Values* const own_radius = other_radius ? other_radius : find(radius);
  Experiment moving{.ball = {.name = "", .radius = own_radius ? own_radius->numbers[0] : 0},
                    .contact = {.friction = 0, .patch = WholeFace{}},
                    .start = Velocities{Eigen::Vector2d(centre.numbers.data()), Eigen::Vector3d(body.numbers.data())}};
  values_[&slip] = {{slip_at_start(moving)}, centre.source};
  values_[&spin] = {{spin_at_start(moving)}, body.source};
  values_.erase(&velocity);
  values_.erase(&angular_velocity);
}

Description Description::under(const Description& above) const {
  Description result = *this;
  if (above.find(velocity) || above.find(angular_velocity)) {
    const auto move = [&](const Quantity& from, const Quantity& to, auto numbers) {
      if (const Values* own = find(from)) result.values_[&to] = {numbers(own->numbers[0]), own->source};
      result.values_.erase(&from);
    };
    move(slip, velocity, [](double along_x) { return std::vector{along_x, 0.0}; });
    move(spin, angular_velocity, [](double upright) { return std::vector{0.0, 0.0, upright}; });
  }
  const bool slides_anew = above.find(slip) || above.find(spin);
  if (slides_anew && find(velocity) && find(angular_velocity)) result.start_along_x(above.find(radius));
  for (const Ways& ways : alternatives()) {
    for (const Way& way : ways) {
      if (!has_all(above, way)) continue;
      for (const Way& other : ways) {
        if (&other == &way) continue;
        for (const Quantity* quantity : other) result.values_.erase(quantity);
      }
    }
  }
  for (const auto& [quantity, values] : above.values_) result.values_[quantity] = values;
  result.spreads_ = spreads_.of([&](const Component& of) {
    const Values *own = find(*of.quantity), *now = result.find(*of.quantity);
    return own && now && own->numbers[of.index] == now->numbers[of.index];
  });
  if (!above.spreads_.empty()) result.spreads_ = above.spreads_;
  if (!above.name_.empty()) result.name_ = above.name_;
  if (!above.law_.empty()) result.law_ = above.law_;
  if (above.body_) result.body_ = above.body_;
  return result;
}

void Description::require_no_contradiction() const {
  for (const Ways& ways : alternatives()) {
    std::vector<Source> given;
    for (const Way& way : ways) {
      if (const Quantity* first = given_of(*this, way)) given.push_back(source_of(*first));
    }
    if (given.size() < 2) continue;
    const auto placed = std::ranges::find_if(given, [](const Source& source) { return !source.place.empty(); });
    (placed == given.end() ? given.front() : *placed)
        .fail(fmt::format("{} exclude each other: {}", joined(given), ways_out(*this, ways)));
  }
  if (spreads_.empty()) return;
  if (const double least = least_eigenvalue(spreads_.correlation); least < -eigenvalue_rounding) {
    const auto place = places_.find("uncertainty");
    Source{place == places_.end() ? "" : place->second, "", ""}.fail(fmt::format(
        "no numbers have these correlations: of their matrix an eigenvalue is {:.3g}, and none may be below 0; make "
        "them smaller",
        least));
  }
}

Source Description::source_of(const Quantity& quantity) const {
  if (const Values* given = find(quantity)) return given->source;
  return home_of(quantity);
}

Source Description::home_of(const Quantity& quantity) const {
  if (!in_file_) return {"", std::string(quantity.name), ""};
  const auto place = places_.find(quantity.section);
  return {place == places_.end() ? "" : place->second, fmt::format("'{}'", quantity.name),
          fmt::format("[{}]", quantity.section)};
}

bool Description::in_one_file() const {
  return in_file_ && std::ranges::none_of(values_, [](const auto& each) { return each.second.source.place.empty(); });
}

Description describe(const Experiment& experiment) {
  Description described;
  described.set_name(experiment.ball.name);
  described.set_body(experiment.ball.body);
  described.set_law(experiment.contact.law);
  for (const auto& [quantity, values] : given_by(experiment))
    described.set(*quantity, values, {"", std::string(quantity->name), ""});
  described.set_spreads(experiment.spreads);
  return described;
}

Experiment experiment_of(const Description& described) {
  described.require_no_contradiction();
  for (const auto& [of, standard] : described.spreads().numbers) described.require_given(of, {"", of.name(), ""});
  const Body body = body_of(described);
  Experiment experiment{
      .ball = {.name = described.name().empty() ? "ball" : described.name(), .radius = 0, .body = body},
      .contact = {.friction = 0, .patch = WholeFace{}, .law = described.law()},
      .start = SlipAndSpin{},
      .spreads = described.spreads()};
  for (const Quantity* quantity : quantities()) {
    if (quantity == &mass && !described.find(mass)) continue;
    if (double* const member = member_of(experiment, *quantity))
      *member =
          described.find(*quantity) || !quantity->standard ? numbers_of(described, *quantity)[0] : *quantity->standard;
  }
  experiment.contact.patch = patch_of(described, body);
  experiment.start = start_of(described);
  try {
    if (const Description::Values* newtons = described.find(load)) {
      experiment.environment.load = newtons->numbers[0];
      experiment.environment.gravity = newtons->numbers[0] / mass_for("a load", experiment.ball);
    } else if (const Description::Values* given = described.find(gravity)) {
      experiment.environment.gravity = given->numbers[0];
    }
    require_experiment(experiment);
  } catch (const std::domain_error& error) {  // the values exclude each other
    if (!described.in_one_file()) throw;
    described.home_of(friction).fail(error.what());
  }
  return experiment;
}

std::string law_of(const Description& described) {
  return described.law().empty() ? std::string(described.body().value_or(Body{}).law) : described.law();
}

}  // namespace contensou::si
