// Random fields with kinks and jumps. Orbits of the program are compared with a reference: steps of order 8 in long
// double within one smooth part of the field, up to a zero of a switching function, and then in the next part.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <catch2/catch.hpp>

#include "answers/asked/planar_system.hpp"
#include "contensou/reduction/planar_reduction.hpp"

using namespace contensou;
using Eigen::Vector2d;

namespace {

using Real = long double;
using RealState = std::array<Real, 2>;
using Randoms = std::mt19937_64;

double drawn(Randoms& random, double from, double to) {
  const double all = from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
  return std::copysign(std::fmax(0.01, std::stod(fmt::format("{:.2f}", std::fabs(all)))), all);
}
std::size_t one_of(Randoms& random, std::size_t count) { return static_cast<std::size_t>(random() % count); }

/// A switching function: a u + b v - c, or u^2 + v^2 - c.
struct Gate {
  bool is_circle;
  double a, b, c;

  Real value(const RealState& x) const { return is_circle ? x[0] * x[0] + x[1] * x[1] - c : a * x[0] + b * x[1] - c; }
  RealState slopes(const RealState& x) const { return is_circle ? RealState{2 * x[0], 2 * x[1]} : RealState{a, b}; }
  std::string text() const {
    if (is_circle) return fmt::format("u^2 + v^2 - {}", c);
    return fmt::format("{}{}{} - ({})", a == 0 ? "" : fmt::format("({})*u", a), a == 0 || b == 0 ? "" : " + ",
                       b == 0 ? "" : fmt::format("({})*v", b), c);
  }
};

/// A smooth function of the state.
struct Smooth {
  std::string text;
  std::function<Real(const RealState& x)> value;
};
const std::vector<Smooth>& smooth_parts() {
  static const std::vector<Smooth> all{
      {"1", [](const RealState&) { return Real(1); }},
      {"u", [](const RealState& x) { return x[0]; }},
      {"v", [](const RealState& x) { return x[1]; }},
      {"u*v", [](const RealState& x) { return x[0] * x[1]; }},
      {"u^3", [](const RealState& x) { return x[0] * x[0] * x[0]; }},
      {"sin(u)", [](const RealState& x) { return std::sin(x[0]); }},
      {"cos(v)", [](const RealState& x) { return std::cos(x[1]); }},
      {"exp(-u^2)", [](const RealState& x) { return std::exp(-x[0] * x[0]); }},
  };
  return all;
}

/// A function with a break where a gate is 0. The side of the gate is -1 or 1.
struct Broken {
  std::string text;
  Real (*value)(Real gate, int side);
};
const std::array<Broken, 4> breaks{{
    {"sign({})", [](Real, int side) { return Real(side); }},
    {"|{}|", [](Real gate, int side) { return gate * side; }},
    {"max(0, {})", [](Real gate, int side) { return side > 0 ? gate : 0; }},
    {"(({0}) > 0 ? ({0})^2 + 0.3 : 0)", [](Real gate, int side) { return side > 0 ? gate * gate + Real(0.3L) : 0; }},
}};

struct Term {
  std::size_t equation;
  double factor;
  const Smooth* smooth;  ///< null for a term with a break
  const Broken* broken = nullptr;
  std::size_t gate = 0;
};

/// u' = v + ..., v' = -a u + ...: most orbits turn about the origin, and cross the gates.
struct KinkedField {
  std::vector<Gate> gates;
  std::vector<Term> terms;

