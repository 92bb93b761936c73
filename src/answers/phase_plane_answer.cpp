#include "answers/phase_plane_answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "contensou/reduction/phase_plane.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::answers {

using reduction::InvariantDirection;
using reduction::InvariantRay;
using reduction::PhasePlane;
using reduction::ReducedSystem;
using reduction::SingularPoint;
using reduction::TerminalRatio;
using reduction::TerminalRatios;

namespace {

/// Of something that has a place in an enumeration.
template <class Enumeration>
std::string_view text_of(const std::array<std::string_view, 3>& texts, Enumeration place) {
  return texts[static_cast<std::size_t>(place)];
}

/// In the order of TerminalRegime.
constexpr std::array<std::string_view, 3> limits{"zero", "ray", "infinity"};
/// In the order of InvariantDirection: what tends to what along an orbit that enters the origin.
constexpr std::array<std::string_view, 3> approaches{"along v = 0: k falls", "along the ray: k - k* falls",
                                                     "along u = 0: 1/k falls"};

std::string_view effect(const InvariantRay& ray) {
  return ray.attracts()       ? "attracts"
         : ray.attracts_above ? "attracts from above, repels below"
         : ray.attracts_below ? "attracts from below, repels above"
                              : "repels";
}

/// The end of the largest sector of starts, by the angle of (mu |u|, v).
std::size_t usual_end(const TerminalRatios& ratios) {
  const auto sector = [](const TerminalRatio& end) { return std::atan(end.to) - std::atan(end.from); };
  return static_cast<std::size_t>(std::ranges::max_element(ratios.ends, {}, sector) - ratios.ends.begin());
}

/// r_low, r_high, rays and ends; of each end limit, k_star with its relative error, k_from and k_to. These five stand
/// before them, too, for the usual end.
Json members_of(const TerminalRatios& ratios) {
  Json rays = Json::array(), ends = Json::array();
  for (const InvariantRay& ray : ratios.rays) {
    rays.push_back({{"k", ray.k}, {"attracts", ray.attracts()}, {"accuracy", ray.accuracy}});
  }
  for (const TerminalRatio& end : ratios.ends) {
    const auto ray = std::ranges::find(ratios.rays, end.k, &InvariantRay::k);
    ends.push_back({{"limit", text_of(limits, end.regime)},
                    {"k_star", end.k},
                    {"k_star_accuracy", ray == ratios.rays.end() ? 0.0 : ray->accuracy},
                    {"k_from", end.from},
                    {"k_to", end.to}});
  }
  Json members{{"r_low", ratios.low}, {"r_high", ratios.high}};
  members.update(ends[usual_end(ratios)]);
  members.update({{"rays", rays}, {"ends", ends}});
  return members;
}

/// The law, what r is made of, and where there are rays.
std::string heading(const ReducedSystem& system, const TerminalRatios& ratios, std::string_view rays,
                    const Digits& digits) {
  return fmt::format(
      "law    {}\n"
      "r      {} = gamma mu^2/chi, gamma = {}, mu = {}, chi = {}\n"
      "rays   {}where Phi/(k Psi) = r; it is {} at k = 0 and {} at k = infinity",
      system.law().name(), digits(system.r()), digits(system.inertia().gamma), digits(system.mu()),
      digits(system.inertia().chi), rays, digits(ratios.low), digits(ratios.high));
}

std::string as_text(const ReducedSystem& system, const TerminalRatios& ratios, const Digits& digits) {
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
  text += "\n" + heading(system, ratios, "", digits) + "\n";
  for (const InvariantRay& ray : ratios.rays) {
    text +=
        fmt::format("       k = {} {}, relative error of k below {:.0e}\n", digits(ray.k), effect(ray), ray.accuracy);
  }
  return text;
}

std::string as_text(const ReducedSystem& system, const PhasePlane& plane, const Digits& digits) {
  std::string text =
      fmt::format("{}, the r of {} < mu < {}\n\n", heading(system, plane.terminal, "v = k mu |u| ", digits),
                  digits(plane.mu_low), digits(plane.mu_high));
  const auto line = [&](auto direction, auto place, const std::array<std::string, 4>& numbers, auto kind) {
    text += fmt::format("{:<11}{:<9}", direction, place);
    for (const std::string& number : numbers) text += fmt::format("{:>{}}", number, digits.width());
    text += fmt::format("  {}\n", kind);
  };
  line("half-line", "at", {"k", "q = v/|u|", "radial", "angular"}, "kind");
  for (const SingularPoint& point : plane.points) {
    line(name(point.direction), name(point.place),
         {digits(point.k), digits(point.q), digits(point.radial), digits(point.angular)}, name(point.kind));
  }
  text +=
      "\n"
      "radial, angular   eigenvalues of (2.7) in |u| and q = v/|u| (at u = 0 in v and |u|/v), divided by |u| (v);\n"
      "                  at infinity 1/|u| (1/v) is the radial coordinate. (2.7) has no linear part at the origin\n"
      "kind              a half-line is a separatrix of its saddle; u < 0 is the mirror image\n"
      "every other orbit is born at infinity in an unstable node and enters the origin\n";
  for (std::size_t i = 0; i < plane.tangents.size(); ++i) {
    const auto& [direction, k, order] = plane.tangents[i];
    const auto& end = plane.terminal.ends[i];
    const std::string_view speed = direction == InvariantDirection::sliding ? "v" : "|u|";
    text += fmt::format("from {} < k < {} {}{}\n", digits(end.from), digits(end.to), text_of(approaches, direction),
                        order > 0 ? fmt::format(" like {}^{}", speed, digits(order))
                                  : fmt::format(" slower than any power of {}", speed));
  }
  return text;
}

}  // namespace

