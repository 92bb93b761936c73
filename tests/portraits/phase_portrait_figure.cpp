#include "contensou/portraits/phase_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "../octic_law.hpp"
#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/render.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "figures.hpp"

using namespace contensou;
using portraits::Figure;
using portraits::inside;
using portraits::layer;
using portraits::Lines;
using portraits::Panel;
using portraits::Point;
using portraits::PortraitRequest;
using portraits::PortraitStyle;
using portraits::View;
using reduction::State;

namespace {

portraits::PhasePortrait portrait_of(double mu, const PortraitRequest& request = {}) {
  return portraits::phase_portrait({{reduction::HertzLaw{}, mu}}, request);
}

Figure figure_of(double mu, const PortraitRequest& request = {}) { return draw(portrait_of(mu, request)); }

/// A style that draws all orbits as one layer.
const PortraitStyle plain{.colour_by_time = false};

/// Returns the parts of lines that are seen in a panel.
std::vector<portraits::Polyline> seen(const Panel& panel, const std::vector<portraits::Polyline>& lines) {
  std::vector<portraits::Polyline> parts;
  for (const auto& line : lines) std::ranges::move(portraits::clipped(panel, line), std::back_inserter(parts));
  return parts;
}

/// Returns the number of points of all lines that are seen in a panel.
std::size_t seen_points(const Panel& panel) {
  std::size_t points = 0;
  for (const auto& layer : panel.lines) {
    for (const auto& part : seen(panel, layer.lines)) points += part.size();
  }
  return points;
}

/// Calls a function with each line of an orbit and the number of its colour. These are the lines without a legend.
template <class Visit>
void each_coloured(const Panel& panel, const std::vector<portraits::Colour>& colours, const Visit& visit) {
  for (const auto& layer : panel.lines) {
    if (!layer.legend.empty()) continue;
    const auto band = std::ranges::find(colours, layer.stroke.colour.rgb, &portraits::Colour::rgb) - colours.begin();
    for (const auto& line : layer.lines) visit(line, band);
  }
}

/// Returns the largest sine of the angles of a line on paper. An angle between short pieces looks like a bend.
double sharpest(const Panel& panel, const portraits::Polyline& line, double shortest) {
  double sharpest = 0;
  for (std::size_t i = 2; i < line.size(); ++i) {
    const Point a = on_paper(panel, line[i - 2]), b = on_paper(panel, line[i - 1]), c = on_paper(panel, line[i]);
    const double before = std::hypot(b.x - a.x, b.y - a.y), after = std::hypot(c.x - b.x, c.y - b.y);
    if (std::min(before, after) <= shortest) continue;
    const double cosine = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
    const double sine = ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x)) / (before * after);
    sharpest = std::max(sharpest, cosine < 0 ? 1 : std::abs(sine));
  }
  return sharpest;
}

/// Returns the points of the marks with a legend.
std::vector<Point> marked(const Panel& panel, const portraits::Text& legend) {
  const auto found = std::ranges::find(panel.marks, legend, &portraits::Marks::legend);
  REQUIRE(found != panel.marks.end());
  return found->points;
}

/// Computes the stop time at a point of a portrait's plane, by quadrature.
class Clock {
 public:
  explicit Clock(const portraits::PhasePortrait& portrait)
      : flow_(reduction::Flow::by_quadrature(portrait.system())), scale_(portrait.scale) {}
  double operator()(portraits::Point at) const {
    const double v = scale_.linear() ? at.y : at.y == 0 ? 0 : std::exp(scale_.ln_v(at.y));
    return flow_.orbit({at.x, v}).stop_time();
  }

 private:
  reduction::Flow flow_;
  portraits::SpeedScale scale_;
};

/// Returns the relative luminance as WCAG 2 defines it.
double luminance(portraits::Colour colour) {
  double sum = 0;
  for (const auto& [shift, weight] : {std::pair{16, 0.2126}, {8, 0.7152}, {0, 0.0722}}) {
    const double part = ((colour.rgb >> shift) & 0xFF) / 255.0;
    sum += weight * (part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
  }
  return sum;
}

/// Returns the arrow heads on orbits, without the heads on the axes, which have the colour of the axes.
std::vector<portraits::Arrow> heads_on_orbits(const Panel& panel) {
  std::vector<portraits::Arrow> heads;
  for (const auto& layer : panel.arrows) {
    if (layer.colour.rgb != 0x222222) heads.insert(heads.end(), layer.arrows.begin(), layer.arrows.end());
  }
  return heads;
}

const std::vector<double> patch_ratios{1.0, 0.3, 0.01, 0.001};

}  // namespace

TEST_CASE("Every view at every patch ratio: drawn within its axes, with names, and states where their points are",
          "[invariant]") {
  for (double mu : patch_ratios) {
    for (View view : portraits::views()) {
      const auto [figure, maps] = draw_mapped(portrait_of(mu, {.view = view, .highlight = State{1, 0.8}}));
      CHECK_FALSE(figure.title.empty());
      CHECK_FALSE(figure.subtitle.empty());
      REQUIRE(maps.size() == figure.panels.size());
      for (std::size_t i = 0; i < maps.size(); ++i) {
        const Panel& panel = figure.panels[i];
        CAPTURE(mu, portraits::name(view), i);
        CHECK(panel.x.low < panel.x.high);
        CHECK(panel.y.low < panel.y.high);
        CHECK(seen_points(panel) > 200);
        for (const auto& layer : panel.arrows) {
          for (const auto& arrow : layer.arrows) CHECK(inside(panel, arrow.at));
        }
        for (const auto& layer : panel.marks) CHECK_FALSE(layer.points.empty());
        CHECK((maps[i].state == nullptr) == shows_moments(view));
        if (!maps[i].state) continue;
        int states = 0;
        constexpr int steps = 24;
        // Coordinates are rounded. For small mu the panel shows a narrow range, in which the rounding weighs more.
        const double rounding = 1e-15 / std::min(panel.x.high - panel.x.low, panel.y.high - panel.y.low);
        for (int cell = 0; cell < steps * steps; ++cell) {
          const Point point = from_paper(panel, {(cell % steps + 0.5) / steps, (cell / steps + 0.5) / steps});
          const auto at = maps[i].state(point);
          if (!at) continue;
          ++states;
          REQUIRE(portraits::paper_distance(panel, maps[i].place(*at, *at), point) < 1e-11 + rounding);
          REQUIRE(at->ln_v == Approx(at->ln_k + std::log(mu * std::abs(at->u))).epsilon(1e-12).margin(1e-9));
          REQUIRE(at->v == Approx(std::exp(at->ln_v)).epsilon(1e-12));
        }
        CHECK(states > steps * steps / 3);
      }
    }
  }
}

