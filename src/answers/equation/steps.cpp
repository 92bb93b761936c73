#include "answers/equation/equation.hpp"

#include <algorithm>
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
  return fmt::format("d{0}/d{1} = {2}", names[of_q ? 2 : 3], names[of_q ? 3 : 2],
                     text(of_q ? *coordinates->dq_dp : *coordinates->dp_dq, digits));
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
  for (const Expression& part : parts) part.replaced(look);
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
    if (jumps_at(integral->H, z)) add(z);
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
    stays |= side == 0 && jumps_at(integral->H, part.parts()[0]);
    return Expression(side > 0 ? 1 : -1);
  });
  return stays ? std::numeric_limits<double>::quiet_NaN() : H(here);
}

namespace {

using Eigen::Vector2d;

/// Returns the constant solutions with |y| up to 1000, those nearest to the start if there are many.
///
/// Values cannot tell 0 from terms that rounding hides. A zero y of F is therefore a solution only if F does not
/// contain x, if a factor of F without x vanishes, or if F becomes 0 when a fraction is put for y.
/// @param slope  F as a formula
std::vector<ConstantSolution> constant_solutions(const Expression& slope, const Vector2d& start, bool autonomous) {
  const auto at = [&](const Expression& e, double y) { return e({start[0] + 0.2371, y}); };
  std::vector<Expression> factors;
  const Expression above = fraction_of(slope).above;
  for (const Expression& factor : factors_of(above)) {
    const Expression base = base_and_exponent(factor).first;
    if (base.with(0, 1) == base) factors.push_back(base);
  }
  const auto vanishes = [&](const Expression& e, double y) {
    constexpr double zero = 1e-9, step = 1e-3;
    // On one side F may have no value, as y^(2/3).
    const auto size = [&](double there) {
      const double value = std::abs(at(e, there));
      return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
    };
    const double beside = step * (1 + std::abs(y)), least = std::min(size(y - beside), size(y + beside));
    return size(y) <= zero * least && least > 0 && std::isfinite(least);
  };
  const auto stays = [&](double y) {
    return vanishes(slope, y) && (autonomous || slope.with(1, snapped(y)).is_zero() ||
                                  std::ranges::any_of(factors, [&](const Expression& e) { return vanishes(e, y); }));
  };
  // The equilibria of (x', y') = (x, F(x0, y)) have the places and the stability of the zeros at one x.
  const reduction::SmoothField across([&](const Vector2d& x) { return Vector2d(x[0], at(slope, x[1])); });
  constexpr std::size_t many = 6, most = 7;
  std::vector<ConstantSolution> all;
  for (double last = -1; const double reach : {2., 16., 128., 1024.}) {
    if (all.size() > many) break;
    for (const auto& each : find_equilibria(across, Vector2d(-1, -reach), Vector2d(1, reach)).points) {
      const double y = each.x[1];
      if (std::abs(y) <= last || !stays(y)) continue;
      all.push_back({y, !autonomous                    ? ""
                        : each.kind == "saddle"        ? "stable"
                        : each.kind == "unstable node" ? "unstable"
                        : each.kind == "saddle-node"   ? "stable on one side"
                                                       : ""});
    }
    last = reach;
  }
  const auto distance = [&](const ConstantSolution& each) { return std::abs(each.y - start[1]); };
  std::ranges::sort(all, {}, distance);
  all.resize(std::min(all.size(), most), {});
  std::ranges::sort(all, {}, &ConstantSolution::y);
  return all;
}

/// Returns the solutions on which the separated equation dq/dp = G(q) has G = 0 and which no C gives, as formulas in x:
/// y = k pi x for y' = y/x + tan(y/x), where q = y/x and G = tan(q). The formulas are put into the equation.
std::vector<Expression> lost_solutions(const Equation& equation, const Coordinates& c,
                                       const std::optional<IntegralFormula>& integral, const Vector2d& start) {
  constexpr double zero = 1e-9, linear = 1e-12, beside = 1.01;
  const Expression y = Expression::variable(1);
  std::vector<Expression> all;
  if (!c.dq_dp || c.q == y) return all;
  const double below = c.q({start[0], 0}), slope = c.q({start[0], 1}) - below, there = c.q({start[0], start[1]});
  if (!(std::abs(below + slope * start[1] - there) <= linear * (1 + std::abs(there))) || slope == 0) return all;
  for (const ConstantSolution& each : constant_solutions(c.dq_dp->with(2, y), {0, there}, true)) {
    Equation through = equation;
    through.start = {start[0], (each.y - below) / slope};
    const auto curve = solved_for_y(through, c.q);
    if (!curve || !curve->has(0)) continue;
    // On a solution with a C, H has this value at all x. Rounding can hide that ln 0 is infinite.
    const auto C = [&](double x) { return integral->H({x, (*curve)({x, 0})}); };
    if (integral && std::abs(C(start[0]) - C(beside * start[0])) <= zero * (1 + std::abs(C(start[0])))) continue;
    if (equation.vanishes(curve->derivative(0) - equation.slope.with(1, *curve))) all.push_back(*curve);
  }
  return all;
}

}  // namespace

Steps steps_of(const FormulaField& system, const reduction::PlanarSymmetries& found, const std::string& factor,
               bool cleared, const std::optional<Eigen::Vector2d>& start, const Eigen::Vector2d& around) {
  Steps steps{system.variables};
  const auto is_taken = [&](const std::string& name) { return std::ranges::count(system.variables, name) > 0; };
  const bool taken = is_taken("q") || is_taken("p");
  steps.names.insert(steps.names.end(), {taken ? "Q" : "q", taken ? "P" : "p"});
  const auto equation = equation_of(system, around);
  if (!equation) return steps;
  steps.parts = {equation->f[0], equation->f[1]};
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
  if (steps.integral && steps.integral->quadrant) {
    const auto side = [&](std::size_t i) {
      return fmt::format("{} {} 0", steps.names[i], around[static_cast<Eigen::Index>(i)] < 0 ? "<" : ">");
    };
    steps.where = side(0) + ", " + side(1);
  }
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
