#include "contensou/portraits/planar_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "contensou/reduction/planar_reduction.hpp"
#include "contensou/reduction/symmetries.hpp"
#include "figures.hpp"

using namespace contensou;
using namespace contensou::portraits;
using Catch::Matchers::Contains;
using Eigen::Vector2d;
using reduction::PlanarField;
using reduction::PlanarReduction;
using reduction::State;

namespace {

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

PlanarPortrait portrait_of(const PlanarField& field, const PortraitRequest& request = {}) {
  const Vector2d around(1, 1);
  const reduction::PlanarSymmetries found = reduction::find_symmetries(field, around);
  REQUIRE(found.scaling);
  return planar_portrait(PlanarReduction(field, *found.scaling, around, found.residual), "a system", request);
}

/// Checks that every step of the orbits follows the field, lies in the window and takes the stated time.
void check_motions(const PlanarField& field, const PlanarPortrait& portrait) {
  REQUIRE(portrait.orbits.size() >= 8);
  for (const PortraitOrbit& orbit : portrait.orbits) {
    REQUIRE(orbit.u.size() >= 2);
    for (Eigen::Index i = 0; i < orbit.u.size(); ++i) {
      const Vector2d here(orbit.u[i], orbit.v[i]);
      CHECK((here - portrait.window.low).minCoeff() >= -1e-9);
      CHECK((portrait.window.high - here).minCoeff() >= -1e-9);
      if (i == 0) continue;
      const Vector2d last(orbit.u[i - 1], orbit.v[i - 1]), step = here - last, rate = field((here + last) / 2);
      // A chord may cut a corner at a place where the field is not smooth.
      if (step.norm() < 1e-5 || here.norm() < 0.1 || here[0] * last[0] <= 0 || here[1] * last[1] <= 0) continue;
      INFO("from " << last.transpose() << " to " << here.transpose());
      CHECK(step.dot(rate) > 0.99 * step.norm() * rate.norm());
      if (!std::isfinite(orbit.tau_left[i - 1])) continue;
      CHECK(orbit.tau_left[i - 1] - orbit.tau_left[i] == Approx(step.norm() / rate.norm()).epsilon(0.05).margin(1e-4));
    }
  }
}

}  // namespace

TEST_CASE("orbits of any planar system go along its field, in its time", "[physics]") {
  const PlanarField fields[] = {
      [](const Vector2d& x) { return Vector2d(-x[0], -3 * x[1]); },                            // a node
      [](const Vector2d& x) { return Vector2d(x[0], -x[1]); },                                 // a saddle
      [](const Vector2d& x) { return Vector2d(x[1], -x[0] - x[1]); },                          // a focus
      [](const Vector2d& x) { return Vector2d(x[1], -x[0] * x[0] * x[0]); },                   // a centre
      [](const Vector2d& x) { return Vector2d(x[0] * x[0] - x[1] * x[1], 2 * x[0] * x[1]); },  // a dipole
      [](const Vector2d& x) { return Vector2d(x[0] * x[0], x[1] * x[1]); },                    // blow-up
      [](const Vector2d& x) -> Vector2d { return Vector2d(-x[0], -2 * x[1]) * std::pow(x.norm(), -1.5); },
      [](const Vector2d& x) { return Vector2d(x[1], -sign(x[0]) - 0.5 * sign(x[1])); },  // dry friction and a relay
      [](const Vector2d& x) { return Vector2d(std::sqrt(x[0]), 1 - x[1] / std::sqrt(x[0])); },  // has values for u > 0
  };
  for (const PlanarField& field : fields) {
    INFO("field " << &field - fields);
    check_motions(field, portrait_of(field));
    check_motions(field, portrait_of(field, {.window = Window{{-2, -0.5}, {1, 1}}}));
  }
}

TEST_CASE("isochrones of dry friction of degree -1/2 are circles", "[physics]") {
  // x' = -x |x|^(-3/2), so |x|^(3/2) falls at the rate 3/2.
  const PlanarPortrait portrait =
      portrait_of([](const Vector2d& x) -> Vector2d { return -x * std::pow(x.norm(), -1.5); });
  CHECK(portrait.plane.kind() == "stable star");
  REQUIRE(portrait.isochrones.size() >= 4);
  for (const Isochrone& isochrone : portrait.isochrones) {
    for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) {
      const double r = std::hypot(isochrone.u[i], isochrone.v[i]),
                   on_border = std::abs(std::max(std::abs(isochrone.u[i]), std::abs(isochrone.v[i])) - 1);
      if (on_border < 1e-12) continue;  // the border cuts a chord: within the circle
      CHECK(std::pow(r, 1.5) == Approx(1.5 * isochrone.tau_stop).epsilon(1e-11));
    }
  }
  CHECK(portrait_of(portrait.plane.field(), {.isochrones = 0}).isochrones.empty());
  // A linear system never reaches its centre.
  CHECK(portrait_of([](const Vector2d& x) -> Vector2d { return -x; }).isochrones.empty());
}

