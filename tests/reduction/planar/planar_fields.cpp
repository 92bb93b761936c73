// Random fields r' = r^d R(angle), angle' = r^(d-1) T(angle) with known zeros and poles of R and T, transformed by a
// random linear map. They are compared with steps by Odeint in (ln r, angle), and with the ends that follow from the
// orders of R and T.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/LU>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <catch2/catch.hpp>

#include "contensou/reduction/planar_reduction.hpp"

using namespace contensou::reduction;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

/// A line through the centre. Near it |T| ~ z^angular and |R| ~ z^radial, z being the angle from the line.
struct Line {
  double angle;
  int angular, radial;

  /// Returns the sine of the angle from the line to the unit vector (x, y). It is exact on axes and diagonals.
  double sine(double x, double y) const {
    const double eighths = angle / (pi / 4);
    if (eighths == 0) return y;
    if (eighths == 1) return (y - x) / std::numbers::sqrt2;
    if (eighths == 2) return -x;
    return y * std::cos(angle) - x * std::sin(angle);
  }
};

/// The field and its parts compute with numbers. Expressions of Eigen are slow in tests, which are not optimised.
struct RandomField {
  double degree, angular, radial, slant;
  std::vector<Line> lines = {};
  Matrix2d map = Matrix2d::Identity(), inverse = map;

  /// Returns T in the direction of the unit vector (x, y).
  double turning(double x, double y) const {
    double product = angular * (1.3 + y * std::cos(slant) + x * std::sin(slant));
    for (const Line& line : lines) product *= std::pow(line.sine(x, y), line.angular);
    return product;
  }
  /// Returns R in the direction of the unit vector (x, y).
  double growth(double x, double y) const {
    double product = radial * (1.4 + x * std::cos(slant) + y * std::sin(slant));
    for (const Line& line : lines) product *= std::pow(line.sine(x, y), line.radial);
    return product;
  }
  Vector2d operator()(const Vector2d& point) const {
    const double *to = inverse.data(), *back = map.data();  // by columns
    const double u = point.x(), v = point.y(), x = to[0] * u + to[2] * v, y = to[1] * u + to[3] * v;
    const double r = std::sqrt(x * x + y * y), scale = std::pow(r, degree) / r;
    const double R = scale * growth(x / r, y / r), T = scale * turning(x / r, y / r);
    const double x_rate = R * x - T * y, y_rate = R * y + T * x;
    return {back[0] * x_rate + back[2] * y_rate, back[1] * x_rate + back[3] * y_rate};
  }
  std::string text() const {
    std::string all = fmt::format("d = {}, T {}, R {}, slant {}", degree, angular, radial, slant);
    for (const Line& line : lines) all += fmt::format("; at {}: z^{}, z^{}", line.angle, line.angular, line.radial);
    return all + fmt::format("; map {} {} {} {}", map(0, 0), map(0, 1), map(1, 0), map(1, 1));
  }
};

/// Returns the end of orbits that come to a line, from the orders of T and R and the sign of R beside the line.
PlanarEnd expected_end(const Line& line, double sign) {
  const int a = line.angular, b = line.radial, gamma = b - a + 1;
  if (gamma > 0 && !(a > 0 && b == 0)) return a > 0 && b > 0 ? PlanarEnd::rest : PlanarEnd::border;
  return sign < 0 ? PlanarEnd::centre : PlanarEnd::infinity;
}

using Polar = std::array<double, 2>;  ///< ln r and the angle

/// Returns the state after a time, computed by steps.
Polar stepped(const RandomField& field, Polar state, double time) {
  namespace odeint = boost::numeric::odeint;
  const auto rates = [&](const Polar& x, Polar& slope, double) {
    const double scale = std::exp((field.degree - 1) * x[0]);
    const double across = std::cos(x[1]), up = std::sin(x[1]);
    slope = {scale * field.growth(across, up), scale * field.turning(across, up)};
  };
  auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<Polar>>(1e-13, 1e-13);
  double now = 0, step = time * 1e-3;
  for (int steps = 0; now < time; ++steps) {
    if (steps > 20'000) throw std::runtime_error("too many steps");
    step = std::min(step, time - now);
    stepper.try_step(rates, state, now, step);
  }
  return state;
}

}  // namespace