TEST_CASE("Every body is drawn in windows from 1:1e-6 to 1:1e6 in every view, with an orbit in every sector",
          "[extremes]") {
  struct Body {
    const char* law;
    reduction::Inertia inertia;
    double mu;
  };
  const std::vector<Body> bodies{{"exact", {3.5, 2.5}, 1}, {"exact", {3.5, 2.5}, 0.05}, {"exact", {2.5, 1.5}, 0.3},
                                 {"uniform", {1, 2}, 1},   {"ring", {1, 1}, 1},         {"uniform", {1, 2}, 0.01},
                                 {"exact", {1, 8}, 1}};
  const std::vector<double> all{1e-6, 3e-5, 6e-4, 0.01, 0.7, 30.0, 1.8e3, 1e6}, some{1e-6, 6e-4, 0.7, 1e6};
  for (const auto& [law, inertia, mu] : bodies) {
    const reduction::Flow flow({*reduction::find_law(law), mu, inertia});
    for (double v : CONTENSOU_FULL_TESTS ? all : some) {
      for (View view : portraits::views()) {
        CAPTURE(law, inertia.gamma, mu, v, portraits::name(view));
        const auto portrait =
            portraits::phase_portrait(flow, {.view = view, .sides = {{1, v}}, .highlight = State{1, v}});
        for (const Panel& panel : draw(portrait).panels) CHECK(seen_points(panel) > 100);
        if (!portraits::shows_window(view)) continue;
        for (const auto& curve : flow.solution().curves()) {
          CHECK(std::ranges::any_of(portrait.orbits, [&](const portraits::PortraitOrbit& orbit) {
            return flow.solution().through(orbit.ln_k[0]) == curve;
          }));
        }
      }
    }
  }
}

TEST_CASE("Seen lines are smooth: no two pieces of an orbit meet at a sharp angle on paper", "[invariant]") {
  for (double mu : patch_ratios) {
    for (View view : {View::log, View::similarity, View::blowup, View::disc, View::patch}) {
      for (const Panel& panel : draw(portrait_of(mu, {.view = view}), {}, plain).panels) {
        CAPTURE(mu, portraits::name(view), panel.title);
        for (const auto& part : seen(panel, layer(panel, "orbits").lines)) CHECK(sharpest(panel, part, 0.03) < 0.2);
      }
    }
  }
}

TEST_CASE("The plane shows orbits, isochrones and both invariant axes, each in the legend", "[table]") {
  for (double mu : {0.3, 0.099, 0.0035}) {
    CAPTURE(mu);
    const auto portrait = portrait_of(mu);
    const Panel panel = draw(portrait, {}, plain).panels.front();
    CHECK(layer(panel, "orbits").lines.size() == portrait.orbits.size());
    CHECK(layer(panel, "time left").lines.size() >= 4);
    const auto& axes = layer(panel, "invariant axes").lines;
    REQUIRE(axes.size() == 3);  // three half-lines, with arrows towards the stop, which has a mark
    for (const auto& axis : axes) CHECK(std::ranges::all_of(axis, [](auto point) { return point.x * point.y == 0; }));
    CHECK(panel.arrows.back().arrows.size() == 6);
    CHECK(panel.marks.back().legend == "the stop");
  }
}

TEST_CASE("Colours by time cut orbits into pieces and lose none", "[invariant]") {
  for (double mu : {0.3, 0.05}) {
    const auto portrait = portrait_of(mu);
    const Figure figure = draw(portrait);
    const Panel& panel = figure.panels.front();
    const auto whole = layer(draw(portrait, {}, plain).panels.front(), "orbits").lines;
    REQUIRE(figure.colour_bar);
    double pieces = 0, lines = 0;
    each_coloured(panel, figure.colour_bar->colours,
                  [&](const auto& line, auto) { pieces += portraits::paper_length(panel, line); });
    for (const auto& line : whole) lines += portraits::paper_length(panel, line);
    CHECK(pieces == Approx(lines).epsilon(1e-9));
    // Each band has a colour of its own. The colours run from dark to light, so that they differ in prints in grey.
    double before = -1;
    for (portraits::Colour colour : figure.colour_bar->colours) {
      CHECK(luminance(colour) > before);
      before = luminance(colour);
    }
  }
}

TEST_CASE("Every colour of an orbit has a contrast of 3:1 to what it is drawn on", "[table]") {
  const auto contrast = [](portraits::Colour one, portraits::Colour other) {
    const double ratio = (luminance(one) + 0.05) / (luminance(other) + 0.05);
    return std::max(ratio, 1 / ratio);
  };
  for (bool screen : {false, true}) {
    for (double mu : {0.9, 0.3, 0.05, 0.0035}) {
      const Figure figure = draw(portrait_of(mu, {.highlight = {{0.8, 3.5}}}), {}, {.screen = screen});
      const Panel& panel = figure.panels.front();
      std::vector<portraits::Colour> grounds{figure.theme.ground};
      for (const auto& region : panel.regions) grounds.push_back(region.colour);
      std::vector<portraits::Colour> colours = figure.colour_bar.value().colours;
      for (const auto& layer : panel.lines) {
        const bool halo = layer.stroke.colour.rgb == figure.theme.ground.rgb;
        if (!halo) colours.push_back(layer.stroke.colour);
      }
      for (portraits::Colour ground : grounds) {
        for (portraits::Colour colour : colours) CHECK(contrast(colour, ground) >= 3);
      }
    }
  }
}

TEST_CASE("A piece has the colour of the time left on it", "[route]") {
  const auto portrait = portrait_of(0.3);
  const Figure figure = draw(portrait);
  const Panel& panel = figure.panels.front();
  const portraits::ColourBar& bar = figure.colour_bar.value();
  const double step =
      portrait.isochrone_step / std::round(bar.ticks.at(1).at * static_cast<double>(bar.colours.size()));
  const Clock clock(portrait);
  each_coloured(panel, bar.colours, [&](const auto& line, auto band) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double tau = clock({(line[i - 1].x + line[i].x) / 2, (line[i - 1].y + line[i].y) / 2});
      CHECK(tau > (static_cast<double>(band) - 0.05) * step);
      CHECK(tau < (static_cast<double>(band) + 1.05) * step);
    }
  });
}

TEST_CASE("Planes side by side have one frame, and one colour for one time left", "[route]") {
  std::vector<reduction::Flow> flows;
  for (double mu : {0.05, 0.3, 1.0}) flows.emplace_back(reduction::ReducedSystem{reduction::HertzLaw{}, mu});
  const auto all = portraits::phase_portraits(flows, {});
  const Figure figure = draw_together(all, std::vector<portraits::PortraitCaption>(3));
  std::set<double> edges{0, 1e9};
  for (const auto& portrait : all) {
    for (const auto& isochrone : portrait.isochrones) edges.insert(isochrone.tau_stop);
  }
  const auto& colours = figure.colour_bar.value().colours;
  REQUIRE(edges.size() == colours.size() + 1);
  REQUIRE(figure.panels.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Panel& panel = figure.panels[i];
    const portraits::Text own = portraits::math("μ = ") + fmt::format("{}", flows[i].system().mu());
    CHECK(panel.title.words().starts_with(own.words()));
    CHECK((panel.x.low == -1 && panel.x.high == 1 && panel.y.low == 0 && panel.y.high == 1));
    CHECK(panel.labels.size() == 3);
    const Clock clock(all[i]);
    each_coloured(panel, colours, [&](const auto& line, auto band) {
      const auto begin = std::next(edges.begin(), band);
      const auto& at = line[line.size() / 2];
      if (line.size() < 3 || at.y > 0.5) return;
      CHECK(clock(at) > 0.95 * *begin);
      CHECK(clock(at) < 1.05 * *std::next(begin));
    });
  }
  CHECK_THROWS_WITH(draw_together(portraits::phase_portraits(flows, {.view = portraits::View::pair}),
                                  std::vector<portraits::PortraitCaption>(3)),
                    Catch::Contains("2 panels for each plane"));
}

