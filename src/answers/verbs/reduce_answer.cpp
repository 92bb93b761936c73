#include "answers/verbs/plane_answers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/equation/equation.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/portraits/reduction_figure.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/verification.hpp"

namespace contensou::answers {

using Eigen::Vector2d;
using reduction::Generator;
using reduction::PlanarCanonical;
using reduction::PlanarEnd;
using reduction::PlanarOrbit;
using reduction::PlanarRay;
using reduction::PlanarReduction;
using reduction::PlanarSymmetries;
using std::numbers::pi;

namespace {

/// Adds a part to the text of an answer.
void add_text(Answer& answer, std::function<std::string(const Digits&)> text) {
  answer.text = [before = answer.text, text = std::move(text)](const Digits& digits) {
    return (before ? before(digits) : "") + text(digits);
  };
}

Json json_of(const Generator& x) {
  Json json{{"time", x.time},
            {"matrix", {{x.matrix(0, 0), x.matrix(0, 1)}, {x.matrix(1, 0), x.matrix(1, 1)}}},
            {"shift", {x.shift[0], x.shift[1]}}};
  if (!x.everywhere) json["within"] = "each smooth sector";
  return json;
}

/// Returns a sum of terms as people write it: terms with the factor 0 and factors 1 are left out.
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

/// Returns a generator c t d/dt + ... with the given names of time and coordinates.
std::string text_of(const Generator& x, std::string_view time, const Digits& digits, std::string_view u = "u",
                    std::string_view v = "v") {
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
  add(sum({{x.matrix(0, 0), u}, {x.matrix(0, 1), v}, {x.shift[0], ""}}, digits), u);
  add(sum({{x.matrix(1, 0), u}, {x.matrix(1, 1), v}, {x.shift[1], ""}}, digits), v);
  return text;
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
  text += fmt::format("\n            singular ones of the determining equations at {} points, |u| <= {}, |v| <= {}; ",
                      found.points, digits(found.within[0]), digits(found.within[1]));
  // Each singular value is divided by the largest one.
  return text + (found.level < 1 ? fmt::format("0 is below {:.1g}, gap {:.1g}\n", found.level, found.gap)
                                 : "the errors of differences exceed all of them\n");
}

void add_symmetries(Answer& answer, const PlanarSymmetries& found, const std::string& time) {
  Json generators = Json::array();
  for (const Generator& x : found.generators) generators.push_back(json_of(x));
  answer.members.update({{"generators", generators},
                         {"singular_values", found.singular_values},
                         {"level", or_infinity(found.level)},
                         {"gap", or_infinity(found.gap)},
                         {"sampled_within", {found.within[0], found.within[1]}}});
  add_text(answer, [=](const Digits& digits) { return text_of(found, time, digits); });
}

/// Adds the row of CSV: the members that are one number or text, and the first generator. Only formats other than text
/// need the lists that `numbers` computes.
Answer finished(Answer answer, const PlanarSymmetries& found, bool solved) {
  Json& row = answer.rows.emplace_back();
  for (const auto& [name, value] : answer.members.items()) {
    if (value.is_primitive() && !value.is_null() && !value.is_boolean()) row[name] = value;
  }
  if (answer.members.contains("canonical")) row.update(answer.members["canonical"]);
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
  if (const auto lists = std::exchange(answer.numbers, {})) {
    answer.numbers = [all = answer, lists]() mutable {
      all.members.update(lists().members);
      return all;
    };
  }
  answer.passed = solved || !found.generators.empty();
  return answer;
}

/// Returns the orbit of the start in the strip (q, p), and the starts of its copies: the same curve with p shifted.
Json strip_members(const PlanarReduction& plane, const Vector2d& start) {
  constexpr std::size_t most = 100;
  const portraits::ReducedOrbits from = portraits::reduced_orbits(plane, start);
  const auto time_left = [&](const Vector2d& x) {
    if (plane.flow()) return plane.flow()->stop_time({x[0], x[1]}).tau;
    const auto there = plane.orbit(x);
    return or_infinity(there.end() == PlanarEnd::centre ? there.end_time() : infinity);
  };
  const auto place = [&](portraits::Point at) {
    const auto [u, v] = from.in_plane(at);
    return Vector2d(u, v);
  };
  Json strip = Json::array(), copies = Json::array();
  for (const portraits::Polyline& line : from.orbit) {
    const char* const x = plane.flow() ? "ln_k" : "q";
    Json columns{{x, Json::array()}, {"p", {}}, {"u", {}}, {"v", {}}, {"tau_left", {}}};
    const std::size_t step = (line.size() + most - 1) / most;
    for (std::size_t i = (line.size() - 1) % step; i < line.size(); i += step) {
      const Vector2d at = place(line[i]);
      if (!at.allFinite()) continue;  // that long before the start, the speeds overflow
      columns[x].push_back(line[i].x);
      columns["p"].push_back(line[i].y);
      columns["u"].push_back(at[0]);
      columns["v"].push_back(at[1]);
      columns["tau_left"].push_back(time_left(at));
    }
    strip.push_back(std::move(columns));
  }
  for (const int multiple : portraits::copies) {
    const double shift = multiple * from.step;
    const Vector2d copy = place({from.start.x, from.start.y + shift});
    if (!copy.allFinite()) continue;
    copies.push_back({{"factor", std::exp(shift)}, {"u0", copy[0]}, {"v0", copy[1]}, {"tau_stop", time_left(copy)}});
  }
  return {{"strip", strip}, {"copies", copies}};
}

std::string difference(double one, double other) {
  if (one == other) return "the same";
  return fmt::format("differs by {:.1e}", std::abs(one / other - 1));
}

/// Returns a text on the tried forms of the inverse integrating factor V. If V was found, it has the last form listed.
std::string text_of(const std::vector<reduction::TriedForm>& tried) {
  std::string text;
  for (const auto& [form, value, gap, residual, cleared] : tried) {
    text += fmt::format("{:<12}{}{}: least singular value {:.0e}, gap {:.0e}, residual {:.0e}\n",
                        text.empty() ? "factor V" : "", form, cleared ? ", V times the denominator" : "", value, gap,
                        residual);
  }
  return text;
}

Json members_of_plane(const reduction::Equilibria& equilibria) {
  Json names = Json::array();
  for (const auto& [name, matrix] : equilibria.reversors) names.push_back(name);
  Json json = portraits::equilibria_members<Json>(equilibria);
  json["reversors"] = names;
  return json;
}

/// Returns the kind of a part of a switching curve in words, and its ends.
std::pair<std::string, std::array<Vector2d, 2>> words_of(const portraits::SwitchingPart& part) {
  using Kind = reduction::SwitchingMotion::Kind;
  const char* const kind = part.motion == Kind::rests ? "rest" : part.motion == Kind::slides ? "sliding" : "not unique";
  return {kind, {part.points.front(), part.points.back()}};
}

/// Returns the number of equilibria, and the part of the plane in which they were sought.
/// @param letters  names of the coordinates
std::string count_of(const reduction::Equilibria& equilibria, const std::array<std::string, 2>& letters,
                     const Digits& digits) {
  const auto part = [&](double x) { return digits(x + 0.0); };  // the addition turns -0 into 0
  const auto& [points, low, high, complete, on_curve, reversors] = equilibria;
  const std::string curve =
      on_curve ? fmt::format("{} a curve of them through ({}, {})", points.empty() && complete ? ", but" : ", and",
                             part((*on_curve)[0]), part((*on_curve)[1]))
               : "";
  return fmt::format("{}{}, within {} <= {} <= {}, {} <= {} <= {}",
                     points.empty() ? std::string(complete ? (on_curve ? "no isolated one" : "none")
                                                           : "none found, but some may be missing")
                     : complete     ? fmt::format("{}", points.size())
                                    : fmt::format("at least {}", points.size()),
                     curve, part(low[0]), letters[0], part(high[0]), part(low[1]), letters[1], part(high[1]));
}

/// Returns the kind of an equilibrium with the eigenvalues of the equations linearised there.
std::string kind_of(const reduction::Equilibrium& point, const Digits& digits) {
  const std::string kind(point.kind);
  if (!point.eigenvalues) return kind;
  const auto part = [&](double x) { return digits(x + 0.0); };
  const auto [first, second] = *point.eigenvalues;
  const std::string real = part(first.real()), imaginary = second.imag() == 1 ? "i" : part(second.imag()) + " i";
  return fmt::format("{}, eigenvalues {}", kind,
                     first.imag() == 0   ? real + ", " + part(second.real())
                     : first.real() == 0 ? "+-" + imaginary
                                         : real + " +- " + imaginary);
}

/// Returns the equilibria of a wider square, if none lies nearby, or if no start says which ones are meant. Many of
/// them, as those of a pendulum, say no more than the nearest ones.
reduction::Equilibria widened(const reduction::Equilibria& nearby, const reduction::SmoothField& field,
                              const Vector2d& around, bool has_start) {
  constexpr std::size_t many = 12;
  constexpr double same = 1e-6;
  reduction::Equilibria best = nearby;
  for (const double times : {8, 64}) {
    if (best.on_curve || (has_start && !best.points.empty())) break;
    const reduction::Equilibria wider = reduction::find_equilibria(field, times * around);
    const bool has_all = std::ranges::all_of(best.points, [&](const auto& each) {
      const auto is_it = [&](const auto& other) { return (each.x - other.x).norm() < same * around.norm(); };
      return std::ranges::any_of(wider.points, is_it);
    });
    if (has_all && wider.points.size() > best.points.size() && wider.points.size() <= many) best = wider;
  }
  return best;
}

/// Returns a text on the equilibria near the start, and the reversors.
std::string text_of(const reduction::Equilibria& equilibria, const Digits& digits) {
  const auto part = [&](double x) { return digits(x + 0.0); };
  const auto& [points, low, high, complete, on_curve, reversors] = equilibria;
  std::string text = fmt::format("equilibria  {}\n", count_of(equilibria, {"u", "v"}, digits));
  for (const reduction::Equilibrium& each : points) {
    text += fmt::format("equilibrium ({}, {}): {}", part(each.x[0]), part(each.x[1]), kind_of(each, digits));
    if (each.kind == "degenerate" && each.index) text += fmt::format(", index {}", *each.index);
    text += '\n';
  }
  for (const auto& [name, matrix] : reversors) {
    const bool first = name == reversors.front().name;
    text += fmt::format("{:<12}(u, v) -> {}, t -> -t{}\n", first ? "reversor" : "", name,
                        first ? ", compared at points within the same bounds" : "");
  }
  return text;
}

/// Returns the canonical coordinates that the answer shows. For (2.6) they are v/u and ln v; on an axis their limits.
PlanarCanonical shown_canonical(const PlanarReduction& plane, const Vector2d& x) {
  const reduction::Flow* flow = plane.flow();
  if (flow == nullptr) {
    PlanarCanonical there = plane.canonical(x);
    there.dp_dq += 0.0;  // the additions turn -0 into 0
    return there;
  }
  const double q = x[0] == 0 ? infinity : x[1] / x[0] + 0.0;
  const bool limit = q == 0 || std::isinf(q);
  return {q, std::log(x[1]), limit ? infinity : reduction::separated_slope(flow->system(), q)};
}

/// The names of rays and coordinates in an answer.
struct ScalingNames {
  const char* ray;           ///< member of JSON
  std::string_view on_ray;   ///< before the number of a ray
  std::string_view q, of_q;  ///< before and after the value of q
  std::string_view p, integral;
  double PlanarRay::*number;
  double least_ray, largest_ray;  ///< range of q of the rays that are shown
};
constexpr ScalingNames names_of_motion{"k",           "k = ", "v/u = ", "", "ln v = ", "ln |u| - ln w(k)",
                                       &PlanarRay::k, 0,      pi / 2};
constexpr ScalingNames names_of_system{"angle",    "at the angle ", "",        " (angle)", "",
                                       "p - L(q)", &PlanarRay::q,   -infinity, infinity};

/// Adds to the answer a solution by a scaling.
void add_scaling(Answer& answer, const ScalingNames& names, const PlanarReduction& plane, const Vector2d& start,
                 bool at_centre) {
  const auto canonical = shown_canonical(plane, start);
  std::optional<double> integral;
  try {
    if (!at_centre) integral = plane.first_integral(start);
  } catch (const std::domain_error&) {
    // a start on a ray has no first integral, so `integral` stays empty
  }
  std::vector<PlanarRay> shown = plane.rays();
  std::erase_if(shown, [&](const PlanarRay& ray) { return ray.q < names.least_ray || ray.q > names.largest_ray; });
  Json rays = Json::array();
  for (const PlanarRay& ray : shown) {
    rays.push_back({{names.ray, ray.*names.number}, {"attracts", ray.attracts}});
    if (plane.flow() != nullptr) continue;
    rays.back().update({{"to_centre", ray.to_centre},
                        {"radial", ray.radial},
                        {"angular", or_infinity(ray.angular)},
                        {"order", ray.order}});
  }
  Json& members = answer.members;
  if (!at_centre) {
    members["canonical"] = {{"q", canonical.q}, {"p", canonical.p}, {"dp_dq", or_infinity(canonical.dp_dq)}};
  }
  if (integral) members["first_integral"] = *integral;
  const std::string_view kind = plane.kind();
  members.update({{"rays", rays}, {"kind", kind.empty() ? Json() : Json(kind)}});
  if (!plane.undecided().empty()) members["undecided"] = plane.undecided();
  if (plane.turn()) members["turn"] = {{"factor", plane.turn()->factor}, {"sigma", plane.turn()->sigma}};
  const bool rests = at_centre && plane.end(plane.centre()) == PlanarEnd::centre;
  if (rests) members.update({{"end", name(PlanarEnd::centre)}, {"tau_stop", 0.0}});
  if (integral && (plane.flow() != nullptr || (!kind.empty() && kind != "bordered"))) {
    answer.numbers = [=] { return Answer{.members = strip_members(plane, start)}; };
  }
  add_text(answer, [=](const Digits& digits) {
    std::string lines =
        fmt::format("centre      ({}, {}): {}\n", digits(plane.centre()[0]), digits(plane.centre()[1]),
                    plane.kind().empty() ? "not decided, as " + plane.undecided() : std::string(plane.kind()));
    for (const PlanarRay& ray : shown) {
      lines +=
          fmt::format("ray         {}{}{}: {}, the motion on it goes {}\n", names.on_ray, digits(ray.*names.number),
                      ray.order == 2   ? ", double"
                      : ray.order == 3 ? ", triple"
                                       : "",
                      ray.attracts     ? "attracts"
                      : ray.order == 2 ? "attracts on one side, repels on the other"
                                       : "repels",
                      ray.radial == 0 ? "nowhere: its points are at rest"
                      : ray.to_centre ? "to the centre"
                                      : "away");
    }
    if (plane.turn()) {
      lines += fmt::format("a turn      multiplies exp(p) by {} in {} of sigma, d sigma = exp(-c p) dt\n",
                           digits(plane.turn()->factor), digits(plane.turn()->sigma));
    }
    if (at_centre) return lines + (rests ? "tau_stop    0: the start is the centre\n" : "");
    lines += fmt::format("canonical   q = {}{}{}, p = {}{}, dp/dq = {}\n", names.q, digits(canonical.q), names.of_q,
                         names.p, digits(canonical.p), digits(canonical.dp_dq));
    if (!integral) {
      return lines +
             "integral    none: the start is on the ray, which the symmetry moves along itself, or on a border\n";
    }
    return lines + fmt::format("integral    {} = {}\n", names.integral, digits(*integral));
  });
}

/// Adds to the answer the reduction as formulas.
void add_steps(Answer& answer, const Steps& steps) {
  const auto& c = steps.coordinates;
  const std::string where = steps.integral ? steps.where() : "";
  answer.members.update({{"variables", {steps.names[0], steps.names[1]}},
                         {"equation", steps.kinds},
                         {"steps",
                          {{"q", c ? Json(steps.text(c->q)) : Json()},
                           {"p", c ? Json(steps.text(c->p)) : Json()},
                           {"separated", c ? Json(steps.separated()) : Json()}}},
                         {"integral_formula", steps.integral ? Json(steps.text(steps.integral->H)) : Json()},
                         {"integral_where", where.empty() ? Json() : Json(where)}});
}

/// Adds to the answer a solution by the inverse integrating factor V, for a system without a scaling.
void add_factor(Answer& answer, const PlanarReduction& plane, const Steps& steps) {
  const std::string_view divided = plane.tried().back().cleared ? " divided by the denominator" : "";
  const std::string_view form = plane.form();
  const std::string_view shown = form == "basis" ? "a sum of the basis" : form == "affine" ? "f ^ X, X affine" : form;
  const std::string v = fmt::format("{}{}", shown, divided);
  const std::string factor = plane.formula();
  const std::string integral = steps.integral ? steps.integral->H.text(std::array<std::string, 2>{"u", "v"}) : "";
  Json& members = answer.members;
  members["factor"] = factor.empty() ? v + ", 1 at the start" : fmt::format("{}{}", factor, divided);
  if (!integral.empty()) members["integral"] = integral;
  members["kind"] = nullptr;
  std::string lines = fmt::format("solution    by quadrature along H = constant, dH = (u' dv - v' du)/V; V is {}\n", v);
  if (!factor.empty()) lines += fmt::format("            V = {}{}, up to a constant factor\n", factor, divided);
  if (!integral.empty()) lines += fmt::format("            H = {}\n", integral);
  add_text(answer, [=](const Digits&) { return lines; });
}

/// The difference of a solution from steps in time.
struct BySteps {
  double time, difference;
  double error;  ///< estimated error of the steps, from steps with another tolerance

