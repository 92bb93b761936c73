#include "contensou/portraits/roll_figure.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace contensou::portraits {

namespace {

constexpr Colour path_colour{0x222222};
constexpr Colour textbook_colour{0x8a8a8a};
constexpr Colour slip_colour{0xb3003b};
constexpr Colour rim_colour{0x0b4f8a};
constexpr Colour speed_colour{0xc8761a};

constexpr double width_mm = 290;
constexpr double height_mm = 125;
/// Width over height of a panel on paper, beside what layout.cpp leaves for its names and ticks.
constexpr double panel_shape = (width_mm / 2 - 22.3) / (height_mm - 42.7);

/// A path that bends less than this share of its length is straight to the eye.
constexpr double straight = 0.01;
/// From this ratio of the two times on, the time axis is logarithmic.
constexpr double long_spin = 6;

void require_columns(const RollCurve& curve) {
  for (const Eigen::ArrayXd* column : {&curve.x, &curve.y, &curve.slip, &curve.rim, &curve.speed}) {
    if (curve.t.size() >= 2 && column->size() == curve.t.size()) continue;
    throw std::domain_error(fmt::format("roll_figure: columns must be of one length, 2 or more; got {} beside t of {}",
                                        column->size(), curve.t.size()));
  }
}

Polyline line_of(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, Eigen::Index count) {
  Polyline line;
  for (Eigen::Index i = 0; i < count; ++i) line.push_back({x[i], y[i]});
  return line;
}

/// How many of the instants are at most that late.
Eigen::Index until(const RollCurve& curve, double end) { return (curve.t <= end * (1 + 1e-12)).count(); }

Point at_time(const RollCurve& curve, double t) {
  const Eigen::Index last = curve.t.size() - 1;
  const Eigen::Index i = std::clamp<Eigen::Index>((curve.t <= t).count() - 1, 0, last - 1);
  const double share = std::clamp((t - curve.t[i]) / (curve.t[i + 1] - curve.t[i]), 0.0, 1.0);
  return {curve.x[i] + share * (curve.x[i + 1] - curve.x[i]), curve.y[i] + share * (curve.y[i + 1] - curve.y[i])};
}

struct Box {
  Point low, high;

