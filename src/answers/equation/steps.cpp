#include "answers/equation/equation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::answers {

std::string Steps::separated(int digits) const {
  if (!coordinates) return "";
  const bool of_q = coordinates->dq_dp.has_value();
  const std::string where = equation->text_of(coordinates->within);
  return fmt::format("d{0}/d{1} = {2}{3}{4}", names[of_q ? 2 : 3], names[of_q ? 3 : 2],
                     text(of_q ? *coordinates->dq_dp : *coordinates->dp_dq, digits), where.empty() ? "" : ",  for ",
                     where);
}

std::string Steps::broken_at(const Eigen::Vector2d& x) const {
  constexpr double large = 300, small = 1e-3;
  const double here[]{x[0], x[1]};
  std::string reason;
  const auto look = [&](const Expression& part) -> std::optional<Expression> {
    if (part.parts().empty()) return part;
    const auto [base, exponent] = base_and_exponent(part);
    const bool is_below = exponent.is(Expression::Kind::number) && exponent.number().value() < 0;
    const bool is_root = exponent.is(Expression::Kind::number) && !exponent.number().is_whole();
    if (part.is(Expression::Kind::function) && part.name() == "tan" && std::abs(part(here)) > large) {
      reason = text(part) + " has a pole";
    } else if ((is_below || is_root || (part.is(Expression::Kind::function) && part.name() == "ln")) &&
               std::abs((part.is(Expression::Kind::function) ? part.parts()[0] : base)(here)) <
                   small * (1 + x.lpNorm<1>())) {
      reason = text(part.is(Expression::Kind::function) ? part.parts()[0] : base) + " = 0";
    }
    return std::nullopt;
  };
  if (equation) {
    for (const Expression& part : equation->f) part.replaced(look);
  }
  return reason;
}

std::vector<Expression> Steps::jumps() const {
  std::vector<Expression> places;
  if (!integral) return places;
  const auto add = [&](const Expression& place) {
    if (!place.is_constant() && std::ranges::count(places, place) == 0) places.push_back(place);
  };
  const auto look = [&](const Expression& part) -> std::optional<Expression> {
    if (is_function(part, "atan")) {
      const Expression below = fraction_of(part.parts()[0]).below;
      for (const Expression& each : factors_of(below)) {
        const auto [base, exponent] = base_and_exponent(each);
        if (exponent.is(Expression::Kind::number) && exponent.number().is_whole()) add(base);
      }
      part.parts()[0].replaced([&](const Expression& inner) -> std::optional<Expression> {
        if (is_function(inner, "tan")) add(Expression::function("cos", inner.parts()[0]));
        return std::nullopt;
      });
    }
    return std::nullopt;
  };
  integral->H.replaced(look);
  for (const Expression& z : signs_in(integral->H)) {
    if (std::ranges::any_of(jumps_at(integral->H, z), [&](const auto& x) { return holds_at(x); })) add(z);
  }
  return places;
}

double Steps::constant(const Eigen::Vector2d& start, const std::function<reduction::PlanarOrbit()>& orbit) const {
  constexpr double soon = 1e-6;
  const double here[]{start[0], start[1]};
  std::optional<Eigen::Vector2d> after;
  bool stays = false;
  const Expression H = integral->H.replaced([&](const Expression& part) -> std::optional<Expression> {
    if (!is_function(part, "sign") || part.parts()[0](here) != 0) return std::nullopt;
    if (!after) {
      try {
        const reduction::PlanarOrbit motion = orbit();
        after = motion.at(std::isfinite(motion.end_time()) ? std::min(soon, motion.end_time() / 2) : soon);
      } catch (const std::domain_error&) {
        after = start;  // the motion is not known
      }
    }
    const double side = part.parts()[0]({(*after)[0], (*after)[1]});
    stays |= side == 0 && !jumps_at(integral->H, part.parts()[0]).empty();
    return Expression(side > 0 ? 1 : -1);
  });
  return stays ? std::numeric_limits<double>::quiet_NaN() : H(here);
}

