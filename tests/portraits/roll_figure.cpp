#include "contensou/portraits/roll_figure.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/render.hpp"
#include "figures.hpp"

using namespace contensou::portraits;

namespace {

/// A ball that moves along x, is pushed along y until it rolls at t = 1, and spins until t = 2.
RollCurve curve(double push, double last) {
  RollCurve c;
  c.t = Eigen::ArrayXd::LinSpaced(101, 0, last);
  const Eigen::ArrayXd slides = c.t.min(1.0);
  c.x = c.t;
  c.y = push * (slides.square() / 2 + (c.t - slides));
  c.slip = 1 - slides;
  c.rim = (2 - c.t).max(0.0);
  c.speed = (1 + (push * slides).square()).sqrt();
  c.rolls = 1;
  return c;
}

}  // namespace

TEST_CASE("the path with the point from which it rolls, beside the speeds", "[table]") {
  const Figure figure = roll_figure({"a ball", "", curve(0.5, 2.2), curve(0.6, 2.2)});
  REQUIRE(figure.panels.size() == 2);
  const Panel& path = figure.panels[0];
  REQUIRE(path.lines.size() == 2);
  // The path continues to 1.6 times the time at which rolling begins. Every point lies in the panel.
  CHECK(path.lines[0].lines[0].back().x == Approx(1.6).margin(0.03));
  for (const Lines& layer : path.lines) {
    for (const Point& point : layer.lines[0]) CHECK(inside(path, point));
  }
  REQUIRE(path.marks.size() == 2);
  CHECK(path.marks[1].points[0].x == Approx(1).epsilon(1e-3));
  CHECK(path.marks[1].points[0].y == Approx(0.25).epsilon(1e-2));

  const Panel& speeds = figure.panels[1];
  REQUIRE(speeds.lines.size() == 6);
  CHECK_FALSE(speeds.x.logarithmic);
  CHECK(speeds.x.high == 2.2);
  CHECK(std::ranges::count_if(speeds.lines, [](const Lines& layer) { return layer.stroke.dashed; }) == 3);
  // The three speeds differ in grey, too, because each curve has marks of another kind.
  REQUIRE(speeds.marks.size() == 3);
  for (int i = 0; i < 3; ++i) {
    CHECK(speeds.marks[i].shape == static_cast<Marks::Shape>(i));
    CHECK(speeds.marks[i].points.size() >= 7);
    CHECK(speeds.marks[i].legend == layer(speeds, speeds.marks[i].legend.words()).legend);
  }
  for (const Point& point : speeds.marks[0].points) CHECK(point.y == Approx(1 - std::min(point.x, 1.0)).margin(1e-3));
  for (const Lines& layer : speeds.lines) {
    for (const Point& point : layer.lines[0]) CHECK(inside(speeds, point));
  }
}

TEST_CASE("a path is to scale; a flat one is stretched a round number of times, and says so", "[limit]") {
  // Returns the length of a unit of y on the page, divided by the length of a unit of x.
  const auto stretched = [](const Figure& figure) {
    const Panel& path = figure.panels[0];
    const Box box = lay_out(figure).panels[0].box;
    return box.height / (path.y.high - path.y.low) / (box.width / (path.x.high - path.x.low));
  };
  for (double push : {0.3, 0.5, 2.0, 10.0, 30.0}) {
    for (std::optional<double> width : {std::optional<double>(), std::optional(85.0)}) {
      RollPicture picture{"", "", curve(push, 2.2), curve(push, 2.2)};
      picture.size.width_mm = width;
      const Figure figure = roll_figure(picture);
      CAPTURE(push, figure.size.width_mm);
      const std::string name = figure.panels[0].x.name.words();  // a path along y stretches x
      const std::size_t note = name.find("(stretched ");
      CHECK((note == name.npos) == (push < 5));
      CHECK(figure.panels[0].to_scale == (push < 5));
      const double times = push < 5 ? 1 : std::stod(name.substr(note + 11));
      CHECK((push < 5 || (times >= 5 && times <= 20)));
      CHECK(stretched(figure) == Approx(1 / times).epsilon(push < 5 ? 1e-12 : 0.01));
    }
  }
  const Figure wide = roll_figure({"", "", curve(0.1, 2.2), curve(0.1, 2.2)});
  CHECK_THAT(wide.panels[0].y.name.words(), Catch::Contains("(stretched 5 times)"));
  CHECK(stretched(wide) == Approx(5).epsilon(0.01));
}

