#include "contensou/portraits/theory_figures.hpp"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "../octic_law.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/reduced_system.hpp"

using namespace contensou;
using namespace contensou::portraits;

namespace {

const Lines* lines_of(const Panel& panel, const Text& legend) {
  const auto found = std::ranges::find(panel.lines, legend, &Lines::legend);
  return found == panel.lines.end() ? nullptr : &*found;
}

/// Returns the k at which a line of rays has the given r, interpolated between the two nearest points of the line.
double ray_at(const Polyline& line, double r) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point &a = line[i - 1], &b = line[i];
    if ((a.x - r) * (b.x - r) <= 0 && a.x != b.x) return a.y * std::pow(b.y / a.y, (r - a.x) / (b.x - a.x));
  }
  return std::nan("");
}

}  // namespace

TEST_CASE("rays are drawn where terminal_ratios finds them, and as it says that they attract or repel", "[route]") {
  std::vector<reduction::Law> laws{contensou::tests::OcticLaw{}};
  for (const char* name : {"exact", "pade", "uniform", "ring"}) laws.push_back(*reduction::find_law(name));
  for (const reduction::Law& law : laws) {
    const Panel panel = rays_figure(law).panels[0];
    for (const double r : {1.0, 1.992, 2.5, 3.5}) {
      for (const reduction::InvariantRay& ray : reduction::terminal_ratios(law, r).rays) {
        INFO(law.name() << " r = " << r << " k = " << ray.k);
        const Lines* lines = lines_of(panel, ray.attracts() ? "attracts" : "repels");
        REQUIRE(lines != nullptr);
        bool found = false;
        for (const Polyline& line : lines->lines) found = found || std::abs(ray_at(line, r) / ray.k - 1) < 1e-3;
        CHECK(found);
      }
    }
  }
  CHECK(lines_of(rays_figure(reduction::HertzLaw{}).panels[0], "repels") == nullptr);
  CHECK(lines_of(rays_figure(contensou::tests::OcticLaw{}).panels[0], "repels") != nullptr);
}

TEST_CASE("with a drive rays are drawn where terminal_ratios finds them", "[route]") {
  for (const char* name : {"exact", "pade", "uniform"}) {
    const reduction::Law law = *reduction::find_law(name);
    for (const double drive : {0.01, 0.3}) {
      const Figure figure = rays_figure(law, 0.5, {}, drive);
      const Lines* lines = lines_of(figure.panels[0], "attracts");
      REQUIRE(lines != nullptr);
      REQUIRE(lines_of(figure.panels[0], "without a drive") != nullptr);
      for (const double r : {0.1, 0.5, 1.0}) {
        const auto rays = reduction::terminal_ratios(law, r, drive).rays;
        INFO(name << " drive " << drive << " r = " << r);
        REQUIRE(rays.size() == 1);
        CHECK(ray_at(lines->lines.at(0), r) == Approx(rays[0].k).epsilon(1e-3));
      }
      for (const Arrows& heads : figure.panels[1].arrows) {
        for (const Arrow& head : heads.arrows) CHECK(head.at.y * head.direction.x < 0);
      }
      // The lines show m over v, for u = 1. The stop time is P + m S, (R5) of reduction/theory.md.
      const Lines* of_r = lines_of(figure.panels[2], math("r = 0.5"));
      REQUIRE(of_r != nullptr);
      const reduction::ReducedSystem system(law, 1, {.chi = 1, .gamma = 0.5}, drive);
      for (const Polyline& line : of_r->lines) {
        for (std::size_t i = 0; i < line.size(); i += 37) {
          const double tau = system.pivoting_limit(1) + line[i].y * system.sliding_limit(line[i].x);
          CHECK(reduction::Flow(system).stop_time({.u = 1, .v = line[i].x}).tau == Approx(tau).epsilon(1e-9));
        }
      }
    }
  }
}

TEST_CASE("heads point to smaller k where D > 0, and m lies between its bounds", "[invariant]") {
  for (const char* name : {"exact", "pade", "elliptic", "annulus:0.5"}) {
    const reduction::Law law = *reduction::find_law(name);
    const Figure figure = rays_figure(law, 3.0);
    INFO(name);
    REQUIRE(figure.panels.size() == 3);
    REQUIRE(figure.panels[1].arrows.size() >= 3);
    for (const Arrows& heads : figure.panels[1].arrows) {
      CHECK(heads.arrows.size() == 4);
      for (const Arrow& head : heads.arrows) CHECK(head.at.y * head.direction.x < 0);
    }
    CHECK(lines_of(figure.panels[2], math("r = 3")) != nullptr);
    for (const Lines& lines : figure.panels[2].lines) {
      for (const Polyline& line : lines.lines) {
        for (const Point& point : line) {
          CHECK(point.y >= law.sliding_bounds()->min - 1e-12);
          CHECK(point.y <= law.sliding_bounds()->max + 1e-12);
        }
      }
    }
  }
  CHECK_THROWS_AS(rays_figure(reduction::HertzLaw{}, -1.0), std::domain_error);
}