TEST_CASE("the orbit of a start begins there, one through a point at the border", "[route]") {
  const PlanarField twisting = [](const Vector2d& x) { return Vector2d(x[1], -sign(x[0]) - 0.5 * sign(x[1])); };
  const PlanarPortrait portrait =
      portrait_of(twisting, {.highlight = {{0.5, 1}}, .through = {{-0.2, 0.3}}, .orbits = 5});
  CHECK(portrait.window.low == Vector2d(-1.2, -1.2));
  REQUIRE(portrait.highlight.size() == 1);
  CHECK(portrait.highlight[0].u[0] == Approx(0.5));
  CHECK(portrait.highlight[0].v[0] == Approx(1.0));
  CHECK(portrait.highlight[0].tau_left[0] == portrait.plane.end_time({0.5, 1}));
  REQUIRE(!portrait.through.empty());
  const PortraitOrbit& first = portrait.through.front();
  CHECK(std::max(std::abs(first.u[0]), std::abs(first.v[0])) == Approx(1.2));
  double nearest = 1;
  for (const PortraitOrbit& piece : portrait.through) {
    nearest = std::min(nearest, ((piece.u + 0.2).square() + (piece.v - 0.3).square()).minCoeff());
  }
  CHECK(nearest < 1e-12);
  CHECK(portrait.orbits.size() >= 5);
}

TEST_CASE("the curves V = 0 are drawn where V changes its sign and where it only touches 0", "[physics]") {
  const auto lines_of = [](const PlanarField& field) {
    const reduction::PlanarReduction plane = reduction::by_factor({field}, {0.3, 0.5});
    REQUIRE(plane.solved());
    PortraitRequest request;
    request.window = Window{{-1, -1}, {1.2, 1.1}};
    return planar_portrait(plane, "a system", request).invariant;
  };
  // V = (1 + u^2) v^power is the only V of these fields.
  for (const double power : {1, 2}) {
    INFO("v' = v^" << power);
    const std::vector<PortraitOrbit> lines =
        lines_of([&](const Vector2d& x) { return Vector2d(1 + x[0] * x[0], std::pow(x[1], power)); });
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].v.abs().maxCoeff() < 1e-3);
    CHECK(lines[0].u.maxCoeff() - lines[0].u.minCoeff() > 2.1);
  }
  CHECK(lines_of([](const Vector2d& x) { return Vector2d(1 + x[0] * x[0], x[1] * x[1] + 1e-4); }).empty());
}

TEST_CASE("a solution curve goes on beyond a pole of the field, where its tangent is vertical", "[physics]") {
  // W. E. Boyce, R. C. DiPrima, Elementary Differential Equations, section 2.2: y^2 - 2y = x^3 + 2x^2 + 2x + C.
  const PlanarField field = [](const Vector2d& x) {
    return Vector2d(1, (3 * x[0] * x[0] + 4 * x[0] + 2) / (2 * (x[1] - 1)));
  };
  PortraitRequest request;
  request.window = Window{{-3, -3}, {3, 3}};
  const PlanarPortrait portrait = planar_portrait(reduction::by_factor({field}, {0.3, 0.5}), "a system", request);
  std::vector<Vector2d> ends;
  for (const PortraitOrbit& orbit : portrait.orbits) {
    for (const Eigen::Index row : {Eigen::Index{0}, orbit.rows() - 1}) {
      const Vector2d end(orbit.u[row], orbit.v[row]);
      if (std::abs(end[1] - 1) < 0.05 && std::abs(end[0]) < 2.9) ends.push_back(end);
    }
  }
  REQUIRE(ends.size() >= 12);
  for (const Vector2d& end : ends) {
    CAPTURE(end.transpose());
    // The curve beyond may belong to another orbit, if it begins so near that the eye sees one curve.
    CHECK(std::ranges::count_if(
              ends, [&](const Vector2d& other) { return (other - end).norm() < 0.015 && &other != &end; }) >= 1);
  }
}

TEST_CASE("a planar portrait is refused where there is nothing to show", "[input]") {
  const PlanarField field = [](const Vector2d& x) { return Vector2d(std::sqrt(x[0]), -std::sqrt(x[0])); };
  CHECK_THROWS_WITH(portrait_of(field, {.window = Window{{0, 0}, {0, 1}}}), Contains("two positive sides"));
  CHECK_THROWS_WITH(portrait_of(field, {.window = Window{{0, 0}, {1, INFINITY}}}), Contains("finite"));
  CHECK_THROWS_WITH(portrait_of(field, {.window = Window{{0, 0}, {1, 1}}, .through = {{2, 0}}}),
                    Contains("(2, 0) lies outside the window 0 to 1 by 0 to 1"));
  CHECK_THROWS_WITH(portrait_of(field, {.orbits = -1}), Contains(">= 0, got -1 and 0"));
  CHECK_THROWS_WITH(portrait_of(field, {.isochrone_times = {0}}), Contains("must be > 0, got 0"));
  for (const auto& request : std::vector<PortraitRequest>{{.view = View::uv}, {.linear = true}, {.time_unit = 2}}) {
    CHECK_THROWS_WITH(portrait_of(field, request), Contains("only for (2.6)"));
  }
  CHECK_THROWS_WITH(portrait_of(field, {.highlight = {{-1, 1}}}), Contains("no value"));
}