  bool confirms() const {
    constexpr double margin = 10, rounding = 1e-11;
    return difference <= std::max(rounding, margin * error);
  }
};

/// Compares a solution with steps in time at a time. If it has no state there, it is compared at half the time, and so
/// on.
/// @param compared  returns the difference from the first motion, and that of the second motion from the first
std::optional<BySteps> by_steps(const PlanarReduction& plane, const Vector2d& start, double time,
                                const std::function<std::array<double, 2>(double time, const PlanarOrbit& steps,
                                                                          const PlanarOrbit& coarse)>& compared) {
  constexpr double coarser = 1e-11;
  const PlanarOrbit steps = reduction::by_steps(plane.field()).orbit(start);
  const PlanarOrbit coarse = reduction::by_steps(plane.field(), coarser).orbit(start);
  constexpr int halvings = 20;
  for (int i = 0; i <= halvings && time > 0; ++i, time /= 2) {
    try {
      const auto [difference, error] = compared(time, steps, coarse);
      if (std::isfinite(difference) && std::isfinite(error)) return BySteps{time, difference, error};
    } catch (const std::domain_error&) {
      // One of the motions does not reach this time.
    }
  }
  return std::nullopt;
}

/// Compares states at 95 % of a finite end time, after three periods, or else at t = 5. Their distance is divided by
/// the distance from 0 of the start or of the state by steps, whichever is farther from 0.
std::optional<BySteps> states_by_steps(const PlanarReduction& plane, const PlanarOrbit& orbit, const Vector2d& start) {
  constexpr double share = 0.95, usual = 5, periods = 3;
  const double time = orbit.period()                    ? periods * *orbit.period()
                      : std::isfinite(orbit.end_time()) ? share * orbit.end_time()
                                                        : usual;
  return by_steps(plane, start, time, [&](double t, const PlanarOrbit& steps, const PlanarOrbit& coarse) {
    const Vector2d here = orbit.at(t), there = steps.at(t), again = coarse.at(t);
    const double size = std::max(start.stableNorm(), there.stableNorm());
    return std::array{(here - there).stableNorm() / size, (again - there).stableNorm() / size};
  });
}

/// Compares H with C at t = 4, or before the steps leave the part of the plane in which H holds.
std::optional<BySteps> values_by_steps(const PlanarReduction& plane, const Steps& formulas, const Vector2d& start,
                                       double C) {
  constexpr double longest = 4;
  constexpr int samples = 64;
  return by_steps(plane, start, longest, [&](double t, const PlanarOrbit& steps, const PlanarOrbit& coarse) {
    for (int i = 1; i <= samples; ++i) {
      if (!formulas.holds_at(steps.at(t * i / samples))) return std::array{infinity, infinity};
    }
    const auto H = [&](const PlanarOrbit& orbit) {
      const Vector2d x = orbit.at(t);
      return formulas.integral->H({x[0], x[1]});
    };
    const double size = std::max(1., std::abs(C));
    return std::array{std::abs(H(steps) - C) / size, std::abs(H(coarse) - H(steps)) / size};
  });
}

/// The orbit of the start, its end, and the comparison with steps in time.
struct Followed {
  PlanarOrbit orbit;
  double error;  ///< relative error of the end time or of the period; 0 for an end that is not known
  std::optional<BySteps> stepped;

