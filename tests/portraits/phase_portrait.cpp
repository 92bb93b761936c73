#include "contensou/portraits/phase_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"

using namespace contensou;
using Eigen::Vector2d;
using portraits::phase_portrait;
using portraits::PhasePortrait;
using portraits::PortraitOrbit;
using portraits::PortraitRequest;
using portraits::Window;
using reduction::Flow;
using reduction::Orbit;
using reduction::ReducedSystem;
using reduction::State;

namespace {

const std::vector<reduction::Law> laws{reduction::PadeLaw{}, reduction::HertzLaw{}};
const std::vector<double> portrait_ratios{1e-6, 1e-3, 0.0035, 0.099, 0.3, 1.0};

double paper_distance(const PhasePortrait& portrait, const PortraitOrbit& orbit, Eigen::Index i, Eigen::Index j) {
  const portraits::SpeedScale& scale = portrait.scale;
  return std::hypot((orbit.u[i] - orbit.u[j]) / portrait.window.u(),
                    scale.height(orbit.ln_v[i]) - scale.height(orbit.ln_v[j]));
}

template <class Check>
void for_each_portrait(Check check) {
  for (const reduction::Law& law : laws) {
    for (double mu : portrait_ratios) {
      CAPTURE(law.name(), mu);
      const ReducedSystem system(law, mu);
      for (bool linear : {false, true}) {
        CAPTURE(linear);
        check(system, phase_portrait(system, {.linear = linear}));
      }
    }
  }
}

}  // namespace

TEST_CASE("Every orbit runs unbroken from the border of the window to the origin, mirrored in u", "[invariant]") {
  for_each_portrait([](const ReducedSystem&, const PhasePortrait& portrait) {
    REQUIRE(portrait.orbits.size() == 24);
    for (const PortraitOrbit& orbit : portrait.orbits) {
      const Eigen::Index last = orbit.u.size() - 1;
      const bool on_top = orbit.v[0] == portrait.window.v() && std::abs(orbit.u[0]) <= portrait.window.u();
      const bool on_side = std::abs(orbit.u[0]) == portrait.window.u() && orbit.v[0] <= portrait.window.v();
      CHECK((on_top || on_side));
      CHECK(orbit.u[last] == 0);
      CHECK(orbit.v[last] == 0);
      CHECK(orbit.tau_left[last] == 0);
      double longest = 0;
      for (Eigen::Index i = 1; i <= last; ++i) {
        longest = std::max(longest, paper_distance(portrait, orbit, i, i - 1));
        CHECK(orbit.tau_left[i] < orbit.tau_left[i - 1]);
        CHECK(std::abs(orbit.u[i]) <= std::abs(orbit.u[i - 1]));
        CHECK(orbit.v[i] <= orbit.v[i - 1]);
      }
      CHECK(longest < (portrait.scale.linear() ? 0.05 : 0.1));  // orbits along rays are straight
    }
    for (std::size_t i = 0; i < portrait.orbits.size(); i += 2) {
      CHECK((portrait.orbits[i].u == -portrait.orbits[i + 1].u).all());
      CHECK((portrait.orbits[i].v == portrait.orbits[i + 1].v).all());
      CHECK(portrait.orbits[i].u[0] > 0);
    }
  });
}

TEST_CASE("The border is filled evenly: neighbours are equally far apart across the flow", "[invariant]") {
  for_each_portrait([](const ReducedSystem& system, const PhasePortrait& portrait) {
    if (!portrait.scale.linear()) return;
    const double U = portrait.window.u(), V = portrait.window.v();
    // Integral of the distance across the flow along the border, from (0, V) to the start of the orbit; midpoint rule.
    const auto across = [&](const PortraitOrbit& orbit) {
      const auto fraction = [&](State at, bool top) {
        const auto rate = system.field(at);
        const double du = rate.u / U, dv = rate.v / V;
        return std::abs(top ? dv : du) / std::hypot(du, dv);
      };
      const double along_top = orbit.v[0] == V ? orbit.u[0] / U : 1;
      const double along_side = 1 - orbit.v[0] / V;
      double sum = 0;
      constexpr int pieces = 4000;
      for (int i = 0; i < pieces; ++i) {
        const double middle = (i + 0.5) / pieces;
        sum += along_top / pieces * fraction({middle * along_top * U, V}, true);
        if (along_side > 0) sum += along_side / pieces * fraction({U, (1 - middle * along_side) * V}, false);
      }
      return sum;
    };
    std::vector<double> places;
    for (std::size_t i = 0; i < portrait.orbits.size(); i += 2) places.push_back(across(portrait.orbits[i]));
    const double gap = places[1] - places[0];
    CHECK(gap > 0.05);
    for (std::size_t i = 1; i < places.size(); ++i) CHECK(places[i] - places[i - 1] == Approx(gap).epsilon(0.02));
  });
}

