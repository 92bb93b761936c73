#include "answers/verbs/plane_answers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"

namespace contensou::answers {

using Eigen::Vector2d;
using reduction::PlanarEnd;
using reduction::PlanarOrbit;
using reduction::PlanarReduction;

namespace {

/// A state, and the method that computed it.
struct ComputedState {
  Vector2d x;
  bool by_quadrature;
};

/// Returns the last time, up to a given one, at which a condition holds that holds at 0. Times differ by powers of ten.
double last_time(const std::function<bool(double time)>& holds, double time) {
  return std::expm1(reduction::last_where([&](double s) { return holds(std::expm1(s)); }, 0, std::log1p(time), 100));
}

/// The half of an orbit after the start, or before the start with reversed time.
class HalfOrbit {
  static constexpr double finest = 1e-12, coarser = 1e-11;  ///< tolerances of the steps
  static constexpr std::size_t most_steps = 300'000;        ///< some 0.5 s

 public:
  /// @param moves  true for y' = F(x, y): x goes on also at a centre, where F has no value
  HalfOrbit(const PlanarReduction& plane, const Vector2d& start, bool moves)
      : plane_(plane),
        start_(start),
        moves_(moves),
        solved_(plane.solved()),
        orbit_(solved_ ? plane.orbit(start) : reduction::by_steps(plane.field(), finest, most_steps).orbit(start)),
        again_(reduction::by_steps(plane.field(), solved_ ? finest : coarser, most_steps).orbit(start)) {}

  /// Returns the state after a time; empty beyond the end.
  std::optional<ComputedState> at(double time) const {
    if (time == 0) return ComputedState{start_, solved_};
    // Within the error of the end time the state at infinity has no digits.
    constexpr double error = 1e-12;
    const bool ends = end() == PlanarEnd::infinity || (moves_ && end() == PlanarEnd::centre);
    if (ends && time >= (1 - error) * orbit_.end_time()) return std::nullopt;
    if (const auto x = followed(time)) return agrees(time) ? std::optional(ComputedState{*x, solved_}) : std::nullopt;
    // A quadrature that does not reach this time leaves it to the steps, unless the orbit ends earlier or divides.
    if (!solved_ || !goes_on(time) || !orbit_.unique() || !agrees(time)) return std::nullopt;
    const auto x = state(again_, time);
    return x ? std::optional(ComputedState{*x, false}) : std::nullopt;
  }

  /// Returns true unless the orbit is known to end before a time.
  bool goes_on(double time) const {
    constexpr double beyond = 1 + 1e-6;  // the last known time is that much before the end, or less
    return end() == PlanarEnd::undecided || beyond * time < orbit_.end_time();
  }

  /// Returns the reason why neither a quadrature nor steps reach a time.
  std::string why_not(double time) const {
    if (!orbit_.unique()) return orbit_.undecided();
    if (!agrees(time)) return "two computations of the orbit differ; rounding grows along it";
    try {
      (solved_ ? again_ : orbit_).at(time);
    } catch (const std::domain_error& stopped) {
      const std::string words = stopped.what();
      constexpr std::string_view before = ", where ";
      if (const auto at = words.rfind(before); at != std::string::npos) return words.substr(at + before.size());
    }
    return "neither a quadrature nor steps in time follow it farther";
  }

  PlanarEnd end() const { return orbit_.end(); }

  /// Returns the end of the instants if none is given: the time of rest, or a period.
  std::optional<double> whole() const {
    if (orbit_.period()) return orbit_.period();
    const bool rests = end() == PlanarEnd::centre || end() == PlanarEnd::rest;
    return rests && std::isfinite(orbit_.end_time()) ? std::optional(orbit_.end_time()) : std::nullopt;
  }

 private:
  static std::optional<Vector2d> state(const PlanarOrbit& orbit, double time) {
    try {
      const Vector2d x = orbit.at(time);
      if (x.allFinite()) return x;
    } catch (const std::domain_error&) {
      // The orbit ends earlier, or is not followed so far.
    }
    return std::nullopt;
  }

  /// An orbit that lasts for ever is followed over a part. The next part begins at its last state.
  std::optional<Vector2d> followed(double time) const {
    constexpr std::size_t most = 6;  // each takes up to half a second
    while (true) {
      const auto& [begin, orbit] = *std::prev(std::ranges::upper_bound(parts_, time, {}, &Part::begin));
      const auto x = state(orbit, time - begin);
      const bool lasts = end() == PlanarEnd::infinity && std::isinf(orbit_.end_time());
      if (x || !lasts || begin != parts_.back().begin || parts_.size() == most) return x;
      const double passed = last_time([part = orbit](double t) { return state(part, t).has_value(); }, time - begin);
      if (!(passed > 0)) return std::nullopt;
      parts_.push_back({begin + passed, plane_.orbit(*state(orbit, passed))});
    }
  }