TEST_CASE("Arrows point the way of the motion, and lie where equal times are left", "[invariant]") {
  for (double mu : {0.3, 0.099, 0.0035}) {
    const auto portrait = portrait_of(mu);
    const Figure figure = draw(portrait);
    for (const Panel& panel : figure.panels) {
      std::size_t count = 0;
      for (const auto& arrows : panel.arrows) {
        for (const auto& arrow : arrows.arrows) {
          ++count;
          CHECK(arrow.direction.y <= 0);
          CHECK(arrow.direction.x * arrow.at.x <= 0);
          CHECK(std::hypot(arrow.direction.x, arrow.direction.y) > 0);
        }
      }
      CHECK(count > 20);
    }
    const double step = portrait.isochrones.front().tau_stop;
    const Clock clock(portrait);
    for (const auto& arrow : heads_on_orbits(figure.panels.front())) {
      if (arrow.at.y > 0.6) continue;  // at large v the body slides; hardly any time passes
      const double tau = clock(arrow.at);
      CHECK(std::abs(tau / step - std::floor(tau / step) - 0.5) < 0.05);
    }
  }
  const auto heads = [](PortraitStyle::Arrows arrows) {
    return heads_on_orbits(draw(portrait_of(0.3), {}, {.arrows = arrows}).panels[0]).size();
  };
  CHECK(heads(PortraitStyle::Arrows::none) == 0);
  CHECK(heads(PortraitStyle::Arrows::one) <= 24);
  CHECK(heads(PortraitStyle::Arrows::one) >= 20);
}

TEST_CASE("Isochrones are labelled, inside the panel, and no label touches an orbit or a label", "[invariant]") {
  for (double mu : {1.0, 0.5, 0.3, 0.2, 0.099, 0.01, 0.0035}) {
    CAPTURE(mu);
    const auto portrait = portrait_of(mu);
    const Panel panel = draw(portrait).panels.front();
    CHECK(panel.labels.size() >= 3);
    const auto orbits = layer(draw(portrait, {}, plain).panels.front(), "orbits").lines;
    for (const auto& label : panel.labels) {
      CAPTURE(label.text.words());
      CHECK(inside(panel, label.at));
      const auto at = portraits::on_paper(panel, label.at);
      const double half = 0.004 * static_cast<double>(label.text.words().size());  // half a digit for each letter
      for (const auto& line : orbits) {
        for (std::size_t i = 1; i < line.size(); ++i) {
          if (line[i - 1].y < label.at.y || line[i].y > label.at.y) continue;
          CHECK(std::abs(portraits::on_paper(panel, line[i]).x - at.x) > half);
        }
      }
      for (const auto& other : panel.labels) {
        if (&other != &label) CHECK(portraits::paper_distance(panel, label.at, other.at) > 0.03);
      }
    }
  }
}

TEST_CASE("An isochrone has the stop time that its label says", "[route]") {
  for (double mu : {0.3, 0.01}) {
    const auto portrait = portrait_of(mu);
    const Panel panel = draw(portrait).panels.front();
    const Clock clock(portrait);
    for (const auto& label : panel.labels)
      CHECK(clock(label.at) == Approx(std::stod(label.text.words())).epsilon(2e-3));
  }
}

TEST_CASE("At small mu every orbit runs straight into the stop, whatever mu is, and the plane is filled to its corners",
          "[invariant]") {
  for (double mu : {0.45, 0.3, 0.099, 0.01, 0.0035}) {
    CAPTURE(mu);
    const auto portrait = portrait_of(mu);
    CHECK(portrait.scale.exponent == Approx(5 * mu * mu / 14).epsilon(1e-12));
    CHECK(portrait.window.v() <= 20 * mu);
    const Panel panel = draw(portrait, {}, plain).panels.front();
    double lowest = 1;
    for (const auto& line : layer(panel, "orbits").lines) {
      if (line.front().y < 1) lowest = std::min(lowest, line.front().y);
      const auto& near = line[line.size() - 2];
      for (const auto& point : line) {
        if (point.y < 0.2 && point.y > 1e-9) CHECK(point.x / point.y == Approx(near.x / near.y).epsilon(1e-3));
      }
    }
    CHECK(lowest < 0.12);
  }
  CHECK(portrait_of(0.5).scale.linear());
  CHECK(portrait_of(0.3, {.linear = true}).scale.linear());
  CHECK(portraits::phase_portrait({{*reduction::find_law("uniform"), 1, {.chi = 1, .gamma = 2}}}, {}).scale.linear());
}

TEST_CASE("Arrows on invariant rays point to the stop in every view", "[invariant]") {
  const reduction::Flow flow({*reduction::find_law("uniform"), 1, {.chi = 1, .gamma = 2}});
  for (View view : {View::uv, View::log, View::similarity, View::blowup, View::disc, View::pair}) {
    std::size_t count = 0;
    for (const Panel& panel : draw(portraits::phase_portrait(flow, {.view = view})).panels) {
      for (const auto& layer : panel.arrows) {
        if (layer.colour.rgb != 0xc8621a) continue;
        for (const auto& [at, direction] : layer.arrows) {
          ++count;
          CAPTURE(portraits::name(view), at.x, at.y);
          CHECK((direction.y < 0 || (direction.y == 0 && direction.x * at.x < 0)));
        }
      }
    }
    CHECK(count >= 2);
  }
}

TEST_CASE(
    "The log view has one scale on both axes, and every orbit that was asked for begins in it, copies along 45 degrees",
    "[invariant]") {
  for (double mu : patch_ratios) {
    for (double factor : {2.0, 1e3}) {
      const reduction::State start{0.8, 3.5};
      const reduction::State copy{start.u / factor, start.v / factor}, third{copy.u / factor, copy.v / factor};
      const auto portrait = portrait_of(mu, {.view = View::log, .highlight = start, .through = {copy, third}});
      const auto [figure, maps] = portraits::draw_mapped(portrait, {}, plain);
      const Panel& panel = figure.panels.at(0);
      CAPTURE(mu, factor);
      const auto at = [&, &maps = maps](const reduction::State& state) {
        const double ln_k = std::log(state.v / (mu * state.u));
        return maps.at(0).place({state.u, state.v, std::log(state.v), ln_k, 1}, {});
      };
      for (const auto& state : {start, copy, third}) CHECK(inside(panel, at(state)));
      CHECK(panel.to_scale);
      const portraits::Point from = at(start), to = at(third);
      CHECK(from.x - to.x == Approx(2 * std::log(factor)).epsilon(1e-12));
      CHECK(from.y - to.y == Approx(2 * std::log(factor)).epsilon(1e-12));
    }
  }
}