TEST_CASE("random fields with poles and zeros of any order, through a linear map", "[planar][random]") {
  std::mt19937 random(41);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  const auto one_of = [&](std::vector<int> values) {
    return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
  };
  const int count = CONTENSOU_FULL_TESTS ? 1000 : 100;
  int ordinary = 0, decided = 0, compared = 0, accurate = 0;
  for (int i = 0; i < count; ++i) {
    RandomField field{double(one_of({-1, 0, 0, 1, 2, 3})), uniform(0.5, 2) * one_of({-1, 1}),
                      uniform(0.3, 2) * one_of({-1, 1}), uniform(-3, 3)};
    const int lines = one_of({1, 1, 2});
    for (int j = 0; j < lines; ++j) {
      field.lines.push_back({uniform(0, 1) + 1.5 * j, one_of({-2, -1, 1, 2, 2, 3}), one_of({-2, -1, 0, 0, 0, 1, 2})});
    }
    if (i % 3 == 0) field.lines[0].angle = one_of({0, 1, 2}) * pi / 4;
    if (i % 2 == 0) field.map << uniform(0.5, 2), uniform(-1, 1), uniform(-0.4, 0.4), uniform(0.5, 2);
    field.inverse = field.map.inverse();
    const double angle = uniform(-3, 3), r = uniform(0.5, 2);
    const Vector2d start = field.map * (r * Vector2d(std::cos(angle), std::sin(angle)));
    const double turning = field.turning(std::cos(angle), std::sin(angle));
    CAPTURE(i, field.text(), angle, r, start);
    // Find the line to which the orbit tends.
    double nearest = 10;
    Line end{};
    for (const Line& line : field.lines) {
      const double way = std::fmod((turning > 0 ? 1 : -1) * (line.angle - angle) + 8 * pi, pi);
      if (way < nearest) {
        nearest = way;
        end = line;
      }
    }
    if (nearest < 1e-3 || nearest > pi - 1e-3) continue;
    const double beside = angle + (turning > 0 ? 1 : -1) * nearest * (1 - 1e-6);
    const double sign = field.growth(std::cos(beside), std::sin(beside));
    // If T has a zero and R a pole on the same line off the axes, the rounding of R hides the zero.
    const bool is_ordinary =
        std::ranges::none_of(field.lines, [](const Line& line) { return line.angular > 0 && line.radial < 0; });
    ordinary += is_ordinary;
    const Generator scaling{1 - field.degree, Matrix2d::Identity(), Vector2d::Zero(), true};
    std::optional<PlanarReduction> plane;
    try {
      plane.emplace(field, scaling, start, 1e-15);
    } catch (const UndecidedRays& undecided) {
      continue;
    }
    const PlanarOrbit orbit = plane->orbit(start);
    if (orbit.end() == PlanarEnd::undecided) continue;
    decided += is_ordinary;
    CHECK(name(orbit.end()) == name(expected_end(end, sign)));
    CHECK(orbit.end_time() > 0);
    const double last = std::isfinite(orbit.end_time()) ? orbit.end_time() : 2 * std::pow(r, 1 - field.degree);
    for (double part : {0.2, 0.6, 0.95}) {
      const double time = part * last;
      Vector2d got, wanted;
      try {
        got = orbit.at(time);
      } catch (const std::domain_error&) {
        continue;  // the orbit has ended at a border or at infinity
      }
      Polar state;
      try {
        state = stepped(field, {std::log(r), angle}, time);
      } catch (const std::runtime_error&) {
        continue;
      }
      if (!(std::abs(state[0]) < 200)) continue;
      wanted = field.map * (std::exp(state[0]) * Vector2d(std::cos(state[1]), std::sin(state[1])));
      const double error = (got - wanted).norm() / wanted.norm();
      ++compared;
      accurate += error < 1e-10;
      // The angle of a multiple ray off the axes has an error of 1e-12. Ends next to such a ray may be ill-conditioned.
      CHECK(error < 1e-3);
    }
  }
  CAPTURE(ordinary, decided, compared, accurate);
  CHECK(decided > 0.93 * ordinary);
  CHECK(compared > 1.5 * count);
  CHECK(accurate > 0.97 * compared);
}