TEST_CASE("Planes side by side have the height of the median plane", "[table]") {
  const auto height = [](const std::vector<double>& all) {
    std::vector<reduction::Flow> flows;
    for (double mu : all) flows.emplace_back(reduction::ReducedSystem{reduction::HertzLaw{}, mu});
    return portraits::phase_portraits(flows, {}).back().window.v();
  };
  // Each plane alone: 0.2, 2, 5 and 2.
  CHECK(height({0.01, 0.1, 0.3, 1}) == height({1}));
  CHECK(height({0.01, 0.3}) == height({0.01}));
}

TEST_CASE("The time left at each point is that point's stop time", "[route]") {
  for_each_portrait([](const ReducedSystem& system, const PhasePortrait& portrait) {
    const auto flow = Flow::by_quadrature(system);
    for (const PortraitOrbit& orbit : portrait.orbits) {
      for (Eigen::Index i = 0; i < orbit.u.size(); i += 7) {
        const double stop = flow.orbit({orbit.u[i], orbit.v[i]}).stop_time();
        CHECK(std::abs(orbit.tau_left[i] - stop) < 1e-12 * orbit.tau_left[0]);
      }
    }
  });
}

TEST_CASE("Every point of an isochrone has its stop time and lies in the window", "[route]") {
  for_each_portrait([](const ReducedSystem& system, const PhasePortrait& portrait) {
    const auto flow = Flow::by_quadrature(system);
    CHECK(portrait.isochrones.size() >= 4);
    for (const auto& isochrone : portrait.isochrones) {
      for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) {
        const double stop = flow.orbit({isochrone.u[i], isochrone.v[i]}).stop_time();
        CHECK(stop == Approx(isochrone.tau_stop).epsilon(1e-12));
        CHECK(std::abs(isochrone.u[i]) <= portrait.window.u() * (1 + 1e-12));
        CHECK(isochrone.v[i] <= portrait.window.v() * (1 + 1e-12));
      }
    }
  });
}

TEST_CASE("Isochrones are at round multiples of the time unit, from the first to the corner of the window", "[table]") {
  const Flow flow(reduction::PadeLaw{}, 0.3);
  constexpr double unit = 0.7;
  const PhasePortrait portrait = phase_portrait(flow, {.time_unit = unit});
  const double first = portrait.isochrones.front().tau_stop / unit;
  const double mantissa = first / std::pow(10, std::floor(std::log10(first) + 1e-9));
  CAPTURE(first, mantissa);
  CHECK((mantissa == Approx(1) || mantissa == Approx(2) || mantissa == Approx(5)));
  for (const auto& isochrone : portrait.isochrones) {
    const double multiple = isochrone.tau_stop / unit / first;
    CHECK(multiple == Approx(std::round(multiple)));
  }
  const double corner = flow.orbit({portrait.window.u(), portrait.window.v()}).stop_time();
  CHECK(portrait.isochrones.back().tau_stop > 0.7 * corner);
}

TEST_CASE("The similarity solution and (2.7) in beta draw the same curves", "[route]") {
  for (const reduction::Law& law : laws) {
    for (double mu : {0.0035, 0.099, 0.3, 1.0}) {
      CAPTURE(law.name(), mu);
      const ReducedSystem system(law, mu);
      const PhasePortrait similar = phase_portrait(system, {.linear = true}),
                          stepped = phase_portrait(system, {.stepped = true});
      REQUIRE(stepped.orbits.size() == similar.orbits.size());
      for (std::size_t i = 0; i < stepped.orbits.size(); i += 2) {
        const PortraitOrbit& orbit = stepped.orbits[i];
        CHECK(orbit.u[0] == Approx(similar.orbits[i].u[0]).epsilon(1e-14));
        CHECK(orbit.v[0] == Approx(similar.orbits[i].v[0]).epsilon(1e-14));
        const Orbit exact = Flow(system).orbit({similar.orbits[i].u[0], similar.orbits[i].v[0]});
        for (Eigen::Index j = 0; j + 1 < orbit.u.size(); ++j) {
          const auto point = exact.at_log_ratio(std::min(orbit.ln_k[j], exact.start_log_ratio()));
          CHECK(std::abs(orbit.u[j] - point.u) < 1e-10 * similar.window.u());
          CHECK(std::abs(orbit.v[j] - point.v) < 1e-10 * similar.window.v());
          CHECK(std::abs(orbit.tau_left[j] - (exact.stop_time() - point.tau)) < 1e-10 * exact.stop_time());
        }
      }
    }
  }
}