TEST_CASE("Heights of a speed scale and speeds lead back to each other", "[invariant]") {
  for (double exponent : {1.0, 0.1, 1e-4}) {
    const portraits::SpeedScale scale{2, exponent};
    CHECK(scale.height(std::log(2.0)) == 1);
    for (double h : {0.01, 0.3, 0.5, 0.7, 1.0}) {
      CHECK(scale.height(scale.ln_v(h)) == Approx(h).epsilon(1e-9));
      const double at = scale.ln_v(h), step = 1e-6;
      CHECK((scale.height(at + step) - scale.height(at - step)) / (2 * step) == Approx(scale.slope(at)).epsilon(1e-3));
    }
  }
}

TEST_CASE("The panel in ln k is filled to its corners", "[invariant]") {
  for (double mu : {0.099, 0.0035, 1e-6}) {
    CAPTURE(mu);
    const Figure figure = draw(portrait_of(mu, {.view = View::pair}), {}, plain);
    REQUIRE(figure.panels.size() == 2);
    const Panel& panel = figure.panels[1];
    double lowest_start = panel.y.high;
    for (const auto& line : layer(panel, "orbits").lines) {
      const auto parts = portraits::clipped(panel, line);
      REQUIRE(parts.size() == 1);
      lowest_start = std::min(lowest_start, parts[0].front().y);
    }
    // Orbits enter through the sides, from the top nearly down to the bottom.
    CHECK(lowest_start < panel.y.low + 0.2 * (panel.y.high - panel.y.low));
  }
}

TEST_CASE("Where a panel's map puts an orbit the figure draws it", "[route]") {
  for (View view : portraits::views()) {
    const auto portrait = portrait_of(0.3, {.view = view, .highlight = State{-0.8, 1.5}});
    const auto [figure, maps] = draw_mapped(portrait, {.highlight = "this one"});
    for (std::size_t i = 0; i < maps.size(); ++i) {
      INFO(portraits::name(view) << ", panel " << i);
      const auto drawn = layer(figure.panels[i], "this one").lines.front();
      const auto line = maps[i].line(portrait.highlight[0]);
      if (view == View::regularised) {
        // Compare on paper: each row of the orbit must lie between two neighbouring points of the line.
        const auto on = [&panel = figure.panels[i]](Point at) { return portraits::on_paper(panel, at); };
        for (const Point& row : line) {
          const auto after = std::ranges::lower_bound(drawn, row.x, {}, &Point::x);
          if (after == drawn.end() || after == drawn.begin()) continue;
          const Point a = on(*(after - 1)), b = on(*after), at = on(row);
          CHECK(std::abs(std::lerp(a.y, b.y, (at.x - a.x) / (b.x - a.x)) - at.y) < 1e-3);
        }
        continue;
      }
      REQUIRE(line.size() >= drawn.size());
      for (std::size_t j = 0; j < drawn.size(); ++j) {
        CHECK((drawn[j].x == line[j].x && drawn[j].y == line[j].y));
      }
    }
  }
}

TEST_CASE("The order of contact is a number on the line, for every mu", "[table]") {
  using portraits::math;
  const auto title_of = [](double mu) { return figure_of(mu, {.view = View::pair, .orbits = 1}).panels.at(1).title; };
  const auto before = "orbits touch the axis " + math("v = 0") + ":  " + math("k ∝ |u|") + portraits::sup(math("n")) +
                      ",  " + math("n = ");
  CHECK(title_of(1e-4) == before + "2.8·10" + portraits::sup("8"));
  CHECK(title_of(0.01) == before + "28000");
  for (double mu = 1e-6; mu < 0.8; mu *= 3) {
    const std::string words = title_of(mu).words();
    CAPTURE(mu, words);
    const std::string number = words.substr(words.rfind("n\u00A0=\u00A0") + 6);
    // The exponent is 1/s - 1 with s = 5 mu^2/14.
    const std::size_t power = number.find("·10");
    const double order =
        std::stod(number) * (power == number.npos ? 1 : std::pow(10, std::stod(number.substr(power + 4))));
    CHECK(order == Approx(14 / (5 * mu * mu) - 1).epsilon(0.02));
  }
}

TEST_CASE("Orbits are copies of one curve only between rays, and the subtitle says so", "[symmetry]") {
  int with_ray = 0;
  for (const char* law : {"exact", "pade", "uniform", "ring", "punch"}) {
    for (const reduction::Inertia body :
         {reduction::homogeneous_ball, reduction::Inertia{1, 2}, reduction::Inertia{1, 1}}) {
      for (double mu : {0.2, 0.6, 1.0}) {
        for (View view : {View::log, View::similarity}) {
          const auto portrait =
              portraits::phase_portrait({{reduction::find_law(law).value(), mu, body}}, {.view = view, .orbits = 1});
          const std::string words = portraits::draw(portrait).subtitle.words();
          CAPTURE(law, body.chi, body.gamma, mu, portraits::name(view), words);
          const auto has = [&](const char* part) { return words.find(part) != words.npos; };
          const std::size_t rays = portrait.plane.terminal.rays.size();
          with_ray += rays == 1 ? 1 : 0;
          CHECK(has("all orbits are one curve"));
          CHECK(has("on each side of the ray") == (rays == 1));
          CHECK(has("between two rays") == (rays > 1));
        }
      }
    }
  }
  CHECK(with_ray > 5);
}

TEST_CASE("The paper's figure is named only for the paper's ball and law", "[table]") {
  const auto title_of = [](const reduction::ReducedSystem& system) {
    return draw(portraits::phase_portrait(system, {.view = View::pair, .linear = true})).panels.at(0).title.words();
  };
  CHECK(title_of({reduction::PadeLaw{}, 0.9}) == "the plane, as in Zhuravlev 1998, Fig. 4");
  CHECK(title_of({reduction::HertzLaw{}, 0.9}) == "the plane");
  CHECK(title_of({reduction::PadeLaw{}, 0.9, {2.5, 1.5}}) == "the plane");
}