  Point size() const { return {high.x - low.x, high.y - low.y}; }
};

Box box_of(std::initializer_list<const Polyline*> lines) {
  Box box{lines.begin()[0]->front(), lines.begin()[0]->front()};
  for (const Polyline* line : lines) {
    for (const Point& point : *line) {
      box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
      box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
    }
  }
  return box;
}

/// An interval that is wider by a margin and has at least that length, about the same middle.
std::pair<double, double> widened(double low, double high, double least) {
  constexpr double margin = 0.08;
  const double middle = (low + high) / 2;
  const double half = std::max((high - low) * (0.5 + margin), least / 2);
  return {middle - half, middle + half};
}

/// How far into the motion the path is shown.
double shown_time(const RollPicture& picture) {
  const double rolls = std::max(picture.ball.rolls, picture.textbook.rolls);
  const double last = picture.ball.t[picture.ball.t.size() - 1];
  return rolls > 0 ? std::min(1.6 * rolls, last) : last;
}

/// Both paths with the points from which the balls roll.
void add_paths(Panel& panel, const RollPicture& picture, Polyline ball, Polyline textbook, Point ball_mark,
               Point textbook_mark) {
  constexpr double size = 1.1;
  panel.lines.push_back({{std::move(ball)}, {path_colour, 2.2, false}, "this ball"});
  panel.lines.push_back({{std::move(textbook)}, {textbook_colour, 1.8, true}, "textbook"});
  if (picture.textbook.rolls > 0) panel.marks.push_back({{textbook_mark}, textbook_colour, size});
  if (picture.ball.rolls > 0) panel.marks.push_back({{ball_mark}, path_colour, size});
}

/// The path from above, to scale unless it is flat.
Panel path_panel(const RollPicture& picture) {
  const double end = shown_time(picture);
  Polyline ball = line_of(picture.ball.x, picture.ball.y, until(picture.ball, end));
  Polyline textbook = line_of(picture.textbook.x, picture.textbook.y, until(picture.textbook, end));
  const Box box = box_of({&ball, &textbook});
  const double scale = std::max(box.size().x / panel_shape, box.size().y);
  // Most of the panel is used, across too.
  const double least_share = 0.75;
  const double stretch_x = std::max(1.0, least_share * scale * panel_shape / std::max(box.size().x, 1e-300));
  const double stretch_y = std::max(1.0, least_share * scale / std::max(box.size().y, 1e-300));
  const auto [x_low, x_high] = widened(box.low.x, box.high.x, 1.16 * scale * panel_shape / stretch_x);
  const auto [y_low, y_high] = widened(box.low.y, box.high.y, 1.16 * scale / stretch_y);
  const auto stretched = [](const char* letter, double stretch) {
    const std::string note = stretch > 1.05 ? fmt::format(" (stretched {:.2g} times)", stretch) : "";
    return fmt::format("{{/:Italic {}}}, m{}", letter, note);
  };
  Panel panel;
  panel.title = "the path on the table";
  panel.x = {stretched("x", stretch_x), x_low, x_high, false, {}};
  panel.y = {stretched("y", stretch_y), y_low, y_high, false, {}};
  add_paths(panel, picture, std::move(ball), std::move(textbook), at_time(picture.ball, picture.ball.rolls),
            at_time(picture.textbook, picture.textbook.rolls));
  return panel;
}

/// The distance along a straight path against time.
Panel distance_panel(const RollPicture& picture, Point along) {
  const double end = shown_time(picture);
  const auto distance = [&](const RollCurve& curve) -> Eigen::ArrayXd { return along.x * curve.x + along.y * curve.y; };
  Polyline ball = line_of(picture.ball.t, distance(picture.ball), until(picture.ball, end));
  Polyline textbook = line_of(picture.textbook.t, distance(picture.textbook), until(picture.textbook, end));
  const Box box = box_of({&ball, &textbook});
  const auto [low, high] = widened(box.low.y, box.high.y, box.size().y > 0 ? 0 : 1);
  const auto mark = [&](const RollCurve& curve) {
    const Point point = at_time(curve, curve.rolls);
    return Point{curve.rolls, along.x * point.x + along.y * point.y};
  };
  Panel panel;
  panel.title = "the path is straight: the way along it";
  panel.x = {"{/:Italic t}, s", 0, end, false, {}};
  panel.y = {"way, m", low, high, false, {}};
  add_paths(panel, picture, std::move(ball), std::move(textbook), mark(picture.ball), mark(picture.textbook));
  return panel;
}

Panel speed_panel(const RollPicture& picture) {
  const double last = picture.ball.t[picture.ball.t.size() - 1];
  const double rolls = std::max(picture.ball.rolls, picture.textbook.rolls);
  const bool logarithmic = rolls > 0 && last > long_spin * rolls;
  Panel panel;
  panel.title = "speeds; dashed: textbook, sliding and spinning uncoupled";
  panel.x = {"{/:Italic t}, s", logarithmic ? rolls / 30 : 0, last, logarithmic, {}};
  double top = 0;
  const auto add = [&](Eigen::ArrayXd RollCurve::*column, Colour colour, const char* legend) {
    for (const RollCurve* curve : {&picture.textbook, &picture.ball}) {
      const bool dashed = curve == &picture.textbook;
      Polyline line;
      for (Eigen::Index i = 0; i < curve->t.size(); ++i) {
        if (curve->t[i] >= panel.x.low && curve->t[i] <= last) line.push_back({curve->t[i], (curve->*column)[i]});
      }
      top = std::max(top, (curve->*column).maxCoeff());
      panel.lines.push_back({{std::move(line)}, {colour, dashed ? 1.6 : 2.4, dashed}, dashed ? "" : legend});
    }
  };
  add(&RollCurve::slip, slip_colour, "slip {/:Italic v}");
  add(&RollCurve::rim, rim_colour, "spin {/:Italic R}|{/:Italic ω_z}|");
  add(&RollCurve::speed, speed_colour, "speed of the centre");
  panel.y = {"m/s", 0, top > 0 ? 1.08 * top : 1, false, {}};
  return panel;
}

}  // namespace

Figure roll_figure(const RollPicture& picture) {
  require_columns(picture.ball);
  require_columns(picture.textbook);
  const double end = shown_time(picture);
  const Polyline path = line_of(picture.ball.x, picture.ball.y, until(picture.ball, end));
  const Polyline textbook = line_of(picture.textbook.x, picture.textbook.y, until(picture.textbook, end));
  // The line through the farthest point of the path, and how far the paths leave it.
  Point far{1, 0};
  double reach = 0;
  for (const Point& point : path) {
    if (std::hypot(point.x, point.y) > reach) {
      reach = std::hypot(point.x, point.y);
      far = {point.x / reach, point.y / reach};
    }
  }
  double bend = 0;
  for (const Polyline* line : {&path, &textbook}) {
    for (const Point& point : *line) bend = std::max(bend, std::abs(far.x * point.y - far.y * point.x));
  }

  Figure figure;
  figure.title = picture.title;
  figure.subtitle = picture.subtitle;
  figure.width_mm = width_mm;
  figure.height_mm = height_mm;
  if (reach == 0) {  // it spins in place
    figure.width_mm = width_mm / 2 + 25;
    figure.panels = {speed_panel(picture)};
  } else {
    figure.panels = {bend <= straight * reach ? distance_panel(picture, far) : path_panel(picture),
                     speed_panel(picture)};
  }
  return figure;
}

}  // namespace contensou::portraits