TEST_CASE("the data of a planar portrait say what it is", "[output]") {
  const PlanarPortrait portrait =
      portrait_of([](const Vector2d& x) { return Vector2d(-x[0], -3 * x[1]); }, {.orbits = 8});
  const auto json = nlohmann::json::parse(to_json(portrait, {.version = "1.2"}));
  CHECK(json["schema"] == 1);
  CHECK(json["system"] == "a system");
  CHECK(json["kind"] == "stable node");
  CHECK(json["version"] == "1.2");
  CHECK(json["window"] == nlohmann::json::parse("[[-1, 1], [-1, 1]]"));
  CHECK(json["rays"].size() == 4);
  CHECK(json["orbits"].size() == 8);
  CHECK(json["orbits"][0]["tau_left"][0] == "inf");
  CHECK(json["isochrones"].empty());
  CHECK(json["equilibria"].size() == 1);
  CHECK(json["equilibria"][0]["kind"] == "stable node");
  for (const auto& orbit : json["orbits"]) {
    // v/u^3 is constant along orbits.
    const double first = orbit["v"][0].get<double>() / std::pow(orbit["u"][0].get<double>(), 3);
    const std::size_t middle = orbit["u"].size() / 2;
    const double u = orbit["u"][middle], v = orbit["v"][middle];
    CHECK(v == Approx(first * u * u * u).epsilon(0.02).margin(1e-9));
  }
  const std::string csv = to_csv(portrait);
  CHECK_THAT(csv, Contains("# kind: \"stable node\"\n") && Contains("\nkind,index,u,v,tau\norbit,0,"));
}

TEST_CASE("the axes of a planar portrait have the letters of the equations", "[output]") {
  PlanarPortrait portrait = portrait_of([](const Vector2d& x) { return Vector2d(-x[0], -2 * x[1]); });
  Figure figure = draw(portrait);
  CHECK(figure.panels[0].x.name == math("u"));
  CHECK(figure.panels[0].y.name == math("v"));
  portrait.variables = {"x", "x'"};
  figure = draw(portrait);
  CHECK(figure.panels[0].x.name == math("x"));
  CHECK(figure.panels[0].y.name == math("x′"));
}

TEST_CASE("the part of a planar portrait in which the field has no value is grey", "[output]") {
  using Condition = std::function<bool(const Vector2d&)>;
  const Condition conditions[] = {
      [](const Vector2d&) { return true; },
      [](const Vector2d& x) { return x[1] > 0; },
      [](const Vector2d& x) { return x[0] > -0.37; },
      [](const Vector2d& x) { return x[1] > x[0] - 0.6; },
      [](const Vector2d& x) { return x.norm() < 0.9; },
      [](const Vector2d& x) { return x.norm() > 0.3; },
      [](const Vector2d& x) { return std::abs(x[0] - 0.2) > 0.15 || x[1] > 0.4; },
      [](const Vector2d& x) { return x[0] * x[1] > 0 || x.lpNorm<Eigen::Infinity>() > 0.7; },
      [](const Vector2d& x) { return std::sin(7 * x[0]) + std::cos(6 * x[1]) < 0.6; },
  };
  for (const Condition& condition : conditions) {
    INFO("condition " << &condition - conditions);
    for (const bool throws : {false, true}) {
      const PlanarField field = [&](const Vector2d& x) -> Vector2d {
        if (condition(x)) return Vector2d(-x[0], -2 * x[1]);
        if (throws) throw std::domain_error("no value");
        return Vector2d::Constant(NAN);
      };
      PlanarPortrait portrait = portrait_of([](const Vector2d& x) { return Vector2d(-x[0], -2 * x[1]); });
      portrait.plane = reduction::by_steps({field});
      const Figure figure = draw(portrait);
      const std::vector<Region>& regions = figure.panels[0].regions;
      CHECK(regions.empty() == (&condition == conditions));
      CHECK(figure.subtitle.words().ends_with("; grey: the field has no value") == !regions.empty());
      const Window& window = portrait.window;
      std::mt19937 random(1);
      int wrong = 0;
      constexpr int count = 4000;
      for (int i = 0; i < count; ++i) {
        const auto within = [&](int of) {
          return std::uniform_real_distribution<>(window.low[of], window.high[of])(random);
        };
        const Vector2d x(within(0), within(1));
        bool grey = false;
        for (const Region& region : regions) {
          bool inside = false;
          const Polyline& line = region.border;
          for (std::size_t j = 0, last = line.size() - 1; j < line.size(); last = j++) {
            const auto [a, b] = std::pair(line[j], line[last]);
            if ((a.y > x[1]) != (b.y > x[1]) && x[0] < a.x + (b.x - a.x) * (x[1] - a.y) / (b.y - a.y)) inside = !inside;
          }
          grey = grey || inside;
        }
        wrong += grey == condition(x) ? 1 : 0;
      }
      CHECK(wrong < count / 100);
    }
  }
}