TEST_CASE("In (ln k, p) orbits are translates of one curve along p", "[symmetry]") {
  const Figure figure = draw(portrait_of(0.3, {.view = View::similarity}), {}, plain);
  REQUIRE(figure.panels.size() == 2);
  const auto& lines = layer(figure.panels[1], "orbits").lines;
  REQUIRE(lines.size() > 10);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    REQUIRE(lines[i].size() == lines[0].size());
    const double shift = lines[i][0].y - lines[0][0].y;
    for (std::size_t j = 0; j < lines[0].size(); ++j) {
      CHECK(lines[i][j].x == lines[0][j].x);
      if (std::abs(lines[0][j].x) < 10) CHECK(lines[i][j].y - lines[0][j].y == Approx(shift).margin(1e-9));
    }
  }
  CHECK(layer(figure.panels[1], "symmetry").lines.size() == 1);
}

TEST_CASE("Translates fill both sides of an invariant ray, wherever it is", "[limit]") {
  struct Case {
    reduction::Law law;
    double gamma;
  };
  for (const auto& [law, gamma] : {Case{*reduction::find_law("uniform"), 3.9}, Case{*reduction::find_law("uniform"), 2},
                                   Case{reduction::PadeLaw{}, 2.5}}) {
    const auto portrait = portraits::phase_portrait({{law, 1, {.chi = 1, .gamma = gamma}}}, {.view = View::similarity});
    REQUIRE(portrait.plane.tangents[0].direction == reduction::InvariantDirection::ray);
    const Panel panel = draw(portrait, {}, plain).panels.at(1);
    // Count the lines by the eighth of the panel's width in which they lie. The ray is in the middle.
    std::map<int, int> lines;
    for (const auto& line : layer(panel, "orbits").lines) {
      std::set<int> eighths;
      for (const auto& part : portraits::clipped(panel, line)) {
        for (const auto& point : part) {
          eighths.insert(static_cast<int>(std::floor(8 * (point.x - panel.x.low) / (panel.x.high - panel.x.low))));
        }
      }
      for (int eighth : eighths) lines[eighth] += 1;
    }
    for (int eighth = 0; eighth < 8; ++eighth) {
      CAPTURE(law.name(), gamma, eighth);
      CHECK(lines[eighth] >= 2);
    }
  }
}

TEST_CASE("Every sector between two invariant half-lines has its orbits in every panel, and no orbit leaves it",
          "[limit]") {
  using Function = double (*)(portraits::Point);  // returns ln k at a point, for mu = 1
  const Function speeds = [](portraits::Point p) { return std::log(p.y / std::abs(p.x)); };
  const Function up = [](portraits::Point p) { return p.y; };
  const std::map<View, std::vector<Function>> ln_k{
      {View::uv, {speeds}},
      {View::patch, {speeds}},
      {View::log, {[](portraits::Point p) { return p.y - p.x; }}},
      {View::similarity, {[](portraits::Point p) { return std::log(p.x); }, [](portraits::Point p) { return p.x; }}},
      {View::blowup, {speeds, up}},
      {View::disc, {speeds}},
      {View::pair, {speeds, up}}};
  const reduction::Law uniform = *reduction::find_law("uniform"), octic = contensou::tests::OcticLaw{};
  // Cases: one ray; two rays; one ray, because the other has met the direction v = 0, which is now degenerate.
  for (const auto& [law, gamma] : {std::pair{uniform, 2.0}, std::pair{octic, 1.995}, std::pair{octic, 2.0}}) {
    const reduction::Flow flow({law, 1, {.chi = 1, .gamma = gamma}});
    const auto sector = [&](double at) {
      return std::ranges::count_if(flow.terminal().rays, [&](const auto& ray) { return std::log(ray.k) < at; });
    };
    for (const auto& [view, functions] : ln_k) {
      const Figure figure = draw(portraits::phase_portrait(flow, {.view = view}), {}, plain);
      REQUIRE(figure.panels.size() == functions.size());
      for (std::size_t i = 0; i < functions.size(); ++i) {
        std::map<std::ptrdiff_t, int> lines;
        for (const auto& line : layer(figure.panels[i], "orbits").lines) {
          std::set<std::ptrdiff_t> sectors;
          for (const auto& part : portraits::clipped(figure.panels[i], line)) {
            for (const auto& point : part) {
              const double at = functions[i](point);
              const auto on = [&](const auto& ray) { return std::abs(std::log(ray.k) - at) < 1e-4; };
              if (std::isfinite(at) && std::ranges::none_of(flow.terminal().rays, on)) sectors.insert(sector(at));
            }
          }
          CHECK(sectors.size() <= 1);
          for (const std::ptrdiff_t crossed : sectors) ++lines[crossed];
        }
        CAPTURE(law.name(), gamma, portraits::name(view), i);
        CHECK(lines.size() == flow.terminal().rays.size() + 1);
      }
    }
    const Panel ratio = draw(portraits::phase_portrait(flow, {.view = View::time}), {}, plain).panels.at(2);
    for (const auto& lines : ratio.lines) {
      const auto& line = lines.lines.front();
      CHECK(sector(line.front().y) == sector(line[line.size() / 2].y));
      CHECK((std::ranges::is_sorted(line, {}, &portraits::Point::y) ||
             std::ranges::is_sorted(line, std::greater<>(), &portraits::Point::y)));
    }
  }
}

TEST_CASE("The disc holds everything; its singular points are those of the plane", "[table]") {
  const auto portrait = portrait_of(0.3, {.view = View::disc});
  const Panel panel = draw(portrait, {}, plain).panels.front();
  CHECK(panel.to_scale);
  for (const auto& line : layer(panel, "orbits").lines) {
    for (const auto& point : line) CHECK(std::hypot(point.x, point.y) < 1 + 1e-12);
    CHECK(std::hypot(line.back().x, line.back().y) < 1e-12);
    CHECK(std::hypot(line.front().x, line.front().y) > 0.99);
  }
  const auto saddles = marked(panel, "saddle"), nodes = marked(panel, "unstable node"),
             stop = marked(panel, "the stop");
  REQUIRE(saddles.size() == 2);  // one mark at each end of the u-axis
  CHECK(std::abs(saddles[0].x) == 1);
  CHECK(saddles[0].y == 0);
  REQUIRE(nodes.size() == 1);  // one mark at the end of the v-axis
  CHECK(nodes[0].y == Approx(1));
  REQUIRE(stop.size() == 1);
  CHECK(std::hypot(stop[0].x, stop[0].y) == 0);
}

TEST_CASE("Two to six planes have room in the usual size", "[limit]") {
  for (int count = 2; count <= 6; ++count) {
    std::vector<reduction::Flow> flows;
    for (int i = 1; i <= count; ++i) flows.emplace_back(reduction::ReducedSystem{reduction::HertzLaw{}, 0.15 * i});
    const auto all = portraits::phase_portraits(flows, {.orbits = 4});
    CAPTURE(count);
    CHECK_NOTHROW(lay_out(draw_together(all, std::vector<portraits::PortraitCaption>(all.size()))));
  }
}

TEST_CASE("The axis says that it is bent, whatever the title", "[table]") {
  const portraits::SpeedScale scale = portrait_of(0.3).scale;
  CHECK_THAT(figure_of(0.3).panels[0].y.name.words(),
             Catch::Contains(fmt::format("shaded: vs, s = {:.3g}", scale.exponent)));
  CHECK_THAT(figure_of(1).panels[0].y.name.words(), !Catch::Contains("shaded"));
}

