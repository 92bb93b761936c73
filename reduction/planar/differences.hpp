#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "contensou/reduction/detail/infinity.hpp"
#include "numerics/epsilon.hpp"

namespace contensou::reduction {

struct Slope {
  Eigen::Vector2d value;
  double error;
};

/// Returns df/dx_i by central differences over halved steps, extrapolated to 0 (C. Ridders, Adv. Eng. Softw. 4 (1982)
/// 75). The result is the table entry that differs least from its neighbours; empty if the field has no value.
///
/// @param field  function of a point that returns an std::optional<Eigen::Vector2d>
template <class Field>
std::optional<Slope> slope(Field&& field, const Eigen::Vector2d& x, int i, double first_step) {
  constexpr int rows = 8;
  std::array<std::array<Eigen::Vector2d, rows>, rows> table;
  Slope best{Eigen::Vector2d::Zero(), infinity};
  double step = first_step;
  for (int row = 0; row < rows; ++row, step /= 2) {
    Eigen::Vector2d ahead = x, behind = x;
    ahead[i] += step;
    behind[i] -= step;
    const auto there = field(ahead), back = field(behind);
    if (!there || !back) return std::nullopt;
    table[row][0] = (*there - *back) / (ahead[i] - behind[i]);
    double power = 1;
    for (int column = 1; column <= row; ++column) {
      power *= 4;
      const Eigen::Vector2d &before = table[row - 1][column - 1], &beside = table[row][column - 1];
      table[row][column] = beside + (beside - before) / (power - 1);
      const double rounding = eps * (there->norm() + back->norm()) / step;
      const double error =
          std::max({(table[row][column] - beside).norm(), (table[row][column] - before).norm(), rounding});
      if (error < best.error) best = {table[row][column], error};
    }
  }
  if (!std::isfinite(best.error)) return std::nullopt;  // the error is not finite if its squares overflow
  return best;
}

}  // namespace contensou::reduction