TEST_CASE("a planar portrait as a drawing", "[output]") {
  const PlanarPortrait portrait =
      portrait_of([](const Vector2d& x) -> Vector2d { return Vector2d(-x[0], -2 * x[1]) * std::pow(x.norm(), -1.5); });
  const Figure figure = draw(portrait, {.field = PortraitStyle::Field::motion});
  CHECK(figure.title == Text("a system"));
  CHECK_THAT(figure.subtitle.words(), Contains("stable node"));
  REQUIRE(figure.panels.size() == 1);
  CHECK(figure.colour_bar.has_value());
  const Panel& panel = figure.panels[0];
  CHECK(panel.to_scale);
  CHECK(layer(panel, "ray that orbits approach").lines.size() == 2);
  CHECK(layer(panel, "ray that orbits leave").lines.size() == 2);
  CHECK(layer(panel, "time left").lines.size() == portrait.isochrones.size());
  CHECK(layer(panel, "direction").lines.size() > 100);
  CHECK_FALSE(draw(portrait, {.colour_by_time = false}).colour_bar.has_value());
  const PlanarPortrait linear = portrait_of([](const Vector2d& x) { return Vector2d(x[0], -x[1]); });
  CHECK_FALSE(draw(linear).colour_bar.has_value());
  CHECK(layer(draw(linear).panels[0], "orbits").lines.size() == linear.orbits.size());
}

TEST_CASE("a planar portrait does not depend on the unit of length", "[symmetry]") {
  // A damped pendulum and a relay, drawn by steps, whose coordinates are divided by S. S is a power of 2, so that the
  // portrait in units of S is the same to rounding.
  const std::vector<PlanarField> fields{[](const Vector2d& x) { return Vector2d(x[1], -std::sin(x[0]) - 0.02 * x[1]); },
                                        [](const Vector2d& x) { return Vector2d(x[1], -sign(x[0]) - 0.3 * x[1]); }};
  for (const PlanarField& field : fields) {
    const auto portrait_in = [&](double S) {
      PortraitRequest request;
      request.window = Window{Vector2d(-2, -2) * S, Vector2d(2, 2) * S};
      request.highlight = State{0.9 * S, 0.3 * S};
      request.orbits = 6;
      const PlanarField scaled = [=](const Vector2d& x) -> Vector2d { return field(x / S) * S; };
      return planar_portrait(reduction::by_steps(scaled), "a system", request);
    };
    const PlanarPortrait one = portrait_in(1);
    for (const double power : {-50, -30, 40}) {
      const double S = std::exp2(power);
      CAPTURE(S);
      const PlanarPortrait other = portrait_in(S);
      REQUIRE(other.orbits.size() == one.orbits.size());
      for (std::size_t i = 0; i < one.orbits.size(); ++i) {
        REQUIRE(other.orbits[i].u.size() == one.orbits[i].u.size());
        CHECK((other.orbits[i].u / S - one.orbits[i].u).abs().maxCoeff() < 1e-9);
        CHECK((other.orbits[i].v / S - one.orbits[i].v).abs().maxCoeff() < 1e-9);
      }
    }
  }
}

namespace {

PlanarPortrait stepped_portrait(const PlanarField& field, const PortraitRequest& request = {}) {
  return planar_portrait(reduction::by_steps({field}), "a system", request);
}

const PlanarField pendulum = [](const Vector2d& x) { return Vector2d(x[1], -std::sin(x[0])); };
const PlanarField van_der_pol = [](const Vector2d& x) { return Vector2d(x[1], (1 - x[0] * x[0]) * x[1] - x[0]); };

}  // namespace