TEST_CASE("On logarithmic axes vertical orbits are explained by their power", "[limit]") {
  const auto title = [](double mu) {
    return draw(portrait_of(mu, {.view = View::log}), {}, plain).panels.at(0).title.words();
  };
  // s = 5 mu^2/14 for a ball.
  CHECK_THAT(title(0.1), Catch::StartsWith("orbits are nearly vertical") &&
                             Catch::EndsWith("u\u00A0∝\u00A0vs,  s\u00A0=\u00A00.00357"));
  CHECK(title(1).empty());
}

TEST_CASE("Isochrones of the law that a portrait is compared with have their legend", "[table]") {
  const Panel panel = draw(portrait_of(0.3, {.comparison = reduction::PadeLaw()}), {}, plain).panels.front();
  const Lines& its_isochrones = layer(panel, "time left τ*, law pade");
  CHECK(its_isochrones.lines.size() > 3);
  CHECK(its_isochrones.stroke.dotted);  // the orbits of this law are dashed
  CHECK_FALSE(its_isochrones.stroke.dashed);
}

TEST_CASE("The blown-up origin is a circle of its own, with a node and a saddle", "[table]") {
  const auto portrait = portrait_of(0.3, {.view = View::blowup});
  const Figure figure = draw(portrait, {}, plain);
  REQUIRE(figure.panels.size() == 2);
  const Panel& panel = figure.panels.front();
  double hole = 1;
  for (const auto& line : layer(panel, "orbits").lines) {
    for (const auto& point : line) hole = std::min(hole, std::hypot(point.x, point.y));
  }
  CHECK(hole == Approx(0.35));
  REQUIRE(marked(panel, "stable node").size() == 2);
  CHECK(std::abs(marked(panel, "stable node")[0].x) == Approx(hole));
  CHECK(marked(panel, "saddle").size() == 3);
  // Inner and outer half-circle are the stop and infinity. On both the motion turns towards v = 0.
  const auto& turning = panel.arrows.back().arrows;
  CHECK(turning.size() == 4);
  for (const auto& arrow : turning) CHECK(arrow.direction.y < 0);
}

TEST_CASE("Against time both speeds fall from 1 to 0, and k starts where its legend says", "[invariant]") {
  for (double mu : {0.5, 0.01}) {
    const Figure figure = figure_of(mu, {.view = View::time});
    REQUIRE(figure.panels.size() == 3);
    for (int i : {0, 1}) {
      REQUIRE(figure.panels[i].lines.size() == 5);
      for (const auto& layer : figure.panels[i].lines) {
        const auto& line = layer.lines.front();
        CHECK(line.front().y == 1);
        CHECK(line.back().x == Approx(1));
        CHECK(line.back().y == Approx(0).margin(1e-12));
        for (std::size_t j = 1; j < line.size(); ++j) {
          CHECK(line[j].x >= line[j - 1].x);
          CHECK(line[j].y <= line[j - 1].y);
        }
      }
    }
    for (const auto& layer : figure.panels[2].lines) {
      CHECK(layer.legend.words().find("k0\u00A0=\u00A0") != std::string::npos);
      CHECK(layer.lines.front().front().x == 0);
    }
  }
}

TEST_CASE("Against beta both speeds fall like powers in the end, and the time goes to tau*", "[limit]") {
  struct Regime {
    const char* law;
    reduction::Inertia body;
    double mu, power_of_u, power_of_v;
  };
  // Cases: k -> 0, where v ~ beta^(-14/(5 mu^2)), for two mu; a ray; k -> infinity, where u ~ beta^(-r K), r K = 8/5.
  for (const auto& [law, body, mu, power_of_u, power_of_v] :
       {Regime{"exact", {3.5, 2.5}, 1, 1, 2.8}, Regime{"exact", {3.5, 2.5}, 0.05, 1, 1120},
        Regime{"uniform", {1, 2}, 1, 1, 1}, Regime{"exact", {1, 8}, 1, 1.6, 1}}) {
    INFO(law << " gamma " << body.gamma << " mu " << mu);
    const reduction::Flow flow({*reduction::find_law(law), mu, body});
    const auto portrait = portraits::phase_portrait(flow, {.view = View::regularised});
    const auto [figure, maps] = draw_mapped(portrait, {}, plain);
    REQUIRE(figure.panels.size() == 3);
    for (std::size_t i = 0; i < 5; ++i) {
      const auto& u = figure.panels[0].lines[i].lines.front();
      const auto& v = figure.panels[1].lines[i].lines.front();
      const auto& tau = figure.panels[2].lines[i].lines.front();
      CHECK((u.front().x == 1 && u.front().y == 1 && v.front().y == 0 && tau.front().y == 0));
      const auto &a = u[u.size() - 2], &b = u.back();
      const double step = std::log(b.x / a.x);
      CHECK(-std::log(b.y / a.y) / step == Approx(power_of_u).epsilon(0.03));
      CHECK(-(v.back().y - v[v.size() - 2].y) / step == Approx(power_of_v).epsilon(0.03));
      CHECK(tau.back().y > 0.99);
      CHECK(tau.back().y < 1);
    }
    // Steps of (2.7) give beta. The axis shows 1 + rate beta, rate = 2 chi/(3 pi) (128 r Psi(0) w + 45 pi^2 v).
    constexpr double pi = std::numbers::pi;
    const State start{1, 3 * mu};
    const auto stepped = reduction::integrate_regularised(flow.system(), start).points;
    const double rate = 2 * body.chi / (3 * pi) *
                        (128 * flow.system().r() * flow.system().law().pivoting_moment() * mu + 45 * pi * pi * start.v);
    const auto instant = [&, mu = mu](const reduction::OrbitPoint& at) {
      const double left = flow.orbit({at.u, at.v}).stop_time();
      return portraits::PortraitOrbit::Instant{at.u, at.v, at.ln_v, at.ln_v - std::log(mu * at.u), left};
    };
    for (Eigen::Index row = 1; row < stepped.rows() && stepped.v[row] > 1e-200; ++row) {
      const double x = maps[0].place(instant(stepped.row(row)), instant(stepped.row(0))).x;
      REQUIRE(x == Approx(1 + rate * stepped.beta[row]).epsilon(1e-8));
    }
  }
}

TEST_CASE("Against beta every motion is drawn to the border, without corners, however small mu is", "[extremes]") {
  for (double mu : {1.0, 0.1, 0.01, 1e-3, 1e-4, 1e-6}) {
    const Figure figure = figure_of(mu, {.view = View::regularised});
    for (const Panel& panel : figure.panels) {
      for (std::size_t i = 0; i < 5; ++i) {
        const auto& line = panel.lines[i].lines.front();
        CAPTURE(mu, panel.title.words(), i);
        CHECK(line.front().x == 1);
        CHECK(line.back().x == panel.x.high);
        CHECK(sharpest(panel, line, 0) < std::sin(0.2));
      }
    }
  }
}