TEST_CASE("a path that is cut says where", "[table]") {
  RollPicture picture{"", "", curve(0.5, 2.2), curve(0.6, 2.2)};
  CHECK(roll_figure(picture).panels[0].title == "the path on the table, the first 1.6 s");
  picture.whole_path = true;
  const Panel path = roll_figure(picture).panels[0];
  CHECK(path.title == "the path on the table");
  CHECK(path.lines[0].lines[0].back().x == Approx(2.2));
}

TEST_CASE("a straight path is drawn against time", "[limit]") {
  const Panel path = roll_figure({"", "", curve(0, 2.2), curve(0, 2.2)}).panels[0];
  CHECK(path.x.low == 0);
  CHECK(path.x.high == Approx(1.6));
  CHECK(path.title.words().find("straight") != std::string::npos);
}

TEST_CASE("a ball that stays in its place has no path", "[limit]") {
  RollCurve still = curve(0, 2.2);
  still.x.setZero();
  still.rolls = 0;
  const Figure figure = roll_figure({"", "", still, still});
  REQUIRE(figure.panels.size() == 1);
  CHECK(figure.panels[0].title.words().find("speeds") != std::string::npos);
}

TEST_CASE("a long spin is drawn on a time axis that is compressed after rolling begins", "[limit]") {
  const Panel speeds = roll_figure({"", "", curve(0.5, 30), curve(0.5, 30)}).panels[1];
  CHECK_THAT(speeds.x.name.words(), Catch::Contains("(shaded part compressed 20 times)"));
  // Paper for a time: unchanged up to 1.5 s, then 20 times less.
  const auto place = [](double t) { return t < 1.5 ? t : 1.5 + (t - 1.5) / 20; };
  CHECK(speeds.x.high == Approx(place(30)));
  REQUIRE(speeds.x.ticks.size() >= 8);
  for (const Axis::Tick& tick : speeds.x.ticks)
    CHECK(tick.at == Approx(place(std::stod(tick.text.words()))).margin(1e-12));
  REQUIRE(speeds.regions.size() == 1);
  CHECK(speeds.regions[0].border.front().x == 1.5);
  const Polyline& spin = layer(speeds, "spin R|ωz|").lines[0];
  CHECK(spin.front().x == 0);
  CHECK(spin.front().y == 2);
  CHECK(std::ranges::find_if(spin, [](Point at) { return at.y == 0; })->x == Approx(place(2.1)));
}

TEST_CASE("a picture of two paths that coincide says how far apart the bodies are", "[limit]") {
  const auto title = [](double push) {
    return roll_figure({"", "", curve(0.5, 2.2), curve(push, 2.2)}).panels[0].title.words();
  };
  // At the end of the path, at t = 1.6, a push of 0.5 has moved the body by 0.5 (1/2 + 0.6).
  CHECK_THAT(title(0.502), Catch::EndsWith("; the models differ by 2.2 mm"));
  CHECK_THAT(title(0.500001), Catch::EndsWith("; both models agree"));
}

TEST_CASE("a flat body has one curve for its slip and for the speed of its centre", "[table]") {
  RollCurve puck = curve(0, 2.2);
  puck.speed = puck.slip;
  const Panel speeds = roll_figure({{}, {}, puck, puck, {}, 0, true}).panels.at(1);
  CHECK(speeds.lines.size() == 4);
  REQUIRE(speeds.marks.size() == 2);
  CHECK(speeds.marks[0].legend.words() == "slip v, the speed of the centre");
}

TEST_CASE("a fast spin is drawn in a part of its size, and says so: the slip keeps its room", "[table]") {
  RollCurve fast = curve(0.5, 2.2);
  fast.rim = 23 * fast.slip;
  const Panel speeds = roll_figure({"", "", fast, fast}).panels[1];
  CHECK(speeds.y.high == Approx(1.08 * std::max(fast.speed.maxCoeff(), fast.rim.maxCoeff() / 20)));
  CHECK(std::ranges::any_of(speeds.lines, [](const Lines& lines) { return lines.legend.words().ends_with(" / 20"); }));
}

