#include "contensou/si/wrench.hpp"
#include "contensou/reduction/detail/infinity.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <string>

#include <catch2/catch.hpp>

#include "allocations.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/wrench.h"

using namespace contensou;
using namespace contensou::si;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr Patch patch{0.2, 3e-3, 1e-4};
constexpr double normal_force = 1.7;
constexpr double limit = patch.friction * normal_force;

/// Returns motions in every direction, with every k and every size compared with the creep speed.
std::vector<Vector3d> motions() {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> ln_speed(std::log(1e-7), std::log(10)), angle(0, 6.3);
  std::vector<Vector3d> all{{0, 0, 0}, {1, 0, 0}, {0, 0, 5}, {1e-3, -1e-3, 0}};
  while (all.size() < 200) {
    const double v = std::exp(ln_speed(generator)), w = std::exp(ln_speed(generator)), turn = angle(generator);
    all.emplace_back(v * std::cos(turn), v * std::sin(turn), (turn > 2 ? w : -w) / patch.radius);
  }
  return all;
}

/// Does one Newton step of an implicit time step, for a body with the given inverse masses.
Vector3d stepped(const PatchFriction& friction, const Vector3d& motion, double weight, const Patch& of,
                 const Vector3d& per_mass, double dt, const Vector3d& pushed = Vector3d::Zero()) {
  const auto [value, jacobian] = friction(motion, weight, of);
  const Matrix3d mobility = dt * per_mass.asDiagonal().toDenseMatrix();
  return motion + (Matrix3d::Identity() - mobility * jacobian).inverse() * (mobility * (value + pushed));
}

}  // namespace

TEST_CASE("beside a small creep the wrench is that of the law", "[analytic]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    const PatchFriction friction(law);
    const auto [force, moment] = law({0.5, 0.3});
    const Vector3d value = friction({0.3, -0.4, -100}, normal_force, {0.2, 3e-3, 1e-9}).value;
    CAPTURE(law.name());
    CHECK(value.x() == Approx(-0.6 * limit * force).epsilon(1e-14));
    CHECK(value.y() == Approx(0.8 * limit * force).epsilon(1e-14));
    CHECK(value.z() == Approx(limit * 3e-3 * moment).epsilon(1e-14));
  }
}

TEST_CASE("friction takes power, within its bounds, and its Jacobian is its own", "[invariant]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    const PatchFriction friction(law);
    for (const Vector3d& motion : motions()) {
      const auto [value, jacobian] = friction(motion, normal_force, patch);
      CAPTURE(law.name(), motion.transpose());
      CHECK((value.dot(motion) < 0 || motion.isZero()));
      CHECK(value.head<2>().norm() <= limit * (1 + 1e-15));
      CHECK(std::abs(value.z()) <= limit * patch.radius * law.pivoting_moment() * (1 + 1e-15));

      // Units of the motion: V, the sliding speed with creep; for the rim, the larger one of V and the rim speed w.
      const double V = std::hypot(motion.x(), motion.y(), patch.creep), w = patch.radius * std::abs(motion.z());
      const Vector3d unit(V, V, std::max(V, w) / patch.radius);
      const Vector3d moment_arm(1, 1, patch.radius);
      const Matrix3d scaled = (moment_arm.cwiseInverse().asDiagonal() * jacobian * unit.asDiagonal()) / limit;
      CHECK(scaled.cwiseAbs().maxCoeff() < 4);
      if (std::abs(V / w - 1) < 0.1 || motion.isZero()) continue;  // laws with a kink
      for (int i = 0; i < 3; ++i) {
        if (law.name() == "pade" && i == 2 && w < 1e-4 * V) continue;  // the slope of Pade has a kink at omega = 0
        const double h = 1e-5;
        const Vector3d change = h * unit[i] * Vector3d::Unit(i);
        const Vector3d slope = (friction(motion + change, normal_force, patch).value -
                                friction(motion - change, normal_force, patch).value) /
                               (2 * h);
        CHECK((slope.cwiseQuotient(moment_arm) / limit - scaled.col(i)).norm() < 3e-8);
      }
    }
  }
}

TEST_CASE("the Jacobian of a law with a potential is symmetric and negative semidefinite", "[invariant]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    if (law.name() == "pade") continue;
    const PatchFriction friction(law);
    for (const Vector3d& motion : motions()) {
      const Vector3d arm(1, 1, 1 / patch.radius);  // factors that give all entries the same unit
      const Matrix3d jacobian = arm.asDiagonal() * friction(motion, normal_force, patch).jacobian * arm.asDiagonal();
      const double size = jacobian.norm();
      CAPTURE(law.name(), motion.transpose());
      CHECK((jacobian - jacobian.transpose()).norm() < 1e-9 * size);
      CHECK(Eigen::SelfAdjointEigenSolver<Matrix3d>(jacobian).eigenvalues().maxCoeff() < 1e-9 * size);
    }
  }
}