TEST_CASE("The field points along the motion, and its needles lengthen with the speed", "[route]") {
  const auto portrait = portrait_of(0.5, {.view = View::uv});
  for (auto field : {PortraitStyle::Field::motion, PortraitStyle::Field::regularised}) {
    const Panel panel = draw(portrait, {}, {.field = field}).panels.front();
    const auto& needles = layer(panel, "direction of").lines;
    REQUIRE(needles.size() > 250);
    CHECK(panel.arrows.front().arrows.size() == needles.size());
    double shortest = 1, longest = 0;
    for (const auto& needle : needles) {
      REQUIRE(needle.size() == 2);
      const auto rate = portrait.system().field({(needle[0].x + needle[1].x) / 2, (needle[0].y + needle[1].y) / 2});
      const double dx = needle[1].x - needle[0].x, dy = needle[1].y - needle[0].y;
      CHECK(std::abs(dx * rate.v - dy * rate.u) < 1e-3 * std::hypot(dx, dy) * std::hypot(rate.u, rate.v));
      CHECK(dx * rate.u + dy * rate.v > 0);
      const double size = portraits::paper_distance(panel, needle[0], needle[1]);
      shortest = std::min(shortest, size);
      longest = std::max(longest, size);
    }
    CHECK(longest > 1.5 * shortest);
  }
}

TEST_CASE("Every panel of every view draws the other law too", "[invariant]") {
  using reduction::PressureLaw;
  // Orbits of the puck end on a ray under the uniform law, and along the axis u = 0 under the ring law.
  const reduction::ReducedSystem ball(reduction::HertzLaw{}, 0.3),
      puck(PressureLaw::uniform(), 1, {.chi = 1, .gamma = 2});
  for (const auto& [system, other] : {std::pair<reduction::ReducedSystem, reduction::Law>{ball, reduction::PadeLaw{}},
                                      std::pair<reduction::ReducedSystem, reduction::Law>{puck, PressureLaw::ring()}}) {
    for (View view : portraits::views()) {
      const Figure figure = draw(portraits::phase_portrait(system, {.view = view, .comparison = other}));
      for (const Panel& panel : figure.panels) {
        INFO(portraits::name(view) << ", law " << other.name() << ", " << panel.title.words());
        const Lines& lines = layer(panel, "law " + other.name());
        CHECK(lines.stroke.dashed);
        std::size_t parts = 0;
        for (const auto& same : panel.lines) parts += same.legend == lines.legend ? seen(panel, same.lines).size() : 0;
        CHECK(parts >= 5);
      }
    }
  }
}

TEST_CASE("A portrait without what its view does not draw is the same drawing", "[route]") {
  for (View view : portraits::views()) {
    const auto drawing = [&](bool drawn_only) {
      return portraits::pgfplots(figure_of(0.3, {.view = view, .through = {{0.3, 0.5}}, .drawn_only = drawn_only}));
    };
    CHECK(drawing(true) == drawing(false));
  }
}

TEST_CASE("Two laws in one figure: each its look, and no colours of time", "[table]") {
  const Figure figure =
      draw(portraits::phase_portrait({{reduction::PadeLaw{}, 0.5}}, {.comparison = reduction::HertzLaw{}}));
  CHECK_FALSE(figure.colour_bar);
  CHECK_FALSE(layer(figure.panels[0], "law pade").stroke.dashed);
  CHECK(layer(figure.panels[0], "law exact").stroke.dashed);
  CHECK(layer(figure.panels[0], "law exact").lines.size() == 24);
  CHECK(layer(figure.panels[0], "law exact").lines[3].back().y == 0);
  CHECK(figure.title.words().find("pade against exact") != std::string::npos);
}

TEST_CASE("A highlighted orbit is marked at its start, and points asked for have their orbit", "[table]") {
  for (double sign : {1.0, -1.0}) {
    const Panel panel = figure_of(0.3, {.highlight = State{sign, 2}}).panels.front();
    REQUIRE(panel.marks.size() == 2);  // the mark of the start, and the mark of the stop
    CHECK(panel.marks[0].points[0].x == sign);
  }
  const Figure figure = draw(portrait_of(0.3, {.highlight = State{1, 2}, .through = {{0.5, 1}, {-0.5, 2}}}),
                             {.highlight = "this motion"});
  const Panel& panel = figure.panels[0];
  const Lines &through = layer(panel, "through"), &own = layer(panel, "this motion");
  CHECK(through.lines.size() == 2);
  CHECK(through.stroke.width < 0.7 * own.stroke.width);
  const auto points = marked(panel, through.legend);
  REQUIRE(points.size() == 2);
  for (int i : {0, 1}) {
    CHECK(points[i].x == std::vector{0.5, -0.5}[i]);
    CHECK(std::ranges::any_of(through.lines[i],
                              [&](Point point) { return portraits::paper_distance(panel, point, points[i]) < 0.02; }));
  }
}

TEST_CASE("Times of a colour bar are all written in one way, under the name of the isochrones", "[table]") {
  for (View view : {View::uv, View::similarity, View::log, View::disc, View::blowup}) {
    for (double mu : {0.01, 0.3, 1.0}) {
      const Figure figure = figure_of(mu, {.view = view});
      CAPTURE(portraits::name(view), mu);
      CHECK((figure.colour_bar || view == View::log));
      if (!figure.colour_bar) continue;
      CHECK(figure.colour_bar->name == portraits::math("τ*") + " left");
      const auto& ticks = figure.colour_bar->ticks;
      CHECK((std::ranges::all_of(ticks, [](const auto& tick) { return tick.text.runs().back().level == 1; }) ||
             std::ranges::none_of(ticks, [](const auto& tick) { return tick.text.runs().back().level == 1; })));
    }
  }
}

TEST_CASE("An orbit stays on its side of the blown-up origin to the end", "[invariant]") {
  for (double sign : {1.0, -1.0}) {
    const Panel panel = figure_of(0.3, {.view = View::blowup, .highlight = State{sign * 0.5, 2}}).panels.front();
    REQUIRE(panel.marks.size() > 1);
    std::size_t found = 0;
    for (const auto& lines : panel.lines) {
      for (const auto& line : lines.lines) {
        if (line.front().x != panel.marks[0].points[0].x || line.front().y != panel.marks[0].points[0].y) continue;
        ++found;
        CHECK(line.back().x * sign > 0);
      }
    }
    CHECK(found == 1);
  }
}

TEST_CASE("Times keep off the orbits that were asked for", "[invariant]") {
  for (double u : {0.2, 0.4, 0.6, 0.7, 0.8, 0.9}) {
    const Panel panel = figure_of(0.3, {.sides = {{1, 4}}, .through = {{u, 3.5}}}).panels[0];
    REQUIRE(panel.labels.size() >= 4);
    for (const auto& label : panel.labels) {
      for (const auto& point : layer(panel, "through").lines.front()) {
        INFO("u = " << u << ", " << label.text.words());
        CHECK(portraits::paper_distance(panel, label.at, point) > 0.008);
      }
    }
  }
}

