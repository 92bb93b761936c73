#include "contensou/portraits/roll_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "data/round_numbers.hpp"

namespace contensou::portraits {

namespace {

constexpr Colour path_colour{0x222222};
constexpr Colour textbook_colour{0x8a8a8a};
/// Colours that differ in lightness, and so in grey. The lines also differ in their marks.
constexpr Colour slip_colour{0x8c0f35};
constexpr Colour rim_colour{0x2f7fc1};
constexpr Colour speed_colour{0xe0a030};
constexpr Colour ball_colour{0xf3efe6};
constexpr Colour shade_colour{0xf2f2f2};

constexpr PaperSize usual{290, 125};

/// A path that bends by less than this fraction of its length is drawn as straight.
constexpr double straight = 0.01;
/// The time axis is compressed after the begin of rolling if the last time divided by that of rolling exceeds this
/// ratio.
constexpr double long_spin = 6;

void require_columns(const RollCurve& curve) {
  for (const Eigen::ArrayXd* column : {&curve.x, &curve.y, &curve.slip, &curve.rim, &curve.speed}) {
    if (curve.t.size() >= 2 && column->size() == curve.t.size()) continue;
    throw std::domain_error(fmt::format("roll_figure: columns must be of one length, 2 or more; got {} beside t of {}",
                                        column->size(), curve.t.size()));
  }
}

/// Returns the time up to which the path is shown.
double shown_time(const RollPicture& picture) {
  const double rolls = std::max(picture.ball.rolls, picture.textbook.rolls);
  const double last = picture.ball.t[picture.ball.t.size() - 1];
  return rolls > 0 && picture.slow == 0 && !picture.whole_path ? std::min(1.6 * rolls, last) : last;
}

Polyline path_of(const RollCurve& curve, double end) {
  Polyline line;
  for (Eigen::Index i = 0; i < curve.t.size() && curve.t[i] <= end * (1 + 1e-12); ++i) {
    line.push_back({curve.x[i], curve.y[i]});
  }
  return line;
}

Point at_time(const RollCurve& curve, double t) {
  const Eigen::Index last = curve.t.size() - 1;
  const Eigen::Index i = std::clamp<Eigen::Index>((curve.t <= t).count() - 1, 0, last - 1);
  const double fraction = std::clamp((t - curve.t[i]) / (curve.t[i + 1] - curve.t[i]), 0.0, 1.0);
  return between({curve.x[i], curve.y[i]}, {curve.x[i + 1], curve.y[i + 1]}, fraction);
}

/// Returns an interval about the same middle, with a margin and at least the given length.
std::pair<double, double> widened(double low, double high, double min_length) {
  constexpr double margin = 0.08;
  const double middle = (low + high) / 2;
  const double half = std::max((high - low) * (0.5 + margin), min_length / 2);
  return {middle - half, middle + half};
}

/// Draws the path of each model and the point from which on the ball rolls. The axes are as long as the paths.
Panel paths(const RollPicture& picture) {
  constexpr double size = 1.1;
  const double x = picture.ball.x[0], y = picture.ball.y[0];
  Panel panel;
  panel.x = {"", x, x, false, {}};
  panel.y = {"", y, y, false, {}};
  for (const RollCurve* curve : {&picture.ball, &picture.textbook}) {
    const bool is_ball = curve == &picture.ball;
    const Stroke stroke = is_ball ? Stroke{path_colour, 2.2, false} : Stroke{textbook_colour, 1.8, true};
    Polyline path = path_of(*curve, shown_time(picture));
    for (const Point& point : path) {
      std::tie(panel.x.low, panel.x.high) = std::minmax({panel.x.low, panel.x.high, point.x});
      std::tie(panel.y.low, panel.y.high) = std::minmax({panel.y.low, panel.y.high, point.y});
    }
    panel.lines.push_back({{std::move(path)},
                           stroke,
                           !is_ball            ? "textbook"
                           : picture.lies_flat ? "this body"
                                               : "this ball"});
    // The marks of picture.ball are drawn last, on top.
    if (curve->rolls > 0) {
      panel.marks.insert(panel.marks.begin(), {{at_time(*curve, curve->rolls)}, stroke.colour, size});
    }
  }
  return panel;
}

/// Draws the panel of the path, seen from above.
Panel path_panel(const RollPicture& picture) {
  Panel panel = paths(picture);
  for (auto [axis, letter] : {std::pair{&panel.x, "x"}, {&panel.y, "y"}}) {
    const auto [low, high] = widened(axis->low, axis->high, 0);
    *axis = {math(letter) + ", m", low, high, false, {}};
  }
  panel.title = "the path on the table";
  const double shown = shown_time(picture);
  if (shown < picture.ball.t[picture.ball.t.size() - 1]) panel.title += fmt::format(", the first {:.3g} s", shown);
  const Eigen::ArrayXd& t = picture.ball.t;
  double apart = 0;
  for (Eigen::Index i = 0; i < t.size() && t[i] <= shown; ++i) {
    const Point ball{picture.ball.x[i], picture.ball.y[i]}, textbook = at_time(picture.textbook, t[i]);
    apart = std::max(apart, std::hypot(ball.x - textbook.x, ball.y - textbook.y));
  }
  constexpr double visible = 0.01, exact = 1e-5;
  if (apart < visible * std::max(panel.x.high - panel.x.low, panel.y.high - panel.y.low))
    panel.title += apart < exact ? "; both models agree" : fmt::format("; the models differ by {:.2g} mm", 1e3 * apart);
  return panel;
}

/// Widens the axes of the path, the first panel, to the shape of that panel on the page. The path is to scale unless it
/// is so flat that most of the panel would be empty. Then one side is stretched by a round factor.
void fill_panel(Figure& figure) {
  constexpr double flattest = 0.2, wanted = 0.75;
  const Box box = lay_out(figure).panels.front().box;
  Panel& path = figure.panels.front();
  const double x = (path.x.high - path.x.low) / box.width, y = (path.y.high - path.y.low) / box.height;
  const double flat = std::min(x, y) / std::max(x, y);
  const double times = flat < flattest ? round_down(wanted / flat) : 1;
  if (times > 1) (x < y ? path.x : path.y).name += " (stretched " + number(times) + " times)";
  widen(figure, 0, x < y ? 1 / times : times);
  path.to_scale = times == 1;
}

/// The direction of the paths, and whether they are straight.
struct PathShape {
  Point along{1, 0};  ///< direction of the farthest point of the path
  double reach = 0;   ///< distance of that point from the start; 0: the ball spins in place
  bool bends = false;
};

PathShape path_shape(const RollPicture& picture) {
  const Polyline path = path_of(picture.ball, shown_time(picture));
  const Polyline textbook = path_of(picture.textbook, shown_time(picture));
  PathShape shape;
  for (const Point& point : path) {
    const double distance = std::hypot(point.x, point.y);
    if (distance > shape.reach) shape = {{point.x / distance, point.y / distance}, distance};
  }
  for (const Polyline* line : {&path, &textbook}) {
    for (const Point& point : *line) {
      const double off = std::abs(shape.along.x * point.y - shape.along.y * point.x);
      shape.bends = shape.bends || off > straight * shape.reach;
    }
  }
  return shape;
}

/// Draws the distance along a straight path against time.
Panel distance_panel(RollPicture picture, Point along) {
  for (RollCurve* curve : {&picture.ball, &picture.textbook}) {
    curve->y = along.x * curve->x + along.y * curve->y;
    curve->x = curve->t;
  }
  Panel panel = paths(picture);
  const auto [low, high] = widened(panel.y.low, panel.y.high, panel.y.high > panel.y.low ? 0 : 1);
  panel.title = "the path is straight: distance along it";
  panel.x = {math("t") + ", s", 0, shown_time(picture), false, {}};
  panel.y = {"distance, m", low, high, false, {}};
  return panel;
}

Panel speed_panel(const RollPicture& picture) {
  const double last = picture.ball.t[picture.ball.t.size() - 1];
  const double rolls = std::max(picture.ball.rolls, picture.textbook.rolls);
  const bool compressed = picture.slow == 0 && rolls > 0 && last > long_spin * rolls;
  // The compressed part takes about 0.6 times as much paper as the part before.
  const double step = round_step(compressed ? 1.3 * rolls : last, 4);
  const double knee = compressed ? step * std::ceil(1.3 * rolls / step) : last;
  const double times = compressed ? round_down((last - knee) / (0.6 * knee)) : 1;
  const auto place = [=](double t) { return t <= knee ? t : knee + (t - knee) / times; };
  Panel panel;
  panel.title = "speeds; dashed: textbook, slip and spin uncoupled";
  panel.x = {math("t") + ", s", 0, place(last), false, {}};
  if (compressed) {
    panel.x.name += "  (shaded part compressed " + number(times) + " times)";
    for (double t : multiples(-step, knee + step / 2, step)) panel.x.ticks.push_back({t, number(t)});
    for (double t : multiples(knee, last, round_step(last - knee, 5))) panel.x.ticks.push_back({place(t), number(t)});
  }
  // A fast spin is divided by a round number, so that the slip remains visible on the axis.
  const double fastest = std::max(picture.ball.slip.maxCoeff(), picture.ball.speed.maxCoeff());
  const double spin_to_slip = fastest > 0 ? picture.ball.rim.maxCoeff() / fastest : 1;
  const double spin_scale = spin_to_slip > 4 ? round_down(spin_to_slip) : 1;
  double top = 0;
  const auto add = [&](Eigen::ArrayXd RollCurve::*column, Colour colour, Marks::Shape shape, const Text& legend,
                       double scale = 1) {
    Marks marks{{}, colour, 0.8, shape, legend};
    for (const RollCurve* curve : {&picture.textbook, &picture.ball}) {
      const bool dashed = curve == &picture.textbook;
      Polyline line;
      for (Eigen::Index i = 0; i < curve->t.size(); ++i) {
        if (curve->t[i] <= last) line.push_back({place(curve->t[i]), (curve->*column)[i] / scale});
      }
      top = std::max(top, (curve->*column).maxCoeff() / scale);
      if (!dashed) {
        // Marks stand at equal distances on paper, up to the end of the curve.
        constexpr int count = 8;
        for (double i = 0.5 + 0.15 * static_cast<int>(shape); i < count; ++i) {
          const double t = from_paper(panel, {i / count, 0}).x;
          const auto after = std::ranges::lower_bound(line, t, {}, &Point::x);
          if (after == line.begin() || after == line.end()) continue;
          const Point before = *(after - 1);
          marks.points.push_back({t, before.y + (t - before.x) / (after->x - before.x) * (after->y - before.y)});
        }
      }
      panel.lines.push_back({{std::move(line)}, {colour, dashed ? 1.6 : 2.4, dashed}, dashed ? Text() : legend});
    }
    panel.marks.push_back(std::move(marks));
  };
  add(&RollCurve::slip, slip_colour, Marks::Shape::dot,
      "slip " + math("v") + (picture.lies_flat ? ", the speed of the centre" : ""));
  add(&RollCurve::rim, rim_colour, Marks::Shape::circle,
      "spin " + math("R|ω") + sub(math("z")) + "|" + (spin_scale > 1 ? " / " + number(spin_scale) : Text()),
      spin_scale);
  if (!picture.lies_flat) add(&RollCurve::speed, speed_colour, Marks::Shape::square, "speed of the centre");
  panel.y = {"m/s", 0, top > 0 ? 1.08 * top : 1, false, {}};
  if (compressed) {
    const auto [right, high] = std::pair(panel.x.high, panel.y.high);
    panel.regions.push_back({{{knee, 0}, {right, 0}, {right, high}, {knee, high}}, shade_colour});
  }
  return panel;
}

/// Returns the part of a panel that a frame of the film shows. Dashed lines become solid lines of one colour.
Panel until(const Panel& whole, std::size_t frame) {
  Panel panel = whole;
  panel.marks.clear();
  for (Lines& lines : panel.lines) {
    for (Polyline& line : lines.lines) line.resize(std::min(line.size(), frame + 1));
    if (lines.stroke.dashed) lines.stroke = {textbook_colour, 1.2};
  }
  return panel;
}

/// Draws a ball of radius 1 from above, with its state in words beside it. A circle on the ball, through the point that
/// was its top, shows how it turns. Half of the circle is thick and has a spot, so that opposite positions differ.
Panel ball_from_above(const RollCurve& curve, const Eigen::Matrix3d& turned, Eigen::Index frame, Colour colour,
                      const char* name, bool lies_flat) {
  using Eigen::Vector3d;
  constexpr int pieces = 72;
  const auto circle = [&](const Vector3d& one, const Vector3d& other, double part = 1) {
    Polyline line;
    for (int i = 0; i <= pieces; ++i) {
      const double angle = 2 * std::numbers::pi * part * i / pieces;
      const Vector3d at = std::cos(angle) * one + std::sin(angle) * other;
      constexpr double hidden = std::numeric_limits<double>::quiet_NaN();
      line.push_back(at.z() > -1e-9 ? Point{at.x(), at.y()} : Point{hidden, hidden});
    }
    return line;
  };
  const auto [x, z] = std::tuple(turned.col(0), turned.col(2));
  const Polyline outline = circle(Vector3d::UnitX(), Vector3d::UnitY());
  Panel panel;
  panel.title = name;
  panel.x = {"", -1.6, 3, false, {}};
  panel.y = {"", -1.05, 1.05, false, {}};
  panel.to_scale = panel.bare = true;
  panel.regions = {{outline, ball_colour}};
  panel.lines = {{{circle(z, -x, 0.5)}, {colour, 1.2}, ""},
                 {{circle(z, x, 0.5)}, {slip_colour, 4}, ""},
                 {{outline}, {colour, 2.2}, ""}};
  const Vector3d spot = (x + z).normalized();
  if (spot.z() > 0) panel.marks.push_back({{{spot.x(), spot.y()}}, slip_colour, 2});
  const std::string slides = fmt::format("slides {:.2f} m/s", curve.slip[frame]);
  panel.labels = {{{1.3, 0.25},
                   curve.t[frame] >= curve.rolls ? (lies_flat ? "rests" : "rolls") : slides,
                   path_colour,
                   Label::Align::left},
                  {{1.3, -0.25},
                   fmt::format("spins {:.1f} rad/s", curve.angular_velocity(2, frame)),
                   path_colour,
                   Label::Align::left}};
  return panel;
}

}  // namespace

FilmPace film_pace(double end, std::optional<Eigen::Index> asked) {
  constexpr double longest = 10, rate = 12.5;
  if (asked) return {Eigen::ArrayXd::LinSpaced(*asked, 0, end), static_cast<double>(*asked - 1) / (rate * end)};
  const double most = longest / end, digit = std::pow(10, std::floor(std::log10(most)));
  const double slow = most >= 1 ? digit * std::floor(most / digit) : round_down(most);
  const double frames = std::max(1.0, std::round(end * slow * rate));
  return {Eigen::ArrayXd::LinSpaced(static_cast<Eigen::Index>(frames) + 1, 0, frames / (rate * slow)), slow};
}

std::vector<Figure> roll_film(const RollPicture& picture) {
  Figure whole = roll_figure(picture);
  const Eigen::ArrayXd& t = picture.ball.t;
  const RollCurve* const curves[]{&picture.ball, &picture.textbook};
  for (const RollCurve* curve : curves) {
    if (curve->angular_velocity.cols() == t.size()) continue;
    throw std::domain_error("roll_film: columns need an angular velocity in each row");
  }
  const double slow = picture.slow;
  const std::string pace = slow == 1  ? "real time"
                           : slow > 1 ? fmt::format("slowed {:.3g} times", slow)
                                      : fmt::format("{:.3g} times faster", 1 / slow);
  const bool moves = whole.panels.size() == 2;
  const int digits = std::max(2, static_cast<int>(std::ceil(std::log10(12.5 * slow))));  // so that each frame differs
  whole.max_columns = moves ? 2 : 3;
  std::vector<Figure> frames;
  Eigen::Matrix3d turned[]{Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    Figure& frame = frames.emplace_back(whole);
    for (Panel& panel : frame.panels) panel = until(panel, static_cast<std::size_t>(i));
    frame.panels.back().title =
        math("t = ") + fmt::format("{:.{}f}", t[i], digits) + fmt::format(" s, {}; grey: textbook", pace);
    for (int which : {0, 1}) {
      const RollCurve& curve = *curves[which];
      if (i > 0) {
        const auto& omega = curve.angular_velocity;
        const Eigen::Vector3d angle = (omega.col(i) + omega.col(i - 1)) / 2 * (t[i] - t[i - 1]);
        turned[which] = Eigen::AngleAxisd(angle.norm(), angle.stableNormalized()) * turned[which];
      }
      const Colour colour = which == 0 ? path_colour : textbook_colour;
      frame.panels.push_back(ball_from_above(curve, turned[which], i, colour,
                                             which == 1          ? "textbook, from above"
                                             : picture.lies_flat ? "this body, from above"
                                                                 : "this ball, from above",
                                             picture.lies_flat));
      if (!moves) continue;
      // Mark the current position, and the point from which on the ball rolls. Marks of picture.ball are on top.
      Panel& path = frame.panels.front();
      const Polyline& line = path.lines[static_cast<std::size_t>(which)].lines.front();
      Marks rolls{{},
                  colour,
                  1.6,
                  Marks::Shape::circle,
                  which == 1          ? ""
                  : picture.lies_flat ? "rests here"
                                      : "rolls from here"};
      const auto at = static_cast<std::size_t>((t < curve.rolls).count());
      if (at < line.size()) rolls.points.push_back(line[at]);
      path.marks.insert(path.marks.begin(), {Marks{{line.back()}, colour, 1.6}, rolls});
    }
  }
  if (!path_shape(picture).bends) return frames;
  fill_panel(frames.front());
  const Panel& first = frames.front().panels.front();
  for (Figure& frame : frames) {
    Panel& path = frame.panels.front();
    std::tie(path.x, path.y, path.to_scale) = std::tuple(first.x, first.y, first.to_scale);
  }
  return frames;
}

Figure roll_figure(const RollPicture& picture) {
  require_columns(picture.ball);
  require_columns(picture.textbook);
  const PathShape shape = path_shape(picture);
  Figure figure;
  figure.title = picture.title;
  figure.subtitle = picture.subtitle;
  const bool stays = shape.reach == 0;
  const double film_width = picture.size.width_mm.value_or(160);
  const double film_shape = panel_columns(film_width, 4) == 1 ? 2.2 : stays ? 0.45 : 0.75;
  figure.size = picture.slow > 0 ? PaperSize{film_width, picture.size.height_mm.value_or(film_shape * film_width)}
                : stays          ? fitted({usual.width_mm / 2 + 25, usual.height_mm}, 1, picture.size)
                                 : fitted(usual, 2, picture.size);
  if (!stays) figure.panels.push_back(shape.bends ? path_panel(picture) : distance_panel(picture, shape.along));
  figure.panels.push_back(speed_panel(picture));
  if (shape.bends && picture.slow == 0) fill_panel(figure);
  return figure;
}

}  // namespace contensou::portraits
