#include "verbs/phase_plane_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "output/columns.hpp"
#include "output/json.hpp"

namespace contensou::program {

using reduction::InvariantDirection;
using reduction::PhasePlane;
using reduction::ReducedSystem;
using reduction::SingularKind;
using reduction::SingularPoint;
using reduction::TerminalRatio;
using reduction::TerminalRatios;

namespace {

/// In the order of InvariantDirection: what tends to what along an orbit that enters the origin.
constexpr std::array<std::string_view, 3> approaches{"along v = 0: k falls", "along the ray: k - k* falls",
                                                     "along u = 0: 1/k falls"};

/// The end of the largest sector of starts, by the angle of (mu |u|, v).
std::size_t usual_end(const TerminalRatios& ratios) {
  const auto sector = [](const TerminalRatio& end) { return std::atan(end.to) - std::atan(end.from); };
  return static_cast<std::size_t>(std::ranges::max_element(ratios.ends, {}, sector) - ratios.ends.begin());
}

bool is_separatrix(const SingularPoint& point) { return point.kind == SingularKind::saddle; }

}  // namespace

std::string_view limit_name(reduction::TerminalRegime regime) {
  constexpr std::array<std::string_view, 3> names{"zero", "ray", "infinity"};
  return names[static_cast<std::size_t>(regime)];
}

void add_terminal_ratios(JsonObject& document, const TerminalRatios& ratios) {
  std::vector<std::string> rays, ends;
  for (const reduction::InvariantRay& ray : ratios.rays) {
    rays.push_back(JsonObject()
                       .add("k", json(ray.k))
                       .add("attracts", ray.attracts() ? "true" : "false")
                       .add("accuracy", json(ray.accuracy))
                       .inline_text());
  }
  const auto add = [&](JsonObject& object, const TerminalRatio& end) {
    object.add("limit", json(limit_name(end.regime)))
        .add("k_star", json(end.k))
        .add("k_star_accuracy", json(accuracy_of(end, ratios)))
        .add("k_from", json(end.from))
        .add("k_to", json(end.to));
  };
  for (const TerminalRatio& end : ratios.ends) {
    JsonObject object;
    add(object, end);
    ends.push_back(object.inline_text());
  }
  document.add("r_low", json(ratios.low)).add("r_high", json(ratios.high));
  add(document, ratios.ends[usual_end(ratios)]);
  document.add("rays", json_array(rays)).add("ends", json_array(ends));
}

double accuracy_of(const TerminalRatio& end, const TerminalRatios& ratios) {
  const auto ray = std::ranges::find(ratios.rays, end.k, &reduction::InvariantRay::k);
  return ray == ratios.rays.end() ? 0 : ray->accuracy;
}

std::string phase_plane_as_text(const ReducedSystem& system, const PhasePlane& plane, int digits) {
  const auto number = [&](double value) { return fmt::format("{:.{}g}", value, digits); };
  std::string text = fmt::format(
      "law    {}\n"
      "r      {} = gamma mu^2/chi, gamma = {}, mu = {}, chi = {}\n"
      "rays   v = k mu |u| where Phi/(k Psi) = r; it is {} at k = 0 and {} at k = infinity, the r of {} < mu < {}\n\n",
      system.law().name(), number(system.r()), number(system.inertia().gamma), number(system.mu()),
      number(system.inertia().chi), number(plane.terminal.low), number(plane.terminal.high), number(plane.mu_low),
      number(plane.mu_high));
  const int width = digits + 8;  // sign, point, exponent and two spaces
  text += fmt::format("{:<11}{:<9}{:>{}}{:>{}}{:>{}}{:>{}}  {}\n", "half-line", "at", "k", width, "q = v/|u|", width,
                      "radial", width, "angular", width, "kind");
  for (const SingularPoint& point : plane.points) {
    text += fmt::format("{:<11}{:<9}{:>{}}{:>{}}{:>{}}{:>{}}  {}\n", name(point.direction), name(point.place),
                        number(point.k), width, number(point.q), width, number(point.radial), width,
                        number(point.angular), width, name(point.kind));
  }
  text += fmt::format(
      "\n"
      "radial, angular   eigenvalues of (2.7) blown up at the origin, v = q |u|, and divided by |u| (by v at u = 0);\n"
      "                  at infinity multiplied by it. The field itself has no linear part at the origin\n"
      "kind              a half-line is a separatrix of its saddle; u < 0 is the mirror image\n"
      "every other orbit is born at infinity in an unstable node and enters the origin\n");
  for (std::size_t i = 0; i < plane.tangents.size(); ++i) {
    const auto& [direction, k, order] = plane.tangents[i];
    const auto& end = plane.terminal.ends[i];
    text += fmt::format("from {} < k < {} {}", number(end.from), number(end.to),
                        approaches[static_cast<std::size_t>(direction)]);
    const std::string_view speed = direction == InvariantDirection::sliding ? "v" : "|u|";
    text += order > 0 ? fmt::format(" like {}^{}\n", speed, number(order))
                      : fmt::format(" slower than any power of {}\n", speed);
  }
  return text;
}

std::string phase_plane_as_csv(const PhasePlane& plane) {
  std::string text = csv_line({"half_line", "place", "k", "q", "radial", "angular", "kind", "separatrix"});
  for (const SingularPoint& point : plane.points) {
    text += csv_line({std::string(name(point.direction)), std::string(name(point.place)), fmt::format("{}", point.k),
                      fmt::format("{}", point.q), fmt::format("{}", point.radial), fmt::format("{}", point.angular),
                      std::string(name(point.kind)), is_separatrix(point) ? "yes" : "no"});
  }
  return text;
}

std::string phase_plane_as_json(const ReducedSystem& system, const PhasePlane& plane) {
  std::vector<std::string> points;
  for (const SingularPoint& point : plane.points) {
    points.push_back(
        JsonObject()
            .add("half_line", json(name(point.direction)))
            .add("place", json(name(point.place)))
            .add("k", json(point.k))
            .add("q", json(point.q))
            .add("eigenvalues",
                 JsonObject().add("radial", json(point.radial)).add("angular", json(point.angular)).inline_text())
            .add("kind", json(name(point.kind)))
            .add("separatrix", is_separatrix(point) ? "true" : "false")
            .inline_text());
  }
  std::vector<std::string> tangents;
  for (const auto& [direction, k, order] : plane.tangents) {
    tangents.push_back(JsonObject()
                           .add("half_line", json(name(direction)))
                           .add("k", json(k))
                           .add("contact_order", json(order))
                           .inline_text());
  }
  JsonObject document = JsonObject::document();
  document.add("law", json(system.law().name()))
      .add("mu", json(system.mu()))
      .add("body",
           JsonObject().add("chi", json(system.inertia().chi)).add("gamma", json(system.inertia().gamma)).inline_text())
      .add("r", json(system.r()));
  add_terminal_ratios(document, plane.terminal);
  const reduction::Tangent& usual = plane.tangents[usual_end(plane.terminal)];
  document.add("mu_low", json(plane.mu_low))
      .add("mu_high", json(plane.mu_high))
      .add("tangent", json(name(usual.direction)))
      .add("contact_order", json(usual.contact_order))
      .add("tangents", json_array(tangents))
      .add("singular_points", json_array(points));
  return document.text();
}

}  // namespace contensou::program
