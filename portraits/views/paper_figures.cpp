#include "contensou/portraits/theory_figures.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace contensou::portraits {

namespace {

using std::numbers::pi;

constexpr Colour ink{0x222222};
constexpr Colour guide{0x888888};
constexpr Colour velocity_colour{0x0b4f8a};
constexpr Colour force_colour{0xb3003b};
constexpr Colour patch_colour{0xb9cfe4};

/// Returns an arc of an ellipse; angles are counter-clockwise from the x axis.
Polyline arc(Point centre, double rx, double ry, double from, double to) {
  constexpr int pieces = 90;
  Polyline line;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = from + (to - from) * i / pieces;
    line.push_back({centre.x + rx * std::cos(angle), centre.y + ry * std::sin(angle)});
  }
  return line;
}

/// A drawing to which parts are added.
class Sketch {
 public:
  /// @param usual  default size; its shape is kept unless both sides are requested
  Sketch(Text title, Text subtitle, const PaperSize& usual, const AskedSize& size) {
    figure_.title = std::move(title);
    figure_.subtitle = std::move(subtitle);
    const double width = size.width_mm.value_or(usual.width_mm);
    figure_.size = {width, size.height_mm.value_or(width * usual.height_mm / usual.width_mm)};
    panel_.bare = true;
  }

  void line(Polyline line, Stroke stroke) { panel_.lines.push_back({{std::move(line)}, stroke, ""}); }
  void dot(Point at, Colour colour = ink) { panel_.marks.push_back({{at}, colour, 0.7}); }
  void label(Point at, Text text, Colour colour = ink, Label::Align align = Label::Align::centre) {
    panel_.labels.push_back({at, std::move(text), colour, align});
  }

  /// Adds a line that ends in an arrow head.
  void arrow(Polyline shaft, Colour colour, double width) {
    const Point& tip = shaft.back();
    const Point& before = shaft[shaft.size() - 2];
    panel_.arrows.push_back({{{tip, {tip.x - before.x, tip.y - before.y}}}, colour});
    line(std::move(shaft), {colour, width, false});
  }

  /// Adds a line with a head at each end.
  void distance(Point from, Point to) {
    arrow({from, to}, guide, 1);
    panel_.arrows.push_back({{{from, {from.x - to.x, from.y - to.y}}}, guide});
  }

  /// Returns the figure to scale, with the given middle, width and height.
  Figure framed(Point middle, double width, double height) {
    panel_.x = {"", middle.x - width / 2, middle.x + width / 2, false, {}};
    panel_.y = {"", middle.y - height / 2, middle.y + height / 2, false, {}};
    panel_.to_scale = true;
    figure_.panels = {panel_};
    return figure_;
  }

 private:
  Figure figure_;
  Panel panel_;
};

}  // namespace