TEST_CASE("However small mu is, an orbit has as few points", "[extremes]") {
  for (double mu : {1e-7, 1e-8, 1e-10}) {
    const PhasePortrait portrait = phase_portrait({{reduction::HertzLaw{}, mu}}, {});
    for (const PortraitOrbit& orbit : portrait.orbits) CHECK(orbit.u.size() < 1000);
    CHECK(portrait.orbits.size() == 24);
    CHECK(portraits::orbit_through(portrait.flow, 0, 0, 14).u.size() < 2000);
  }
}

TEST_CASE("The axis of v follows mu: below 0.48 a linear one shows a comb", "[table]") {
  const auto linear = [](double mu, PortraitRequest request = {}) {
    const PhasePortrait portrait = phase_portrait({{reduction::PadeLaw{}, mu}}, request);
    CHECK(portrait.view == request.view.value_or(portraits::View::uv));
    return portrait.scale.linear();
  };
  CHECK(linear(0.49));
  for (double mu : {0.48, 0.099, 1e-6}) {
    CHECK_FALSE(linear(mu));
    CHECK_FALSE(linear(mu, {.view = portraits::View::patch}));
    CHECK(linear(mu, {.view = portraits::View::disc}));
    CHECK(linear(mu, {.linear = true}));
  }
}

TEST_CASE("A window that is given is kept; a highlighted start lies in the window that is chosen", "[table]") {
  const Flow flow(reduction::PadeLaw{}, 0.3);
  const Window kept = phase_portrait(flow, {.sides = {{2, 0.5}}}).window;
  CHECK((kept.low == Vector2d(-2, 0) && kept.high == Vector2d(2, 0.5)));
  for (const State& start : {State{-3, 0.2}, State{0, 2}, State{5, 0}, State{1e-140, 1e140}}) {
    CAPTURE(start.u, start.v);
    const PhasePortrait portrait = phase_portrait(flow, {.highlight = start});
    CHECK(std::abs(start.u) < portrait.window.u());
    CHECK(start.v < portrait.window.v());
    REQUIRE(portrait.highlight.size() == 1);
    CHECK(portrait.highlight[0].u[0] == start.u);
    CHECK(portrait.highlight[0].v[0] == Approx(start.v).epsilon(1e-13));
    CHECK(portrait.highlight[0].tau_left[0] == Approx(flow.orbit(start).stop_time()).epsilon(1e-13));
  }
  // A start at rest has no motion.
  CHECK(phase_portrait(flow, {.highlight = State{0, 0}}).highlight.empty());
}

TEST_CASE("Orbits have no visible corners, also where v is far below mu u", "[invariant]") {
  for (const Vector2d& sides : {Vector2d(1e5, 1e-5), Vector2d(1, 1e-12), Vector2d(1e-5, 1e5), Vector2d(1, 1)}) {
    for (double mu : {0.01, 0.3, 1.0}) {
      CAPTURE(mu, sides[0], sides[1]);
      const PhasePortrait portrait = phase_portrait({{reduction::HertzLaw{}, mu}}, {.sides = sides, .linear = true});
      double sharpest = 0;
      for (const PortraitOrbit& orbit : portrait.orbits) {
        for (Eigen::Index i = 1; i + 1 < orbit.u.size(); ++i) {
          const double before = paper_distance(portrait, orbit, i, i - 1);
          const double after = paper_distance(portrait, orbit, i + 1, i);
          const double chord = paper_distance(portrait, orbit, i + 1, i - 1);
          if (std::min(before, after) < 0.01) continue;  // such pieces are too short for a visible corner
          const double cosine = (before * before + after * after - chord * chord) / (2 * before * after);
          sharpest = std::max(sharpest, std::acos(-1) - std::acos(std::clamp(cosine, -1.0, 1.0)));
        }
      }
      CHECK(sharpest < 0.5);
    }
  }
}

