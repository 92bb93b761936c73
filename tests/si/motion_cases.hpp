#pragma once

#include <array>

#include "contensou/si/experiment.hpp"

/// Starts of every kind, for a ball of radius 0.03 m.
struct MotionCase {
  const char* name;
  contensou::si::Velocities start;
};

inline const std::array motion_cases{
    MotionCase{"slip with sidespin", {{1, 0}, {0, 0, 30}}},
    MotionCase{"masse: slip across the velocity", {{1, 0}, {40, 1 / 0.03, -50}}},
    MotionCase{"masse, any direction", {{1, 0.3}, {20, -50, 100}}},
    MotionCase{"backspin that brings the ball back", {{0.5, 0}, {0, -200, 10}}},
    MotionCase{"topspin faster than rolling", {{0, 1}, {-100, 0, -40}}},
    MotionCase{"pure spin", {{0, 0}, {0, 0, 70}}},
    MotionCase{"no spin", {{1, 2}, {10, 0, 0}}},
    MotionCase{"rolling with spin", {{0.3, 0}, {0, 10, 3}}},
    MotionCase{"rolling", {{0.3, 0}, {0, 10, 0}}},
    MotionCase{"hardly any slip", {{1e-3, 0}, {0, 0, 100}}},
    MotionCase{"hardly any spin", {{1, 0}, {0, 0, -1e-3}}},
};

inline contensou::si::Experiment experiment_of(const MotionCase& motion_case, double patch_ratio) {
  return {.ball = {.name = "ball", .mass = 0.17, .radius = 0.03},
          .contact = {.friction = 0.2, .patch = contensou::si::PatchRadius{patch_ratio * 0.03}},
          .start = motion_case.start};
}