namespace {

using Eigen::Vector2d;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the constant solutions with |y| up to 1000, those nearest to the start if there are many.
///
/// Values cannot tell 0 from terms that rounding hides. A zero y of F is therefore a solution only if F does not
/// contain x, if a factor of F without x vanishes, or if F becomes 0 when a fraction is put for y. A factor can be the
/// power of a base, as in sqrt(2 - y^2): next to the zero of the base, rounding leaves no zero of F.
/// @param slope  F as a formula
Constants constant_solutions(const Expression& slope, const Vector2d& start, bool autonomous) {
  const auto at = [&](const Expression& e, double y) { return e({start[0] + 0.2371, y}); };
  std::vector<Expression> bases;  // without x
  const Expression above = fraction_of(slope).above;
  for (const Expression& factor : factors_of(above)) {
    const Expression base = base_and_exponent(factor).first;
    if (!base.has(0) && base.has(1)) bases.push_back(base);
  }
  // On one side F may have no value, as y^(2/3).
  const auto size = [&](const Expression& e, double y) {
    const double value = std::abs(at(e, y));
    return std::isfinite(value) ? value : infinity;
  };
  const auto beside = [&](const Expression& e, double y, double step) {
    step *= 1 + std::abs(y);
    return std::min(size(e, y - step), size(e, y + step));
  };
  constexpr double step = 1e-3;
  const auto vanishes = [&](const Expression& e, double y) {
    constexpr double zero = 1e-9;
    const double least = beside(e, y, step);
    return size(e, y) <= zero * least && least > 0 && std::isfinite(least);
  };
  const auto is_zero_of_base = [&](double y) {
    constexpr double smaller = 0.6;  // a thousandth of the distance, with an exponent of 1/12 or more
    const double last = beside(slope, y, step * step * step), middle = beside(slope, y, step * step);
    return std::ranges::any_of(bases, [&](const Expression& e) { return vanishes(e, y); }) && last < smaller * middle &&
           middle < smaller * beside(slope, y, step);
  };
  const auto stays = [&](double y) {
    return (vanishes(slope, y) && (autonomous || slope.with(1, snapped(y)).is_zero())) || is_zero_of_base(y);
  };
  // The equilibria of (x', y') = (x, F(x0, y)) have the places and the stability of the zeros at one x.
  const auto zeros = [&](const Expression& e, double reach) {
    const reduction::SmoothField across([&](const Vector2d& x) { return Vector2d(x[0], at(e, x[1])); });
    return find_equilibria(across, Vector2d(-1, -reach), Vector2d(1, reach)).points;
  };
  const auto of_kind = [](std::string_view kind) -> std::string_view {
    return kind == "saddle"          ? "stable"
           : kind == "unstable node" ? "unstable"
           : kind == "saddle-node"   ? "stable on one side"
                                     : "";
  };
  const auto of_sides = [&](double y) -> std::string_view {
    const double near = step * (1 + std::abs(y)), before = at(slope, y - near), after = at(slope, y + near);
    return before > 0 && after < 0   ? "stable"
           : before < 0 && after > 0 ? "unstable"
           : before * after > 0      ? "stable on one side"
                                     : "";
  };
  constexpr std::size_t many = 6, most = 7;
  Constants found;
  auto& all = found.all;
  for (double last = -1; const double reach : {2., 16., 128., 1024.}) {
    if (all.size() > many) break;
    std::vector<ConstantSolution> places;
    for (const auto& each : zeros(slope, reach)) places.push_back({each.x[1], of_kind(each.kind)});
    for (const Expression& base : bases) {
      for (const auto& each : zeros(base, reach)) places.push_back({each.x[1], of_sides(each.x[1])});
    }
    for (const ConstantSolution& each : places) {
      const double y = each.y;
      constexpr double same = 1e-6;
      const bool known = std::ranges::any_of(
          all, [&](const auto& other) { return std::abs(other.y - y) <= same * (1 + std::abs(y)); });
      if (std::abs(y) > last && !known && stays(y)) all.push_back({y, autonomous ? each.stability : ""});
    }
    last = reach;
  }
  const auto distance = [&](const ConstantSolution& each) { return std::abs(each.y - start[1]); };
  std::ranges::sort(all, {}, distance);
  found.complete = all.size() <= many;
  all.resize(std::min(all.size(), most), {});
  std::ranges::sort(all, {}, &ConstantSolution::y);
  return found;
}

/// Returns the solutions on which the separated equation dq/dp = G(q) has G = 0 and which no C gives, as formulas in x:
/// y = k pi x for y' = y/x + tan(y/x), where q = y/x and G = tan(q). The formulas are put into the equation.
Curves lost_solutions(const Equation& equation, const Coordinates& c, const std::optional<IntegralFormula>& integral,
                      const Vector2d& start) {
  constexpr double zero = 1e-9;
  const Expression y = Expression::variable(1), slope = c.q.derivative(1);
  Curves found;
  if (!c.dq_dp || c.q == y || slope.has(1) || slope.is_zero()) return found;
  const auto solves = [&](const Expression& curve) {
    const Expression by_x = curve.derivative(0);
    const auto at = equation.points({curve, by_x, equation.slope.with(1, curve)}, c.within);
    return !at.empty() && std::ranges::all_of(at, [&](const Vector2d& point) {
      const double x = point[0], here = curve({x, 0}), rate = by_x({x, 0}), expected = equation.slope({x, here});
      // On the border of the domain, as y = x of sqrt(x^2 - y^2), rounding has a root.
      constexpr double root = 1e-6;
      return std::abs(rate - expected) <= root * (std::abs(rate) + std::abs(expected) + std::abs(here / x));
    });
  };
  // On a solution with a C, H has this value at all x. On a lost one ln 0 or 1/0 is infinite, which rounding can hide.
  const auto has_C = [&](const Expression& curve) {
    const auto C = [&](double x, double off) {
      return integral->H({x, curve({x, 0}) + off * (1 + std::abs(curve({x, 0})))});
    };
    constexpr double step = 1e-3;
    const double unit = 1 + std::abs(start[0]);
    return std::ranges::any_of(std::array{unit, -unit}, [&](double way) {
      const double x0 = start[0] + 0.2371 * way, x1 = start[0] + 0.2839 * way;
      const double last = std::abs(C(x0, step * step * step) - C(x0, step * step));
      return last < std::abs(C(x0, step * step) - C(x0, step)) / 2 &&
             std::abs(C(x0, 0) - C(x1, 0)) <= zero * (1 + std::abs(C(x0, 0)));
    });
  };
  const Constants values = constant_solutions(c.dq_dp->with(2, y), {0, c.q({start[0], start[1]})}, true);
  found.complete = values.complete;
  for (const ConstantSolution& each : values.all) {
    const Expression curve = tidied((exact(each.y) - c.q.with(1, 0)) / slope);
    if (!curve.has(0)) continue;
    if (integral && has_C(curve)) continue;
    if (solves(curve)) found.all.push_back(curve);
  }
  return found;
}

/// A divisor in a formula, and its sign at a start.
struct Divisor {
  Expression value;
  bool positive;