TEST_CASE("An orbit from far outside the window is bounded, and smooth inside it", "[invariant]") {
  for (const State start : {State{1e6, 1}, State{1, 1e9}}) {
    const PhasePortrait portrait =
        phase_portrait({{reduction::HertzLaw{}, 0.3}}, {.sides = {{1, 5}}, .highlight = start, .orbits = 0});
    const PortraitOrbit& orbit = portrait.highlight.at(0);
    CHECK(orbit.u.size() < 2000);
    double longest = 0;
    for (Eigen::Index i = 1; i < orbit.u.size(); ++i) {
      if (orbit.u[i - 1] > 1 || orbit.v[i - 1] > 5) continue;
      longest = std::max(longest, paper_distance(portrait, orbit, i, i - 1));
    }
    CHECK(longest > 0);
    CHECK(longest < 0.05);
  }
}

TEST_CASE("What cannot be drawn is rejected", "[domain]") {
  std::vector<PortraitRequest> bad{{.orbits = -1}, {.isochrones = -1}, {.highlight = State{1, -1}}};
  for (const Vector2d& sides : {Vector2d(0, 1), Vector2d(1, -1), Vector2d(NAN, 1), Vector2d(1, INFINITY),
                                Vector2d(1e308, 1e308), Vector2d(1e-320, 1)}) {
    bad.push_back({.sides = sides});
  }
  bad.push_back({.window = Window{{0, -1}, {1, 1}}});
  bad.push_back({.window = Window{{1, 0}, {0, 1}}});
  bad.push_back({.view = portraits::View::disc, .window = Window{{0, 0}, {1, 1}}});
  // Points on an axis, or outside the window, are no starts of orbits.
  for (const State point : {State{0, 1}, State{1, 0}, State{1.5, 0.5}, State{0.5, 1.5}}) {
    bad.push_back({.sides = {{1, 1}}, .through = {point}});
  }
  for (const PortraitRequest& request : bad) {
    CHECK_THROWS_AS(phase_portrait({{reduction::PadeLaw{}, 0.3}}, request), std::domain_error);
  }
}

TEST_CASE("Views have names, and the names lead back", "[table]") {
  std::set<std::string_view> names;
  for (portraits::View view : portraits::views()) names.insert(portraits::name(view));
  CHECK(names.size() == portraits::views().size());
  CHECK(portraits::name(portraits::View::pair) == "pair");
  for (portraits::View view : portraits::views()) CHECK(portraits::find_view(portraits::name(view)) == view);
  CHECK_FALSE(portraits::find_view("vu"));
}

TEST_CASE("Numbers of orbits and isochrones are those asked for", "[table]") {
  const Flow flow(reduction::PadeLaw{}, 0.3);
  const PhasePortrait few = phase_portrait(flow, {.orbits = 5, .isochrones = 0});
  CHECK(few.orbits.size() == 10);
  CHECK(few.isochrones.empty());
  const PhasePortrait many = phase_portrait(flow, {.orbits = 0, .isochrones = 20});
  CHECK(many.orbits.empty());
  CHECK(many.isochrones.size() >= 14);
  // Each isochrone consists of one or two pieces.
  for (int count : {1, 2, 3, 4, 5, 6, 7, 10, 15, 30, 100}) {
    for (double mu : {0.01, 0.3, 1.0}) {
      std::set<double> times;
      for (const auto& isochrone : phase_portrait({{reduction::PadeLaw{}, mu}}, {.isochrones = count}).isochrones) {
        times.insert(isochrone.tau_stop);
      }
      CAPTURE(count, mu, times.size());
      CHECK(std::abs(static_cast<double>(times.size()) - count) <= std::max(count > 3 ? 1.0 : 0.0, 0.15 * count));
    }
  }
}

TEST_CASE("An orbit through a point begins on the border and passes through it", "[route]") {
  for (const reduction::Law& law : laws) {
    for (double mu : {0.01, 0.3, 1.0}) {
      const ReducedSystem system(law, mu);
      const std::vector<State> points{{0.5, 0.2}, {-0.9, 2.9}, {0.3, 1e-3}};
      const PhasePortrait portrait = phase_portrait(system, {.sides = {{1, 3}}, .through = points});
      REQUIRE(portrait.through.size() == points.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        const State point = points[i];
        const PortraitOrbit& orbit = portrait.through[i];
        CAPTURE(law.name(), mu, point.u, point.v, orbit.u[0], orbit.v[0]);
        const double reach = std::max(std::abs(orbit.u[0]) / 1, orbit.v[0] / 3);
        CHECK(reach == Approx(1).epsilon(1e-6));
        const auto there =
            Flow(system).orbit({orbit.u[0], orbit.v[0]}).at_log_ratio(std::log(point.v / (mu * std::abs(point.u))));
        CHECK(there.u == Approx(point.u).epsilon(1e-10));
        CHECK(there.v == Approx(point.v).epsilon(1e-10));
      }
    }
  }
}