  bool refuted() const { return stepped && !stepped->confirms(); }

  /// Returns the reason why the end is not certain; empty if it is. Along unstable orbits, as y = x of
  /// y' = y^2 + 1 - x^2, rounding grows until another orbit is followed.
  std::string doubt(const Digits& digits) const {
    constexpr double most = 1e-6;
    const double difference = stepped ? std::max(stepped->difference, stepped->error) : 0;
    if (!refuted() && !(difference > most)) return "";
    return fmt::format("two computations of the orbit differ by {:.0e} after {}; rounding grows along it", difference,
                       digits(stepped->time));
  }
};

/// Adds to the answer the end of the orbit, and the comparison with steps in time.
Followed add_end(Answer& answer, const PlanarReduction& plane, const Vector2d& start) {
  Json& members = answer.members;
  const PlanarOrbit orbit = plane.orbit(start);
  const PlanarEnd end = orbit.end();
  const Followed followed{orbit, 0, states_by_steps(plane, orbit, start)};
  const auto& stepped = followed.stepped;
  const bool doubtful = !followed.doubt({6}).empty();
  const bool unknown = end == PlanarEnd::border || end == PlanarEnd::undecided || doubtful;
  const double tau_stop = end == PlanarEnd::centre ? orbit.end_time() : infinity;
  const bool named = !doubtful && std::ranges::count(named_ends(), name(end)) > 0;
  members.update({{"end", named ? Json(name(end)) : Json()}, {"tau_stop", unknown ? Json() : Json(tau_stop)}});
  if (std::isfinite(orbit.end_time()) && end != PlanarEnd::undecided && !doubtful)
    members["end_time"] = orbit.end_time();
  const double error = unknown ? 0 : plane.end_time_error(start, orbit);
  if (error > 0) members["accuracy"] = error;
  if (orbit.period() && !doubtful) members["period"] = *orbit.period();
  if (doubtful) {
    members["undecided"] = followed.doubt({6});
  } else if (!orbit.undecided().empty()) {
    members["undecided"] = orbit.undecided();
  }
  members["by_steps"] = stepped ? Json{{"difference", stepped->difference},
                                       {"time", stepped->time},
                                       {"error", stepped->error},
                                       {"confirmed", stepped->confirms()}}
                                : Json();
  const bool refuted = followed.refuted();
  const auto end_text = [=](const Digits& digits) -> std::string {
    if (doubtful) return fmt::format("tau_stop    not decided: {}\n", followed.doubt(digits));
    if (end == PlanarEnd::border) {
      const double at = orbit.end_time();
      return fmt::format("tau_stop    not known: the orbit comes to a border of the field, a pole or a jump{}\n",
                         std::isfinite(at) ? fmt::format(", after {}", digits(at)) : "");
    }
    if (end == PlanarEnd::undecided) return fmt::format("tau_stop    not decided: {}\n", orbit.undecided());
    const double time = orbit.end_time();
    const auto words = [&]() -> std::string {
      switch (end) {
        case PlanarEnd::centre:
          return std::isfinite(time) ? fmt::format(", by quadrature; relative error below {:.0e}", error)
                                     : ": it nears the centre for ever";
        case PlanarEnd::periodic:
          return fmt::format(": it returns after {}; relative error below {:.0e}", digits(orbit.period().value()),
                             error);
        case PlanarEnd::rest:
          return std::isfinite(time)
                     ? fmt::format(": it comes to rest elsewhere, after {}; relative error below {:.0e}", digits(time),
                                   error)
                     : ": it nears a point at rest for ever";
        case PlanarEnd::equilibrium:
          return ": it nears an equilibrium for ever";
        case PlanarEnd::cycle:
          return ": it nears a closed orbit for ever";
        default:
          return std::isfinite(time)
                     ? fmt::format(": it is at infinity after {}; relative error below {:.0e}", digits(time), error)
                     : ": it goes to infinity, for ever";
      }
    };
    return fmt::format("tau_stop    {}{}\n", digits(tau_stop), words());
  };
  add_text(answer, [=](const Digits& digits) {
    if (!stepped) return end_text(digits) + "by steps    not compared: one of the two gives no state\n";
    std::string text =
        fmt::format("by steps    at t = {} the state differs by {:.0e}\n", digits(stepped->time), stepped->difference);
    if (refuted) {
      text += fmt::format("            not confirmed: the error of the steps is only {:.0e}\n", stepped->error);
    }
    return end_text(digits) + text;
  });
  return {orbit, error, stepped};
}

/// Returns the equilibrium to which steps in time lead, forwards: they come so near that linear equations hold, and
/// all of their solutions tend to the equilibrium. Empty if there is none, or if it is not reached.
std::optional<Vector2d> sink_reached(const PlanarReduction& plane, const Vector2d& start) {
  constexpr double tolerance = 1e-12, near = 1e-6, about = 0.02, clear = 1e-4;
  constexpr int doublings = 40;
  constexpr std::size_t most_steps = 50'000;
  const PlanarOrbit steps = reduction::by_steps(plane.field(), tolerance, most_steps).orbit(start);
  const double speed = plane.field()(start).norm();
  double size = start.norm(), time = size / speed;
  try {
    for (int i = 0; i < doublings && std::isfinite(time); ++i, time *= 2) {
      const Vector2d x = steps.at(time), half = Vector2d::Constant(about * size);
      size = std::max(size, x.norm());
      if (plane.field()(x).norm() > clear * speed) continue;
      for (const reduction::Equilibrium& each : find_equilibria(plane.field(), x - half, x + half).points) {
        if (!each.eigenvalues || (x - each.x).norm() > near * size) continue;
        const auto [first, second] = *each.eigenvalues;
        if (std::max(first.real(), second.real()) < -clear * each.slopes.norm()) return each.x;
      }
    }
  } catch (const std::domain_error&) {
    // The steps do not follow the motion so far.
  }
  return std::nullopt;
}

/// Writes the reduction as it stands on a blackboard, in the letters of the equation.
class Blackboard {
 public:
  Blackboard(const FormulaField& system, const Steps& steps, const Digits& digits)
      : type_(system.equations), time_(system.independent), steps_(steps), digits_(digits) {}