  RealState rate(const RealState& x, const std::vector<int>& sides) const {
    RealState all{};
    for (const Term& term : terms) {
      all[term.equation] +=
          term.factor *
          (term.smooth ? term.smooth->value(x) : term.broken->value(gates[term.gate].value(x), sides[term.gate]));
    }
    return all;
  }
  std::string text() const {
    std::array<std::string, 2> sides;
    for (const Term& term : terms) {
      std::string& side = sides[term.equation];
      const std::string part =
          term.smooth ? term.smooth->text : fmt::format(fmt::runtime(term.broken->text), gates[term.gate].text());
      side += fmt::format("{}({})*{}", side.empty() ? "" : " + ", term.factor, part);
    }
    return fmt::format("u' = {}; v' = {}", sides[0], sides[1]);
  }
};

/// Draws a field of one of three families: a force (u' = v), a field u' = F(v), v' = G(u), and a field of any gates.
/// @param linear  true: linear on both sides of each gate
KinkedField draw_field(Randoms& random, bool linear = false) {
  const auto& smooth = smooth_parts();
  const std::size_t family = one_of(random, linear ? 2 : 3);
  KinkedField field;
  field.terms.push_back({0, 1, &smooth[2]});
  field.terms.push_back({1, -drawn(random, 0.5, 2), &smooth[1]});
  if (family == 0) field.terms.push_back({1, -drawn(random, 0, 0.5), &smooth[2]});
  if (family == 1 && !linear) field.terms.push_back({0, drawn(random, -0.3, 0.3), &smooth[6]});
  if (family == 2) field.terms.push_back({one_of(random, 2), drawn(random, -0.4, 0.4), &smooth[3 + one_of(random, 5)]});
  if (!linear && one_of(random, 2) == 0)
    field.terms.push_back({1, drawn(random, -0.6, 0.6), &smooth[std::array{0, 4, 5, 7}[one_of(random, 4)]]});
  const std::size_t count = 1 + one_of(random, 3);
  for (std::size_t i = 0; i < count; ++i) {
    const bool of_first = family == 1 && one_of(random, 2) == 0;
    Gate gate{family == 2 && one_of(random, 3) == 0, 0, 0, drawn(random, -0.5, 0.5)};
    if (gate.is_circle) gate.c = drawn(random, 0.3, 2);
    const bool of_v = family == 0 ? one_of(random, 2) == 0 : of_first;
    gate.a = family == 2 ? drawn(random, -1, 1) : of_v ? 0 : 1;
    gate.b = family == 2 ? drawn(random, -1, 1) : of_v ? 1 : 0;
    if (one_of(random, 3) == 0 && !gate.is_circle) gate.c = 0;
    field.gates.push_back(gate);
    const std::size_t equation = family == 2 ? one_of(random, 2) : of_first ? 0 : 1;
    field.terms.push_back(
        {equation, drawn(random, -1.5, 1.5), nullptr, &breaks[one_of(random, linear ? 3 : breaks.size())], i});
  }
  return field;
}

/// Integrates a field. An orbit that touches a gate or meets two gates at once is given up, and one that slides along a
/// gate unless slides are asked for.
class Reference {
 public:
  Reference(const KinkedField& field, const RealState& start, bool may_slide = false)
      : field_(field), x_(start), may_slide_(may_slide) {
    for (const Gate& gate : field.gates) {
      if (std::fabs(gate.value(x_)) < least_angle) lost_ = true;
      sides_.push_back(gate.value(x_) > 0 ? 1 : -1);
    }
  }

  int crossings() const { return crossings_; }
  int slides() const { return slides_; }
  Real largest() const { return largest_; }  ///< largest distance from the origin so far

  /// Returns the state at a time that is not before that of the last call; empty if the orbit is given up.
  std::optional<RealState> at(Real time) {
    // A sliding velocity is singular where both fields are equal along the normal; 1/64 loses 6e-10 beside such a
    // point.
    while (!lost_ && time_ < time) advance(std::min(slide_ ? longest / 8 : longest, time - time_));
    return lost_ ? std::nullopt : std::optional(x_);
  }

 private:
  static constexpr Real longest = 1.0L / 64, least_angle = 0.03L;

  RealState after(Real duration) const {
    boost::numeric::odeint::runge_kutta_fehlberg78<RealState, Real> stepper;
    RealState x = x_;
    stepper.do_step([&](const RealState& at, RealState& rate, Real) { rate = rate_at(at); }, x, Real(0), duration);
    return x;
  }

  RealState rate_on(const RealState& x, int side) const {
    std::vector<int> sides = sides_;
    sides[*slide_] = side;
    return field_.rate(x, sides);
  }

  /// Returns the rates of the gate of a slide along the fields of its two sides.
  std::array<Real, 2> rates_of_slide(const RealState& x) const {
    const RealState n = field_.gates[*slide_].slopes(x), f = rate_on(x, 1), g = rate_on(x, -1);
    return {n[0] * f[0] + n[1] * f[1], n[0] * g[0] + n[1] * g[1]};
  }

  RealState rate_at(const RealState& x) const {
    if (!slide_) return field_.rate(x, sides_);
    const auto [a, b] = rates_of_slide(x);
    const RealState f = rate_on(x, 1), g = rate_on(x, -1);
    return {(b * f[0] - a * g[0]) / (b - a), (b * f[1] - a * g[1]) / (b - a)};
  }

  bool slides_at(const RealState& x) const {
    const auto [a, b] = rates_of_slide(x);
    return a <= 0 && b >= 0;
  }