TEST_CASE("the window of a planar portrait shows what the system has", "[output]") {
  // The limit cycle, whose amplitudes are 2.0086 and 2.6726 (SciPy's DOP853).
  const Window cycle = stepped_portrait(van_der_pol).window;
  CHECK(-cycle.low[0] == Approx(2.5).epsilon(0.2));
  CHECK(cycle.high[1] == Approx(3.3).epsilon(0.2));
  // Also about a start near the equilibrium.
  CHECK(stepped_portrait(van_der_pol, {.highlight = {{0.1, 0}}}).window.high[1] == Approx(3.3).epsilon(0.2));
  // An epidemic, at its peak: i = 1 - (1 + ln(3 s))/3 at s = 1/3, after i = 0.01.
  const PlanarField epidemic = [](const Vector2d& x) { return Vector2d(-3 * x[0] * x[1], (3 * x[0] - 1) * x[1]); };
  const Window wave = stepped_portrait(epidemic, {.highlight = {{0.99, 0.01}}}).window;
  CHECK(wave.high[1] > 1 - (1 + std::log(3 * 0.99)) / 3);
  CHECK(wave.high[1] < 1);
  // One and a half periods, and the orbits that turn over.
  const Window periods = stepped_portrait(pendulum).window;
  CHECK(periods.low[0] == Approx(-1.5 * std::numbers::pi));
  CHECK(periods.high[0] == Approx(1.5 * std::numbers::pi));
  CHECK(periods.high[1] > 2.3);
  CHECK(periods.high[1] < 5);
  // About a start that lies some periods away.
  const Window moved = stepped_portrait(pendulum, {.highlight = {{20, 0.1}}}).window;
  CHECK((moved.low[0] + moved.high[0]) / 2 == Approx(6 * std::numbers::pi));
  // The positive quadrant of a population.
  const PlanarField animals = [](const Vector2d& x) { return Vector2d(x[0] * (1 - x[1]), x[1] * (x[0] - 1)); };
  const Window population = stepped_portrait(animals).window;
  CHECK(population.low == Vector2d(0, 0));
  CHECK(population.high.minCoeff() > 1.7);
  CHECK(population.high.maxCoeff() < 4);
  CHECK(stepped_portrait(animals, {.highlight = {{1, -0.5}}}).window.low[1] < -0.5);
  // The loop of a saddle, which reaches from 0 to 1.5.
  const Window loop = stepped_portrait([](const Vector2d& x) { return Vector2d(x[1], x[0] - x[0] * x[0]); }).window;
  CHECK(loop.high[0] > 1.5);
  CHECK(loop.high[0] < 3);
  CHECK(loop.low[0] < -0.2);
  // Equilibria of y' = F(x, y).
  std::mt19937_64 random(1);
  for (int i = 0; i < 10; ++i) {
    // The capacity of a population, and slopes that change their sign again and again.
    const double capacity = std::pow(10, std::uniform_real_distribution(-1., 2.95)(random));
    const Window to_capacity =
        stepped_portrait([=](const Vector2d& x) { return Vector2d(1, x[1] * (1 - x[1] / capacity)); }).window;
    CAPTURE(capacity);
    CHECK(to_capacity.contains({0, capacity}));
    CHECK(to_capacity.high[1] < std::max(4., 1.5 * capacity));
    const double factor = std::uniform_real_distribution(0.5, 2.)(random);
    const Window waves =
        stepped_portrait([=](const Vector2d& x) { return Vector2d(1, std::sin(factor * x[0] * x[1])); }).window;
    CHECK(waves.high[1] < 12);
  }
  const Window growth = stepped_portrait([](const Vector2d& x) { return Vector2d(1, x[1] * (1 - x[1] / 10)); }).window;
  CHECK(growth.high[1] > 10);
  CHECK(growth.high[1] < 20);
  const Window asked{{-3, -1}, {2, 4}};
  CHECK(stepped_portrait(van_der_pol, {.window = asked}).window.low == asked.low);
}

TEST_CASE("limit cycles are drawn once, and other orbits end beside them", "[output]") {
  const PlanarField two = [](const Vector2d& x) -> Vector2d {  // cycles of radius 0.5 and 1
    const double square = x.squaredNorm();
    return (square - 0.25) * (1 - square) * x + Vector2d(-x[1], x[0]);
  };
  const PlanarPortrait portrait = stepped_portrait(two, {.highlight = {{0.7, 0.1}}});
  REQUIRE(portrait.cycles.size() == 2);
  const double side = portrait.window.sides()[0];
  REQUIRE(portrait.orbits.size() > 8);
  for (const PortraitOrbit& orbit : portrait.orbits) {
    for (Eigen::Index i = 0; i < orbit.rows(); ++i) {
      const double r = std::hypot(orbit.u[i], orbit.v[i]);
      CHECK(std::min(std::abs(r - 0.5), std::abs(r - 1)) > 0.005 * side);
    }
  }
  // The orbit of the start comes near the stable cycle and ends.
  REQUIRE(portrait.highlight.size() == 1);
  const PortraitOrbit& asked = portrait.highlight.front();
  CHECK(std::hypot(asked.u[asked.rows() - 1], asked.v[asked.rows() - 1]) == Approx(1).margin(0.03 * side));
  const auto json = nlohmann::json::parse(to_json(portrait));
  REQUIRE(json["cycles"].size() == 2);
  for (const auto& cycle : json["cycles"]) {
    CHECK(cycle["period"].get<double>() == Approx(2 * std::numbers::pi).epsilon(1e-9));
    const double square = std::pow(cycle["u"].get<double>(), 2) + std::pow(cycle["v"].get<double>(), 2);
    CHECK(cycle["stable"] == square > 0.5);
    CHECK(square == Approx(square > 0.5 ? 1 : 0.25).epsilon(1e-9));
    // The rate of the radius r has the slope 2 r^2 (1.25 - 2 r^2) at the cycle.
    CHECK(std::log(cycle["multiplier"].get<double>()) ==
          Approx(2 * std::numbers::pi * 2 * square * (1.25 - 2 * square)).epsilon(1e-7));
  }
  const Panel panel = draw(portrait).panels[0];
  const Lines &stable = layer(panel, "stable limit cycle, T = 6.2832, multiplier 8.07e-05"),
              &unstable = layer(panel, "unstable limit cycle, T = 6.2832, multiplier 10.6");
  CHECK(!stable.stroke.dashed);
  CHECK(unstable.stroke.dashed);
  CHECK(stable.lines.size() == 1);
  CHECK(panel.lines.back().legend == Text("orbit of the start"));
}

