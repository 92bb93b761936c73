#include "answers/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"

namespace contensou::answers {

namespace {

using portraits::Panel;
using portraits::Point;

constexpr portraits::Colour law_colour{0x8c0f35}, nearest_colour{0x707070}, table_colour{0x4a90cc};
constexpr std::size_t most_rows = 250;  ///< largest number of rows of a table that are drawn; more marks would overlap
constexpr int samples = 400;            ///< number of points of a curve

/// Returns the time, s after the first row, until this speed is almost 0 in the table and under the law; with a margin.
double lasting(const MotionsBeside& motions, double si::SlipAndSpin::*speed) {
  constexpr double next_to_nothing = 2e-3, more = 1.15;
  const double first = motions.rows.front().t;
  std::vector<double> sizes;
  for (const auto& [line, t, speeds, body] : motions.rows) {
    sizes.push_back(std::max(std::abs(speeds.*speed), std::abs(motions.models.front().motion(t - first).*speed)));
  }
  const double little = next_to_nothing * *std::ranges::max_element(sizes);
  const auto end = std::find_if(sizes.rbegin(), sizes.rend(), [&](double size) { return size > little; });
  const double all = motions.rows.back().t - first;
  if (end == sizes.rend()) return all;
  return std::min(all, more * (motions.rows[static_cast<std::size_t>(sizes.rend() - end) - 1].t - first));
}

Panel panel_of(const MotionsBeside& motions, const char* name, const char* unit, double si::SlipAndSpin::*speed) {
  const double first = motions.rows.front().t, lasts = lasting(motions, speed);
  const double end = lasts > 0 ? first + lasts : first + 1;
  Panel panel;
  panel.x = {portraits::math("t") + ", s", first, end, false, {}};
  panel.y = {fmt::format("{}, {}", name, unit), 0, 0, false, {}};
  const auto shown = [&](Point point) {
    panel.y.low = std::min(panel.y.low, point.y);
    panel.y.high = std::max(panel.y.high, point.y);
    return point;
  };
  portraits::Marks table{{}, table_colour, 0.4, portraits::Marks::Shape::dot, "table"};
  const auto inside = static_cast<std::size_t>(
      std::ranges::count_if(motions.rows, [&](const Instant& instant) { return instant.t <= end; }));
  const std::size_t step = (inside + most_rows - 1) / most_rows;
  for (std::size_t i = 0; i < inside; i += step)
    table.points.push_back(shown({motions.rows[i].t, motions.rows[i].speeds.*speed}));
  panel.marks.push_back(std::move(table));
  const auto add = [&](const ModelBeside& model, const portraits::Stroke& stroke, const std::string& legend) {
    portraits::Polyline line;
    for (int i = 0; i <= samples; ++i) {
      const double t = (end - first) * i / samples;
      line.push_back(shown({first + t, model.motion(t).*speed}));
    }
    panel.lines.push_back({{std::move(line)}, stroke, portraits::Text(legend)});
  };
  const ModelBeside& law = motions.models.front();
  const ModelBeside* const nearest = motions.nearest();
  add(law, {law_colour, 2.2}, fmt::format("law {}", portraits::shortened(law.name)));
  if (nearest && nearest != &law) {
    add(*nearest, {nearest_colour, 1.6, true}, fmt::format("nearest: {}", portraits::shortened(nearest->name)));
  }
  const double margin = 0.06 * std::max(panel.y.high - panel.y.low, 1e-300);
  panel.y.low -= panel.y.low < 0 ? margin : 0;
  panel.y.high += margin;
  return panel;
}

}  // namespace

portraits::Figure check_figure(const MotionsBeside& motions, const std::string& ball,
                               const portraits::AskedSize& size) {
  const ModelBeside& law = motions.models.front();
  portraits::Figure figure;
  figure.title = fmt::format("{},  law: {}", portraits::shortened(ball), portraits::shortened(law.name));
  figure.subtitle = fmt::format("largest deviation, in % of the start: slip {:.2g}, spin {:.2g}; nearest model: {}",
                                100 * law.slip.relative, 100 * law.spin.relative,
                                motions.nearest() ? portraits::shortened(motions.nearest()->name) : "none");
  figure.panels = {panel_of(motions, "slip", "m/s", &si::SlipAndSpin::slip),
                   panel_of(motions, "spin", "rad/s", &si::SlipAndSpin::spin)};
  figure.size = portraits::fitted({180, 80}, 2, size);
  return figure;
}

}  // namespace contensou::answers
