#include "contensou/si/wrench.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/wrench.h"

namespace contensou::si {

namespace {

/// Returns sqrt(x^2 + y^2 + z^2). std::hypot takes longer, and that of three numbers overflows in libc++ 16.
double length(double x, double y, double z) {
  const double square = x * x + y * y + z * z;
  return square > 1e-200 && square < 1e300 ? std::sqrt(square) : std::hypot(std::hypot(x, y), z);
}

/// Returns a description of a wrong number; null if there is none.
const char* fault_of(reduction::Slip slip, double load, const Patch& patch) {
  if (!(patch.friction >= 0)) return "friction must be >= 0";
  if (!(patch.radius >= 0)) return "the patch radius must be >= 0";
  if (!(patch.creep >= std::numeric_limits<double>::min())) return "the creep speed must be positive";
  if (!std::isfinite(slip.sliding) || !std::isfinite(slip.pivoting)) return "speeds must be finite";
  const double stiffness = patch.friction * load / patch.creep;
  const bool bounded = std::isfinite(stiffness) && std::isfinite(stiffness * patch.radius * patch.radius);
  return bounded ? nullptr : "f N/s and f N eps^2/s must be finite";
}

}  // namespace

const char* PatchFriction::evaluate(const Eigen::Vector3d& motion, double load, const Patch& patch,
                                    Wrench& wrench) const {
  wrench = {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  const reduction::Slip slip{length(motion.x(), motion.y(), patch.creep), patch.radius * std::abs(motion.z())};
  if (const char* fault = fault_of(slip, load, patch)) return fault;
  const double limit = patch.friction * load;
  if (!(limit > 0)) return nullptr;
  const auto [resistance, force_slope, moment_slope] = tangent_(slip);
  const Eigen::Vector2d along = motion.head<2>() / slip.sliding;
  const double arm = std::copysign(patch.radius, motion.z());
  wrench.value << -limit * resistance.force * along, -limit * arm * resistance.moment;

  const double inverse = 1 / std::max(slip.sliding, slip.pivoting);
  // Factor of either slope in a derivative by the sliding speed.
  const double by_sliding = slip.pivoting * inverse * inverse;
  const double by_pivoting = slip.sliding * inverse * inverse;
  const double across = resistance.force / slip.sliding;
  wrench.jacobian.topLeftCorner<2, 2>() =
      limit * ((across - force_slope * by_sliding) * along * along.transpose() - across * Eigen::Matrix2d::Identity());
  wrench.jacobian.topRightCorner<2, 1>() = limit * arm * force_slope * by_pivoting * along;
  wrench.jacobian.bottomLeftCorner<1, 2>() = limit * arm * moment_slope * by_sliding * along.transpose();
  wrench.jacobian(2, 2) = -limit * arm * arm * moment_slope * by_pivoting;
  if (wrench.value.allFinite() && wrench.jacobian.allFinite()) return nullptr;
  wrench = {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  return "force, moment and their slopes must be finite";
}

Wrench PatchFriction::operator()(const Eigen::Vector3d& motion, double load, const Patch& patch) const {
  Wrench wrench;
  const char* fault = evaluate(motion, load, patch, wrench);
  if (fault == nullptr) return wrench;
  throw std::domain_error(fmt::format(
      "PatchFriction: {}; got v = ({}, {}) m/s, omega = {} rad/s, N = {} N, f = {}, radius {} m, creep {} m/s", fault,
      motion.x(), motion.y(), motion.z(), load, patch.friction, patch.radius, patch.creep));
}

}  // namespace contensou::si

struct contensou_law {
  contensou::si::PatchFriction friction;
};

contensou_law* contensou_law_new(const char* name) {
  try {
    const auto law = contensou::reduction::find_law(name == nullptr ? "" : name);
    return law ? new contensou_law{contensou::si::PatchFriction(*law)} : nullptr;
  } catch (...) {
    return nullptr;
  }
}

void contensou_law_free(contensou_law* law) { delete law; }

int contensou_patch_wrench(const contensou_law* law, const double motion[3], double load, const contensou_patch* patch,
                           contensou_wrench* wrench) {
  if (wrench == nullptr) return 1;
  *wrench = {};
  if (law == nullptr || motion == nullptr || patch == nullptr) return 1;
  try {
    contensou::si::Wrench found;
    if (law->friction.evaluate({motion[0], motion[1], motion[2]}, load, {patch->friction, patch->radius, patch->creep},
                               found) != nullptr) {
      return 1;
    }
    Eigen::Map<Eigen::Vector2d>(wrench->force) = found.value.head<2>();
    wrench->moment = found.value.z();
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(wrench->jacobian[0]) = found.jacobian;
    return 0;
  } catch (...) {
    return 1;
  }
}