TEST_CASE("next to a kink the Jacobian is symmetric as far as differences are, and no larger than 5 f N/s", "[limit]") {
  const Vector3d arm(1, 1, 1 / patch.radius);
  for (const char* name : {"exact", "uniform", "punch", "ring", "pressure:-0.99", "annulus:0.999"}) {
    const PatchFriction friction(*reduction::find_law(name));
    double asymmetry = 0;
    double size = 0;
    for (double pivoting : {0.9, 1.0, 2.0, 10.0, 1e3}) {  // speed of the rim divided by the creep speed s
      for (double k = 0.2; k < 5; k *= std::abs(k - 1) < 0.01 ? 1.0001 : 1.01) {
        const double sliding = std::sqrt(std::max(0.0, std::pow(k * pivoting, 2) - 1));
        const Vector3d motion = patch.creep * Vector3d(sliding, 0, pivoting / patch.radius);
        const Matrix3d jacobian = arm.asDiagonal() * friction(motion, normal_force, patch).jacobian * arm.asDiagonal();
        asymmetry = std::max(asymmetry, (jacobian - jacobian.transpose()).norm() / jacobian.norm());
        size = std::max(size, jacobian.norm() * patch.creep / limit);
      }
    }
    CAPTURE(name, asymmetry, size);
    CHECK(asymmetry < 1e-6);
    CHECK(size < 5);
    if (name == std::string("exact") || name == std::string("uniform")) CHECK(asymmetry < 1e-15);
  }
}

TEST_CASE("at rest the patch is viscous", "[limit]") {
  const auto [value, jacobian] = PatchFriction(reduction::HertzLaw{})(Vector3d::Zero(), normal_force, patch);
  CHECK(value.isZero());
  const double stiffness = limit / patch.creep;
  const Matrix3d expected = -stiffness * Vector3d(1, 1, patch.radius * patch.radius / 5).asDiagonal().toDenseMatrix();
  CHECK((jacobian - expected).norm() < 1e-14 * stiffness);
}

TEST_CASE("what creeps under a load", "[analytic]") {
  const Vector3d per_mass(3, 3, 1e5);
  const auto settled = [&](const reduction::Law& law, const Vector3d& pushed) {
    const PatchFriction friction(law);
    Vector3d motion = Vector3d::Zero();
    for (int i = 0; i < 2000; ++i) motion = stepped(friction, motion, normal_force, patch, per_mass, 1e-4, pushed);
    return motion;
  };
  for (const reduction::Law& law : reduction::named_laws()) {
    CAPTURE(law.name());
    for (double share : {0.1, 0.5, 0.9}) {
      const Vector3d creep = settled(law, {-share * limit, 0, 0});
      CHECK(creep.x() == Approx(-patch.creep * share / std::sqrt(1 - share * share)).epsilon(1e-9));
      CHECK(creep.tail<2>().norm() == 0);
    }
    const Vector3d twist = settled(law, {0, 0, 0.4 * limit * patch.radius * law.pivoting_moment()});
    CHECK(law({patch.creep, patch.radius * twist.z()}).moment == Approx(0.4 * law.pivoting_moment()).epsilon(1e-9));
  }
  const double small = 1e-4;
  CHECK(settled(reduction::HertzLaw{}, {0, 0, small * limit * patch.radius}).z() * patch.radius ==
        Approx(5 * small * patch.creep).epsilon(1e-6));
}

TEST_CASE("time steps stop a pool ball when it stops", "[analytic]") {
  Experiment pool = find_ball("pool")->experiment;
  pool.start = SlipAndSpin{1, 100};
  const double m = pool.ball.mass, R = pool.ball.radius, dt = 1e-3;
  for (const char* name : {"exact", "elliptic", "pade"}) {
    const reduction::Law law = *reduction::find_law(name);
    const Motion exact = Motion::reduced(pool, law);
    const PatchFriction friction(law);
    const Patch of{pool.contact.friction, patch_radius_of(pool, law), 1e-4};
    // For a force on the contact point, a ball has the mass 2 m/7.
    const Vector3d per_mass(3.5 / m, 3.5 / m, 2.5 / (m * R * R));
    Vector3d motion(1, 0, 100);
    double slip_gone = 0, t = 0;
    while ((motion.head<2>().norm() > 1e-3 || motion.z() > 0.1) && t < 20) {
      motion = stepped(friction, motion, m * pool.environment.gravity, of, per_mass, dt);
      t += dt;
      if (motion.x() > 0.1) slip_gone = t;
    }
    CAPTURE(name);
    CHECK(t == Approx(exact.stop_time()).epsilon(0.01));
    CHECK(slip_gone == Approx(exact.slip_time(0.1)).epsilon(0.03));
    for (int i = 0; i < 1000; ++i) motion = stepped(friction, motion, m * pool.environment.gravity, of, per_mass, dt);
    CHECK(motion.head<2>().norm() + of.radius * std::abs(motion.z()) < 1e-9);
  }
}