  bool keeps_sign(double x, double y) const { return (value({x, y}) > 0) == positive; }
};

/// Returns the divisors in a formula, and cos(z) for tan(z).
std::vector<Divisor> divisors_in(const Expression& e, const Vector2d& start) {
  std::vector<Divisor> found;
  e.replaced([&](const Expression& part) -> std::optional<Expression> {
    const auto [base, exponent] = base_and_exponent(part);
    const bool is_tan = is_function(part, "tan");
    if (!is_tan && !(exponent.is(Expression::Kind::number) && exponent.number().value() < 0)) return std::nullopt;
    const Expression divisor = is_tan ? Expression::function("cos", part.parts()[0]) : base;
    const double at = divisor({start[0], start[1]});
    if (at != 0) found.push_back({divisor, at > 0});
    return std::nullopt;
  });
  return found;
}

/// Returns how far a condition holds from 0 on; empty if it holds at all samples.
std::optional<double> extent_of(double reach, const std::function<bool(double passed)>& holds) {
  constexpr int samples = 20, halvings = 50;
  for (int i = 1; i <= samples; ++i) {
    double on = reach * (i - 1) / samples, off = reach * i / samples;
    if (holds(off)) continue;
    for (int k = 0; k < halvings; ++k) (holds((on + off) / 2) ? on : off) = (on + off) / 2;
    return on;
  }
  return std::nullopt;
}

}  // namespace

Extent Steps::extent(const Vector2d& start, double end) const {
  const Expression &F = equation->slope, slope = branch->derivative(0);
  const std::vector<Divisor> of_F = divisors_in(F, start), of_branch = divisors_in(*branch, start);
  const auto y_at = [&](double passed) { return (*branch)({start[0] + passed, 0}); };
  const auto keeps_sign = [&](const Divisor& divisor, double passed) {
    return divisor.keeps_sign(start[0] + passed, y_at(passed));
  };
  const auto is_solution = [&](double passed) {
    constexpr double error = 1e-8;
    const double x = start[0] + passed, y = y_at(passed), expected = F({x, y}), found = slope({x, 0});
    return std::ranges::all_of(of_F, [&](const Divisor& each) { return keeps_sign(each, passed); }) && !std::isnan(y) &&
           !std::isnan(expected) && !(std::abs(found - expected) > error * (1 + std::abs(expected)));
  };
  const auto last = [&](double reach) {
    std::optional<double> nearest = extent_of(reach, is_solution);
    // Farther out, formulas overflow: there an equation that jumps is seen, and a missing value says nothing.
    constexpr double farther_out = 10;
    if (!nearest && !std::isfinite(end)) {
      nearest = extent_of(farther_out * reach, [&](double passed) {
        const double y = y_at(passed);
        return std::isnan(y) || std::isnan(F({start[0] + passed, y})) || is_solution(passed);
      });
    }
    for (const Divisor& divisor : of_branch) {
      const auto pole = extent_of(reach, [&](double passed) { return keeps_sign(divisor, passed); });
      // The branch grows towards a pole, and not towards a zero that its numerator shares.
      constexpr double near = 1e-4, farther = 1e-3, grows = 1.5;
      const bool is_pole =
          pole && std::abs(y_at(*pole - near * reach)) > grows * std::abs(y_at(*pole - farther * reach));
      if (is_pole && !(nearest && std::abs(*nearest) < std::abs(*pole))) nearest = pole;
    }
    if (!nearest) return std::copysign(infinity, reach);
    constexpr double at_start = 1e-4, rounding = 1e-7;
    const double x = std::abs(*nearest) <= at_start * std::abs(reach) ? start[0] : start[0] + *nearest;
    return std::abs(x) <= rounding * (1 + std::abs(start[0])) ? 0 : x;
  };
  constexpr double beyond = 1.0131, usual = 5.0731;  // no sample is a round number
  return {last(-usual), last(std::isfinite(end) ? beyond * (end - start[0]) : usual)};
}