Figure patch_drawing(const AskedSize& size) {
  // The unit of length is eps. The patch's centre slips along x.
  constexpr double h = 1.65;
  constexpr Point O{0, 0};
  constexpr Point C{0, -h};
  Sketch sketch(
      "The contact patch and its centre of velocity",
      "Zhuravlev 1998, Fig. 1: every element slips across its radius vector " + math("r") + " from " + math("C"),
      {150, 140}, size);

  const auto polar = [&](double r, double theta) {
    return Point{C.x + r * std::sin(theta), C.y + r * std::cos(theta)};
  };
  // Light hatching shows that the patch is the area within the circle, not the circle alone.
  for (int i = -18; i <= 18; ++i) {
    const double x = i / 18.5;
    const double half = std::sqrt(1 - x * x);
    sketch.line({{x, -half}, {x, half}}, {patch_colour, 0.6, false});
  }
  sketch.line(arc(O, 1, 1, 0, 2 * pi), {ink, 2.2, false});

  // The last chord touches the edge: sin(theta*) = eps/h.
  const double last = std::asin(1 / h);
  for (double side : {-1.0, 1.0}) sketch.line({C, polar(1.75, side * last)}, {guide, 0.9, true});
  sketch.line({C, {0, 1.25}}, {guide, 0.9, true});
  sketch.line(arc(C, 0.62, 0.62, pi / 2, pi / 2 + last), {guide, 1, false});
  sketch.label({C.x - 0.15, C.y + 0.47}, math("θ*"), guide);

  // Draw a chord and an element on it.
  constexpr double theta = 0.33;
  const double middle = h * std::cos(theta);
  const double half = std::sqrt(1 - h * std::sin(theta) * (h * std::sin(theta)));
  sketch.line({C, polar(middle + half + 0.12, theta)}, {ink, 1, false});
  sketch.dot(polar(middle - half, theta));
  sketch.dot(polar(middle + half, theta));
  sketch.label({polar(middle - half, theta).x + 0.14, polar(middle - half, theta).y - 0.1}, math("q") + sub("−"));
  sketch.label({polar(middle + half, theta).x + 0.19, polar(middle + half, theta).y + 0.03}, math("q") + sub("+"));
  sketch.line(arc(C, 0.45, 0.45, pi / 2, pi / 2 - theta), {ink, 1.2, false});
  sketch.label({C.x + 0.11, C.y + 0.58}, math("θ"));
  const Point label_r = polar(1.2, theta);
  sketch.label({label_r.x + 0.13, label_r.y - 0.03}, math("r"));

  constexpr double r = 1.95;
  constexpr double dr = 0.075;
  constexpr double dtheta = 0.04;
  Polyline element;
  for (const auto& [dr_sign, dt_sign] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}, {-1, -1}}) {
    element.push_back(polar(r + dr_sign * dr, theta + dt_sign * dtheta));
  }
  sketch.line(element, {ink, 1.6, false});
  const Point P = polar(r, theta);
  const Point along{std::cos(theta), -std::sin(theta)};  // direction of the slip at P
  sketch.arrow({P, {P.x + 0.55 * along.x, P.y + 0.55 * along.y}}, velocity_colour, 1.8);
  sketch.arrow({P, {P.x - 0.42 * along.x, P.y - 0.42 * along.y}}, force_colour, 2.2);
  sketch.label({P.x - 0.5 * along.x, P.y - 0.5 * along.y + 0.1}, math("dF"), force_colour);
  sketch.label({P.x + 0.72 * along.x, P.y + 0.72 * along.y - 0.01}, math("ω r"), velocity_colour);

  // Draw the motion of the patch.
  sketch.arrow({O, {0.78, 0}}, velocity_colour, 2.4);
  sketch.label({0.72, -0.13}, math("v"), velocity_colour);
  sketch.arrow(arc(O, 0.27, 0.27, pi * 1.05, pi * 0.2), velocity_colour, 1.6);
  sketch.label({-0.3, 0.27}, math("ω"), velocity_colour);
  sketch.line({O, {std::cos(3.6), std::sin(3.6)}}, {ink, 1, false});
  sketch.label({-0.52, -0.15}, math("ε"));
  sketch.dot(O);
  sketch.label({0.13, -0.13}, math("O"));
  sketch.dot(C);
  sketch.label({0.14, C.y - 0.06}, math("C"));

  // Draw h beside the drawing.
  sketch.line({O, {-1.3, 0}}, {guide, 0.7, true});
  sketch.line({C, {-1.3, C.y}}, {guide, 0.7, true});
  sketch.distance({-1.22, -0.02}, {-1.22, C.y + 0.02});
  sketch.label({-1.22, C.y / 2}, math("h = v/ω"));

  // Draw the axes of the plane.
  sketch.arrow({{1.3, C.y}, {1.75, C.y}}, ink, 1.2);
  sketch.arrow({{1.3, C.y}, {1.3, C.y + 0.45}}, ink, 1.2);
  sketch.label({1.82, C.y + 0.02}, math("x"));
  sketch.label({1.3, C.y + 0.54}, math("y"));
  return sketch.framed({0.12, -0.27}, 3.57, 3.2);
}

