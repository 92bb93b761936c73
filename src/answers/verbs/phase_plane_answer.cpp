#include "answers/verbs/plane_answers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "contensou/reduction/phase_plane.hpp"

namespace contensou::answers {

using reduction::InvariantDirection;
using reduction::InvariantRay;
using reduction::PhasePlane;
using reduction::ReducedSystem;
using reduction::SingularPoint;
using reduction::TerminalRatio;
using reduction::TerminalRatios;

namespace {

/// Returns the text that belongs to an enumerator.
template <class Enumeration>
std::string_view text_of(const std::array<std::string_view, 3>& texts, Enumeration place) {
  return texts[static_cast<std::size_t>(place)];
}

/// Names of the regimes, in the order of reduction::TerminalRegime.
constexpr std::array<std::string_view, 3> limits{"zero", "ray", "infinity"};
/// Words for the way in which orbits approach the origin, in the order of InvariantDirection.
constexpr std::array<std::string_view, 3> approaches{"along v = 0: k falls", "along the ray: k - k* falls",
                                                     "along u = 0: 1/k falls"};

std::string_view effect(const InvariantRay& ray) {
  return ray.attracts()       ? "attracts"
         : ray.attracts_above ? "attracts from above, repels below"
         : ray.attracts_below ? "attracts from below, repels above"
                              : "repels";
}

/// Returns the index of the limit of k that the largest sector of starts reaches. A sector is an angle of (mu |u|, v).
std::size_t usual_end(const TerminalRatios& ratios) {
  const auto sector = [](const TerminalRatio& end) { return std::atan(end.to) - std::atan(end.from); };
  return static_cast<std::size_t>(std::ranges::max_element(ratios.ends, {}, sector) - ratios.ends.begin());
}

/// A limit of k at the stop; and the relative error of this limit, k*, if it belongs to a ray.
struct End {
  TerminalRatio ratio;
  double accuracy;
};

End end_of(const TerminalRatios& ratios, const TerminalRatio& end) {
  const auto ray = std::ranges::find(ratios.rays, end.k, &InvariantRay::k);
  return {end, ray == ratios.rays.end() ? 0 : ray->accuracy};
}

constexpr Field<ReducedSystem> system_fields[]{
    {"law", "", "name of the law of friction", [](const ReducedSystem& system) -> Json { return system.law().name(); }},
    {"r", "", "number gamma mu^2/chi, which decides the limit of k",
     [](const ReducedSystem& system) -> Json { return system.r(); }},
    {"drive", "", "force of --drive. With a drive, r_high is the value of (Phi - drive)/(k Psi) at k = infinity",
     [](const ReducedSystem& system) -> Json { return system.drive() > 0 ? Json(system.drive()) : Json(); }},
    {"mu", "", "radius of the patch divided by the radius R of the body",
     [](const ReducedSystem& system) -> Json { return system.mu(); }, ""},
    {"body", "", "inertia of the body: chi = 1 + m R^2/J, gamma = m R^2/J_z",
     [](const ReducedSystem& system) -> Json {
       return {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}};
     },
     "", 0, " {`chi`, `gamma`}"},
};
constexpr Field<TerminalRatios> regime_fields[]{
    {"r_low", "", "value of Phi/(k Psi) at k = 0. If r is at most r_low, k tends to 0",
     [](const TerminalRatios& ratios) -> Json { return ratios.low; }},
    {"r_high", "", "value of Phi/(k Psi) at k = infinity. If r is at least r_high, k tends to infinity",
     [](const TerminalRatios& ratios) -> Json { return ratios.high; }},
};
constexpr Field<End> end_fields[]{
    {"limit", "",
     "limit of k for most starts: zero, infinity, or ray for a number between them. CSV has a row for each limit",
     [](const End& end) -> Json { return text_of(limits, end.ratio.regime); }},
    {"k_star", "", "limit of k as a number", [](const End& end) -> Json { return end.ratio.k; }},
    {"k_star_accuracy", "", "relative error of k_star", [](const End& end) -> Json { return end.accuracy; }, nullptr,
     1},
    {"k_from", "", "", [](const End& end) -> Json { return end.ratio.from; }},
    {"k_to", "", "smallest and largest k of the starts with this limit",
     [](const End& end) -> Json { return end.ratio.to; }},
};
constexpr Field<TerminalRatios> list_fields[]{
    {"rays", "",
     "values of k at which a half-line v = k mu |u| is the curve of a motion. attracts: true if neighbouring motions "
     "approach this half-line. accuracy: relative error of k",
     [](const TerminalRatios& ratios) {
       Json rays = Json::array();
       for (const InvariantRay& ray : ratios.rays) {
         rays.push_back({{"k", ray.k}, {"attracts", ray.attracts()}, {"accuracy", ray.accuracy}});
       }
       return rays;
     },
     "", 0, " [{`k`, `attracts`, `accuracy`}]"},
    {"ends", "", "all limits of k, each with the range k_from to k_to of its starts",
     [](const TerminalRatios& ratios) {
       Json ends = Json::array();
       for (const TerminalRatio& end : ratios.ends) ends.push_back(members_of(end_fields, end_of(ratios, end)));
       return ends;
     },
     "", 0, " [{`limit`, ...}]"},
};

/// Returns the half-line along which orbits with this limit of k enter the origin, its k, and the order of contact.
Json tangent_of(const PhasePlane& plane, std::size_t end) {
  const auto& [direction, k, order] = plane.tangents[end];
  return {{"half_line", name(direction)}, {"k", k}, {"contact_order", order}};
}

constexpr Field<SingularPoint> point_fields[]{
    {"half_line", "", "half-line of the point: u = 0, v = 0, or a ray v = k mu |u|",
     [](const SingularPoint& point) -> Json { return name(point.direction); }},
    {"place", "", "end of the half-line at which the point lies: origin or infinity",
     [](const SingularPoint& point) -> Json { return name(point.place); }},
    {"k", "", "ratio k on the half-line", [](const SingularPoint& point) -> Json { return point.k; }},
    {"q", "", "ratio v/|u| on the half-line", [](const SingularPoint& point) -> Json { return point.q; }},
    {"eigenvalues", "", "eigenvalues of (2.7) at the point, along the half-line and across it",
     [](const SingularPoint& point) -> Json {
       return {{"radial", point.radial}, {"angular", point.angular}};
     },
     nullptr, 0, " {`radial`, `angular`}"},
    {"kind", "", "type of the point, such as stable node or saddle",
     [](const SingularPoint& point) -> Json { return point.kind; }},
    {"separatrix", "", "true if the half-line is a separatrix, the curve of a motion that leads to a saddle or from it",
     [](const SingularPoint& point) -> Json { return point.kind == "saddle"; }},
};
constexpr Field<PhasePlane> plane_fields[]{
    {"mu_low", "", "mu at which the number r of this body is r_low; not with --drive",
     [](const PhasePlane& plane) -> Json { return plane.points.front().k == 0 ? Json(plane.mu_low) : Json(); }, ""},
    {"mu_high", "", "mu at which the number r of this body is r_high",
     [](const PhasePlane& plane) -> Json { return plane.mu_high; }, ""},
    {"tangent", "", "half-line along which most motions enter the origin",
     [](const PhasePlane& plane) { return tangent_of(plane, usual_end(plane.terminal))["half_line"]; }, ""},
    {"contact_order", "", "exponent n: motions leave this half-line like speed^n",
     [](const PhasePlane& plane) { return tangent_of(plane, usual_end(plane.terminal))["contact_order"]; }, ""},
    {"tangents", "", "half-line and power for each limit of k",
     [](const PhasePlane& plane) {
       Json tangents = Json::array();
       for (std::size_t i = 0; i < plane.tangents.size(); ++i) tangents.push_back(tangent_of(plane, i));
       return tangents;
     },
     "", 0, " [{`half_line`, `k`, `contact_order`}]"},
    {"singular_points", "",
     "singular points of (2.7), with the origin and infinity drawn as curves. portrait --facts writes each as a row of "
     "CSV",
     [](const PhasePlane& plane) {
       Json points = Json::array();
       for (const SingularPoint& point : plane.points) points.push_back(members_of(point_fields, point));
       return points;
     },
     "", 0, " [{`half_line`, `place`, `k`, `q`, `eigenvalues` {`radial`, `angular`}, `kind`, `separatrix`}]"},
};

std::string as_text(const ReducedSystem& system, const PhasePlane& plane, const Digits& digits) {
  const TerminalRatios& ratios = plane.terminal;
  const bool driven = system.drive() > 0;
  std::string text;
  if (ratios.ends.size() == 1) {
    const TerminalRatio& end = ratios.ends.front();
    text = fmt::format("k = v/(mu |u|) tends to {}: {}\n", digits(end.k), meaning(end.regime));
  } else {
    text = "k = v/(mu |u|) tends to one of several ratios; the k of the start tells which\n";
    for (const TerminalRatio& end : ratios.ends) {
      text +=
          fmt::format("{} < k < {}: to {}, {}\n", digits(end.from), digits(end.to), digits(end.k), meaning(end.regime));
    }
  }
  text += fmt::format(
      "\n"
      "law    {}\n"
      "r      {} = gamma mu^2/chi, gamma = {}, mu = {}, chi = {}\n"
      "{}\n",
      system.law().name(), digits(system.r()), digits(system.inertia().gamma), digits(system.mu()),
      digits(system.inertia().chi),
      driven ? fmt::format("drive  {} of f N, along the slip: v = 0 is no motion, from there a body creeps\n"
                           "rays   where (Phi - drive)/(k Psi) = r; it is {} at k = infinity, the r of mu = {}",
                           digits(system.drive()), digits(ratios.high), digits(plane.mu_high))
             : fmt::format("rays   v = k mu |u| where Phi/(k Psi) = r; it is {} at k = 0 and {} at k = infinity, "
                           "the r of {} < mu < {}",
                           digits(ratios.low), digits(ratios.high), digits(plane.mu_low), digits(plane.mu_high)));
  for (const InvariantRay& ray : ratios.rays) {
    text +=
        fmt::format("       k = {} {}, relative error of k below {:.0e}\n", digits(ray.k), effect(ray), ray.accuracy);
  }
  const TextTable::Column number = TextTable::right(digits.width());
  TextTable table({TextTable::left(11), TextTable::left(9), number, number, number, number});
  table.add({"half-line", "at", "k", "q = v/|u|", "radial", "angular", "  kind"});
  for (const SingularPoint& point : plane.points) {
    table.add({std::string(name(point.direction)), std::string(name(point.place)), digits(point.k), digits(point.q),
               digits(point.radial), digits(point.angular), fmt::format("  {}", point.kind)});
  }
  text += "\n" + table.text();
  text +=
      std::string(
          "\n"
          "radial, angular   eigenvalues of (2.7) in |u| and q = v/|u| (at u = 0 in v and |u|/v), divided by |u| (v);\n"
          "                  at infinity 1/|u| (1/v) is the radial coordinate. (2.7) has no linear part at the origin\n"
          "kind              a half-line is a separatrix of its saddle; u < 0 is the mirror image\n") +
      fmt::format("every other orbit is born at infinity in an unstable node{} and enters the origin\n",
                  driven ? ", or begins at v = 0," : "");
  for (std::size_t i = 0; i < plane.tangents.size(); ++i) {
    const auto& [direction, k, order] = plane.tangents[i];
    const auto& end = ratios.ends[i];
    const std::string_view speed = direction == InvariantDirection::sliding ? "v" : "|u|";
    text += fmt::format("from {} < k < {} {}{}\n", digits(end.from), digits(end.to), text_of(approaches, direction),
                        order > 0 ? fmt::format(" like {}^{}", speed, digits(order))
                                  : fmt::format(" slower than any power of {}", speed));
  }
  return text;
}

}  // namespace