Steps steps_of(const FormulaField& system, const reduction::PlanarSymmetries& found, const std::string& factor,
               bool cleared, const std::optional<Eigen::Vector2d>& start, const Eigen::Vector2d& around) {
  Steps steps{system.variables};
  const auto is_taken = [&](const std::string& name) { return std::ranges::count(system.variables, name) > 0; };
  const bool taken = is_taken("q") || is_taken("p");
  steps.names.insert(steps.names.end(), {taken ? "Q" : "q", taken ? "P" : "p"});
  const auto& equation = steps.equation = equation_of(system, around);
  if (!equation) return steps;
  const auto attempt = [](const std::function<void()>& part) {
    try {
      part();
    } catch (const std::exception&) {
      // A formula became too long, and its part stays empty.
    }
  };
  attempt([&] {
    if (factor.empty()) return;
    FormulaShape shape{{}, {"u", "v", "u'", "v'"}, "V"};
    shape.read_name = read_name_of_equation;
    const Formulas typed(shape, factor, {});
    const auto both = typed.expressions();
    if (!both) return;
    Expression D = 1;
    if (const auto divisors = cleared ? system.formulas.denominator() : std::nullopt) {
      const auto below = divisors->expressions();
      if (!below) return;
      D = (*below)[0];
    }
    steps.factor = tidied((*both)[0].with(2, D * equation->f[0]).with(3, D * equation->f[1]) / D);
  });
  attempt([&] { steps.kinds = kinds_of(*equation); });
  attempt([&] {
    if (system.equations != FormulaField::Equations::first) return;
    const bool autonomous = std::ranges::count(steps.kinds, "autonomous") > 0;
    steps.constants = constant_solutions(equation->f[1], start.value_or(around), autonomous);
  });
  attempt([&] { steps.coordinates = coordinates_of(*equation, found); });
  attempt([&] { steps.integral = integral_of(*equation, steps.coordinates, steps.factor); });
  attempt([&] {
    if (system.equations != FormulaField::Equations::first || !steps.coordinates) return;
    steps.lost = lost_solutions(*equation, *steps.coordinates, steps.integral, start.value_or(around));
  });
  attempt([&] {
    if (!steps.integral || !steps.factor) return;
    // V is known up to a function of H. The one that belongs to this H has dH = (x' dy - y' dx)/V.
    const Expression H_y = steps.integral->H.derivative(1);
    if (H_y.is_zero()) return;
    const Expression V = equation->f[0] / H_y;
    const auto ratio = equation->constant(*steps.factor / V);
    steps.factor = ratio ? tidied(*steps.factor / *ratio) : tidied(V);
  });
  const bool is_system = system.equations == FormulaField::Equations::system;
  const std::string of = is_system ? std::string(of_orbits) : "";
  const bool separable = std::ranges::count(steps.kinds, of + "separable") > 0;
  if (steps.coordinates && !separable && steps.coordinates->changes_q) {
    steps.kinds.push_back(
        fmt::format("{}separable after {} = {}", of, steps.names[2], steps.text(steps.coordinates->q)));
  }
  if (steps.integral && !steps.integral->after.empty()) steps.kinds.push_back(of + steps.integral->after);
  const auto is_polynomial = [](const Expression& e) { return coefficients(e, 0) && coefficients(e, 1); };
  if (is_system && steps.factor && !steps.factor->is_constant() && is_polynomial(*steps.factor)) {
    const auto is_of_orbits = [](const std::string& kind) { return kind.starts_with(of_orbits); };
    steps.kinds.insert(std::ranges::find_if(steps.kinds, is_of_orbits), "Darboux");
  }
  if (start && steps.integral && system.equations == FormulaField::Equations::first) {
    Equation of_start = *equation;
    of_start.start = *start;
    attempt([&] { steps.branch = solved_for_y(of_start, steps.integral->solvable); });
    if (!steps.branch) attempt([&] { steps.branch = solved_for_y(of_start, steps.integral->H); });
  }
  return steps;
}

}  // namespace contensou::answers