TEST_CASE("a film of so many frames lasts as long as they do", "[table]") {
  const auto [t, slow] = film_pace(4, 51);
  CHECK(t.size() == 51);
  CHECK(t[50] == 4);
  CHECK(slow == Approx(1));
}

TEST_CASE("the legend lists the entries of every panel once", "[table]") {
  const std::string script = gnuplot_script(roll_figure({"", "", curve(0.5, 2.2), curve(0.6, 2.2)}));
  for (const std::string entry : {"this ball", "textbook", "speed of the centre"}) {
    const std::string title = "'{/*1 " + entry + "}' at screen";
    const std::size_t at = script.find(title);
    CHECK(at != std::string::npos);
    CHECK(script.find(title, at + 1) == std::string::npos);
  }
}

TEST_CASE("a film shows as much as has happened, and both balls as they have turned", "[table]") {
  for (double end : {0.013, 0.4, 7.0, 10.5, 300.0}) {
    const auto [t, slow] = film_pace(end);
    CAPTURE(end, slow);
    CHECK(t[1] * slow == Approx(0.08));
    CHECK(t[t.size() - 1] == Approx(end).epsilon(0.01));
    CHECK(t.size() <= 127);
    CHECK(t.size() >= 50);
  }
  RollCurve ball = curve(0.5, 2.2), textbook = curve(0.6, 2.2);
  textbook.rolls = 1.5;
  // Both balls turn by a quarter turn about the vertical.
  for (RollCurve* of : {&ball, &textbook}) {
    of->angular_velocity = Eigen::Vector3d(0, 0, 3.14159265 / 2 / 2.2).replicate(1, of->t.size());
  }
  const RollPicture picture{"", "", ball, textbook, {}, 20};
  const std::vector<Figure> frames = roll_film(picture);
  REQUIRE(frames.size() == 101);
  for (std::size_t i : {0, 50, 60, 100}) {
    const auto& panels = frames[i].panels;
    REQUIRE(panels.size() == 4);
    CHECK(panels[0].lines[0].lines[0].size() == i + 1);
    CHECK_THAT(panels[1].title.words(), Catch::Contains("slowed 20 times"));
    // Marks of the uncoupled model come first, then marks of this ball: its position, and the beginning of rolling.
    REQUIRE(panels[0].marks.size() == 4);
    CHECK(panels[0].marks[2].points[0].x == Approx(ball.t[static_cast<Eigen::Index>(i)]));
    CHECK(panels[0].marks[3].points.size() == (i >= 46 ? 1 : 0));
    CHECK(panels[2].labels[0].text == (i >= 46 ? "rolls" : "slides 1.00 m/s"));
    CHECK_THAT(panels[3].labels[0].text.words(), Catch::StartsWith(i >= 69 ? "rolls" : "slides"));
  }
  const Point before = frames[0].panels[2].marks[0].points[0], after = frames[100].panels[2].marks[0].points[0];
  CHECK(after.x == Approx(-before.y).margin(1e-7));
  CHECK(after.y == Approx(before.x));
  // Only half of one circle is thick, so that opposite positions differ.
  CHECK(frames[0].panels[2].lines[1].stroke.width > 2 * frames[0].panels[2].lines[0].stroke.width);
  CHECK(frames[0].panels[2].lines[1].lines[0][36].x == Approx(1));
  CHECK(frames[100].panels[2].lines[1].lines[0][36].y == Approx(1));
  ball.angular_velocity.resize(3, 0);
  CHECK_THROWS_AS(roll_film({"", "", ball, textbook, {}, 20}), std::domain_error);
}

TEST_CASE("columns of different lengths are refused", "[domain]") {
  RollCurve bad = curve(0.5, 2.2);
  bad.rim = Eigen::ArrayXd::Zero(3);
  CHECK_THROWS_AS(roll_figure({"", "", curve(0.5, 2.2), bad}), std::domain_error);
}
