#pragma once

#include <array>
#include <string_view>

#include "contensou/si/whole_motion.hpp"

namespace contensou::program {

/// The two ways to the whole motion of a ball.
enum class RollRoute { reduced, integrated };

/// In the order of RollRoute.
inline constexpr std::array<std::string_view, 2> roll_route_names{"reduced", "integrated"};

std::string_view name_of(RollRoute route);

/// The motion by a route, at times in s.
si::MotionColumns roll_motion(const si::Shot& shot, const reduction::Law& law, RollRoute route,
                              const Eigen::ArrayXd& times);

/// Share of the initial slip below which a ball is said to roll: friction over a pivoting patch is viscous, so that
/// slip ends together with the spin only.
inline constexpr double rolling_share = 1e-3;

/// When the ball rolls, in s: the slip is below its rolling_share, or over where there is no spin.
double rolling_time(const si::Shot& shot, const si::WholeMotion& motion);

/// Where a series of instants ends unless the user says otherwise, in s: a little past the stop.
double standard_end(const si::Shot& shot, const reduction::Law& law);

}  // namespace contensou::program