Answer phase_plane_answer(const ReducedSystem& system, PlaneRows rows) {
  const PhasePlane plane = reduction::phase_plane(system);
  const TerminalRatios& ratios = plane.terminal;
  Answer answer{.members = members_of(system_fields, system),
                .text = [=](const Digits& digits) { return as_text(system, plane, digits); }};
  answer.members.update(members_of(regime_fields, ratios));
  // The limit with the largest sector precedes the list of all limits.
  answer.members.update(members_of(end_fields, end_of(ratios, ratios.ends[usual_end(ratios)])));
  answer.members.update(members_of(list_fields, ratios));
  answer.members.update(members_of(plane_fields, plane));
  if (rows == PlaneRows::points) {
    for (const SingularPoint& point : plane.points) answer.rows.push_back(row_of(point_fields, point));
    return answer;
  }
  for (const TerminalRatio& end : ratios.ends) {
    Json& row = answer.rows.emplace_back(row_of(system_fields, system));
    row.update(row_of(regime_fields, ratios));
    row.update(row_of(end_fields, end_of(ratios, end)));
  }
  return answer;
}

std::vector<FieldText> terminal_fields() {
  return joined({texts_of(system_fields), texts_of(regime_fields), texts_of(end_fields), texts_of(list_fields),
                 texts_of(plane_fields)});
}

std::vector<FieldText> phase_plane_fields() {
  return joined({{{"JSON `law`, `r`, `drive`, `mu`, `body`, `r_low`, `r_high`, `limit`, `k_star`, `k_star_accuracy`, "
                   "`k_from`, `k_to`, `rays`, `ends`, `mu_low`, `mu_high`, `tangent`, `contact_order`, `tangents`, "
                   "`singular_points`",
                   "", "fields as in terminal"}},
                 texts_of(point_fields)});
}

}  // namespace contensou::answers