TEST_CASE("an implicit step under any law is that of its friction", "[analytic]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    const PatchFriction friction(law);
    for (const Vector3d& motion : motions()) {
      kernel::Step<double> after;
      REQUIRE(friction.step(motion, {20, 2e6}, normal_force, patch, 0.01, after) == nullptr);
      const double size = std::max(std::hypot(after.vx, after.vy), patch.radius * std::abs(after.w));
      if (size == 0) continue;
      const Patch dry{patch.friction, patch.radius, 1e-14 * size};  // the law pade is linear in k at k = 0
      const Vector3d value = friction({after.vx, after.vy, after.w}, normal_force, dry).value;
      const double start = std::max(motion.head<2>().norm(), patch.radius * std::abs(motion.z()));
      CAPTURE(law.name(), motion.transpose());
      CHECK((value - Vector3d(after.fx, after.fy, value.z())).norm() <= 1e-12 * limit * std::max(1.0, start / size));
      CHECK(std::abs(value.z() - after.m) <= 1e-12 * limit * patch.radius * std::max(1.0, start / size));
    }
  }
}

TEST_CASE("no call allocates, of any law", "[limit]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    const PatchFriction friction(law);
    const std::vector<Vector3d> all = motions();
    friction(all.back(), normal_force, patch);
    const long before = allocations();
    double sum = 0;
    for (const Vector3d& motion : all) sum += friction(motion, normal_force, patch).value.z();
    for (const Vector3d& motion : all) {
      kernel::Step<double> step;
      CHECK(friction.step(motion, {20, 2e4}, normal_force, patch, 1e-3, step) == nullptr);
      sum += step.w;
    }
    const long after = allocations();
    CAPTURE(law.name());
    CHECK(after == before);
    CHECK(std::isfinite(sum));
  }
  const long before = allocations();
  ::operator delete(::operator new(8));
  CHECK(allocations() > before);
}

