#include "answers/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/aim.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::answers {

namespace {

using portraits::Point;

/// The result of a start, in SI units and turns. If slip and spin at the start are multiplied by c, the time is
/// multiplied by c, and distance and turns are multiplied by c^2.
struct Arrival {
  double slip, spin, time, distance, turns;
};

Arrival arrival_of(const si::Experiment& ball, const reduction::Flow& flow, reduction::State start) {
  const double radius = ball.ball.radius;
  const reduction::Reached end = reduction::reached(flow, start);
  return {start.v, start.u / radius, si::seconds(ball, end.tau), si::seconds(ball, end.distance),
          si::seconds(ball, end.turned) / (2 * std::numbers::pi * radius)};
}

/// Returns the results of starts whose ratio v/u runs from spin alone to slip alone.
std::vector<Arrival> arrivals(const si::Experiment& ball, const reduction::Flow& flow) {
  const double mu = flow.system().mu();
  std::vector<Arrival> all{arrival_of(ball, flow, {1, 0})};
  constexpr double widest = 16;  // largest |ln k|
  constexpr int steps = 320;
  for (int i = 0; i <= steps; ++i) {
    const double ln_k = widest * (2.0 * i / steps - 1);
    all.push_back(arrival_of(ball, flow, {std::exp(std::min(0.0, -ln_k)) / mu, std::exp(std::min(0.0, ln_k))}));
  }
  all.push_back(arrival_of(ball, flow, {0, 1}));
  return all;
}

/// Returns the numbers 1, 2 and 5 times powers of ten in [least, largest]; if fewer than 5, also 1.5, 3, 4, 6 and 8.
std::vector<double> round_values(double least, double largest) {
  constexpr std::size_t enough = 5;
  std::vector<double> values;
  for (const std::vector<double>& digits : {std::vector<double>{1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 6, 8}}) {
    values.clear();
    for (double power = std::pow(10, std::floor(std::log10(least))); power <= largest; power *= 10) {
      for (double digit : digits) {
        if (digit * power >= least && digit * power <= largest) values.push_back(digit * power);
      }
    }
    if (values.size() >= enough) break;
  }
  return values;
}

/// The look of the curves on each of which one number of the start (`value`) is constant.
struct Family {
  double Arrival::*value;
  const char *name, *unit;
  portraits::Stroke stroke;
  double label;  ///< place of the label on a curve, as a share of the length of the curve, 0 to 1
};

void add(portraits::Panel& panel, const std::vector<Arrival>& all, const Family& family) {
  portraits::Lines lines{{}, family.stroke, fmt::format("{}, {}", family.name, family.unit)};
  const auto copy = [&](const Arrival& arrival, double factor) {
    return Point{factor * factor * arrival.distance, factor * factor * arrival.turns};
  };
  // A ray (constant k) crosses the border of the panel at two points. There `value` is least and largest on this ray.
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  for (const Arrival& arrival : all) {
    if (!(arrival.distance > 0 && arrival.turns > 0)) continue;
    const double in = std::max(panel.x.low / arrival.distance, panel.y.low / arrival.turns);
    const double out = std::min(panel.x.high / arrival.distance, panel.y.high / arrival.turns);
    if (in > out) continue;
    least = std::min(least, std::sqrt(in) * arrival.*family.value);
    largest = std::max(largest, std::sqrt(out) * arrival.*family.value);
  }
  for (double value : round_values(least, largest)) {
    portraits::Polyline line;
    for (const Arrival& arrival : all) {
      if (arrival.distance > 0 && arrival.turns > 0) line.push_back(copy(arrival, value / arrival.*family.value));
    }
    for (portraits::Polyline& part : portraits::clipped(panel, line)) {
      constexpr double least_labelled = 0.2;
      if (portraits::paper_length(panel, part) > least_labelled) {
        panel.labels.push_back(
            {portraits::arrow_along(panel, part, family.label).at, fmt::format("{:.4g}", value), family.stroke.colour});
      }
      lines.lines.push_back(std::move(part));
    }
  }
  panel.lines.push_back(std::move(lines));
}

}  // namespace

portraits::Figure aim_figure(const si::Experiment& ball, const reduction::Law& law, const si::Goal& goal,
                             const portraits::AskedSize& size) {
  constexpr portraits::Colour time_colour{0x1a1a1a}, slip_colour{0x0b4f8a}, spin_colour{0xb3003b}, faint{0x888888};
  constexpr double around = 8;  // largest and least value of an axis: the demanded value times 8, and divided by 8
  const reduction::Flow flow(si::undriven_system(ball, law));
  const si::SlipAndSpin start = si::aimed(ball, flow, goal);
  const std::vector<Arrival> all = arrivals(ball, flow);
  const Arrival &in_place = all.front(), &straight = all.back();
  const Arrival end = arrival_of(ball, flow, {ball.ball.radius * start.spin, start.slip});
  // A logarithmic axis cannot show 0. In place of 0 it shows the largest value that the same time allows.
  const auto squared = [](double x) { return x * x; };
  const double x = end.distance > 0 ? end.distance : straight.distance * squared(end.time / straight.time);
  const double y = end.turns > 0 ? end.turns : in_place.turns * squared(end.time / in_place.time);
  if (!(std::min(x, y) > 0))
    throw std::domain_error("a picture needs a start that moves: both numbers are 0, so the body rests");

  portraits::Panel panel;
  panel.x = {"distance of the centre, m", x / around, x * around, true, {}};
  panel.y = {start.spin < 0 ? "turns about the vertical, to the right" : "turns about the vertical",
             y / around,
             y * around,
             true,
             {}};
  add(panel, all, {&Arrival::slip, "slip of the start", "m/s", {slip_colour, 1.2, true}, 0.12});
  add(panel, all, {&Arrival::spin, "spin of the start", "rad/s", {spin_colour, 1.2, false, true}, 0.88});
  add(panel, all, {&Arrival::time, "time until slip and spin end", "s", {time_colour, 1.6}, 0.3});
  const auto ray = std::ranges::min_element(all, {}, [&](const Arrival& arrival) {
    return std::abs(arrival.slip - flow.system().mu() * arrival.spin * ball.ball.radius);
  });
  const double far = std::max(panel.x.high / ray->distance, panel.y.high / ray->turns);
  const double near = std::min(panel.x.low / ray->distance, panel.y.low / ray->turns);
  panel.lines.push_back(
      {portraits::clipped(panel, {{near * ray->distance, near * ray->turns}, {far * ray->distance, far * ray->turns}}),
       {faint, 1, true, true},
       portraits::math("k = 1")});
  if (end.distance > 0 && end.turns > 0) {
    panel.marks.push_back({{{end.distance, end.turns}},
                           spin_colour,
                           1.4,
                           portraits::Marks::Shape::dot,
                           fmt::format("aim: slip {:.4g} m/s, spin {:.4g} rad/s", start.slip, start.spin)});
  }

  portraits::Figure figure;
  figure.title = portraits::title_of(portraits::shortened(ball.ball.name), fmt::format("{:.4g}", flow.system().mu()),
                                     portraits::shortened(law.name()));
  figure.subtitle = fmt::format("starts by distance and turns; {:.4g} m and {:.4g} turns take {:.4g} s", end.distance,
                                std::copysign(end.turns, start.spin), end.time);
  figure.size = portraits::fitted({170, 130}, 1, size);
  figure.panels = {std::move(panel)};
  return figure;
}

}  // namespace contensou::answers