TEST_CASE("separatrices have a direction, and a connection is one line", "[output]") {
  const auto count = [](const PlanarPortrait& portrait, std::string_view manifold) {
    return std::ranges::count(portrait.separatrices, manifold, &Separatrix::manifold);
  };
  const PlanarPortrait swings = stepped_portrait(pendulum);
  CHECK(count(swings, "connection") == 2);
  CHECK(count(swings, "stable") == 2);
  CHECK(count(swings, "unstable") == 2);
  for (const Separatrix& each : swings.separatrices) {
    for (Eigen::Index i = 0; i < each.rows(); ++i) {
      CHECK(std::abs(each.v[i]) == Approx(2 * std::abs(std::cos(each.u[i] / 2))).margin(1e-4));
    }
  }
  const PlanarPortrait loop = stepped_portrait([](const Vector2d& x) { return Vector2d(x[1], x[0] - x[0] * x[0]); });
  CHECK(count(loop, "connection") == 1);
  // Two loops inside two connections of other saddles. The orbits come from V.
  const PlanarField two_loops = [](const Vector2d& x) {
    return Vector2d(x[1], std::sin(x[0]) * (std::cos(x[0]) - 0.3));
  };
  const PlanarReduction solved = reduction::by_factor({two_loops}, {0.3, 0.5});
  REQUIRE(solved.solved());
  PortraitRequest few;
  few.orbits = 2;
  const PlanarPortrait loops = planar_portrait(solved, "a system", few);
  CHECK(count(loops, "connection") == 4);
  CHECK(count(loops, "unstable") == 2);
  const PlanarPortrait damped =
      stepped_portrait([](const Vector2d& x) { return Vector2d(x[1], x[0] - std::pow(x[0], 3) - 0.2 * x[1]); });
  CHECK(count(damped, "connection") == 0);
  CHECK(count(damped, "unstable") == 2);
  const auto json = nlohmann::json::parse(to_json(damped));
  CHECK(json["separatrices"].size() == damped.separatrices.size());
  CHECK(json["separatrices"][0]["manifold"] == damped.separatrices[0].manifold);
}

TEST_CASE("curves of equilibria and nullclines are drawn as such", "[output]") {
  const PlanarField infection = [](const Vector2d& x) {
    return Vector2d(-0.5 * x[0] * x[1], 0.5 * x[0] * x[1] - 0.2 * x[1]);
  };
  const PlanarPortrait portrait = planar_portrait(reduction::reduce({infection}, {1, 1}), "a system",
                                                  {.window = Window{{-0.2, -0.2}, {1, 1}}, .nullclines = true});
  REQUIRE(portrait.lines_of_equilibria.size() == 1);
  CHECK(portrait.lines_of_equilibria[0].v.abs().maxCoeff() < 1e-6);
  CHECK(portrait.lines_of_equilibria[0].u.maxCoeff() - portrait.lines_of_equilibria[0].u.minCoeff() > 1.1);
  // v' = 0 on v = 0 and on u = 0.4.
  bool found = false;
  for (const PortraitOrbit& line : portrait.nullclines[1]) {
    found |= (line.u - 0.4).abs().maxCoeff() < 1e-6;
    CHECK(((line.u - 0.4) * line.v).abs().maxCoeff() < 1e-6);
  }
  CHECK(found);
  const Panel panel = draw(portrait).panels[0];
  CHECK(!layer(panel, "equilibria").lines.empty());
  for (const Polyline& line : layer(panel, "invariant curves").lines) {
    for (const Point& at : line) CHECK(std::abs(at.x) < 1e-6);
  }
  CHECK(!layer(panel, "u′ = 0").lines.empty());
  CHECK(!layer(panel, "v′ = 0").lines.empty());
}

TEST_CASE("a line of equilibria is drawn as such, not as a ray", "[output]") {
  std::mt19937_64 random(9);
  const auto among = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 8; ++i) {
    const double angle = among(0, 6.28);
    const Vector2d n(std::cos(angle), std::sin(angle)), w = n + among(-1, 1) * Vector2d(-n[1], n[0]);
    const PlanarPortrait portrait = portrait_of([=](const Vector2d& x) -> Vector2d { return n.dot(x) * w; });
    CAPTURE(angle);
    REQUIRE(!portrait.lines_of_equilibria.empty());
    double length = 0;
    for (const PortraitOrbit& line : portrait.lines_of_equilibria) {
      for (Eigen::Index k = 0; k < line.rows(); ++k) {
        CHECK(std::abs(n.dot(Vector2d(line.u[k], line.v[k]))) < 1e-6);
        length = std::max(length, std::hypot(line.u[k] - line.u[0], line.v[k] - line.v[0]));
      }
    }
    CHECK(length > 1.9);  // from border to border
    const Figure figure = draw(portrait);
    for (const Lines& layer : figure.panels[0].lines) {
      if (!layer.legend.words().starts_with("ray")) continue;
      for (const Polyline& line : layer.lines) {
        for (const Point& at : line) {
          const double across = std::abs(n.dot(Vector2d(at.x, at.y))), distance = std::hypot(at.x, at.y);
          CHECK((distance < 1e-6 || across > 1e-3 * distance));
        }
      }
    }
  }
}

TEST_CASE("y' = F(x, y) is drawn in the words of curves, without times", "[output]") {
  const PlanarPortrait portrait = portrait_of([](const Vector2d& x) { return Vector2d(1, x[1] / x[0] + x[0] * x[0]); });
  CHECK(portrait.isochrones.empty());
  const Figure figure = draw(portrait);
  CHECK(!figure.colour_bar);
  CHECK(!layer(figure.panels[0], "solutions").lines.empty());
  CHECK(figure.subtitle.words() == "all solutions between two of these are one curve, moved by the symmetry");
}