TEST_CASE("the C interface gives numbers or zeros, and throws nothing", "[limit]") {
  const std::unique_ptr<contensou_law, void (*)(contensou_law*)> law(contensou_law_new("exact"), contensou_law_free);
  REQUIRE(law);
  constexpr double nan = NAN;
  contensou_wrench wrench;
  const auto call = [&](const Vector3d& motion, double weight, const contensou_patch& of) {
    wrench = {{nan, nan}, nan, {{nan, nan, nan}, {nan, nan, nan}, {nan, nan, nan}}};
    return contensou_patch_wrench(law.get(), motion.data(), weight, &of, &wrench);
  };
  const auto numbers = [&] { return Eigen::Map<const Eigen::Array<double, 12, 1>>(wrench.force); };
  const contensou_patch good{0.2, 3e-3, 1e-4};
  for (const double v : {0.0, 1e-300, 1e-4, 1.0, 1e300}) {
    for (const double omega : {0.0, 1e-300, -1.0, 1e300}) {
      CAPTURE(v, omega);
      CHECK(call({v, -v, omega}, normal_force, good) == 0);
      CHECK(numbers().allFinite());
      CHECK(std::hypot(wrench.force[0], wrench.force[1]) <= limit * (1 + 1e-15));
      const Wrench same = PatchFriction(reduction::HertzLaw{})({v, -v, omega}, normal_force, patch);
      CHECK(wrench.moment == same.value.z());
      CHECK(wrench.jacobian[0][2] == same.jacobian(0, 2));
      CHECK(wrench.jacobian[1][0] == same.jacobian(1, 0));
    }
  }
  for (const auto& [motion, of] :
       {std::pair{Vector3d(1.7e308, 1.7e308, 0), good}, {Vector3d(0, 0, -1e308), contensou_patch{0.2, 100, 1e-4}}}) {
    CHECK(call(motion, normal_force, of) == 0);
    CHECK(std::hypot(wrench.force[0], wrench.force[1]) == Approx(motion.x() > 0 ? limit : 0).epsilon(1e-15));
    CHECK(wrench.moment == Approx(motion.x() > 0 ? 0 : 100 * limit * 3 * EIGEN_PI / 16).epsilon(1e-15));
  }
  for (const auto& [weight, of] :
       {std::pair{0.0, good}, {-1.0, good}, {normal_force, contensou_patch{0, 3e-3, 1e-4}}}) {
    CHECK(call({1, 1, 1}, weight, of) == 0);
    CHECK((numbers() == 0).all());
  }
  CHECK(call({1, 1, 1}, normal_force, {0.2, 0, 1e-4}) == 0);
  CHECK(wrench.moment == 0);
  const auto refused = [&](const Vector3d& motion, double weight, const contensou_patch& of) {
    CHECK(call(motion, weight, of) == 1);
    CHECK((numbers() == 0).all());
    CHECK_THROWS_AS(PatchFriction(reduction::HertzLaw{})(motion, weight, Patch{of.friction, of.radius, of.creep}),
                    std::domain_error);
  };
  for (const double bad : {nan, infinity, -infinity}) {
    refused({bad, 0, 0}, normal_force, good);
    refused({0, bad, 0}, normal_force, good);
    refused({0, 0, bad}, normal_force, good);
    refused({1, 0, 0}, bad, good);
    refused({1, 0, 0}, normal_force, {bad, 3e-3, 1e-4});
    refused({1, 0, 0}, normal_force, {0.2, bad, 1e-4});
  }
  refused({1, 0, 0}, normal_force, {0.2, 3e-3, 0});
  refused({1, 0, 0}, normal_force, {0.2, 3e-3, nan});
  refused({1, 0, 0}, normal_force, {0.2, -1, 1e-4});
  refused({1, 0, 0}, normal_force, {-0.2, 3e-3, 1e-4});
  refused({1, 0, 0}, 1e300, {0.2, 3e-3, 1e-20});
  refused({1, 1, 1}, 1, {0.3, 1e160, 1e160});  // the square of the radius overflows
  CHECK(contensou_patch_wrench(nullptr, Vector3d(1, 0, 0).data(), normal_force, &good, &wrench) == 1);
  CHECK(contensou_patch_wrench(law.get(), nullptr, normal_force, &good, &wrench) == 1);
  CHECK(contensou_patch_wrench(law.get(), Vector3d(1, 0, 0).data(), normal_force, nullptr, &wrench) == 1);
  CHECK(contensou_patch_wrench(law.get(), Vector3d(1, 0, 0).data(), normal_force, &good, nullptr) == 1);

  contensou_step after;
  const double mobility[2] = {20, 2e4};
  const auto step = [&](const Vector3d& motion, const double* of, double weight, const contensou_patch& on, double dt) {
    after = {{nan, nan, nan}, {nan, nan}, nan};
    return contensou_patch_step(law.get(), motion.data(), of, weight, &on, dt, &after);
  };
  const auto zeros = [&] { return (Eigen::Map<const Eigen::Array<double, 6, 1>>(after.motion) == 0).all(); };
  CHECK(step({1, -2, 300}, mobility, 1.7, {0.2, 3e-3, 0}, 0.01) == 0);
  const auto same = kernel::step<kernel::Exact>(1.0, -2.0, 300.0, 20.0, 2e4, 0.2 * 1.7, 3e-3, 0.01);
  CHECK((after.motion[0] == same.vx && after.motion[1] == same.vy && after.motion[2] == same.w));
  CHECK((after.force[0] == same.fx && after.force[1] == same.fy && after.moment == same.m));
  for (const double bad : {nan, infinity, -1.0}) {
    const double first[2] = {bad, 1}, second[2] = {1, bad};
    const int allowed = bad == -1 ? 0 : 1;  // a load below 0 is no contact
    CHECK((step({1, 0, 1}, first, 1, good, 0.01) == 1 && zeros()));
    CHECK((step({1, 0, 1}, second, 1, good, 0.01) == 1 && zeros()));
    CHECK((step({1, 0, 1}, mobility, bad, good, 0.01) == allowed && after.motion[0] == 1 - allowed));
    CHECK((step({1, 0, 1}, mobility, 1, good, bad) == 1 && zeros()));
    CHECK((step({1, 0, 1}, mobility, 1, {bad, 1, 1}, 0.01) == 1 && zeros()));
    CHECK((step({1, 0, 1}, mobility, 1, {1, bad, 1}, 0.01) == 1 && zeros()));
    if (bad != -1) CHECK((step({bad, 0, 1}, mobility, 1, good, 0.01) == 1 && zeros()));
  }
  CHECK(contensou_patch_step(law.get(), Vector3d(1, 0, 0).data(), nullptr, 1, &good, 1, &after) == 1);
  CHECK(contensou_patch_step(law.get(), Vector3d(1, 0, 0).data(), mobility, 1, &good, 1, nullptr) == 1);
  for (const char* name : {"exakt", "", "elliptic:x", "elliptic:7", static_cast<const char*>(nullptr)}) {
    CHECK(contensou_law_new(name) == nullptr);
  }
  contensou_law_free(contensou_law_new("elliptic:0.6"));
  contensou_law_free(nullptr);
}