  /// Goes on along a gate, up to a tangent point.
  void slide(Real duration) {
    RealState next = after(duration);
    const bool leaves = !slides_at(next);
    if (leaves) {
      Real before = 0, behind = duration;
      for (int halvings = 0; halvings < 70; ++halvings) {
        const Real middle = (before + behind) / 2;
        (slides_at(after(middle)) ? before : behind) = middle;
      }
      duration = behind;
      next = after(duration);
    }
    move_to(next, duration);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const RealState slopes = field_.gates[i].slopes(x_);
      if (i != slide_ && std::fabs(field_.gates[i].value(x_)) < least_angle * std::hypot(slopes[0], slopes[1]))
        lost_ = true;
    }
    if (!leaves) return;
    // The motion is not unique if both sides turn away at once.
    const auto [a, b] = rates_of_slide(x_);
    const RealState slopes = field_.gates[*slide_].slopes(x_), rate = rate_on(x_, a > 0 ? -1 : 1);
    const Real other = std::fabs(a > 0 ? b : a) / std::hypot(slopes[0], slopes[1]) / std::hypot(rate[0], rate[1]);
    if (!(other > 0.1L)) lost_ = true;
    sides_[*slide_] = a > 0 ? 1 : -1;
    left_ = std::exchange(slide_, std::nullopt);
  }

  /// Returns the rate of a gate relative to the speed: the sine of the angle at which the orbit meets the gate.
  Real angle(std::size_t gate) const {
    const RealState slopes = field_.gates[gate].slopes(x_), rate = field_.rate(x_, sides_);
    return (slopes[0] * rate[0] + slopes[1] * rate[1]) / std::hypot(slopes[0], slopes[1]) /
           std::hypot(rate[0], rate[1]);
  }

  void move_to(const RealState& next, Real duration) {
    time_ += duration;
    x_ = next;
    const Real distance = std::hypot(x_[0], x_[1]);
    lost_ = lost_ || !(distance < 10);  // NaN, too
    largest_ = std::max(largest_, distance);
  }

  void advance(Real duration) {
    if (slide_) return slide(duration);
    RealState next = after(duration);
    std::optional<std::size_t> crossed;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const auto beyond = [&](const RealState& x) { return field_.gates[i].value(x) * sides_[i] < 0; };
      if (!beyond(next)) continue;
      Real before = 0, behind = duration;
      for (int halvings = 0; halvings < 70; ++halvings) {
        const Real middle = (before + behind) / 2;
        (beyond(after(middle)) ? behind : before) = middle;
      }
      crossed = i;
      duration = behind;
      next = after(duration);
    }
    move_to(next, duration);
    lost_ = lost_ || crossings_ > 200;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const RealState slopes = field_.gates[i].slopes(x_);
      const Real distance = std::fabs(field_.gates[i].value(x_)) / std::hypot(slopes[0], slopes[1]);
      if (i == left_ && (distance > least_angle || angle(i) * sides_[i] < 0)) left_.reset();
      if (i != crossed && i != left_ && distance < least_angle && (crossed || std::fabs(angle(i)) < 0.1L)) lost_ = true;
    }
    if (!crossed) return;
    const Real before = angle(*crossed);
    sides_[*crossed] *= -1;
    ++crossings_;
    const Real behind = angle(*crossed);
    lost_ = lost_ || std::fabs(before) < 0.1L || std::fabs(behind) < 0.1L;
    if (before * behind > 0) return;
    lost_ = lost_ || !may_slide_;
    slide_ = crossed;
    ++slides_;
  }

  const KinkedField& field_;
  RealState x_;
  std::vector<int> sides_;
  Real time_ = 0, largest_ = 0;
  int crossings_ = 0, slides_ = 0;
  bool may_slide_, lost_ = false;
  std::optional<std::size_t> slide_, left_;  ///< gate along which the orbit slides, and gate that it has just left
};

constexpr std::array<double, 8> times{0.1, 0.5, 1, 1.7, 2.4, 3.3, 4.4, 6};