TEST_CASE("dots are stable equilibria, circles unstable ones", "[output]") {
  const PlanarPortrait portrait = stepped_portrait(
      [](const Vector2d& x) { return Vector2d(x[0] * (3 - x[0] - 2 * x[1]), x[1] * (2 - x[0] - x[1])); });
  const Panel panel = draw(portrait).panels[0];
  const auto shape = [&](std::string_view kind) {
    const auto its = std::ranges::find_if(panel.marks, [&](const Marks& marks) { return marks.legend == Text(kind); });
    REQUIRE(its != panel.marks.end());
    return its->shape;
  };
  CHECK(shape("stable node") == Marks::Shape::dot);
  CHECK(shape("unstable node") == Marks::Shape::circle);
  CHECK(shape("saddle") == Marks::Shape::square);
  // Kinds with one mark share a line of the legend: the center (1, 1) of the animals and the stable node here.
  const Panel shared = draw(stepped_portrait([](const Vector2d& x) {
                         return Vector2d(x[0] * (1 - x[0]) * (2 - x[0]), x[1] * x[1]);
                       })).panels[0];
  CHECK(std::ranges::count(shared.marks, Marks::Shape::diamond, &Marks::shape) == 1);
  // The centre of a symmetry, too.
  for (const double sign : {-1, 1}) {
    const PlanarPortrait scaled =
        portrait_of([=](const Vector2d& x) { return Vector2d(sign * x[0], sign * 3 * x[1]); });
    CHECK(draw(scaled).panels[0].marks.back().shape == (sign < 0 ? Marks::Shape::dot : Marks::Shape::circle));
  }
}

TEST_CASE("values of parameters stand below the title", "[output]") {
  PlanarPortrait portrait = stepped_portrait(van_der_pol);
  portrait.parameters = {{"mu", 0.1}, {"b", 2}};
  CHECK(draw(portrait).subtitle.words().starts_with("b = 2, mu = 0.1; "));
}

TEST_CASE("degenerate equilibria have the separatrices of their sectors", "[output]") {
  struct Case {
    const char* name;
    PlanarField field;
    std::ptrdiff_t stable, unstable;
    std::function<double(double, double)> curve;  // 0 on the separatrices
  };
  const double third = 1. / 3;
  const Case cases[] = {
      {"cusp", [](const Vector2d& x) { return Vector2d(x[1], x[0] * x[0]); }, 1, 1,
       [=](double u, double v) { return v * v / 2 - third * u * u * u; }},
      {"saddle-node", [](const Vector2d& x) { return Vector2d(x[0] * x[0], -x[1]); }, 2, 1,
       [](double u, double v) { return std::min(std::abs(u), std::abs(v)); }},
      {"saddle without eigenvalues", [](const Vector2d& x) { return Vector2d(x[1], std::pow(x[0], 3)); }, 2, 2,
       [](double u, double v) { return v * v / 2 - std::pow(u, 4) / 4; }},
      {"saddle with one eigenvalue", [](const Vector2d& x) { return Vector2d(std::pow(x[0], 3), -x[1]); }, 2, 2,
       [](double u, double v) { return u * v; }},
      {"node with one eigenvalue", [](const Vector2d& x) { return Vector2d(-std::pow(x[0], 3), -x[1]); }, 0, 0,
       [](double, double) { return 0.; }},
      {"dipole", [](const Vector2d& x) { return Vector2d(x[0] * x[0] - x[1] * x[1], 2 * x[0] * x[1]); }, 0, 0,
       [](double, double) { return 0.; }},
  };
  for (const Case& each : cases) {
    INFO(each.name);
    PortraitRequest request;
    request.window = Window{{-1, -1}, {1.1, 1.2}};
    const PlanarPortrait portrait = stepped_portrait(each.field, request);
    const auto count = [&](std::string_view manifold) {
      return std::ranges::count(portrait.separatrices, manifold, &Separatrix::manifold);
    };
    CHECK(count("stable") == each.stable);
    CHECK(count("unstable") == each.unstable);
    for (const Separatrix& line : portrait.separatrices) {
      for (Eigen::Index i = 0; i < line.rows(); ++i) CHECK(each.curve(line.u[i], line.v[i]) == Approx(0).margin(2e-3));
    }
  }
}

TEST_CASE("ordinary orbits do not fill a weak focus or the surroundings of a cycle", "[output]") {
  // An orbit of this focus would make hundreds of turns without the rule for the last turn.
  const PlanarPortrait focus = stepped_portrait([](const Vector2d& x) { return Vector2d(x[1], -x[0] - 0.002 * x[1]); });
  REQUIRE(focus.orbits.size() > 5);
  for (const PortraitOrbit& orbit : focus.orbits) {
    if (orbit.u.abs().maxCoeff() < 0.05 * focus.window.sides()[0]) continue;
    double angle = 0;
    for (Eigen::Index i = 1; i < orbit.rows(); ++i) {
      angle += std::atan2(orbit.u[i - 1] * orbit.v[i] - orbit.v[i - 1] * orbit.u[i],
                          orbit.u[i - 1] * orbit.u[i] + orbit.v[i - 1] * orbit.v[i]);
    }
    CHECK(std::abs(angle) < 2 * std::numbers::pi * 4);
  }
}

