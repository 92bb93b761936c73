#include "answers/verbs/reduce_answer.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/asked/planar_system.hpp"
#include "answers/input/message.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/portraits/reduced_orbits.hpp"
#include "contensou/reduction/canonical_coordinates.hpp"
#include "contensou/reduction/equilibria.hpp"
#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/planar_kinds.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "contensou/reduction/planar_steps.hpp"
#include "contensou/reduction/stop_time.hpp"

namespace contensou::answers {

using Eigen::Vector2d;
using reduction::Generator;
using reduction::PlanarEnd;
using reduction::PlanarOrbit;
using reduction::PlanarReduction;
using reduction::PlanarSymmetries;
using std::numbers::pi;

namespace {

Json json_of(const Generator& x) {
  Json json{{"time", x.time},
            {"matrix", {{x.matrix(0, 0), x.matrix(0, 1)}, {x.matrix(1, 0), x.matrix(1, 1)}}},
            {"shift", {x.shift[0], x.shift[1]}}};
  if (!x.everywhere) json["within"] = "each smooth sector";
  return json;
}

/// A sum of such terms as one writes it: no zeros, no ones.
std::string sum(std::initializer_list<std::pair<double, std::string_view>> terms, const Digits& digits) {
  std::string text;
  for (const auto& [factor, name] : terms) {
    if (factor == 0) continue;
    text += text.empty() ? (factor < 0 ? "-" : "") : factor < 0 ? " - " : " + ";
    const double size = std::abs(factor);
    if (name.empty()) {
      text += digits(size);
    } else {
      text += size == 1 ? std::string(name) : fmt::format("{} {}", digits(size), name);
    }
  }
  return text.empty() ? "0" : text;
}

/// c t d/dt + ... in the names of time and coordinates.
std::string text_of(const Generator& x, std::string_view time, const Digits& digits) {
  std::string text;
  const auto add = [&](std::string factor, std::string_view name) {
    if (factor == "0") return;
    const bool several = factor.find(" + ") != std::string::npos || factor.find(" - ") != std::string::npos;
    const bool negative = !several && factor.starts_with('-');
    if (several) factor = "(" + factor + ")";
    if (negative) factor.erase(0, 1);
    text += text.empty() ? (negative ? "-" : "") : negative ? " - " : " + ";
    text += fmt::format("{} d/d{}", factor, name);
  };
  add(sum({{x.time, time}}, digits), time);
  add(sum({{x.matrix(0, 0), "u"}, {x.matrix(0, 1), "v"}, {x.shift[0], ""}}, digits), "u");
  add(sum({{x.matrix(1, 0), "u"}, {x.matrix(1, 1), "v"}, {x.shift[1], ""}}, digits), "v");
  return text;
}

Json symmetry_members(const PlanarSymmetries& found) {
  Json generators = Json::array();
  for (const Generator& x : found.generators) generators.push_back(json_of(x));
  return {{"generators", generators},
          {"singular_values", found.singular_values},
          {"level", found.level},
          {"gap", found.gap}};
}

std::string text_of(const PlanarSymmetries& found, std::string_view time, const Digits& digits) {
  std::string text;
  for (const Generator& x : found.generators) {
    text +=
        fmt::format("{:<12}X = {}{}\n", text.empty() ? "generator" : "", text_of(x, time, digits),
                    x.everywhere ? "" : ", within each sector in which the field is smooth, not across their borders");
  }
  if (found.verdict == PlanarSymmetries::Verdict::none) {
    text = "generator   none of the form X = c t d/dt + (A x + b) d/dx: no singular value is small\n";
  } else if (found.verdict == PlanarSymmetries::Verdict::undecided) {
    text =
        "generator   not decided: the field's noise, or its kinks, hide what one would leave; a start where both "
        "terms of each sum matter may tell\n";
  }
  text += "values      ";
  for (double value : found.singular_values) text += fmt::format("{:.2g} ", value);
  text += fmt::format("\n            singular ones of the determining equations at {} points; ", found.points);
  // They are relative to the largest.
  return text + (found.level < 1 ? fmt::format("0 is below {:.1g}, gap {:.1g}\n", found.level, found.gap)
                                 : "the errors of differences exceed all of them\n");
}

/// A row of CSV: the members that are one number or text, and the first generator.
Json row_of(const Json& members, const PlanarSymmetries& found) {
  Json row;
  for (const auto& [name, value] : members.items()) {
    if (value.is_primitive() && !value.is_null()) row[name] = value;
  }
  if (members.contains("canonical")) row.update(members["canonical"]);
  if (!found.generators.empty()) {
    const Generator& x = found.generators.front();
    row.update({{"time", x.time},
                {"a11", x.matrix(0, 0)},
                {"a12", x.matrix(0, 1)},
                {"a21", x.matrix(1, 0)},
                {"a22", x.matrix(1, 1)},
                {"b1", x.shift[0]},
                {"b2", x.shift[1]}});
  }
  return row;
}

/// The orbit of the start in the strip, and the starts of its copies: each is the same curve with another p.
Json strip_members(const portraits::ReducedOrbits& from, const char* x,
                   const std::function<double(const Vector2d&)>& time_left) {
  constexpr std::size_t most = 100;
  const auto place = [&](portraits::Point at) {
    const auto [u, v] = from.in_plane(at);
    return Vector2d(u, v);
  };
  Json strip = Json::array(), copies = Json::array();
  for (const portraits::Polyline& line : from.orbit) {
    Json columns{{x, Json::array()}, {"p", {}}, {"u", {}}, {"v", {}}, {"tau_left", {}}};
    const std::size_t step = (line.size() + most - 1) / most;
    for (std::size_t i = (line.size() - 1) % step; i < line.size(); i += step) {
      const Vector2d at = place(line[i]);
      if (!at.allFinite()) continue;  // the state is so long before the start that it exceeds a double
      columns[x].push_back(line[i].x);
      columns["p"].push_back(line[i].y);
      columns["u"].push_back(at[0]);
      columns["v"].push_back(at[1]);
      columns["tau_left"].push_back(or_infinity(time_left(at)));
    }
    strip.push_back(std::move(columns));
  }
  for (const double shift : portraits::copy_shifts) {
    const Vector2d start = place({from.start.x, from.start.y + shift});
    if (!start.allFinite()) continue;
    copies.push_back(
        {{"factor", std::exp(shift)}, {"u0", start[0]}, {"v0", start[1]}, {"tau_stop", or_infinity(time_left(start))}});
  }
  return {{"strip", strip}, {"copies", copies}};
}

std::string difference(double one, double other) {
  if (one == other) return "the same";
  return fmt::format("differs by {:.1e}", std::abs(one / other - 1));
}

/// The forms of V that were tried; the last holds if one does.
std::string text_of(const std::vector<reduction::TriedForm>& tried) {
  std::string text;
  for (const auto& [form, value, gap, residual, cleared] : tried) {
    text += fmt::format("{:<12}{}{}: least singular value {:.0e}, gap {:.0e}, residual {:.0e}\n",
                        text.empty() ? "factor V" : "", form, cleared ? ", V times the denominator" : "", value, gap,
                        residual);
  }
  return text;
}

/// The zeros of the field about the start, and the maps that turn its motions back.
struct Equilibria {
  std::vector<reduction::Equilibrium> zeros;
  std::vector<reduction::Reversor> reversors;