/// States at the times with the sizes that they are compared with. Empty if the orbit is given up, crosses no gate (or
/// slides along none, if slides are asked for), or magnifies an error of the start more than 30 times.
std::optional<std::vector<std::pair<RealState, Real>>> reference_states(const KinkedField& field, const Vector2d& start,
                                                                        bool slides = false) {
  constexpr Real shift = 1e-7L, most = 30;
  Reference reference(field, {start[0], start[1]}, slides);
  Reference beside(field, {start[0] + shift, start[1]}, slides), above(field, {start[0], start[1] + shift}, slides);
  std::vector<std::pair<RealState, Real>> states;
  for (const double time : times) {
    const auto x = reference.at(time);
    if (!x) return std::nullopt;
    states.emplace_back(*x, reference.largest());
  }
  if (slides ? reference.slides() == 0 : reference.crossings() == 0) return std::nullopt;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const RealState& x = states[i].first;
    const auto y = beside.at(times[i]), z = above.at(times[i]);
    if (!y || !z) return std::nullopt;
    for (const RealState& other : {*y, *z}) {
      if (std::hypot(other[0] - x[0], other[1] - x[1]) > most * shift) return std::nullopt;
    }
  }
  return states;
}

/// Compares orbits of fields drawn at random with the reference.
struct Comparison {
  struct Failure {
    double error;
    std::string words;
  };
  std::vector<Failure> failures;
  int systems = 0, solved = 0;

  /// @return false if the orbit has no reference
  bool see(const KinkedField& drawn_field, const Vector2d& start, bool slides) {
    const auto states = reference_states(drawn_field, start, slides);
    if (!states) return false;
    ++systems;
    const answers::FormulaField field = answers::parse_planar_system(drawn_field.text(), {});
    const reduction::PlanarReduction plane = reduction::reduce(field, start, reduction::find_symmetries(field, start));
    solved += plane.solved();
    constexpr double tolerance = 1e-11;
    compare(plane, drawn_field.text(), start, *states, tolerance);
    if (slides && plane.solved())
      compare(reduction::by_steps(field), drawn_field.text(), start, *states, 10 * tolerance);
    return true;
  }

  std::string list() {
    std::ranges::sort(failures, std::greater(), &Failure::error);
    std::string list =
        fmt::format("{} of {} systems, of which {} are solved, fail. The worst:\n", failures.size(), systems, solved);
    for (std::size_t i = 0; i < std::min<std::size_t>(failures.size(), 20); ++i) list += failures[i].words + "\n";
    return list;
  }

 private:
  void compare(const reduction::PlanarReduction& plane, const std::string& text, const Vector2d& start,
               const std::vector<std::pair<RealState, Real>>& states, double tolerance) {
    Failure worst{0, ""};
    const reduction::PlanarOrbit orbit = plane.orbit(start);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto& [x, size] = states[i];
      const std::string about =
          fmt::format("{}  start ({}, {}), t = {}, form '{}'", text, start[0], start[1], times[i], plane.form());
      try {
        const Vector2d got = orbit.at(times[i]);
        const auto error = static_cast<double>(std::hypot(got[0] - x[0], got[1] - x[1]) / size);
        if (!(error <= worst.error)) worst = {error, fmt::format("{:.1e} off: {}", error, about)};
      } catch (const std::domain_error& refused) {
        worst = {contensou::infinity, fmt::format("refused: {}: {}", about, refused.what())};
        break;
      }
    }
    if (!(worst.error <= tolerance)) failures.push_back(worst);
  }
};

}  // namespace

TEST_CASE("orbits cross kinks and jumps without loss of digits", "[net]") {
  constexpr int wanted = CONTENSOU_FULL_TESTS ? 300 : 30;
  Randoms random(20261128);
  Comparison comparison;
  while (comparison.systems < wanted) {
    const KinkedField field = draw_field(random);
    comparison.see(field, Vector2d{drawn(random, -1.5, 1.5), drawn(random, -1.5, 1.5)}, false);
  }
  INFO(comparison.list());
  CHECK(comparison.failures.empty());
  CHECK(comparison.solved > wanted / 4);
  CHECK(comparison.solved < wanted);
}

TEST_CASE("orbits slide along jumps and leave them without loss of digits", "[net][sliding]") {
  constexpr int wanted = CONTENSOU_FULL_TESTS ? 300 : 30;
  Randoms random(60);
  Comparison comparison;
  while (comparison.systems < wanted) {
    const KinkedField field = draw_field(random, comparison.systems % 2 == 0);
    comparison.see(field, Vector2d{drawn(random, -1.5, 1.5), drawn(random, -1.5, 1.5)}, true);
  }
  INFO(comparison.list());
  CHECK(comparison.failures.empty());
  CHECK(comparison.solved > wanted / 4);
  CHECK(comparison.solved < wanted);
}