TEST_CASE("equations are typeset, and slopes of a first-order equation have no heads", "[output]") {
  PlanarPortrait portrait = stepped_portrait([](const Vector2d& x) { return Vector2d(1, x[0] * x[0] - x[1]); });
  portrait.name = "y' = 2*x^2-y";
  const PortraitStyle style{.field = PortraitStyle::Field::motion};
  const Figure figure = draw(portrait, style);
  CHECK(figure.title == Text("y′ = 2·x") + sup("2") + "−y");
  const Lines& slopes = layer(figure.panels[0], "slopes");
  CHECK(slopes.lines.size() > 100);
  for (const Polyline& mark : slopes.lines) {
    const Point from = mark.front(), to = mark.back();
    const double x = (from.x + to.x) / 2, y = (from.y + to.y) / 2;
    CHECK((to.y - from.y) == Approx((x * x - y) * (to.x - from.x)).margin(1e-9));
  }
  // The field of a system has heads.
  const Figure other = draw(stepped_portrait(van_der_pol), style);
  CHECK(layer(other.panels[0], "direction of the motion").lines.size() > 100);
}

TEST_CASE("a high window is not drawn to scale", "[output]") {
  const auto drawn = [](const Window& window) {
    PortraitRequest request;
    request.window = window;
    return draw(stepped_portrait(pendulum, request));
  };
  const Figure high = drawn({{-1, -3}, {1, 3}}), square = drawn({{-1, -1}, {1, 1}});
  CHECK_FALSE(high.panels[0].to_scale);
  CHECK(high.size.height_mm < 1.1 * high.size.width_mm);
  CHECK(square.panels[0].to_scale);
}

TEST_CASE("on the Poincare disc orbits lead from sources at infinity to sinks at infinity", "[output]") {
  // u' = u^2 + v^2 - 1, v' = 5 u v - 5: Perko, section 3.10. There is no equilibrium in the plane.
  reduction::SmoothField field([](const Vector2d& x) { return Vector2d(x.squaredNorm() - 1, 5 * x[0] * x[1] - 5); });
  field.polynomials.assign(2, Eigen::MatrixXd::Zero(3, 3));
  field.polynomials[0](2, 0) = field.polynomials[0](0, 2) = 1;
  field.polynomials[0](0, 0) = -1;
  field.polynomials[1](1, 1) = 5;
  field.polynomials[1](0, 0) = -5;
  PortraitRequest request;
  request.highlight = State{3, -40};
  const PlanarPortrait portrait = portrait_on_disc(reduction::by_steps(field), "a system", request);
  REQUIRE(portrait.disc);
  REQUIRE(portrait.disc->at_infinity.size() == 6);
  CHECK(portrait.equilibria.points.empty());

  // Directions in which motions begin and end: v = 2 u and v = -2 u are sources on the left and sinks on the right.
  int from_infinity = 0;
  for (const PortraitOrbit& orbit : portrait.orbits) {
    const auto last = orbit.rows() - 1;
    const Vector2d first(orbit.u[0], orbit.v[0]), end(orbit.u[last], orbit.v[last]);
    constexpr double far = 50;
    CHECK(end.norm() > far);
    CHECK(end[0] > 0);
    CHECK(std::abs(end[1]) / end[0] == Approx(2).epsilon(0.1));
    if (first.norm() < far) continue;
    ++from_infinity;
    CHECK(first[0] < 0);
    for (Eigen::Index i = 1; i < orbit.rows(); ++i) {
      const Vector2d here(orbit.u[i], orbit.v[i]), before(orbit.u[i - 1], orbit.v[i - 1]);
      if (here.norm() < 5) CHECK((here - before).dot(field((here + before) / 2)) > 0);
    }
  }
  CHECK(from_infinity >= 8);
  REQUIRE(portrait.highlight.size() == 1);
  CHECK(portrait.highlight[0].u[0] == Approx(3).epsilon(1e-12));
  CHECK(portrait.highlight[0].v[0] == Approx(-40).epsilon(1e-12));
  // Each saddle at infinity has a separatrix in the plane.
  CHECK(portrait.separatrices.size() == 2);

  const auto json = nlohmann::json::parse(to_json(portrait));
  CHECK(json["view"] == "disc");
  CHECK(json["degree"] == 2);
  REQUIRE(json["at_infinity"].size() == 6);
  CHECK(json["at_infinity"][3]["kind"] == "saddle");
  CHECK(json["at_infinity"][3]["angle"] == 0);
  CHECK(json["equilibria_within"][0][0] == "-inf");

  const Figure figure = draw(portrait);
  for (const Lines& lines : figure.panels[0].lines) {
    for (const Polyline& line : lines.lines) {
      for (const Point& at : line) CHECK(std::hypot(at.x, at.y) < 1 + 1e-6);
    }
  }
  CHECK_THROWS_WITH(portrait_on_disc(reduction::by_steps(pendulum), "a pendulum", request), Contains("polynomials"));
}