  Json members() const {
    Json names = Json::array();
    for (const auto& [name, matrix] : reversors) names.push_back(name);
    return {{"equilibria", portraits::equilibria_json<Json>(zeros)}, {"reversors", names}};
  }

  std::string text(const Digits& digits) const {
    std::string text;
    for (const auto& each : zeros) {
      const auto [first, second] = each.eigenvalues();
      const auto part = [&](double x) { return digits(x == 0 ? 0 : x); };  // no -0
      text += fmt::format("equilibrium ({}, {}): {}, eigenvalues {}\n", part(each.x[0]), part(each.x[1]), each.kind(),
                          first.imag() == 0   ? part(first.real()) + ", " + part(second.real())
                          : first.real() == 0 ? fmt::format("+-{} i", part(second.imag()))
                                              : fmt::format("{} +- {} i", part(first.real()), part(second.imag())));
    }
    for (const auto& [name, matrix] : reversors) {
      text += fmt::format("{:<12}(u, v) -> {}, t -> -t\n", text.ends_with("-t\n") ? "" : "reversor", name);
    }
    return text;
  }
};

/// Adds the members of a system that its scaling solves.
/// @return their text
std::function<std::string(const Digits&)> solved_by_scaling(Json& members, const PlanarReduction& plane,
                                                            const PlanarOrbit& orbit, const Vector2d& start,
                                                            bool at_centre) {
  const auto canonical = plane.canonical(start);
  std::optional<double> integral;
  try {
    if (!at_centre) integral = plane.first_integral(start);
  } catch (const std::domain_error&) {
    // on a ray it has no value
  }
  Json rays = Json::array();
  for (const auto& ray : plane.rays()) {
    rays.push_back({{"angle", ray.q},
                    {"attracts", ray.attracts},
                    {"to_centre", ray.to_centre},
                    {"radial", ray.radial},
                    {"angular", or_infinity(ray.angular)},
                    {"order", ray.order}});
  }
  if (!at_centre) {
    members["canonical"] = {{"q", canonical.q}, {"p", canonical.p}, {"dp_dq", or_infinity(canonical.dp_dq)}};
  }
  if (integral) members["first_integral"] = *integral;
  const std::string_view kind = plane.kind();
  members.update({{"rays", rays}, {"kind", kind.empty() ? Json() : Json(kind)}});
  if (!plane.undecided().empty()) members["undecided"] = plane.undecided();
  if (integral && !kind.empty() && kind != "bordered") {
    members.update(strip_members(portraits::reduced_orbits(plane, start), "q", [&](const Vector2d& x) {
      const auto there = plane.orbit(x);
      return there.end() == PlanarEnd::centre ? there.end_time() : infinity;
    }));
  }
  if (plane.turn()) members["turn"] = {{"factor", plane.turn()->factor}, {"sigma", plane.turn()->sigma}};
  if (at_centre) members.update({{"end", name(orbit.end())}, {"tau_stop", 0.0}});
  return [=](const Digits& digits) {
    std::string lines =
        fmt::format("centre      ({}, {}): {}\n", digits(plane.centre()[0]), digits(plane.centre()[1]),
                    plane.kind().empty() ? "not decided, as " + plane.undecided() : std::string(plane.kind()));
    for (const auto& ray : plane.rays()) {
      lines += fmt::format("ray         at the angle {}{}: {}, the motion on it goes {}\n", digits(ray.q),
                           ray.order == 2   ? ", double"
                           : ray.order == 3 ? ", triple"
                                            : "",
                           ray.attracts ? "attracts" : "repels",
                           ray.radial == 0 ? "nowhere: its points are at rest"
                           : ray.to_centre ? "to the centre"
                                           : "away");
    }
    if (plane.turn()) {
      lines += fmt::format("a turn      multiplies exp(p) by {} in {} of sigma, d sigma = exp(-c p) dt\n",
                           digits(plane.turn()->factor), digits(plane.turn()->sigma));
    }
    if (at_centre) return lines + "tau_stop    0: the start is the centre\n";
    lines += fmt::format("canonical   q = {} (angle), p = {}, dp/dq = {}\n", digits(canonical.q), digits(canonical.p),
                         digits(canonical.dp_dq));
    return lines +
           (integral
                ? fmt::format("integral    p - L(q) = {}\n", digits(*integral))
                : std::string("integral    none: the start is on the ray, which the symmetry moves along itself\n"));
  };
}

/// Adds the members of a solution by V alone and returns its text. For a scaling, solved_by_scaling does so.
std::function<std::string(const Digits&)> solved_by_factor(Json& members, const SolvedPlane& solved) {
  const std::string_view divided = solved.tried.back().cleared ? " divided by the denominator" : "";
  const std::string_view form = solved.plane->form();
  const std::string_view shown = form == "basis" ? "a sum of the basis" : form == "affine" ? "f ^ X, X affine" : form;
  const std::string v = fmt::format("{}{}", shown, divided);
  const auto [factor, integral] = solved.formula();
  members["factor"] = factor.empty() ? v + ", 1 at the start" : fmt::format("{}{}", factor, divided);
  if (!integral.empty()) members["integral"] = integral;
  members["kind"] = nullptr;
  std::string lines = fmt::format("solution    by quadrature along H = constant, dH = (u' dv - v' du)/V; V is {}\n", v);
  if (!factor.empty()) lines += fmt::format("            V = {}{}, up to a constant factor\n", factor, divided);
  if (!integral.empty()) lines += fmt::format("            H = {}\n", integral);
  return [=](const Digits&) { return lines; };
}

/// Difference between the states by the solution and by steps at a time: at 95 % of a finite end time, else at 5. It is
/// divided by the distance from 0 of the start or of the state by steps, whichever is larger.
struct BySteps {
  double time, difference;
};
std::optional<BySteps> by_steps(const PlanarReduction& plane, const PlanarOrbit& orbit, const Vector2d& start) {
  constexpr double share = 0.95, usual = 5;
  const double time = std::isfinite(orbit.end_time()) ? share * orbit.end_time() : usual;
  if (time == 0) return std::nullopt;
  try {
    const Vector2d here = orbit.at(time), there = reduction::by_steps(plane.field()).orbit(start).at(time);
    return BySteps{time, (here - there).norm() / std::max(start.norm(), there.norm())};
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

/// Adds the members of the end of the orbit.
/// @return their text
std::function<std::string(const Digits&)> end_of(Json& members, const PlanarReduction& plane, const PlanarOrbit& orbit,
                                                 const Vector2d& start) {
  const PlanarEnd end = orbit.end();
  const bool unknown = end == PlanarEnd::border || end == PlanarEnd::undecided;
  const double tau_stop = end == PlanarEnd::centre ? orbit.end_time() : infinity;
  const bool named = std::ranges::count(named_ends(), name(end)) > 0;
  members.update({{"end", named ? Json(name(end)) : Json()}, {"tau_stop", unknown ? Json() : Json(tau_stop)}});
  const double error = std::isfinite(tau_stop) ? plane.end_time_error(start) : 0;
  if (error > 0) members["accuracy"] = error;
  if (orbit.period()) members["period"] = *orbit.period();
  if (!orbit.undecided().empty()) members["undecided"] = orbit.undecided();
  const auto stepped = by_steps(plane, orbit, start);
  members["by_steps"] = stepped ? Json{{"difference", stepped->difference}, {"time", stepped->time}} : Json();
  const auto end_text = [=](const Digits& digits) -> std::string {
    if (end == PlanarEnd::border) {
      return "tau_stop    not known: the orbit comes to a border of the field, a pole or a jump\n";
    }
    if (end == PlanarEnd::undecided) return fmt::format("tau_stop    not decided: {}\n", orbit.undecided());
    const double time = orbit.end_time();
    const auto words = [&]() -> std::string {
      switch (end) {
        case PlanarEnd::centre:
          return std::isfinite(time) ? fmt::format(", by quadrature; relative error below {:.0e}", error)
                                     : ": it nears the centre for ever";
        case PlanarEnd::periodic:
          return fmt::format(": it returns after {}", digits(orbit.period().value()));
        case PlanarEnd::rest:
          return ": it comes to rest elsewhere";
        case PlanarEnd::equilibrium:
          return ": it nears an equilibrium for ever";
        case PlanarEnd::cycle:
          return ": it nears a closed orbit for ever";
        default:
          return std::isfinite(time) ? fmt::format(": it is at infinity after {}", digits(time))
                                     : ": it goes to infinity, for ever";
      }
    };
    return fmt::format("tau_stop    {}{}\n", digits(tau_stop), words());
  };
  return [=](const Digits& digits) {
    return end_text(digits) + (stepped ? fmt::format("by steps    at t = {} the state differs by {:.0e}\n",
                                                     digits(stepped->time), stepped->difference)
                                       : std::string("by steps    not compared: one of the two gives no state\n"));
  };
}

}  // namespace

std::vector<std::string_view> named_ends() {
  std::vector<std::string_view> names;
  for (int i = 0; i < reduction::planar_ends; ++i) {
    const auto end = static_cast<PlanarEnd>(i);
    // A limit cycle is no end that scripts know.
    if (end != PlanarEnd::undecided && end != PlanarEnd::cycle) names.push_back(name(end));
  }
  return names;
}

ReduceAnswer reduce_answer(const reduction::SmoothField& field, const std::string& text, const Vector2d& start) {
  if (start.isZero(0)) throw BadInput("reduce needs a start other than u = v = 0, about which the field is sampled");
  const auto has_value = [&] {
    try {
      return field.value(start).allFinite();
    } catch (const std::exception&) {
      return false;
    }
  };
  if (!has_value()) {
    throw BadInput(fmt::format("the field has no value at the start u = {}, v = {}: give a start where it has one",
                               start[0], start[1]));
  }
  const PlanarSymmetries found = reduction::find_symmetries(field.value, start);
  Answer answer{.members = {{"system", text}, {"u0", start[0]}, {"v0", start[1]}}};
  answer.members.update(symmetry_members(found));
  const SolvedPlane solved = solve_planar(field, found, start);
  answer.members["form"] = solved.plane ? Json(solved.plane->form()) : Json();
  if (!solved.tried.empty()) {
    Json tried = Json::array();
    for (const auto& [form, value, gap, residual, cleared] : solved.tried) {
      tried.push_back({{"form", form}, {"singular_value", or_infinity(value)}, {"gap", or_infinity(gap)}});
      if (cleared) tried.back()["cleared"] = true;
    }
    answer.members["tried"] = tried;
  }
  Equilibria equilibria{reduction::find_equilibria(field, start), reduction::find_reversors(field, start)};
  if (solved.plane) prove_centers(equilibria.zeros, *solved.plane);
  answer.members.update(equilibria.members());
  std::function<std::string(const Digits&)> solution;
  if (solved.plane) {
    const PlanarReduction& plane = *solved.plane;
    const bool at_centre = plane.scaling() != nullptr && is_centre(*plane.scaling(), start);
    const PlanarOrbit orbit = plane.orbit(at_centre ? plane.centre() : start);
    solution = plane.scaling() ? solved_by_scaling(answer.members, plane, orbit, start, at_centre)
                               : solved_by_factor(answer.members, solved);
    if (!at_centre) {
      solution = [before = solution, after = end_of(answer.members, plane, orbit, start)](const Digits& digits) {
        return before(digits) + after(digits);
      };
    }
  } else if (!found.generators.empty()) {
    solution = [why = solved.why_not](const Digits&) {
      return fmt::format("solution    none by quadrature: {}\n", why);
    };
  }
  answer.text = [=, tried = solved.tried](const Digits& digits) {
    return fmt::format("system      {}\nstart       u = {}, v = {}\n{}{}{}{}", text, digits(start[0]), digits(start[1]),
                       text_of(found, "t", digits), text_of(tried), equilibria.text(digits),
                       solution ? solution(digits) : "");
  };
  answer.rows = {row_of(answer.members, found)};
  return {std::move(answer), solved.plane || !found.generators.empty()};
}

ReduceAnswer reduce_answer(const GivenStart& given) {
  const auto& [system, state, experiment, motion] = given;
  if (given.is_in_pieces()) {
    throw BadInput(
        "reduce is of one orbit, and rolling friction lets this ball turn for a part of its motion only: leave it out "
        "(--rolling-friction 0), or ask for --mu, --u0, --v0 with --drive");
  }
  if (given.at_rest()) throw BadInput("reduce needs a start other than rest: --u0 or --v0 must not be 0");
  const Vector2d start(state.u, state.v);
  // Sampled about k = 1, where both speeds change, whatever the start: by the scaling that is found all are alike.
  const PlanarSymmetries found =
      reduction::find_symmetries(reduction::planar_field(system), Vector2d(1 / system.mu(), 1));
  if (!found.scaling) {
    // A law has been found homogeneous when it was made: here only rounding can hide the scaling.
    throw std::runtime_error(fmt::format(
        "reduce: with mu = {} the scaling of (2.6) is lost in rounding, as u and v differ too much in how fast "
        "they change; stop, orbit and portrait take such a mu",
        system.mu()));
  }
  const PlanarReduction plane(reduction::planar_field(system), *found.scaling, start, found.residual);
  const reduction::Flow flow = given.flow();
  const reduction::StopTime stop = flow.stop_time(state);

  Json rays = Json::array();
  const auto ends_at = [&](double k) {
    return std::ranges::any_of(flow.terminal().ends, [k](const auto& end) { return end.k == k; });
  };
  const bool driven = system.drive() > 0;  // then v = 0 is no ray
  if (!driven) rays.push_back({{"k", 0}, {"attracts", ends_at(0)}});
  for (const auto& ray : flow.terminal().rays) rays.push_back({{"k", ray.k}, {"attracts", ray.attracts()}});
  rays.push_back({{"k", infinity}, {"attracts", ends_at(infinity)}});

  Json routes = Json::array();
  const std::vector<reduction::Route> ways = reduction::routes(system);
  for (reduction::Route route : ways) {
    try {
      // The first is the way of `flow`, which is solved.
      const double tau = route == ways.front() ? stop.tau : reduction::stop_time(system, state, route).tau;
      routes.push_back({{"name", name(route)}, {"tau_stop", tau}});
    } catch (const std::runtime_error& failure) {  // a stepper did not come to the stop
      routes.push_back({{"name", name(route)}, {"failure", words_of(failure.what())}});
    }
  }
  routes.push_back({{"name", "section"}, {"tau_stop", plane.end_time(start)}});

  Answer answer{.members = {{"law", system.law().name()},
                            {"mu", system.mu()},
                            {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
                            {"u0", state.u},
                            {"v0", state.v}}};
  if (driven) answer.members["drive"] = system.drive();
  answer.members.update(symmetry_members(found));
  // The axes are rays themselves: there q and p are limits, and the first integral has no value.
  std::optional<double> integral;
  if (given.slides_and_spins()) {
    const auto canonical = reduction::to_canonical(state);
    answer.members["canonical"] = {
        {"q", canonical.q}, {"p", canonical.p}, {"dp_dq", reduction::separated_slope(system, canonical.q)}};
    try {
      integral = flow.log_first_integral(state.u, std::log(state.v));
      answer.members["first_integral"] = *integral;
    } catch (const std::domain_error&) {
      // on an invariant ray
    }
  } else {
    answer.members["canonical"] = {{"q", state.u == 0 ? infinity : 0.0}, {"p", std::log(state.v)}, {"dp_dq", infinity}};
  }
  answer.members.update({{"rays", rays}, {"kind", plane.kind()}, {"tau_stop", stop.tau}, {"routes", routes}});
  if (integral) {
    answer.members.update(strip_members(portraits::reduced_orbits(flow, state), "ln_k", [&](const Vector2d& x) {
      return flow.stop_time(reduction::State{x[0], x[1]}).tau;
    }));
  }

  answer.text = [=, system = system, state = state, members = answer.members](const Digits& digits) {
    const double mu = system.mu(), chi = system.inertia().chi, gamma = system.inertia().gamma;
    const double sliding = 2 * chi / (3 * pi), pivoting = 2 * gamma * mu / (3 * pi), r = system.r();
    std::string text = fmt::format("system      law {}, mu = {}, chi = {}, gamma = {}, r = {}; k = v/({} |u|)\n",
                                   system.law().name(), digits(mu), digits(chi), digits(gamma), digits(r), digits(mu));
    text += fmt::format("(2.6)       du/dtau = -{} Psi(k) sign(u),  dv/dtau = -{} {}\n", digits(pivoting),
                        digits(sliding), driven ? fmt::format("(Phi(k) - {})", digits(system.drive())) : "Phi(k)");
    text += fmt::format("(2.7)       du/dbeta = W du/dtau,  dv/dbeta = W dv/dtau,  smooth at u = v = 0\n");
    text += fmt::format("(2.8)       dtau = W dbeta,  W = ({} |u| + {} v) ({} |u| + {} v)\n", digits(16 * mu),
                        digits(15 * pi), digits(8 * mu), digits(3 * pi));
    text += fmt::format("start       u = {}, v = {}, k = {}\n", digits(state.u), digits(state.v),
                        digits(state.v / (mu * std::abs(state.u))));
    text += text_of(found, "tau", digits);
    const Json& canonical = members.at("canonical");
    text +=
        fmt::format("canonical   q = v/u = {}, p = ln v = {}, dp/dq = {}\n", digits(canonical.at("q").get<double>()),
                    digits(canonical.at("p").get<double>()), digits(canonical.at("dp_dq").get<double>()));
    text += integral
                ? fmt::format("integral    ln |u| - ln w(k) = {}, the same along the orbit\n", digits(*integral))
                : std::string("integral    none: the start is on the ray, which the symmetry moves along itself\n");
    if (integral && !driven && system.law().as<reduction::PadeLaw>() != nullptr && r < 2) {
      const double a = r / (2 - r), b = a - r / (5 - r), A = 8 * (2 - r), B = 3 * pi * (5 - r);
      const double k = state.v / (mu * std::abs(state.u));
      text += fmt::format("orbit       |u| k^-{} ({} + {} k)^{} = {}\n", digits(a), digits(A), digits(B), digits(b),
                          digits(std::exp(std::log(std::abs(state.u)) - a * std::log(k) + b * std::log(A + B * k))));
    }
    for (const Json& ray : members.at("rays")) {
      text += fmt::format("ray         k = {}: {}\n", digits(ray.at("k").get<double>()),
                          ray.at("attracts").get<bool>() ? "attracts" : "repels");
    }
    text += fmt::format("origin      {}, not smooth\n", plane.kind());
    text += fmt::format("tau_stop    {}\n", digits(stop.tau));
    for (const Json& route : members.at("routes")) {
      if (route.contains("failure")) {
        text += fmt::format("  {:<12}none: {}\n", route.at("name").get<std::string>(),
                            route.at("failure").get<std::string>());
        continue;
      }
      text += fmt::format("  {:<12}{:.15g}, {}\n", route.at("name").get<std::string>(),
                          route.at("tau_stop").get<double>(), difference(route.at("tau_stop").get<double>(), stop.tau));
    }
    return text;
  };
  answer.rows = {row_of(answer.members, found)};
  return {std::move(answer), true};
}

std::vector<FieldText> reduce_fields() {
  return {
      {"`law`, `mu`; JSON `body` {`chi`, `gamma`}", "", "law of friction, patch ratio and inertia; not with --system"},
      {"`system`", "", "the system as typed, with --system"},
      {"`u0`, `v0`, `drive`", "speed, speed, 1", "the start; drive divided by f N, with --drive"},
      {"JSON `generators` [{`time` c, `matrix` A, `shift` b, `within`}]; "
       "CSV `time`, `a11`, `a12`, `a21`, `a22`, `b1`, `b2`",
       "",
       "c t d/dt + (A x + b) d/dx with x = (u, v); the first one reduces the system; within: the part of the plane where it holds"},
      {"JSON `singular_values`", "", "singular values of the determining equations, divided by the largest"},
      {"`level`, `gap`", "", "values below level count as 0; the others are larger by the factor gap"},
      {"`form`, `factor`", "",
       "scaling, form of the integrating factor V, or null; V as a formula, up to a constant factor, or in words"},
      {"`integral`", "", "first integral H as a formula, if it is recognised"},
      {"JSON `tried` [{`form`, `singular_value`, `gap`, `cleared`}]", "",
       "forms of V in the order of the search; cleared: V was multiplied by the denominator of the field"},
      {"JSON `canonical` {`q`, `p`, `dp_dq`}; CSV `q`, `p`, `dp_dq`", "",
       "canonical coordinates of the start: v/u and ln v; with --system angle and logarithm of the distance"},
      {"`first_integral`", "", "p minus p of one orbit at this q; constant along a motion"},
      {"JSON `rays` [{`k` or `angle`, `attracts`, `to_centre`, `radial`, `angular`, `order`}]", "",
       "invariant rays: direction of the motion, eigenvalues along the ray and across, 2 for a double ray"},
      {"`kind`, `undecided`", "", "type of the blown-up centre; null if not decided, and the reason"},
      {"every `kind`", "",
       fmt::format("{}; center: imaginary eigenvalues on the axis of a reversor, or V not 0",
                   fmt::join(reduction::planar_kinds, ", "))},
      {"JSON `equilibria` [{`u`, `v`, `kind`, `eigenvalues`}]", "",
       "isolated zeros of the field where |u| and |v| are at most 2.5 max(|u0|, |v0|); eigenvalues [[re, im], "
       "[re, im]] of its derivatives"},
      {"JSON `reversors`", "", "images of (u, v) under the maps that turn motions back, such as (u, -v)"},
      {"JSON `turn` {`factor`, `sigma`}", "", "scaling by one turn of a focus, and its logarithm"},
      {"JSON `strip` [{`ln_k` or `q`, `p`, `u`, `v`, `tau_left`}]", "1, 1, speed, speed, speed",
       "orbit of the start, forward and backward in time; one turn if it is a spiral"},
      {"JSON `copies` [{`factor`, `u0`, `v0`, `tau_stop`}]", "1, speed, speed, speed",
       "images of the start under the symmetry; their orbits are the orbit of strip, shifted in p by ln(factor)"},
      {"`tau_stop`, `accuracy`", "speed, 1",
       "stop time (inf if the centre is not reached, null before a border or if not decided) and relative error"},
      {"`end`", "", "end of the motion, with --system"},
      {"every `end`", "", fmt::format("{}; null if not decided", fmt::join(named_ends(), ", "))},
      {"JSON `routes` [{`name`, `tau_stop`, `failure`}]", "speed",
       "stop time by each method; section is the method for --system"},
      {"`period`", "", "time after which the motion returns"},
      {"JSON `by_steps` {`difference`, `time`}", "", "relative difference from integration in time steps; its time"},
  };
}

}  // namespace contensou::answers