  void add(std::string_view name, const std::string& line) { text_ += fmt::format("{:<13}{}\n", name, line); }

  void add_kinds() {
    using Type = FormulaField::Equations;
    const std::string_view order = type_ == Type::first    ? "first order"
                                   : type_ == Type::second ? "second order"
                                                           : "system";
    // The kinds of the orbits stand last, and their prefix once.
    std::vector<std::string> kinds = steps_.kinds;
    const auto is_of_orbits = [](const std::string& kind) { return kind.starts_with(of_orbits); };
    for (auto kind = std::ranges::find_if(kinds, is_of_orbits); kind != kinds.end() && ++kind != kinds.end();)
      kind->erase(0, of_orbits.size());
    add("equation", fmt::format("{}{}{}", order, kinds.empty() ? "" : ": ", fmt::join(kinds, "; ")));
  }

  /// @param X  the generator as text, for a symmetry without coordinates; empty if there is none
  void add_coordinates(const std::string& X) {
    if (!steps_.coordinates) {
      if (X.empty()) return;
      add("symmetry", "X = " + X);
      add("coordinates", "q is the angle about the centre, p the logarithm of the distance, both scaled by X");
      return;
    }
    const Coordinates& c = *steps_.coordinates;
    add("symmetry", c.symmetry);
    add("coordinates", fmt::format("{} = {},  {} = {}", steps_.names[2], shown(c.q), steps_.names[3], shown(c.p)));
    add("separated", steps_.separated(digits_.count));
    if (c.dt_dp) add("time", fmt::format("d{}/d{} = {}", time_, steps_.names[3], shown(*c.dt_dp)));
  }

  /// @param method  words for a solution without a formula
  /// @param form    form of the inverse integrating factor, if this is the method
  /// @param C       value of H along the orbit, if it is known; else infinity or NaN
  /// @param extent  values of x at which y is on the branch
  void add_solution(double C, const std::string& method, std::string_view form, const Extent& extent) {
    if (steps_.integral) {
      const std::string where = steps_.where();
      std::vector<std::string> jumps;
      for (const Expression& place : steps_.jumps()) jumps.push_back(shown(place) + " = 0");
      add("solution",
          fmt::format("{} = C{}{}{}", shown(steps_.integral->H),
                      std::isfinite(C) ? ",  C = " + digits_(C) : std::string(), where.empty() ? "" : ",  for " + where,
                      jumps.empty() ? "" : fmt::format(";  C jumps where {}", fmt::join(jumps, ", "))));
      if (steps_.branch) {
        const auto& [from, until] = extent;
        const std::string &x = steps_.names[0],
                          begin = std::isfinite(from) ? fmt::format("from {} = {}", x, digits_(from)) : "";
        const std::string end = std::isfinite(until)
                                    ? fmt::format("{}{}", begin.empty() ? "up to " + x + " = " : " to ", digits_(until))
                                    : "";
        add("", fmt::format("{} = {}{}{}{}", steps_.names[1], shown(*steps_.branch),
                            begin.empty() && end.empty() ? "" : ", ", begin, end));
      }
    } else {
      add("solution", method);
    }
    if (steps_.factor) {
      if (!steps_.coordinates || !steps_.integral)
        add("factor", fmt::format("V = {};  dH = {}", shown(*steps_.factor), differential()));
    } else if (!steps_.integral && !form.empty() && form != "scaling") {
      const bool of_u = form.ends_with(" u"), of_v = form.ends_with(" v");  // such as "quadratic in v"
      const std::string letter = of_u ? steps_.names[0] : of_v ? steps_.names[1] : "";
      add("factor", fmt::format("V is {}{}{}, as numbers;  dH = {}", form == "product" ? "a " : "",
                                form.substr(0, form.size() - (of_u || of_v)), letter, differential()));
    }
  }

  void add_constants() {
    std::vector<std::string> lines;
    const auto more = [](bool complete) { return complete ? "" : "; and so on"; };
    for (const auto& [y, stability] : steps_.constants.all) {
      lines.push_back(
          fmt::format("{} = {}{}{}", steps_.names[1], value(y), stability.empty() ? "" : " is ", stability));
    }
    if (!lines.empty()) add("constant", fmt::format("{}{}", fmt::join(lines, "; "), more(steps_.constants.complete)));
    lines.clear();
    for (const Expression& y : steps_.lost.all) lines.push_back(fmt::format("{} = {}", steps_.names[1], shown(y)));
    if (lines.empty()) return;
    add("lost", fmt::format("{}{}, where d{}/d{} = 0", fmt::join(lines, "; "), more(steps_.lost.complete),
                            steps_.names[2], steps_.names[3]));
  }