TEST_CASE("Size, axes and the screen style are as asked", "[table]") {
  const Figure figure = draw(portrait_of(0.3), {}, {.invariant = false, .screen = true, .size = {100, 80}});
  CHECK(figure.size.width_mm == 100);
  CHECK(figure.size.height_mm == 80);
  CHECK(figure.theme.ground.rgb < 0x303030);
  CHECK(std::ranges::none_of(figure.panels[0].lines, [](const auto& l) { return l.legend == "invariant axes"; }));
  CHECK(figure_of(0.3).theme.ground.rgb == 0xffffff);
}

TEST_CASE("Captions replace title, units and the unit of the labels", "[table]") {
  const Figure figure = draw(portrait_of(0.3, {.time_unit = 4}),
                             {.title = "A ball", .speed_unit = "m/s", .time_unit_name = "s", .time_unit = 4});
  CHECK(figure.title == "A ball");
  CHECK_THAT(figure.panels[0].y.name.words(), Catch::Contains(", m/s"));
  CHECK(layer(figure.panels[0], "time left").legend.words().ends_with(", s"));
  std::vector<double> times;
  for (const auto& label : figure.panels[0].labels) {
    if (!label.text.words().starts_with("slip below")) times.push_back(std::stod(label.text.words()));
  }
  CHECK(times.size() >= 3);
  for (const double time : times) {
    const double multiple = time / times.front();
    CHECK(2 * multiple == Approx(std::round(2 * multiple)));
  }
}

TEST_CASE("Against time the estimate for small mu is dashed beside each motion, and nears it as mu^2", "[invariant]") {
  // Returns the largest difference between estimate and motion in a panel, up to 0.9 of the stop time.
  const auto difference = [](double mu, std::size_t panel) {
    const auto portrait = portrait_of(mu, {.view = View::time});
    const Figure without = draw(portrait), figure = draw(portrait, {}, {.estimate = true});
    const auto& lines = figure.panels.at(panel).lines;
    REQUIRE(lines.size() == 10);
    REQUIRE(without.panels.at(panel).lines.size() == 5);
    double largest = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      CHECK(!lines[i].stroke.dashed);
      CHECK(lines[i + 5].stroke.dashed);
      CHECK(lines[i + 5].legend.words() == "estimate for small μ");
      const auto &motion = lines[i].lines.front(), &estimate = lines[i + 5].lines.front();
      REQUIRE(estimate.size() > 20);
      CHECK(estimate.front().y == Approx(motion.front().y).margin(1e-12));
      for (std::size_t row = 0; row < estimate.size() && estimate[row].x < 0.9; ++row) {
        CHECK(estimate[row].x == motion[row].x);
        largest = std::max(largest, std::abs(estimate[row].y - motion[row].y));
      }
    }
    return largest;
  };
  for (std::size_t panel : {0, 1, 2}) {
    const double rough = difference(0.2, panel), fine = difference(0.05, panel);
    CAPTURE(panel, rough, fine);
    CHECK(rough > 0);
    CHECK(fine < rough / 8);
  }
}

TEST_CASE("against beta a spin that vanishes leaves the picture, and its axis stays finite", "[limit]") {
  for (const double drive : {0.5, 0.99, 0.999, 0.99999}) {
    const reduction::Flow flow({reduction::HertzLaw{}, 1, reduction::homogeneous_ball, drive});
    CAPTURE(drive);
    for (const Panel& panel : draw(portraits::phase_portrait(flow, {.view = View::regularised})).panels) {
      CHECK((!panel.y.logarithmic || panel.y.low > 0));
      for (const Lines& layer : panel.lines) {
        for (const portraits::Polyline& line : layer.lines) {
          CHECK(std::ranges::all_of(line, [&](Point at) {
            return std::isfinite(at.x) && std::isfinite(at.y) && (!panel.y.logarithmic || at.y > 0);
          }));
        }
      }
    }
  }
}

TEST_CASE("The story shows the share of the friction that brakes at each drawing of the patch", "[invariant]") {
  for (const State start : {State{1, 0.2}, State{-1, 0.4}}) {
    const reduction::ReducedSystem system(reduction::HertzLaw{}, 0.5);
    const portraits::MappedFigure drawn =
        draw_mapped(portraits::phase_portrait(system, {.view = View::story, .highlight = start}));
    const Panel& panel = drawn.figure.panels.front();
    CHECK_FALSE(drawn.figure.colour_bar);
    REQUIRE(panel.labels.size() == 3);
    REQUIRE(panel.marks.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point at = panel.marks[i].points.front();
      CHECK(at.y <= std::array{1., 0.6, 0.25}[i] * start.v * (1 + 1e-12));
      const double force = system.law()({.sliding = at.y, .pivoting = 0.5 * std::abs(at.x)}).force;
      CHECK(panel.labels[i].text.words() == fmt::format("{:.0f} %", 100 * force));
    }
    // Seen from above, a body whose spin is counterclockwise moves to the right most at the side of negative y.
    const Lines& velocities = layer(panel, "velocity of the patch");
    double fastest = 0, place = 0;
    for (const auto& line : velocities.lines) {
      const double along = line.back().x - line.front().x;
      if (along > fastest) fastest = along, place = (line.front().y + line.back().y) / 2;
    }
    const double middle = (panel.y.high - panel.y.low) * 0.81;
    CHECK((place < middle) == (start.u > 0));
  }
}

TEST_CASE("The bent axis of a real ball names slow slips, and when its slip falls to 1 mm/s", "[table]") {
  const auto portrait = portrait_of(0.1, {.highlight = State{2, 1}});
  REQUIRE_FALSE(portrait.scale.linear());
  const portraits::PortraitCaption ball{.speed_unit = "m/s", .time_unit_name = "s", .time_unit = 4};
  const auto words_of = [&](const portraits::PortraitCaption& caption) {
    const Figure figure = draw(portrait, caption);
    std::string words;
    for (const auto& label : figure.panels[0].labels) words += label.text.words() + "\n";
    return words;
  };
  const reduction::Flow& flow = portrait.flow;
  // Bisection for the time at which v = 0.001, independent of the rows of the orbit.
  const auto orbit = flow.orbit({2, 1});
  double low = 0, high = orbit.stop_time();
  for (int i = 0; i < 60; ++i) (orbit.at_time((low + high) / 2).v > 1e-3 ? low : high) = (low + high) / 2;
  const std::string words = words_of(ball), number = words.substr(words.find("1 mm/s after ") + 13);
  CHECK(std::stod(number) == Approx(low / 4).epsilon(0.02));
  CHECK_THAT(words, Catch::Contains("slip below "));
  CHECK_THAT(words_of({}), !Catch::Contains("slip below "));
}
