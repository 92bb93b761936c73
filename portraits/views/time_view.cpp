// u, v and k against the fraction of the stop time that has passed: by scaling, only k at the start matters.
#include <cmath>

#include <fmt/format.h>

#include "data/round_numbers.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

/// A motion from one ratio, every quantity over its start.
struct Course {
  Polyline u, v, ln_k;
};

Course course(const PortraitOrbit& orbit) {
  constexpr double lowest = -60;
  Course course;
  for (Eigen::Index i = 0; i < orbit.rows(); ++i) {
    const double passed = 1 - orbit.tau_left[i] / orbit.tau_left[0];
    course.u.push_back({passed, orbit.u[i] / orbit.u[0]});
    course.v.push_back({passed, orbit.v[i] / orbit.v[0]});
    course.ln_k.push_back({passed, std::clamp(orbit.ln_k[i], lowest, -lowest)});
  }
  // At rest k is only a limit, that the last rows are next to.
  course.ln_k.back().y = course.ln_k[course.ln_k.size() - 2].y;
  return course;
}

}  // namespace

std::vector<Panel> time_view(const Drawing& drawing) {
  const PhasePortrait& portrait = drawing.portrait;
  const reduction::ReducedSystem& system = portrait.system();
  // About where sliding alone takes as long as pivoting alone, half-decades to both sides: 1, 3, 10, ...
  const double same_time = 1 / (system.r() * system.law().pivoting_moment());
  const double middle = std::round(2 * std::log10(same_time));
  std::vector<double> k_start;
  for (double half = middle - 2; half <= middle + 2; ++half) {
    k_start.push_back((std::fmod(half, 2) == 0 ? 1 : 3) * std::pow(10, std::floor(half / 2)));
  }
  Panel u, v, k;
  const std::string time = "{/:Italic τ}/{/:Italic τ}*";
  u.title = "spinning  {/:Italic u}/{/:Italic u}_0";
  v.title = "sliding  {/:Italic v}/{/:Italic v}_0";
  k.title = "ln {/:Italic k}";
  for (Panel* panel : {&u, &v}) panel->y = {"", 0, 1.04, false, {}};
  for (Panel* panel : {&u, &v, &k}) panel->x = {time, 0, 1, false, {}};
  const std::vector<double> rays = ray_log_ratios(portrait);
  const double highest = std::log(k_start.back());
  k.y = {"", 0, 0, false, {}};
  if (!rays.empty()) {
    k.y.low = rays.front() - 3;
    k.y.high = rays.back() + 3;
  } else if (portrait.plane.terminal.ends.front().k == 0) {
    k.y.low = std::min(-6.0, highest - 10);
    k.y.high = highest + 1;
  } else {
    k.y.low = highest - 6;
    k.y.high = highest + 6;
  }

  const auto add = [&](const Course& line, Stroke stroke, const std::string& legend) {
    u.lines.push_back({{line.u}, stroke, legend});
    v.lines.push_back({{line.v}, stroke, legend});
    k.lines.push_back({{line.ln_k}, stroke, legend});
  };
  const auto add_courses = [&](const PhasePortrait& of, bool compared) {
    const std::vector<Colour>& times = drawing.palette.times;
    for (std::size_t i = 0; i < k_start.size(); ++i) {
      const double ln_k = std::log(k_start[i]);
      const Stroke stroke = compared ? Stroke{drawing.palette.comparison, 1.3, true}
                                     : Stroke{times[i * (times.size() - 1) / (k_start.size() - 1)], 1.8, false};
      const std::string legend =
          compared ? law_legend(of) : fmt::format("{{/:Italic k}}_0 = {}", number(std::exp(ln_k), 3));
      add(course(orbit_through(of.flow, ln_k, 0, 0)), stroke, legend);
    }
  };
  add_courses(portrait, false);
  for (const PhasePortrait& other : portrait.comparisons) add_courses(other, true);
  if (!rays.empty() && drawing.style.invariant) {
    Lines lines{{}, {drawing.palette.comparison, 1.6, true}, rays.size() == 1 ? "{/:Italic k}*" : "invariant rays"};
    for (double ln_k : rays) lines.lines.push_back({{0, ln_k}, {1, ln_k}});
    k.lines.push_back(std::move(lines));
  }
  if (!drawing.style.asked) return {std::move(u), std::move(v), std::move(k)};
  std::vector<const PortraitOrbit*> asked;
  for (const PortraitOrbit& orbit : portrait.through) asked.push_back(&orbit);
  if (portrait.highlight) asked.push_back(&*portrait.highlight);
  for (const PortraitOrbit* orbit : asked) {
    if (orbit->u[0] == 0 || orbit->v[0] == 0) continue;
    add(course(*orbit), {drawing.palette.highlight, 2.6, false},
        portrait.highlight && orbit == &*portrait.highlight ? drawing.caption.highlight : "through the points given");
  }
  return {std::move(u), std::move(v), std::move(k)};
}

}  // namespace contensou::portraits