  void add_orbit(const Followed& followed, const Vector2d& start) {
    const auto& [orbit, error, stepped] = followed;
    if (!stepped && orbit.end() != PlanarEnd::rest) {
      add("check", "not compared: the solution or the steps give no state");
    } else if (stepped) {
      add("check", fmt::format("by steps to {}: differs by {:.0e}{}", at(start, stepped->time), stepped->difference,
                               followed.refuted() ? ", not confirmed" : ""));
    }
    const std::string doubt = followed.doubt(digits_);
    add("end", doubt.empty() ? end_of(orbit, start) : "not decided: " + doubt);
  }

  void add_sink(const Vector2d& x) { add("end", fmt::format("it tends to {}", place(x, x.norm()))); }

  /// Adds the places at which both right sides vanish.
  void add_equilibria(const reduction::Equilibria& equilibria) {
    if (type_ == FormulaField::Equations::first) return;
    constexpr std::size_t most = 9;
    const bool lists = equilibria.points.size() <= most;
    add("equilibria",
        count_of(equilibria, {steps_.names[0], steps_.names[1]}, digits_) + (lists ? "" : "; --details lists them"));
    if (!lists) return;
    for (const reduction::Equilibrium& each : equilibria.points) {
      add("equilibrium", fmt::format("{}: {}", place(each.x), kind_of(each, digits_)));
    }
  }

  /// Adds the parts of switching curves along which motions slide, at which they rest, or which they leave.
  void add_switching(const std::vector<portraits::SwitchingPart>& parts) {
    constexpr std::size_t most = 9;
    if (parts.size() > most) return add("switching", fmt::format("{} parts; --details lists them", parts.size()));
    for (const portraits::SwitchingPart& part : parts) {
      const auto [kind, ends] = words_of(part);
      constexpr double error = 100;  // of the ends, in units of rounding
      const double size = error * std::max(ends[0].norm(), ends[1].norm());
      add(kind, fmt::format("from {} to {}", place(ends[0], size), place(ends[1], size)));
    }
  }

  /// @param found  comparison of H with C
  void add_constancy(const BySteps& found, const Vector2d& start) {
    add("check", fmt::format("by steps to {}: C differs by {:.0e}{}", at(start, found.time), found.difference,
                             found.confirms() ? "" : ", not confirmed"));
  }

  const std::string& text() const { return text_; }

 private:
  /// Returns a number as a multiple of pi, with a root, or with digits.
  std::string value(double y) const {
    constexpr double most = 1000, rounding = 4e-16;
    constexpr int most_below = 6;
    for (int below = 1; below <= most_below; ++below) {
      const double times = std::rint(y * below / pi);
      if (times == 0 || std::abs(times) > most || std::abs(y * below - times * pi) > rounding * std::abs(y * below))
        continue;
      const std::string factor = times == 1 ? "" : times == -1 ? "-" : fmt::format("{}*", times);
      return fmt::format("{}pi{}", factor, below == 1 ? "" : fmt::format("/{}", below));
    }
    const Expression shown_as = exact(y);
    return shown_as.is(Expression::Kind::number) ? digits_(y) : shown(shown_as);
  }

  std::string shown(const Expression& e) const { return steps_.text(e, digits_.count); }

  /// @param size  length of which rounding makes 1e-13
  std::string place(Vector2d x, double size = 0) const {
    constexpr double rounding = 1e-13;
    x = (x.array().abs() < rounding * size).select(0., x);
    return fmt::format("{} = {}, {} = {}", steps_.names[0], digits_(x[0] + 0.0), steps_.names[1], digits_(x[1] + 0.0));
  }

  /// Returns the time as text; for y' = F(x, y) the time is x.
  std::string at(const Vector2d& start, double time) const {
    if (type_ == FormulaField::Equations::first) {
      constexpr double rounding = 1e-15;
      const double x = start[0] + time;
      return steps_.names[0] + " = " + digits_(std::abs(x) <= rounding * std::abs(start[0]) ? 0 : x);
    }
    return fmt::format("{} = {}", time_, digits_(time));
  }

  std::string differential() const {
    const auto& [x, y] = std::tie(steps_.names[0], steps_.names[1]);
    if (type_ == FormulaField::Equations::first) return fmt::format("(d{1} - {1}' d{0})/V", x, y);
    return fmt::format("({0}' d{1} - {1}' d{0})/V", x, y);
  }

  std::string end_of(const PlanarOrbit& orbit, const Vector2d& start) const {
    const bool first = type_ == FormulaField::Equations::first;
    const double time = orbit.end_time();
    const std::string when = std::isfinite(time) ? "at " + at(start, time) : "";
    switch (orbit.end()) {
      case PlanarEnd::centre:
        return std::isfinite(time) ? when + ": it reaches the centre" : tends_to(orbit, "the centre");
      case PlanarEnd::periodic:
        return "none: the orbit is closed, with the period " + digits_(orbit.period().value());
      case PlanarEnd::rest:
        return when.empty() && orbit.limit() == start ? "none: the start is at rest"
               : when.empty()                         ? tends_to(orbit, "rest")
                              : fmt::format("{}, {}: it comes to rest", when, place(orbit.at(time), start.norm()));
      case PlanarEnd::equilibrium:
        return tends_to(orbit, "an equilibrium");
      case PlanarEnd::cycle:
        return "it tends to a closed orbit";
      case PlanarEnd::infinity:
        // In a finite time y is infinite, so its slope is large before. Otherwise x alone grows.
        if (first && !(std::isfinite(time) && is_steep(orbit, time))) {
          const double limit = limit_of(orbit, start);
          return fmt::format(
              "{} grows for ever{}", steps_.names[0],
              std::isfinite(limit) ? fmt::format("; {} tends to {}", steps_.names[1], digits_(limit)) : "");
        }
        return first          ? fmt::format("{}: {} is infinite", when, steps_.names[1])
               : when.empty() ? "it tends to infinity"
                              : "it blows up " + when;
      case PlanarEnd::border: {
        if (!std::isfinite(time)) return "it comes to a border of the equation, a pole or a jump";
        constexpr double before = 1e-9;
        Vector2d x = orbit.limit();
        if (first) x[0] = start[0] + time;
        std::string reason;
        try {
          reason = steps_.broken_at(orbit.at(time * (1 - before)));
        } catch (const std::domain_error&) {
          // The last state is not known.
        }
        if (first && std::isinf(x[1])) {
          return fmt::format("{}: {} is infinite{}", when, steps_.names[1], reason.empty() ? "" : "; " + reason);
        }
        return fmt::format("at {}{}: {}", first ? "" : at(start, time) + ", ",
                           x.allFinite() ? place(x) : at(start, time),
                           reason.empty() ? "a pole or a jump of the equation" : reason);
      }
      default:
        return "not decided: " + orbit.undecided();
    }
  }

  /// Returns the limit of y; NaN if it is not known. Without x in F, it is the next constant solution.
  double limit_of(const PlanarOrbit& orbit, const Vector2d& start) const {
    const double limit = orbit.limit()[1];
    if (std::isfinite(limit) || std::ranges::count(steps_.kinds, "autonomous") == 0) return limit;
    const double slope = steps_.equation->slope({start[0], start[1]});
    double next = std::numeric_limits<double>::quiet_NaN();
    for (const ConstantSolution& each : steps_.constants.all) {
      if (slope == 0 ? each.y == start[1] : (each.y - start[1]) * slope > 0 && !((each.y - next) * slope > 0))
        next = each.y;
    }
    return next;
  }

