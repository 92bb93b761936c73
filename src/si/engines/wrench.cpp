#include "contensou/si/wrench.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>

#include <fmt/format.h>

#include "contensou/reduction/detail/tangent.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/wrench.h"

namespace contensou::si {

namespace {

/// Returns a description of the first wrong number; null if there is none.
const char* fault_of(const Eigen::Vector3d& motion, const Patch& patch) {
  if (!(patch.friction >= 0)) return "friction must be >= 0";
  if (!(patch.radius >= 0)) return "the patch radius must be >= 0";
  return motion.allFinite() ? nullptr : "speeds must be finite";
}

const char* fault_of_creep(double load, const Patch& patch) {
  if (!(patch.creep >= std::numeric_limits<double>::min())) return "the creep speed must be positive";
  const double stiffness = patch.friction * load / patch.creep;
  const bool bounded = std::isfinite(stiffness) && std::isfinite(stiffness * patch.radius * patch.radius);
  return bounded ? nullptr : "f N/s and f N eps^2/s must be finite";
}

}  // namespace

PatchFriction::PatchFriction(const reduction::Law& law) {
  const auto take = [this]<class Sloped>(const Sloped& sloped) {
    wrench_ = [sloped](double vx, double vy, double w, double limit, double radius, double creep) {
      return kernel::wrench_slopes<Sloped>(vx, vy, w, limit, radius, creep, sloped);
    };
    step_ = [sloped](double vx, double vy, double w, double by_force, double by_moment, double limit, double radius,
                     double dt) {
      return kernel::step<Sloped>(vx, vy, w, by_force, by_moment, limit, radius, dt, sloped);
    };
  };
  std::visit(take, reduction::with_slopes(law));
}

const char* PatchFriction::evaluate(const Eigen::Vector3d& motion, double load, const Patch& patch,
                                    Wrench& wrench) const {
  wrench = {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  if (const char* fault = fault_of(motion, patch)) return fault;
  if (const char* fault = fault_of_creep(load, patch)) return fault;
  const auto found = wrench_(motion.x(), motion.y(), motion.z(), patch.friction * load, patch.radius, patch.creep);
  const Eigen::Vector3d value(found.fx, found.fy, found.m);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> jacobian(found.slopes[0]);
  if (!value.allFinite() || !jacobian.allFinite()) return "force, moment and their slopes must be finite";
  wrench = {value, jacobian};
  return nullptr;
}

const char* PatchFriction::step(const Eigen::Vector3d& motion, const Eigen::Vector2d& mobility, double load,
                                const Patch& patch, double dt, kernel::Step<double>& after) const {
  after = {};
  if (const char* fault = fault_of(motion, patch)) return fault;
  if (!(mobility.x() >= 0 && mobility.y() >= 0)) return "by_force and by_moment must be >= 0";
  if (!(dt >= 0)) return "the time step must be >= 0";
  if (!std::isfinite(patch.friction * load) || !std::isfinite(dt)) return "f N and the time step must be finite";
  const auto found =
      step_(motion.x(), motion.y(), motion.z(), mobility.x(), mobility.y(), patch.friction * load, patch.radius, dt);
  if (!Eigen::Map<const Eigen::Array<double, 6, 1>>(&found.vx).allFinite())
    return "f N dt and the results must be finite";
  after = found;
  return nullptr;
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

int contensou_patch_step(const contensou_law* law, const double motion[3], const double mobility[2], double load,
                         const contensou_patch* patch, double dt, contensou_step* after) {
  if (after == nullptr) return 1;
  *after = {};
  if (law == nullptr || motion == nullptr || mobility == nullptr || patch == nullptr) return 1;
  try {
    contensou::kernel::Step<double> found;
    if (law->friction.step({motion[0], motion[1], motion[2]}, {mobility[0], mobility[1]}, load,
                           {patch->friction, patch->radius, patch->creep}, dt, found) != nullptr) {
      return 1;
    }
    *after = {{found.vx, found.vy, found.w}, {found.fx, found.fy}, found.m};
    return 0;
  } catch (...) {
    return 1;
  }
}