  /// Returns false if steps in time, or where there is no quadrature larger steps, lead to another state before a time.
  /// Along unstable orbits, as y = x of y' = y^2 + 1 - x^2, rounding grows until another orbit is followed; later both
  /// may follow the same one.
  bool agrees(double time) const {
    constexpr double periods = 3, between = 16;
    const double until = orbit_.period() ? std::min(time, periods * *orbit_.period()) : time;
    while (agreed_ < until) {
      const double next = std::min(until, agreed_ + until / between);
      if (!agrees_at(next)) return false;
      agreed_ = next;
    }
    return true;
  }

  /// Returns true if both states are equal, or one state a little earlier or later.
  bool agrees_at(double time) const {
    auto here = followed(time);
    const auto there = state(again_, time);
    const bool by_quadrature = solved_ && here;
    if (solved_ && !here) {
      if (!larger_) larger_ = reduction::by_steps(plane_.field(), coarser, most_steps).orbit(start_);
      here = state(*larger_, time);
    }
    const double same = by_quadrature ? 1e-8 : 1e-6;
    if (!here || !there) return true;
    const double difference = (*here - *there).stableNorm();
    return difference <= same * std::max(start_.stableNorm(), here->stableNorm()) ||
           difference <= same * time * plane_.field()(*here).stableNorm();
  }

  struct Part {
    double begin;
    PlanarOrbit orbit;
  };
  PlanarReduction plane_;
  Vector2d start_;
  bool moves_;
  bool solved_;  ///< the orbit is that of a quadrature, else of steps
  PlanarOrbit orbit_;
  PlanarOrbit again_;                               ///< by steps: the second computation
  mutable std::optional<PlanarOrbit> larger_ = {};  ///< by larger steps, for times that the quadrature does not reach

