#include "data/zero_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <boost/math/tools/minima.hpp>

namespace contensou::portraits {

using Eigen::Vector2d;

namespace {

/// Returns the place between two corners of a square at which a function is 0: it changes its sign there, or touches 0
/// as v^2 does. Empty if the function stays away from 0, and at a pole.
/// @param values  at four points in one line; the middle two are the corners. At the border an outer point is missing:
///                its value repeats that of the corner
std::optional<Vector2d> zero_between(const reduction::FactorPiece& piece, const Vector2d& from, const Vector2d& to,
                                     const std::array<double, 4>& values) {
  std::array<double, 4> sizes{};
  std::ranges::transform(values, sizes.begin(), [](double value) { return std::abs(value); });
  const bool crosses = (values[1] < 0) != (values[2] < 0), turns = sizes[0] > sizes[1] && sizes[2] < sizes[3];
  if (!(crosses || turns) || !(sizes[1] + sizes[2] < INFINITY)) return std::nullopt;
  constexpr int bits = 26;
  const auto place = [&](double s) { return Vector2d(from + s * (to - from)); };
  const auto [nearest, least] =
      boost::math::tools::brent_find_minima([&](double s) { return std::abs(piece.value(place(s))); }, 0.0, 1.0, bits);
  constexpr double rounding = 1e-6;  // also of a V that was fitted to differences
  return least <= rounding * std::max(sizes[1], sizes[2]) ? std::optional(place(nearest)) : std::nullopt;
}

}  // namespace

std::vector<Polyline> zero_lines(const reduction::FactorPiece& piece, const Vector2d& sides) {
  constexpr double across = 160;
  const Vector2d extent = piece.high - piece.low;
  const int columns = std::max(2, static_cast<int>(std::lround(across * extent[0] / sides[0])));
  const int rows = std::max(2, static_cast<int>(std::lround(across * extent[1] / sides[1])));
  // The grid is shifted, because axes and lines of round numbers would otherwise run along sides of squares.
  const auto part = [](int i, int count) { return i == 0 ? 0 : i == count ? 1 : (i - 0.363) / count; };
  const auto corner = [&](int i, int j) {
    return Vector2d(piece.low + Vector2d(part(i, columns), part(j, rows)).cwiseProduct(extent));
  };
  std::vector<double> values;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) values.push_back(piece.value(corner(i, j)));
  }
  const auto value = [&](int i, int j) -> double& {
    return values[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(i)];
  };
  // On a border at which the function is 0, rounding decides the sign. The value gets the sign opposite to that inside.
  constexpr double rounding = 1e-12;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double inside = value(std::clamp(i, 1, columns - 1), std::clamp(j, 1, rows - 1));
      double& here = value(i, j);
      if (std::abs(here) < rounding * std::abs(inside)) here = -rounding * inside;
    }
  }

  // Maps a side of a square (first corner; true: upwards) to the zero on the side and to the sides joined with it.
  using Side = std::pair<std::pair<int, int>, bool>;
  struct Crossing {
    Vector2d at;
    std::vector<Side> joined;
  };
  std::map<Side, Crossing> crossings;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      for (const bool up : {false, true}) {
        const int k = up ? i : i + 1, l = up ? j + 1 : j;
        if (k > columns || l > rows) continue;
        const double before = up ? value(i, std::max(j - 1, 0)) : value(std::max(i - 1, 0), j);
        const double after = up ? value(k, std::min(l + 1, rows)) : value(std::min(k + 1, columns), l);
        const auto zero = zero_between(piece, corner(i, j), corner(k, l), {before, value(i, j), value(k, l), after});
        if (zero) crossings[{{i, j}, up}] = {*zero, {}};
      }
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      std::vector<Side> crossed;
      for (const Side& side :
           {Side{{i, j}, false}, Side{{i + 1, j}, true}, Side{{i, j + 1}, false}, Side{{i, j}, true}}) {
        if (crossings.contains(side)) crossed.push_back(side);
      }
      // Sides are ordered counter-clockwise. If four sides are crossed, opposite crossings lie on one curve.
      const std::size_t lines = crossed.size() / 2;
      for (std::size_t k = 0; k < lines; ++k) {
        crossings[crossed[k]].joined.push_back(crossed[k + lines]);
        crossings[crossed[k + lines]].joined.push_back(crossed[k]);
      }
    }
  }
  std::vector<Polyline> lines;
  const auto follow = [&](Side side) {
    Polyline line;
    for (;;) {
      Crossing& here = crossings[side];
      line.push_back({here.at[0], here.at[1]});
      if (here.joined.empty()) break;
      const Side next = here.joined.back();
      here.joined.pop_back();
      std::erase(crossings[next].joined, side);
      side = next;
    }
    // Rounding produces dots where the function touches 0 without a change of sign. Such short lines are left out.
    const double length = std::abs(line.front().x - line[line.size() / 2].x) / sides[0] +
                          std::abs(line.front().y - line[line.size() / 2].y) / sides[1];
    if (length * across > 1) lines.push_back(std::move(line));
  };
  // Follow first the lines that have ends, then closed curves from any of their points.
  for (const std::size_t ways : {std::size_t{1}, std::size_t{2}}) {
    for (auto& [side, crossing] : crossings) {
      if (crossing.joined.size() == ways) follow(side);
    }
  }
  return lines;
}

}  // namespace contensou::portraits