Figure ball_drawing(const AskedSize& size) {
  // The unit of length is R. The plane is seen from above at an angle.
  constexpr double depth_x = 0.6;
  constexpr double depth_y = 0.27;
  const auto seen = [](double x, double y) { return Point{x + depth_x * y, depth_y * y}; };
  Sketch sketch("The ball on the plane",
                "Zhuravlev 1998, Fig. 3: it slides with " + math("v") + ", spins with " + math("ω") + sub(math("z")) +
                    " and touches on a spot of radius " + math("ε = μR"),
                {190, 140}, size);

  // The ball hides what lies behind its outline, the circle of radius 1 about (0, 1).
  constexpr double long_side = 1.3;
  constexpr double short_side = 1.6;
  const auto enters = [](double x) {  // returns the y at which the line (x, y, 0) meets the outline
    const double square = depth_x * depth_x + depth_y * depth_y;
    const double linear = depth_y - x * depth_x;
    return (linear - std::sqrt(linear * linear - square * x * x)) / square;
  };
  const Point far_right = seen(long_side, short_side);
  const double hidden = std::sqrt(1 - (1 - far_right.y) * (1 - far_right.y));
  sketch.line({seen(-long_side, enters(-long_side)),
               seen(-long_side, -short_side),
               seen(long_side, -short_side),
               far_right,
               {hidden, far_right.y}},
              {guide, 1, false});

  // Draw the contact patch, a hatched circle in the plane.
  constexpr double eps = 0.36;
  for (int i = -9; i <= 9; ++i) {
    const double y = eps * i / 9.5;
    const double half = std::sqrt(eps * eps - y * y);
    sketch.line({seen(-half, y), seen(half, y)}, {patch_colour, 1, false});
  }
  Polyline spot;
  for (const Point& point : arc({0, 0}, eps, eps, 0, 2 * pi)) spot.push_back(seen(point.x, point.y));
  sketch.line(spot, {velocity_colour, 1.6, false});

  // Draw the ball with its equator, whose near half is solid.
  constexpr Point centre{0, 1};
  sketch.line(arc(centre, 1, 1, 0, 2 * pi), {ink, 2.4, false});
  sketch.line(arc(centre, 1, 0.26, pi, 2 * pi), {guide, 0.9, false});
  sketch.line(arc(centre, 1, 0.26, 0, pi), {guide, 0.9, true});

  // Draw axes through the point of contact, x along the slip.
  sketch.line({seen(0, 0), {0, 2}}, {guide, 0.9, true});
  sketch.arrow({{0, 2}, {0, 2.55}}, ink, 1.4);
  sketch.arrow({{0, 0}, {1.8, 0}}, ink, 1.4);
  constexpr double leaves = 2 * depth_y / (depth_x * depth_x + depth_y * depth_y);
  sketch.line({{0, 0}, seen(0, leaves)}, {guide, 0.9, true});
  sketch.arrow({seen(0, leaves), seen(0, 2.1)}, ink, 1.4);
  sketch.label({0.12, 2.5}, math("z"));
  sketch.label({1.9, 0}, math("x"));
  sketch.label({seen(0, 2.1).x + 0.11, seen(0, 2.1).y + 0.02}, math("y"));

  // Draw the motion of the ball.
  sketch.arrow({seen(0, 0), seen(0.95, 0)}, velocity_colour, 2.6);
  sketch.label({0.86, -0.14}, math("v"), velocity_colour);
  sketch.arrow(arc({0, 2.26}, 0.3, 0.1, -pi * 0.75, pi * 0.85), velocity_colour, 1.8);
  sketch.label({0.47, 2.27}, math("ω") + sub(math("z")), velocity_colour);
  sketch.arrow({seen(0, 0), seen(-0.72, 0)}, force_colour, 2.4);
  sketch.label({-0.82, 0.02}, math("F"), force_colour);
  sketch.dot({0, 0});

  sketch.line({centre, {-std::cos(0.7), 1 + std::sin(0.7)}}, {ink, 1, false});
  sketch.label({-0.34, 1.42}, math("R"));
  sketch.dot(centre);
  sketch.line({seen(0, 0), seen(-eps * std::cos(1.0), -eps * std::sin(1.0))}, {ink, 1, false});
  sketch.line({seen(-eps * 0.3, -eps * 0.5), {-0.62, -0.24}}, {guide, 0.8, false});
  sketch.label({-0.7, -0.27}, math("ε"));
  return sketch.framed({0, 1.02}, 4.86, 3.3);
}

}  // namespace contensou::portraits