  /// Returns "it tends to" the limit of the orbit, or to the words if the limit is not known.
  std::string tends_to(const PlanarOrbit& orbit, std::string_view words) const {
    const Vector2d limit = orbit.limit();
    return fmt::format("it tends to {}", limit.allFinite() ? place(limit, limit.norm()) : words);
  }

  bool is_steep(const PlanarOrbit& orbit, double time) const {
    constexpr double before = 1e-6, steep = 1e3;
    try {
      const Vector2d x = orbit.at(time * (1 - before));
      return !steps_.equation || std::abs(steps_.equation->slope({x[0], x[1]})) > steep;
    } catch (const std::domain_error&) {
      return true;
    }
  }

  FormulaField::Equations type_;
  const std::string& time_;  ///< letter of the time
  const Steps& steps_;
  Digits digits_;
  std::string text_;
};

}  // namespace

std::vector<std::string_view> named_ends() {
  std::vector<std::string_view> names;
  for (int i = 0; i < reduction::planar_ends; ++i) {
    const auto end = static_cast<PlanarEnd>(i);
    // The end of an orbit that tends to a limit cycle has no name: the member `end` of the answer is null.
    if (end != PlanarEnd::undecided && end != PlanarEnd::cycle) names.push_back(name(end));
  }
  return names;
}

Answer reduce_answer(const FormulaField& system, const reduction::SmoothField& field, const std::string& text,
                     const std::optional<Vector2d>& given, bool details) {
  const auto has_value = [&](const Vector2d& x) {
    try {
      return field.value(x).allFinite();
    } catch (const std::exception&) {
      return false;
    }
  };
  if (given && !has_value(*given)) {
    throw BadInput("the field has no value at the start {} = {}, {} = {}: give a start where it has one",
                   system.variables[0], (*given)[0], system.variables[1], (*given)[1]);
  }
  // Without a start the equation is sampled about the first of these points at which it has a value.
  Vector2d start(1.3, 0.7);
  for (const Vector2d& each : {start, Vector2d(0.6, 0.45), Vector2d(1.7, 2.3), Vector2d(-0.6, 0.45)}) {
    if (!has_value(start)) start = each;
  }
  if (given) start = *given;
  const Vector2d around = reduction::sampled_about(field, start);
  const double size = around.lpNorm<Eigen::Infinity>();
  const PlanarSymmetries found = reduction::find_symmetries(field, around);
  const std::string& time = system.independent;
  Answer answer{.members = {{"system", text}}, .text = [=](const Digits& digits) {
                  const std::string sampled =
                      around == start ? "" : fmt::format("; the field is sampled at distances about {}", digits(size));
                  const std::string &x = system.variables[0], &y = system.variables[1];
                  const std::string letters =
                      x == "u" && y == "v" ? "" : fmt::format("letters     u is {}, v is {}, t is {}\n", x, y, time);
                  return fmt::format("system      {}\n{}{}u = {}, v = {}{}\n", text, letters,
                                     given ? "start       " : "sampled     about ", digits(start[0]), digits(start[1]),
                                     sampled);
                }};
  if (given) answer.members.update({{"u0", start[0]}, {"v0", start[1]}});
  answer.members["size"] = size;
  add_symmetries(answer, found, "t");
  const PlanarReduction plane = reduce(field, start, found);
  answer.members["form"] = plane.solved() ? Json(plane.form()) : Json();
  if (!plane.tried().empty()) {
    Json tried = Json::array();
    for (const auto& [form, value, gap, residual, cleared] : plane.tried()) {
      tried.push_back({{"form", form}, {"singular_value", or_infinity(value)}, {"gap", or_infinity(gap)}});
      if (cleared) tried.back()["cleared"] = true;
    }
    answer.members["tried"] = tried;
  }
  const reduction::Equilibria nearby = reduction::find_equilibria(field, around);
  reduction::Equilibria equilibria =
      system.equations == FormulaField::Equations::first ? nearby : widened(nearby, field, around, given.has_value());
  compare_kinds(equilibria, plane);
  const auto switching = portraits::switching_parts(field, nearby.low, nearby.high);
  portraits::leave_out_rests(equilibria, switching);
  answer.members.update(members_of_plane(equilibria));
  answer.members["switching"] = portraits::switching_member<Json>(switching);
  add_text(answer, [=](const Digits& digits) {
    std::string lines = text_of(plane.tried()) + text_of(equilibria, digits);
    for (const portraits::SwitchingPart& part : switching) {
      const auto [kind, ends] = words_of(part);
      lines += fmt::format("{:<12}from ({}, {}) to ({}, {})\n", kind, digits(ends[0][0]), digits(ends[0][1]),
                           digits(ends[1][0]), digits(ends[1][1]));
    }
    return lines;
  });

  const bool by_factor = plane.solved() && !plane.scaling();
  const bool cleared = by_factor && plane.tried().back().cleared;
  const bool of_basis = plane.form() == "basis";
  const std::string factor = by_factor && !of_basis ? plane.formula() : "";
  const Steps steps = steps_of(system, found, factor, cleared, given, around);
  add_steps(answer, steps);
  std::optional<Followed> followed;
  bool at_rest = false;
  if (plane.scaling()) {
    const bool at_centre = plane.scaling()->fixes(start);
    add_scaling(answer, names_of_system, plane, start, at_centre);
    at_rest = answer.members.contains("end");
    if (given && !at_rest) followed = add_end(answer, plane, at_centre ? plane.centre() : start);
  } else if (plane.solved()) {
    add_factor(answer, plane, steps);
    if (given) followed = add_end(answer, plane, start);
  } else if (const auto orbit = plane.orbit(start); given && orbit.end() == PlanarEnd::rest) {
    followed = Followed{orbit, 0, std::nullopt};
    answer.members.update({{"end", name(orbit.end())}, {"tau_stop", infinity}, {"end_time", orbit.end_time()}});
    add_text(answer, [orbit](const Digits& digits) {
      return fmt::format("tau_stop    inf: by steps it comes to rest elsewhere, after {}\n", digits(orbit.end_time()));
    });
  } else if (!found.generators.empty()) {
    add_text(answer, [why = words_of(plane.why_not())](const Digits&) {
      return fmt::format("solution    none by quadrature: {}\n", why);
    });
  }
  std::optional<reduction::LimitCycle> cycle;
  const PlanarEnd end = followed ? followed->orbit.end() : PlanarEnd::undecided;
  if (given && !plane.scaling() && (end == PlanarEnd::undecided || end == PlanarEnd::cycle)) {
    constexpr double reach = 20;
    for (reduction::LimitCycle& each : find_limit_cycles(field, equilibria, reach)) {
      if (!cycle && nears(field, each, start)) cycle = std::move(each);
    }
  }
  const auto sink = given && !followed && !cycle ? sink_reached(plane, start) : std::nullopt;
  if (sink) answer.members.update({{"end", name(PlanarEnd::equilibrium)}, {"tau_stop", infinity}});
  if (cycle) answer.members["cycle"] = portraits::cycle_members<Json>(*cycle);
  const Extent extent = steps.branch ? steps.extent(start, followed ? start[0] + followed->orbit.end_time() : infinity)
                                     : Extent{-infinity, infinity};
  if (system.equations == FormulaField::Equations::first) {
    answer.members["constant_solutions"] = Json::array();
    for (const auto& [y, stability] : steps.constants.all) {
      answer.members["constant_solutions"].push_back(
          {{"y", y}, {"stability", stability.empty() ? Json() : Json(stability)}});
    }
    answer.members["lost_solutions"] = Json::array();
    for (const Expression& y : steps.lost.all) answer.members["lost_solutions"].push_back(steps.text(y));
  }
  // A constant solution is no member of the family H = C, even where H has a value on it, as asin(y) - x for y = 1.
  const bool is_constant = std::ranges::any_of(steps.constants.all, [&](const ConstantSolution& each) {
    constexpr double rounding = 1e-14;
    return std::abs(start[1] - each.y) <= rounding * std::abs(each.y);
  });
  const double C =
      steps.integral && given && !is_constant ? steps.constant(start, [&] { return plane.orbit(start); }) : infinity;
  const auto constant = !followed && std::isfinite(C) ? values_by_steps(plane, steps, start, C) : std::nullopt;
  answer.text = [=, numbers = answer.text](const Digits& digits) {
    Blackboard board(system, steps, digits);
    board.add_kinds();
    const bool has_centre = plane.scaling() != nullptr;
    std::string X;
    if (!found.generators.empty() && has_centre) {
      Generator shown = found.generators.front();
      if (system.equations == FormulaField::Equations::first) shown.time = 0;  // x is the time
      X = text_of(shown, system.independent, digits, system.variables[0], system.variables[1]);
    }
    board.add_coordinates(X);
    const std::string method = has_centre       ? "by quadrature: p - L(q) = C, where p = L(q) is one orbit"
                               : plane.solved() ? "by quadrature along H = C"
                                                : "none by quadrature: " + words_of(plane.why_not());
    board.add_solution(C, method, plane.form(), extent);
    board.add_constants();
    if (at_rest) {
      board.add("end", "the start is the centre");
    } else if (followed) {
      board.add_orbit(*followed, start);
    } else if (constant) {
      board.add_constancy(*constant, start);
    } else if (is_constant && given) {
      board.add("end", "none: the start is on a constant solution");
    }
    if (sink) board.add_sink(*sink);
    if (cycle) {
      board.add("cycle", fmt::format("the orbit nears a limit cycle with the period {}{}", digits(cycle->period),
                                     std::isnan(cycle->multiplier) ? "" : "; multiplier " + digits(cycle->multiplier)));
    }
    board.add_equilibria(equilibria);
    board.add_switching(switching);
    return board.text() + (details ? numbers(digits) : "");
  };
  answer = finished(answer, found, plane.solved() || steps.integral);
  answer.passed &= !(followed && followed->refuted()) && !(constant && !constant->confirms());
  return answer;
}

Answer reduce_answer(const GivenStart& given) {
  const auto& [system, state, experiment, motion] = given;
  if (given.is_in_pieces()) {
    throw BadInput(
        "reduce is of one orbit, and rolling friction lets this ball turn for a part of its motion only: leave it out "
        "(--rolling-friction 0), or ask for --mu, --u0, --v0 with --drive");
  }
  if (given.at_rest()) throw BadInput("reduce needs a start other than rest: --u0 or --v0 must not be 0");
  const Vector2d start(state.u, state.v);
  const reduction::PlanarField field = reduction::planar_field(system);
  // Both speeds matter near k = 1, so samples lie there for every start. Scaling maps these samples to other speeds.
  const PlanarSymmetries found = reduction::find_symmetries(field, Vector2d(1 / system.mu(), 1));
  if (!found.scaling) {
    // The constructor of the law has tested that the law is homogeneous. Therefore only rounding can hide the scaling.
    throw std::runtime_error(fmt::format(
        "reduce: with mu = {} the scaling of (2.6) is lost in rounding, as u and v differ too much in how fast "
        "they change; stop, orbit and portrait take such a mu",
        system.mu()));
  }
  const PlanarReduction plane = reduction::reduced(given.flow());
  const double tau = plane.flow()->stop_time(state).tau;
  Answer answer{.members = {{"law", system.law().name()},
                            {"mu", system.mu()},
                            {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
                            {"u0", state.u},
                            {"v0", state.v}}};
  if (system.drive() > 0) answer.members["drive"] = system.drive();
  const double k = state.v / (system.mu() * std::abs(state.u)), r = system.r();
  add_text(answer, [=, system = system, state = state](const Digits& digits) {
    const double mu = system.mu(), chi = system.inertia().chi, gamma = system.inertia().gamma;
    const double sliding = 2 * chi / (3 * pi), pivoting = 2 * gamma * mu / (3 * pi);
    std::string text = fmt::format("system      law {}, mu = {}, chi = {}, gamma = {}, r = {}; k = v/({} |u|)\n",
                                   system.law().name(), digits(mu), digits(chi), digits(gamma), digits(r), digits(mu));
    text +=
        fmt::format("(2.6)       du/dtau = -{} Psi(k) sign(u),  dv/dtau = -{} {}\n", digits(pivoting), digits(sliding),
                    system.drive() > 0 ? fmt::format("(Phi(k) - {})", digits(system.drive())) : "Phi(k)");
    text += fmt::format("(2.7)       du/dbeta = W du/dtau,  dv/dbeta = W dv/dtau,  smooth at u = v = 0\n");
    text += fmt::format("(2.8)       dtau = W dbeta,  W = ({} |u| + {} v) ({} |u| + {} v)\n", digits(16 * mu),
                        digits(15 * pi), digits(8 * mu), digits(3 * pi));
    return text + fmt::format("start       u = {}, v = {}, k = {}\n", digits(state.u), digits(state.v), digits(k));
  });
  add_symmetries(answer, found, "tau");
  add_scaling(answer, names_of_motion, plane, start, false);

  Json routes = Json::array();
  const auto add_route = [&](std::string_view name, const std::function<double()>& time) {
    try {
      routes.push_back({{"name", name}, {"tau_stop", time()}});
    } catch (const std::exception& failure) {  // a stepper did not reach the stop
      routes.push_back({{"name", name}, {"failure", words_of(failure.what())}});
    }
  };
  const std::vector<reduction::Route> ways = reduction::routes(system);
  for (reduction::Route route : ways) {
    // The first route is quadrature or the closed form, which has already computed tau.
    add_route(name(route),
              [&] { return route == ways.front() ? tau : reduction::stop_time(given.system, given.state, route).tau; });
  }
  add_route("section", [&] {
    // Other quadrants mirror u, v > 0. Only a multiple zero of the angular rate on an axis needs both sides of it.
    const bool simple = std::ranges::all_of(plane.rays(), [](const PlanarRay& ray) { return ray.order == 1; });
    const auto quadrant = [&](const Vector2d& x) -> Vector2d {
      return simple && x.minCoeff() < 0 ? Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()) : field(x);
    };
    const Vector2d there = start.cwiseAbs();
    return PlanarReduction(quadrant, *found.scaling, there, found.residual).end_time(there);
  });
  answer.members.update({{"tau_stop", tau}, {"routes", routes}});
  const bool closed = answer.members.contains("first_integral") && system.drive() == 0 &&
                      system.law().as<reduction::PadeLaw>() != nullptr && r < 2;
  add_text(answer, [=, state = state](const Digits& digits) {
    std::string text;
    if (closed) {
      const double a = r / (2 - r), b = a - r / (5 - r), A = 8 * (2 - r), B = 3 * pi * (5 - r);
      text = fmt::format("orbit       |u| k^-{} ({} + {} k)^{} = {}\n", digits(a), digits(A), digits(B), digits(b),
                         digits(std::exp(std::log(std::abs(state.u)) - a * std::log(k) + b * std::log(A + B * k))));
    }
    text += fmt::format("tau_stop    {}\n", digits(tau));
    for (const Json& route : routes) {
      const auto name = route.at("name").get<std::string>();
      if (route.contains("failure")) {
        text += fmt::format("  {:<12}none: {}\n", name, route.at("failure").get<std::string>());
      } else {
        const auto time = route.at("tau_stop").get<double>();
        text += fmt::format("  {:<12}{:.15g}, {}\n", name, time, difference(time, tau));
      }
    }
    return text;
  });
  return finished(answer, found, true);
}

namespace {

std::vector<FieldText> texts_of_symmetry() {
  return {
      {"JSON `generators` [{`time` c, `matrix` A, `shift` b, `within`}]; CSV `time`, `a11`, `a12`, `a21`, `a22`, `b1`, "
       "`b2`",
       "",
       "generator of the symmetry: c t d/dt + (A x + b) d/dx, with time t and x = (u, v). The solution uses the first "
       "one. within: part of the plane in which a generator holds, if not everywhere"},
      {"JSON `singular_values`", "",
       "singular values of the linear equations for c, A and b, divided by the largest one"},
      {"`level`, `gap`", "",
       "level: limit below which a singular value counts as 0 and gives a generator. gap: smallest of the larger "
       "values divided by level"},
      {"JSON `sampled_within` [U, V]", "",
       "the generators are compared with the equations at points with |u| <= U and |v| <= V"},
  };
}

}  // namespace

std::vector<FieldText> reduce_fields() {
  return joined(
      {{{"`law`, `mu`; JSON `body` {`chi`, `gamma`}", "", "law of friction, ratio mu, and inertia of the body"},
        {"`u0`, `v0`, `drive`", "speed, speed, 1", "u and v at the start, and force of --drive"}},
       texts_of_symmetry(),
       {{"JSON `canonical` {`q`, `p`, `dp_dq`}; CSV `q`, `p`, `dp_dq`", "",
         "coordinates q = v/u and p = ln v of the start, in which the symmetry only shifts p; slope dp/dq of the "
         "orbit"},
        {"`first_integral`", "",
         "number that stays constant along a motion: ln |u| - ln w(k), with a function w that the law determines"},
        {"JSON `rays` [{`k`, `attracts`}]", "",
         "rays v = k mu |u|; attracts: true if neighbouring orbits approach the ray"},
        {"`kind`", "", "type of the centre, such as stable node; bordered if v = 0 is not an orbit, as with a drive"},
        {"JSON `strip` [{`ln_k`, `p`, `u`, `v`, `tau_left`}]", "1, 1, speed, speed, speed",
         "states on the orbit of the start, before and after it; tau_left: time that is left until the stop"},
        {"JSON `copies` [{`factor`, `u0`, `v0`, `tau_stop`}]", "1, speed, speed, speed",
         "starts that the symmetry makes of this one: u and v times factor. Their p is larger by ln(factor)"},
        {"`tau_stop`", "speed", "time tau when slip and spin end"},
        {"JSON `routes` [{`name`, `tau_stop`, `failure`}]", "speed",
         "tau_stop by each numerical method; the one named section treats (2.6) like --system. failure: reason why a "
         "method gives no number"}}});
}

std::vector<FieldText> reduce_system_fields() {
  return joined(
      {{{"`system`", "", "equations as typed"},
        {"`u0`, `v0`, `size`", "",
         "u and v at the start; size: distance from the origin at which the equations are sampled"}},
       texts_of_symmetry(),
       {{"`form`, `factor`", "",
         "type of the solution: scaling, or the form of the inverse integrating factor V, or null without a solution. "
         "factor: V as a formula, up to a constant factor, or in words"},
        {"JSON `variables` [x, y]", "", "letters of the equations; u and v stand for them in the other fields"},
        {"JSON `until`", "",
         "state at the instant of --until: the time and the letters, with integral and by as in orbit --system"},
        {"JSON `equation` [...]", "", "all kinds of equation that hold; 'contensou help reduce' explains them"},
        {"JSON `steps` {`q`, `p`, `separated`}", "",
         "coordinates q and p as formulas in the typed letters, and the separated equation, such as dq/dp = tan(q), with the "
         "part of the plane in which it holds; "
         "null if the equation has no such symmetry"},
        {"`integral_formula`, `integral`", "",
         "constant of the motion H as a formula in the typed letters, and in u and v; null if no formula is found"},
        {"`integral_where`", "",
         "part of the plane in which this formula was checked, such as x > 0, y > 0; null for the plane"},
        {"JSON `tried` [{`form`, `singular_value`, `gap`, `cleared`}]", "",
         "forms of V in the order of the search, each with the smallest singular value of its equations and its gap. "
         "cleared: true if V was multiplied by the denominator of the equations"},
        {"JSON `canonical` {`q`, `p`, `dp_dq`}; CSV `q`, `p`, `dp_dq`", "",
         "coordinates of the start about the centre: angle q and logarithm p of the distance, scaled by the symmetry; "
         "slope dp/dq of the orbit"},
        {"`first_integral`", "",
         "number that stays constant along a motion: p minus the p of a fixed orbit at the same q"},
        {"JSON `rays` [{`angle`, `attracts`, `to_centre`, `radial`, `angular`, `order`}]", "",
         "half-lines from the centre that are orbits. attracts: true if neighbouring orbits approach the ray. "
         "to_centre: true if the motion on it goes to the centre. radial, angular: eigenvalues along and across the "
         "ray. order: 2 for a double ray"},
        {"`kind`, `undecided`", "",
         "type of the centre, or null; undecided: reason why a type or an end was not found"},
        {"every `kind`", "",
         fmt::format("{}; motions turn about a center, and a reversor, V or a scaling proves that they are closed",
                     fmt::join(reduction::planar_kinds, ", "))},
        {"JSON `equilibria` [{`u`, `v`, `kind`, `eigenvalues`, `index`}]", "",
         "isolated points at which u and v do not change. eigenvalues [[re, im], [re, im]] of the equations linearised "
         "there; null if kind is not smooth. index: turns of (u', v') on a small circle; null if not known"},
        {"JSON `equilibria_within` [[U1, U2], [V1, V2]], `equilibria_complete`, `equilibria_curve`", "",
         "within: ranges of u and v in which equilibria are sought and reversors compared, up to 2.5 max(|u0|, |v0|), "
         "or 8 or 64 times as far if none lies there. "
         "complete: false if the list may be short. curve: [u, v] of a point on a curve of equilibria, or null"},
        {"JSON `constant_solutions` [{`y`, `stability`}]", "",
         "solutions y = c of y' = F(x, y) that were found near the start. stability: null if F contains x"},
        {"JSON `lost_solutions`", "",
         "solutions of y' = F(x, y) on which dq/dp = 0 and that no C gives: y as a formula in x"},
        {"JSON `switching` [{`motion`, `u` [...], `v` [...]}]", "",
         "curves at which the equations jump and that motions do not cross: rests, slides (along the curve), or leaves "
         "(both sides point away, and the motion is not unique)"},
        {"JSON `reversors`", "",
         "reversors: maps of the plane that turn each motion into a motion backward in time, such as (u, -v)"},
        {"JSON `turn` {`factor`, `sigma`}", "",
         "for a spiral: distance from the centre after one turn divided by that before, and scaled time of the turn"},
        {"JSON `strip` [{`q`, `p`, `u`, `v`, `tau_left`}]", "",
         "states on the orbit of the start, before and after it, or on one turn of a spiral; tau_left: time that is "
         "left until the centre"},
        {"JSON `copies` [{`factor`, `u0`, `v0`, `tau_stop`}]", "",
         "starts that the symmetry makes of this one. Their p is larger by ln(factor)"},
        {"`tau_stop`", "",
         "time at which the motion reaches the centre. inf: the motion does not reach the centre. null: the motion "
         "comes to a border before, or its end was not found"},
        {"`end_time`", "", "time of the end, such as rest, a border or infinity; absent if it is not finite"},
        {"`accuracy`", "", "relative error of tau_stop, of period, or of the time at which the motion is at infinity"},
        {"`end`", "", "end of the motion"},
        {"every `end`", "", fmt::format("{}; null if the end was not found", fmt::join(named_ends(), ", "))},
        {"JSON `cycle` {`u`, `v`, `period`, `multiplier`, `stable`}", "",
         "limit cycle that the orbit nears: a point, the period, and the factor of a small distance in a turn; absent "
         "without one"},
        {"`period`", "", "time after which the motion returns to its start"},
        {"JSON `by_steps` {`difference`, `time`, `error`, `confirmed`}", "",
         "relative difference between this solution and an integration in time steps, at this time. error: estimated "
         "error of the steps. confirmed: false if the difference exceeds 1e-11 and ten times this error"}}});
}

}  // namespace contensou::answers