  mutable std::vector<Part> parts_{{0, orbit_}};
  mutable double agreed_ = 0;  ///< time up to which the states agree
};

std::string words_of_end(const HalfOrbit& half, double last, double time) {
  if (half.goes_on(last)) return half.why_not(time);
  switch (half.end()) {
    case PlanarEnd::infinity:
      return "it goes to infinity";
    case PlanarEnd::border:
    case PlanarEnd::centre:
      return "it comes to a pole, a jump or an edge of the equations";
    default:
      return "it ends";
  }
}

std::string time_letter(const StartedSystem& system) {
  const auto& [equations, formulas, letters, independent] = system.formulas;
  return std::ranges::count(letters, independent) > 0 && !system.is_first_order() ? "time" : independent;
}

[[noreturn]] void refuse(const StartedSystem& system, const HalfOrbit& half, const std::string& option, double time,
                         double sense) {
  const double last = last_time([&](double t) { return half.at(t).has_value(); }, time);
  const Vector2d x = half.at(last)->x;
  const std::string letter = time_letter(system);
  const double there = (system.is_first_order() ? x[0] : sense * last) + 0.0;
  std::string place = fmt::format("{} = {:.9g}", letter, there);
  if (half.end() != PlanarEnd::infinity || half.goes_on(last)) {
    for (int i = system.is_first_order() ? 1 : 0; i < 2; ++i) {
      place += fmt::format(", {} = {:.9g}", system.formulas.variables[static_cast<std::size_t>(i)], x[i]);
    }
  }
  throw BadInput("{}: the orbit {} {}: {}; give {} {} {:.9g}", option,
                 half.goes_on(last) ? "is known up to"
                 : sense > 0        ? "ends at"
                                    : "begins at",
                 place, words_of_end(half, last, time), letter, sense > 0 ? "below" : "above", there);
}

}  // namespace

Answer orbit_system_answer(const StartedSystem& system, const SystemInstants& asked) {
  const Vector2d& start = system.start;
  const PlanarReduction plane = reduction::reduce(system.field, start);
  const HalfOrbit after(plane, start, system.is_first_order());
  std::optional<HalfOrbit> before;
  const double origin = system.is_first_order() ? start[0] : 0;
  Eigen::ArrayXd instants = asked.at;
  if (instants.size() == 0) {
    const auto whole = after.whole();
    if (!asked.until && !whole) {
      throw BadInput(
          "--until missing: this orbit neither returns nor comes to rest in a finite time; give --until or --at");
    }
    instants = Eigen::ArrayXd::LinSpaced(asked.samples, origin, asked.until ? *asked.until : origin + *whole);
  }

  std::vector<ComputedState> states;
  for (const double instant : instants) {
    const double time = instant - origin;
    if (time < 0 && !before) before.emplace(plane.reversed(), start, system.is_first_order());
    const HalfOrbit& half = time < 0 ? *before : after;
    const auto state = half.at(std::abs(time));
    if (!state) {
      refuse(system, half, asked.until ? fmt::format("--until {}", *asked.until) : fmt::format("--at {}", instant),
             std::abs(time), time < 0 ? -1 : 1);
    }
    states.push_back(*state);
  }

  // H is continued from the start along the orbit, in the order of time, on both sides of the start.
  std::vector<double> integral(states.size(), infinity);
  if (plane.solved()) {
    for (const int sense : {1, -1}) {
      std::vector<Eigen::Index> order;
      for (Eigen::Index i = 0; i < instants.size(); ++i) {
        if (sense > 0 ? instants[i] >= origin : instants[i] < origin) order.push_back(i);
      }
      std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return sense * instants[i]; });
      // States between the instants keep the path near the orbit.
      constexpr int between = 8;
      std::vector<Vector2d> path{start};
      double passed = 0;
      for (const Eigen::Index i : order) {
        const double time = sense * (instants[i] - origin);
        for (int part = 1; part < between; ++part) {
          const auto state = (sense > 0 ? after : *before).at(passed + (time - passed) * part / between);
          path.push_back(state ? state->x : path.back());
        }
        path.push_back(states[static_cast<std::size_t>(i)].x);
        passed = time;
      }
      const auto levels = plane.levels(path);
      for (std::size_t i = 0; i < order.size(); ++i) {
        integral[static_cast<std::size_t>(order[i])] = or_infinity(levels[(i + 1) * between].integral);
      }
    }
  }

  Answer answer{.members = {{"system", system.text},
                            {"variables", system.formulas.variables},
                            {"u0", start[0]},
                            {"v0", start[1]},
                            {"form", plane.solved() ? Json(plane.form()) : Json()}}};
  std::vector<std::string> names{system.formulas.variables[0], system.formulas.variables[1], "integral", "by"};
  if (!system.is_first_order()) names.insert(names.begin(), time_letter(system));
  for (const std::string& name : names) answer.members[name] = Json::array();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& [x, by_quadrature] = states[i];
    const double instant = instants[static_cast<Eigen::Index>(i)];
    Json row = Json::object();
    row[names.front()] = instant;
    if (!system.is_first_order()) row[system.formulas.variables[0]] = x[0];
    row[system.formulas.variables[1]] = x[1];
    row["integral"] = integral[i];
    row["by"] = by_quadrature ? "quadrature" : "steps";
    for (const auto& [name, value] : row.items()) answer.members[name].push_back(value);
    answer.rows.push_back(std::move(row));
  }
  answer.text = [rows = answer.rows, names](const Digits& digits) {
    std::vector<TextTable::Column> columns(names.size() - 1, TextTable::right(digits.width()));
    columns.push_back(TextTable::left());
    TextTable table(columns);
    std::vector<std::string> heading = names;
    heading.back() = "  by";
    table.add(heading);
    for (const Json& row : rows) {
      std::vector<std::string> cells;
      for (const auto& [name, value] : row.items()) {
        cells.push_back(value.is_string() ? "  " + value.get<std::string>() : digits(value.get<double>()));
      }
      table.add(std::move(cells));
    }
    return table.text();
  };
  return answer;
}

void add_state_at(Answer& answer, const StartedSystem& system, double until) {
  const Json row = orbit_system_answer(system, {Eigen::ArrayXd::Constant(1, until), until, 1}).rows.front();
  answer.members["until"] = row;
  answer.text = [=, before = answer.text, letters = system.formulas.variables,
                 first = system.is_first_order()](const Digits& digits) {
    const auto value = [&](const std::string& letter) {
      return fmt::format("{}({}) = {}", letter, digits(until), digits(row.at(letter).get<double>()));
    };
    return fmt::format("{}{:<13}{}{}, by {}\n", before(digits), "value", first ? "" : value(letters[0]) + ", ",
                       value(letters[1]), row.at("by").get<std::string>());
  };
}

std::vector<FieldText> orbit_system_fields() {
  return {
      {"JSON `system`, `variables` [...]", "", "equations as typed, and the letters of their two coordinates"},
      {"JSON `u0`, `v0`, `form`", "", "start; type of the solution as in reduce, or null if there is none"},
      {"`t`", "", "time since the start, negative before it; absent for y' = F(x, y)"},
      {"`x`, `y`", "", "state in the letters of the equations; for y' = F(x, y) the instants are values of x"},
      {"`integral`", "",
       "constant of the motion H, found by quadrature; inf where it has no value, as for states by steps"},
      {"`by`", "", "method of the state: quadrature, or steps in time"},
  };
}

}  // namespace contensou::answers