Answer terminal_answer(const ReducedSystem& system) {
  const TerminalRatios ratios = reduction::terminal_ratios(system.law(), system.r());
  Answer answer{.members = {{"law", system.law().name()}, {"r", system.r()}},
                .text = [=](const Digits& digits) { return as_text(system, ratios, digits); }};
  answer.members.update(members_of(ratios));
  for (const Json& end : answer.members["ends"]) {
    answer.rows.push_back(
        {{"law", system.law().name()}, {"r", system.r()}, {"r_low", ratios.low}, {"r_high", ratios.high}});
    answer.rows.back().update(end);
    answer.rows.back().erase("k_star_accuracy");
    answer.rows.back()["k_star_accuracy"] = end["k_star_accuracy"];
  }
  return answer;
}

Answer phase_plane_answer(const ReducedSystem& system) {
  const PhasePlane plane = reduction::phase_plane(system);
  Answer answer{.text = [=](const Digits& digits) { return as_text(system, plane, digits); }};
  for (const SingularPoint& point : plane.points) {
    answer.rows.push_back({{"half_line", name(point.direction)},
                           {"place", name(point.place)},
                           {"k", point.k},
                           {"q", point.q},
                           {"eigenvalues", {{"radial", point.radial}, {"angular", point.angular}}},
                           {"kind", name(point.kind)},
                           {"separatrix", point.kind == reduction::SingularKind::saddle}});
  }
  Json tangents = Json::array();
  for (const auto& [direction, k, order] : plane.tangents) {
    tangents.push_back({{"half_line", name(direction)}, {"k", k}, {"contact_order", order}});
  }
  const Json& usual = tangents[usual_end(plane.terminal)];
  answer.members = {{"law", system.law().name()},
                    {"mu", system.mu()},
                    {"body", {{"chi", system.inertia().chi}, {"gamma", system.inertia().gamma}}},
                    {"r", system.r()}};
  answer.members.update(members_of(plane.terminal));
  answer.members.update({{"mu_low", plane.mu_low},
                         {"mu_high", plane.mu_high},
                         {"tangent", usual["half_line"]},
                         {"contact_order", usual["contact_order"]},
                         {"tangents", tangents},
                         {"singular_points", answer.rows}});
  return answer;
}

}  // namespace contensou::answers