TEST_CASE("An orbit through a state given by logarithms passes through it, without gaps", "[route]") {
  for_each_portrait([](const ReducedSystem& system, const PhasePortrait&) {
    const PortraitOrbit orbit = portraits::orbit_through(system, 0, std::log(2), 14);
    CHECK(std::max(system.mu() * orbit.u[0], orbit.v[0]) == Approx(2 * std::exp(14)));
    CHECK(orbit.u[orbit.rows() - 1] == 0);
    CHECK(orbit.tau_left[orbit.rows() - 1] == 0);
    const Flow flow = Flow::by_quadrature(system);
    CHECK(flow.orbit({orbit.u[0], orbit.v[0]}).at_log_ratio(0).v == Approx(2).epsilon(1e-9));
    for (Eigen::Index i = 1; i + 1 < orbit.rows(); ++i) {
      CHECK(orbit.tau_left[i] < orbit.tau_left[i - 1]);
      // Neighbouring points are so close that even a stretched view shows no gap.
      const double turn = std::atan(std::exp(orbit.ln_k[i - 1])) - std::atan(std::exp(orbit.ln_k[i]));
      CHECK(turn < 0.05);
      if (orbit.ln_k[i] > -15) CHECK(orbit.ln_k[i - 1] - orbit.ln_k[i] < 0.6);
    }
    const Eigen::Index row = orbit.rows() / 2;
    const auto scaled = orbit.at(row, 7);
    CHECK(scaled.tau_left == Approx(flow.orbit({scaled.u, scaled.v}).stop_time()).epsilon(1e-10));
    CHECK(scaled.ln_v == Approx(std::log(7) + orbit.ln_v[row]));
    CHECK(portraits::orbit_through(system, 1, 0, 0).v[0] == Approx(1).epsilon(1e-14));
  });
}

TEST_CASE("Another law is drawn in the same window, with isochrones of the same times", "[table]") {
  const PhasePortrait both = phase_portrait({{reduction::PadeLaw{}, 0.3}}, {.comparison = reduction::HertzLaw{}});
  REQUIRE(both.comparisons.size() == 1);
  const PhasePortrait& other = both.comparisons[0];
  CHECK(other.system().law().name() == "exact");
  const PhasePortrait alone = phase_portrait({{reduction::HertzLaw{}, 0.3}}, {.window = both.window});
  REQUIRE(other.orbits.size() == alone.orbits.size());
  CHECK((other.orbits[4].v == alone.orbits[4].v).all());
  const auto times = [](const PhasePortrait& portrait) {
    std::set<double> result;
    for (const auto& isochrone : portrait.isochrones) result.insert(isochrone.tau_stop);
    return result;
  };
  CHECK(times(other) == times(both));
}

TEST_CASE("The uncoupled model slows slip and spin at the rates of the axes", "[route]") {
  for (const reduction::Law& law : laws) {
    for (const auto& [mu, start] :
         {std::pair{0.3, State{1, 0.2}}, {0.3, State{-2, 4}}, {1., State{0.01, 3}}, {0.01, State{-30, 1e-3}}}) {
      const ReducedSystem system(law, mu);
      const PhasePortrait portrait =
          phase_portrait(system, {.highlight = start, .through = {{start.u / 2, start.v}}, .uncoupled = true});
      REQUIRE(portrait.uncoupled.size() == 2);
      const double sliding = system.field({0, start.v}).v, pivoting = std::abs(system.field({start.u, 0}).u);
      const PortraitOrbit& orbit = portrait.uncoupled.front();
      CAPTURE(law.name(), mu, start.u, start.v);
      CHECK(orbit.u[0] == Approx(start.u));
      CHECK(orbit.v[0] == Approx(start.v));
      CHECK(orbit.tau_left[orbit.rows() - 1] == 0);
      for (Eigen::Index i = 0; i < orbit.rows(); ++i) {
        const double time = orbit.tau_left[0] - orbit.tau_left[i];
        const double v = std::max(0., start.v + sliding * time), u = std::max(0., std::abs(start.u) - pivoting * time);
        // The difference of the times is rounded.
        CHECK(orbit.v[i] == Approx(v).margin(1e-14 * sliding * -orbit.tau_left[0]));
        CHECK(orbit.u[i] == Approx(std::copysign(u, start.u)).margin(1e-14 * pivoting * orbit.tau_left[0]));
      }
    }
  }
}
