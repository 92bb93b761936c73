#include "contensou/si/engine.hpp"

#include <algorithm>
#include <numbers>

namespace contensou::si {

namespace {

// Values that several engines share.
double friction_of(const EngineContact& contact) { return contact.friction; }
double arm_of(const EngineContact& contact) { return contact.moment_arm(); }
double diameter_of(const EngineContact& contact) { return 2 * contact.patch_radius; }
double no_arm(const EngineContact& /*any*/) { return 0; }
double five_millimetres(const EngineContact& /*any*/) {
  return 0.005;
}  ///< the default of MuJoCo and of those who follow it

constexpr std::string_view arm_formula = "f a Psi(0)";

Engine mujoco() {
  return {
      .name = "mujoco",
      .title = "MuJoCo",
      .repository = "google-deepmind/mujoco",
      .version = "commit a725507 (after 3.12.0)",
      .parameters = {{"friction[0]", "", "f", friction_of}, {"friction[1]", "m", arm_formula, arm_of}},
      .limit = "M <= friction[1] N",
      .combination = "the larger of the two geoms, number by number: set both; a geom of higher priority counts alone",
      .needs = {"condim=\"4\" (or 6): with 3, the default, there is no moment",
                "<option cone=\"elliptic\"/>: \"pyramidal\" is the default"},
      .settings = {{"cone elliptic", Cone::elliptic, arm_of},
                   {"cone pyramidal (default)", Cone::pyramid, arm_of},
                   {"cone elliptic, friction[1] 0.005 (default)", Cone::elliptic, five_millimetres},
                   {"cone elliptic, friction[1] the diameter", Cone::elliptic, diameter_of},
                   {"condim 3 (default)", Cone::box, no_arm}},
      .remarks = {"The manual calls friction[1] the diameter of the contact patch; f and Psi(0) are missing in that.",
                  "Under the pyramidal cone a ball that slides and spins never rolls before its spin ends: its slip\n"
                  "stays at (friction[1]/f) omega. Shown for a slip along a tangent axis; across, friction is weaker.",
                  "Of friction[0] the larger counts, too: a plane with its default of 1 has friction 1.",
                  "Either cone also lifts what slides: on a stiff contact the ball hops, and the slip of a pool ball\n"
                  "ends 9 % later than here."},
      .sources = {"doc/computation/index.rst:965-968", "doc/computation/index.rst:984-999", "doc/XMLreference.rst:400",
                  "doc/XMLreference.rst:2703", "src/engine/engine_collision_driver.c:1766-1829",
                  "src/engine/engine_core_constraint.c:2228-2232", "src/engine/engine_util_misc.c:1584-1601"},
  };
}

Engine newton() {
  return {
      .name = "newton",
      .title = "Newton",
      .repository = "newton-physics/newton",
      .version = "commit 41a5392",
      .parameters = {{"mu", "", "f", friction_of}, {"mu_torsional", "m", arm_formula, arm_of}},
      .limit = "M <= mu_torsional N",
      .combination = "SolverXPBD the mean of the two shapes, SolverMuJoCo the larger: give both shapes the same",
      .needs = {"SolverMuJoCo(cone=\"elliptic\"): \"pyramidal\" is the default"},
      .settings = {{"SolverMuJoCo, cone elliptic", Cone::elliptic, arm_of},
                   {"SolverMuJoCo, cone pyramidal (default)", Cone::pyramid, arm_of},
                   {"SolverXPBD", Cone::box, arm_of},
                   {"SolverXPBD, mu_torsional 0.005 (default)", Cone::box, five_millimetres}},
      .remarks = {"The other solvers do not read mu_torsional."},
      .sources = {"newton/_src/sim/builder.py:519", "newton/_src/solvers/xpbd/kernels.py:2261-2279",
                  "newton/_src/solvers/xpbd/kernels.py:2353-2376", "newton/_src/solvers/mujoco/kernels.py:2484-2488",
                  "newton/_src/solvers/mujoco/solver_mujoco.py:5423-5424"},
  };
}

Engine genesis() {
  return {
      .name = "genesis",
      .title = "Genesis",
      .repository = "Genesis-Embodied-AI/genesis-world",
      .version = "commit 29d7ade, pull requests 3028 and 3069",
      .parameters = {{"friction", "", "f", friction_of}, {"friction_torsional", "m", arm_formula, arm_of}},
      .limit = "M <= friction_torsional N",
      .combination = "the larger of the two materials, number by number: set both",
      .needs = {"RigidOptions(enable_torsional_friction=True)",
                "RigidOptions(friction_cone=gs.friction_cone.elliptic): pyramidal is the default"},
      .settings = {{"friction_cone elliptic", Cone::elliptic, arm_of},
                   {"friction_cone pyramidal (default)", Cone::pyramid, arm_of},
                   {"friction_cone elliptic, 0.005 (default)", Cone::elliptic, five_millimetres},
                   {"enable_torsional_friction=False (default)", Cone::box, no_arm}},
      .remarks =
          {"Its documentation calls the number the effective radius of the contact patch; f and Psi(0) are missing\n"
           "in that."},
      .sources = {"genesis/engine/materials/rigid.py:35-39"},
  };
}

Engine physx() {
  return {
      .name = "physx",
      .title = "PhysX",
      .repository = "NVIDIA-Omniverse/PhysX",
      .version = "5.6.1 (commit a3d8a64)",
      .parameters = {{"dynamicFriction", "", "f", friction_of},
                     {"minTorsionalPatchRadius", "m", "a Psi(0)",
                      [](const EngineContact& contact) { return contact.patch_radius * contact.pivoting_moment; }}},
      .limit = "M <= f N max(minTorsionalPatchRadius, sqrt(penetration torsionalPatchRadius))",
      .combination = "the larger of the two shapes",
      .needs = {"solverType eTGS: under ePGS, the default, the numbers are ignored",
                "a contact with a single anchor point, as a ball has"},
      .settings = {{"eTGS", Cone::box, arm_of},
                   {"eTGS, minTorsionalPatchRadius = a", Cone::box,
                    [](const EngineContact& contact) { return contact.friction * contact.patch_radius; }},
                   {"eTGS, torsionalPatchRadius alone", Cone::box, no_arm},
                   {"ePGS (default)", Cone::box, no_arm}},
      .remarks =
          {"Neither number is the radius of the patch: Psi(0) is missing in the first, and the second is multiplied\n"
           "by the penetration, which is near 0, under a root: it is a radius of curvature."},
      .sources = {"physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:779-810",
                  "physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:3136-3168",
                  "physx/source/simulationcontroller/src/ScShapeInteraction.cpp:1063-1064",
                  "physx/include/PxShape.h:470-512", "physx/include/PxSceneDesc.h:1044"},
  };
}

Engine bullet() {
  return {
      .name = "bullet",
      .title = "Bullet",
      .repository = "bulletphysics/bullet3",
      .version = "commit 6c888f4 (after 3.25)",
      .parameters = {{"setFriction of the ball", "", "f", friction_of},
                     {"setFriction of the plane", "", "1", [](const EngineContact& /*any*/) { return 1.0; }},
                     {"setSpinningFriction of the ball", "m", arm_formula, arm_of}},
      .limit = "M <= s N with s = sA fB + sB fA; and the impulse of M is at most the number s in each step",
      .combination = "friction f = fA fB, spinning friction s = sA fB + sB fA: the plane has 1 and 0",
      .needs = {"setRollingFriction above 0, however small: without it spinning friction is ignored"},
      .settings = {{"rolling friction > 0", Cone::box, arm_of}, {"rolling friction 0 (default)", Cone::box, no_arm}},
      .remarks =
          {"The cap bites where the load times the time step exceeds 1 N s: a heavy body spins on.",
           "btMultiBody needs no rolling friction and has no cap, but solverMode SOLVER_USE_2_FRICTION_DIRECTIONS."},
      .sources = {"src/BulletCollision/CollisionDispatch/btManifoldResult.cpp:43-60",
                  "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp:1058-1061",
                  "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp:1679-1687",
                  "src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp:78-102",
                  "src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp:1339-1344"},
  };
}

Engine chrono() {
  return {
      .name = "chrono",
      .title = "Chrono (NSC)",
      .repository = "projectchrono/chrono",
      .version = "commit 7689fbc",
      .parameters = {{"SetFriction", "", "f", friction_of}, {"SetSpinningFriction", "m", arm_formula, arm_of}},
      .limit = "M <= spinning_friction N",
      .combination = "the smaller of the two materials: set both",
      .needs = {"ChSystemNSC with ChContactMaterialNSC"},
      .settings = {{"on both materials", Cone::box, arm_of}, {"on one material only", Cone::box, no_arm}},
      .remarks = {"ChSystemSMC: spinning_friction has no effect. Chrono::DEM: SetSpinningCoeff_* have none.",
                  "Chrono::Multicore SMC: M <= spinning_friction r_c N with r_c from the overlap: f a Psi(0)/r_c."},
      .sources = {"src/chrono/solver/ChConstraintRollingNormal.cpp:56-89", "src/chrono/physics/ChContactMaterial.h:161",
                  "src/chrono/physics/ChContactMaterialNSC.cpp:96-111",
                  "src/chrono/physics/ChContactMaterialSMC.cpp:120",
                  "src/chrono_multicore/solver/ChIterativeSolverMulticoreSMC.cpp:387-404",
                  "src/chrono_dem/gpu/ChDemHelpers.cuh:198-241"},
  };
}

Engine ode() {
  return {
      .name = "ode",
      .title = "ODE",
      .repository = "thomasmarsh/ODE",
      .version = "commit bcfb66c",
      .parameters = {{"surface.mu", "", "f", friction_of}, {"surface.rhoN", "m", arm_formula, arm_of}},
      .limit = "M <= rhoN N",
      .combination = "none: the program that uses it fills in dSurfaceParameters for each contact",
      .needs = {"mode dContactRolling | dContactAxisDep: else rho is taken for rhoN",
                "mode dContactApprox1 (1_1, 1_2 and 1_N): else mu is in N and rhoN in N m, whatever the load",
                "with dContactAxisDep also mu2 = mu, rho = rho2 = 0"},
      .settings = {{"with these flags", Cone::box, arm_of}, {"without dContactRolling", Cone::box, no_arm}},
      .remarks = {},
      .sources = {"ode/src/joints/contact.cpp:299-344", "include/ode/contact.h:34-51"},
  };
}

Engine gazebo() {
  return {
      .name = "gazebo",
      .title = "Gazebo classic (its ODE)",
      .repository = "gazebosim/gazebo-classic",
      .version = "commit be2dc76",
      .parameters = {{"<mu>, <mu2>", "", "f", friction_of},
                     {"<torsional><coefficient>", "", "f", friction_of},
                     {"<torsional><patch_radius>", "m", "16 Psi(0) a/(3 pi)",
                      [](const EngineContact& contact) {
                        return contact.patch_radius * contact.pivoting_moment * 16 / (3 * std::numbers::pi);
                      }}},
      .limit = "M <= (3 pi/16) coefficient patch_radius N",
      .combination = "the smaller of the two coefficients, the larger of the two patch radii: set both",
      .needs = {"<use_patch_radius>true</use_patch_radius> in both surfaces"},
      .settings = {{"use_patch_radius", Cone::box, arm_of}, {"patch_radius 0 (default)", Cone::box, no_arm}},
      .remarks = {"Its formula is that of Hertz's pressure: patch_radius is the radius of the patch."},
      .sources = {"deps/opende/src/joints/contact.cpp (getInfo2, dContactMu3)",
                  "gazebo/physics/ode/ODEPhysics.cc (ODEPhysics::Collide)"},
  };
}

Engine edyn() {
  return {
      .name = "edyn",
      .title = "edyn",
      .repository = "xissburg/edyn",
      .version = "commit 42d2ec2 (after 1.3.1)",
      .parameters = {{"material.friction", "", "f", friction_of}, {"material.spin_friction", "m", arm_formula, arm_of}},
      .limit = "M <= spin_friction N",
      .combination = "friction the geometric mean of the two materials, spin_friction the larger: set both",
      .needs = {},
      .settings = {{"spin_friction", Cone::box, arm_of}, {"spin_friction 0 (default)", Cone::box, no_arm}},
      .remarks = {},
      .sources = {"src/edyn/constraints/constraint_row_spin_friction.cpp:5-28",
                  "include/edyn/dynamics/material_mixing.hpp:16-22", "include/edyn/comp/material.hpp:18"},
  };
}

Engine pooltool() {
  return {
      .name = "pooltool",
      .title = "pooltool",
      .repository = "ekiefl/pooltool",
      .version = "commit 9a8abfe (after 0.6.0)",
      .parameters = {{"u_s", "", "f", friction_of},
                     {"u_sp_proportionality", "1/m", "f a Psi(0)/R^2",
                      [](const EngineContact& contact) {
                        return contact.moment_arm() / contact.radius / contact.radius;
                      }}},
      .limit = "M = u_sp R N with u_sp = u_sp_proportionality R",
      .combination = "none: the table has no numbers of its own",
      .needs = {},
      .settings = {{"u_sp_proportionality", Cone::box, arm_of},
                   {"u_sp_proportionality 0.444 (default)", Cone::box,
                    [](const EngineContact& contact) { return 10 * 2.0 / 5 / 9 * contact.radius * contact.radius; }}},
      .remarks = {"The default is written 10 * 2 / 5 / 9: a spin deceleration of 10 rad/s^2, with 9 in place of g and\n"
                  "without R; what acts is 10.9 rad/s^2."},
      .sources = {"pooltool/objects/ball/params.py:77", "pooltool/objects/ball/params.py:102",
                  "pooltool/physics/evolve/__init__.py:113-123", "pooltool/physics/evolve/__init__.py:170",
                  "pooltool/physics/utils.py:77", "pooltool/physics/utils.py:95"},
  };
}

Engine tailuge() {
  constexpr double rolling = 0.0055;  // its mu
  return {
      .name = "tailuge",
      .title = "tailuge/billiards",
      .repository = "tailuge/billiards",
      .version = "commit c1f18f1",
      .parameters = {{"muS", "", "f", friction_of},
                     {"rho", "m", "3 f a Psi(0)/(2 mu), mu = 0.0055",
                      [](const EngineContact& contact) { return 1.5 * contact.moment_arm() / rolling; }}},
      .limit = "M = (2/3) mu rho N with its rolling friction mu = 0.0055",
      .combination = "none: the table has no numbers of its own",
      .needs = {},
      .settings = {{"rho", Cone::box, arm_of},
                   {"rho 0.045 m (default)", Cone::box,
                    [](const EngineContact& /*any*/) { return 2.0 / 3 * rolling * 0.045; }}},
      .remarks = {"rho is not the radius of the patch: the moment is made of the rolling friction.",
                  "Once the ball rolls no more, its spin above 24 rad/s falls 12 times as fast."},
      .sources = {"src/model/physics/constants.ts:1-3", "src/model/physics/constants.ts:45",
                  "src/model/physics/physics.ts:18-22", "src/model/physics/physics.ts:32-38"},
  };
}

Engine drake() {
  return {
      .name = "drake",
      .title = "Drake",
      .repository = "RobotLocomotion/drake",
      .version = "commit be259df (after 1.56.0)",
      .parameters = {},
      .limit = "point contact: none; hydroelastic contact: none of its own, the moment is that of the pressure",
      .combination = "of friction only",
      .needs = {"hydroelastic contact, for any moment at all"},
      .settings = {{"point contact", Cone::box, no_arm}},
      .remarks =
          {"A compliant ball on a rigid half-space has the pressure 1 - rho^2 over its overlap: --law paraboloid.",
           "A torsional friction in a MuJoCo file is ignored, with a warning."},
      .sources = {"multibody/plant/contact_model_doxygen.h:209-211",
                  "multibody/parsing/detail_mujoco_parser.cc:958-971"},
  };
}

}  // namespace

EngineContact contact_of(const Experiment& experiment, const reduction::Law& law) {
  return {.friction = experiment.contact.friction,
          .patch_radius = patch_radius_of(experiment, law),
          .pivoting_moment = law.pivoting_moment(),
          .radius = experiment.ball.radius};
}

const std::vector<Engine>& engines() {
  static const std::vector<Engine> entries{mujoco(), newton(), genesis(), physx(),    bullet(),  chrono(),
                                           ode(),    gazebo(), edyn(),    pooltool(), tailuge(), drake()};
  return entries;
}

const Engine* find_engine(std::string_view name) {
  const auto found = std::ranges::find(engines(), name, &Engine::name);
  return found == engines().end() ? nullptr : &*found;
}

}  // namespace contensou::si
