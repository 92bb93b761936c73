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

double spinning_radius_of(const EngineContact& contact) { return contact.patch_radius * contact.pivoting_moment; }
double rim_arm_of(const EngineContact& contact) { return contact.friction * contact.patch_radius; }

constexpr std::string_view twist_limit = "M <= f sum(distance of a contact point to their middle, times its load)";

/// Of an engine whose contact points lie on the rim of a cylinder: their distance from the middle decides the moment, so
/// the radius of the collision shape takes the place of a number for torsional friction.
/// @param friction  its name of f
/// @param cone      box for one row of twist, points for friction at each
EngineUse face_on_rim(std::string_view friction, Cone cone) {
  return {
      .parameters = {{friction, "", "f", friction_of}, {"radius of the shape", "m", "a Psi(0)", spinning_radius_of}},
      .limit = cone == Cone::box ? twist_limit : "at each contact point: friction <= f times its load",
      .needs = {"the body's own mass and inertia: those of a smaller shape are smaller"},
      .settings = {{"shape of radius a Psi(0)", cone, arm_of}, {"shape of its own radius", cone, rim_arm_of}}};
}

Engine mujoco() {
  return {
      .name = "mujoco",
      .title = "MuJoCo",
      .repository = "google-deepmind/mujoco",
      .version = "commit a725507 (after 3.12.0)",
      .ball = {.parameters = {{"friction[0]", "", "f", friction_of}, {"friction[1]", "m", arm_formula, arm_of}},
               .limit = "M <= friction[1] N",
               .needs = {"condim=\"4\" (or 6): with 3, the default, there is no moment",
                         "<option cone=\"elliptic\"/>: \"pyramidal\" is the default"},
               .settings = {{"cone elliptic", Cone::elliptic, arm_of},
                            {"cone pyramidal (default)", Cone::pyramid, arm_of},
                            {"cone elliptic, friction[1] 0.005 (default)", Cone::elliptic, five_millimetres},
                            {"cone elliptic, friction[1] the diameter", Cone::elliptic, diameter_of},
                            {"condim 3 (default)", Cone::box, no_arm}}},
      .face = face_on_rim("friction[0]", Cone::points),
      .combination = "the larger of the two geoms, number by number: set both; a geom of higher priority counts alone",
      .remarks =
          {"The manual calls friction[1] the diameter of the contact patch; f and Psi(0) are missing in that.",
           "Under the pyramidal cone a ball that slides and spins never rolls before its spin ends: its slip\n"
           "stays at (friction[1]/f) omega. Shown for a slip along a tangent axis; across, friction is weaker.",
           "Of friction[0] the larger counts, too: a plane with its default of 1 has friction 1.",
           "Either cone also lifts what slides: on a stiff contact the ball hops, and the slip of a pool ball\n"
           "ends 9 % later than here.",
           "A cylinder that lies on its face has three contact points on the rim, each with a moment of its own\n"
           "under condim 4: give it condim 3."},
      .sources = {"doc/computation/index.rst:965-968", "doc/computation/index.rst:984-999", "doc/XMLreference.rst:400",
                  "doc/XMLreference.rst:2703", "src/engine/engine_collision_driver.c:1766-1829",
                  "src/engine/engine_core_constraint.c:2228-2232", "src/engine/engine_util_misc.c:1584-1601",
                  "src/engine/engine_collision_primitive.c:101-204"},
  };
}

Engine newton() {
  return {
      .name = "newton",
      .title = "Newton",
      .repository = "newton-physics/newton",
      .version = "commit 41a5392",
      .ball =
          {.parameters = {{"mu", "", "f", friction_of}, {"mu_torsional", "m", arm_formula, arm_of}},
           .limit = "M <= mu_torsional N",
           .needs = {"SolverMuJoCo(cone=\"elliptic\"): \"pyramidal\" is the default",
                     "SolverMuJoCo: the shape's custom attribute mujoco:condim 4: with 3, the default, there is no\n"
                     "moment"},
           .settings = {{"SolverMuJoCo, cone elliptic", Cone::elliptic, arm_of},
                        {"SolverMuJoCo, cone pyramidal (default)", Cone::pyramid, arm_of},
                        {"SolverMuJoCo, condim 3 (default)", Cone::box, no_arm},
                        {"SolverXPBD", Cone::box, arm_of},
                        {"SolverXPBD, mu_torsional 0.005 (default)", Cone::box, five_millimetres}}},
      .face =
          [] {
            EngineUse face = face_on_rim("mu", Cone::points);
            face.needs.emplace_back(
                "SolverXPBD: mu_torsional 0: by default each contact point has 5 mm times its load on top");
            return face;
          }(),
      .combination = "SolverXPBD the mean of the two shapes, SolverMuJoCo the larger: give both shapes the same",
      .remarks =
          {"The other solvers do not read mu_torsional.",
           "mu_torsional is documented in m, for SolverXPBD and SolverMuJoCo alike.",
           "A cylinder on its face has three contact points on the rim, 120 degrees apart, which stay where they\n"
           "are in the world while it turns, and its deepest one where it is tilted."},
      .sources = {"newton/_src/sim/builder.py:519-520", "newton/_src/geometry/collision_primitive.py:535-645",
                  "newton/_src/solvers/xpbd/kernels.py:2308-2361", "newton/_src/solvers/mujoco/kernels.py:146-177",
                  "newton/_src/solvers/mujoco/solver_mujoco.py:855-865",
                  "newton/_src/solvers/xpbd/kernels.py:2261-2279", "newton/_src/solvers/xpbd/kernels.py:2353-2376",
                  "newton/_src/solvers/mujoco/kernels.py:2484-2488",
                  "newton/_src/solvers/mujoco/solver_mujoco.py:5423-5424"},
  };
}

Engine genesis() {
  return {
      .name = "genesis",
      .title = "Genesis",
      .repository = "Genesis-Embodied-AI/genesis-world",
      .version = "commits 3a9e32b (solver), 25ef489 (options), 29d7ade (materials), 7bf5f6a (contact points)",
      .ball =
          {.parameters = {{"friction", "", "f", friction_of}, {"friction_torsional", "m", arm_formula, arm_of}},
           .limit = "M <= friction_torsional N",
           .needs = {"RigidOptions(enable_torsional_friction=True)",
                     "RigidOptions(friction_cone=gs.friction_cone.elliptic): pyramidal is the default",
                     "RigidOptions(contact_resolution=gs.contact_resolution.convex): signorini is the default of the\n"
                     "elliptic cone"},
           .settings = {{"friction_cone elliptic, convex", Cone::elliptic, arm_of},
                        {"friction_cone elliptic, signorini (default)", Cone::box, arm_of},
                        {"friction_cone pyramidal (default)", Cone::pyramid, arm_of},
                        {"friction_cone elliptic, 0.005 (default)", Cone::box, five_millimetres},
                        {"enable_torsional_friction=False (default)", Cone::box, no_arm}}},
      .face = face_on_rim("friction", Cone::points),
      .combination = "the larger of the two materials, number by number: set both",
      .remarks =
          {"Its documentation calls the number the effective radius of the contact patch; f and Psi(0) are missing\n"
           "in that.",
           "Since pull request 3126 friction no longer lifts what slides; in return slip and spin are bounded each\n"
           "for itself and no longer know of each other. Before 3139 convex was called impedance.",
           "A cylinder on its face has up to five contact points on the rim: that of the pose, and of four that are\n"
           "tilted a little. Each would have a moment of its own: leave enable_torsional_friction off."},
      .sources = {"genesis/engine/materials/rigid.py:35-39",
                  "genesis/options/solvers.py (RigidOptions, contact_resolution)",
                  "genesis/engine/solvers/rigid/constraint/solver.py (_friction_blocks, _func_disc_middle)",
                  "genesis/engine/solvers/rigid/collider/narrowphase.py:546-556",
                  "genesis/engine/solvers/rigid/collider/narrowphase.py:606-628",
                  "genesis/engine/solvers/rigid/collider/narrowphase.py:868-937"},
  };
}

Engine physx() {
  return {
      .name = "physx",
      .title = "PhysX",
      .repository = "NVIDIA-Omniverse/PhysX",
      .version = "5.6.1 (commit a3d8a64)",
      .ball = {.parameters = {{"dynamicFriction", "", "f", friction_of},
                              {"minTorsionalPatchRadius", "m", "a Psi(0)",
                               [](const EngineContact& contact) {
                                 return contact.patch_radius * contact.pivoting_moment;
                               }}},
               .limit = "M <= f N max(minTorsionalPatchRadius, sqrt(penetration torsionalPatchRadius))",
               .needs = {"solverType eTGS: under ePGS, the default, the numbers are ignored",
                         "a contact with a single anchor point, as a ball has"},
               .settings = {{"eTGS", Cone::box, arm_of},
                            {"eTGS, minTorsionalPatchRadius = a", Cone::box,
                             [](const EngineContact& contact) { return contact.friction * contact.patch_radius; }},
                            {"eTGS, torsionalPatchRadius alone", Cone::box, no_arm},
                            {"ePGS (default)", Cone::box, no_arm}}},
      .face = face_on_rim("dynamicFriction", Cone::points),
      .combination = "the larger of the two shapes",
      .remarks =
          {"Neither number is the radius of the patch: Psi(0) is missing in the first, and the second is multiplied\n"
           "by the penetration, which is near 0, under a root: it is a radius of curvature.",
           "A face has two anchors, as far apart as its contact points are, each with half of the friction and\n"
           "neither with a moment of its own.",
           "Isaac Sim 4.1 gives each FixedCuboid and DynamicCuboid, however small, a minTorsionalPatchRadius of\n"
           "0.8 m: on a single anchor it stops at once (omni/isaac/core/objects/cuboid.py)."},
      .sources = {"physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:779-810",
                  "physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:3136-3168",
                  "physx/source/simulationcontroller/src/ScShapeInteraction.cpp:1063-1064",
                  "physx/include/PxShape.h:470-512", "physx/include/PxSceneDesc.h:1044",
                  "physx/source/lowleveldynamics/src/DyFrictionCorrelation.cpp:184-280",
                  "physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:679"},
  };
}

Engine bullet() {
  return {
      .name = "bullet",
      .title = "Bullet",
      .repository = "bulletphysics/bullet3",
      .version = "commit 6c888f4 (after 3.25)",
      .ball = {.parameters = {{"setFriction of the ball", "", "f", friction_of},
                              {"setFriction of the plane", "", "1", [](const EngineContact& /*any*/) { return 1.0; }},
                              {"setSpinningFriction of the ball", "m", arm_formula, arm_of}},
               .limit = "M <= s N with s = sA fB + sB fA; and the impulse of M is at most the number s in each step",
               .needs = {"setRollingFriction above 0, however small: without it spinning friction is ignored"},
               .settings = {{"rolling friction > 0", Cone::box, arm_of},
                            {"rolling friction 0 (default)", Cone::box, no_arm}}},
      .face =
          [] {
            EngineUse face = face_on_rim("setFriction of the body", Cone::points);
            face.needs.emplace_back("setFriction(1) of the plane: friction is the product");
            face.needs.emplace_back(
                "spinning friction 0, the default: each contact point would have a moment of its own");
            return face;
          }(),
      .combination = "friction f = fA fB, spinning friction s = sA fB + sB fA: the plane has 1 and 0",
      .remarks =
          {"The cap bites where the load times the time step exceeds 1 N s: a heavy body spins on.",
           "A btCylinderShape on a btStaticPlaneShape gets one contact point in a step, on its rim. It keeps four at\n"
           "most, each until it has moved by 2 % of the shape's size: of a puck that slides or turns by more in a\n"
           "step one is left, the load is on the rim, and it rocks. A box or hull gets several at once: what is said\n"
           "here of a face is of one that stands on points around it.",
           "Friction at a point acts along its own slip, in one row (SOLVER_USE_2_FRICTION_DIRECTIONS: two).",
           "btMultiBody needs no rolling friction and has no cap, but solverMode SOLVER_USE_2_FRICTION_DIRECTIONS."},
      .sources = {"src/BulletCollision/CollisionDispatch/btManifoldResult.cpp:43-60",
                  "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp:1058-1061",
                  "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp:1096-1105",
                  "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp:1656-1671",
                  "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp:1679-1687",
                  "src/BulletCollision/CollisionDispatch/btConvexPlaneCollisionAlgorithm.cpp:112-152",
                  "src/BulletCollision/CollisionDispatch/btCollisionDispatcher.cpp:74",
                  "src/BulletCollision/CollisionShapes/btCollisionShape.cpp:42-45",
                  "src/BulletCollision/NarrowPhaseCollision/btPersistentManifold.h:52",
                  "src/BulletCollision/NarrowPhaseCollision/btPersistentManifold.cpp:264-296",
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
      .ball = {.parameters = {{"SetFriction", "", "f", friction_of}, {"SetSpinningFriction", "m", arm_formula, arm_of}},
               .limit = "M <= spinning_friction N",
               .needs = {"ChSystemNSC with ChContactMaterialNSC"},
               .settings = {{"on both materials", Cone::box, arm_of}, {"on one material only", Cone::box, no_arm}}},
      .face = {},
      .combination = "the smaller of the two materials: set both",
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
      .ball = {.parameters = {{"surface.mu", "", "f", friction_of}, {"surface.rhoN", "m", arm_formula, arm_of}},
               .limit = "M <= rhoN N",
               .needs = {"mode dContactRolling | dContactAxisDep: else rho is taken for rhoN",
                         "mode dContactApprox1 (1_1, 1_2 and 1_N): else mu is in N and rhoN in N m, whatever the load",
                         "with dContactAxisDep also mu2 = mu, rho = rho2 = 0"},
               .settings = {{"with these flags", Cone::box, arm_of}, {"without dContactRolling", Cone::box, no_arm}}},
      .face = face_on_rim("surface.mu", Cone::points),
      .combination = "none: the program that uses it fills in dSurfaceParameters for each contact",
      .remarks = {},
      .sources = {"ode/src/joints/contact.cpp:299-344", "include/ode/contact.h:34-51",
                  "ode/src/collision_cylinder_plane.cpp:85-215"},
  };
}

Engine gazebo() {
  return {
      .name = "gazebo",
      .title = "Gazebo classic (its ODE)",
      .repository = "gazebosim/gazebo-classic",
      .version = "commit be2dc76",
      .ball = {.parameters = {{"<mu>, <mu2>", "", "f", friction_of},
                              {"<torsional><coefficient>", "", "f", friction_of},
                              {"<torsional><patch_radius>", "m", "16 Psi(0) a/(3 pi)",
                               [](const EngineContact& contact) {
                                 return contact.patch_radius * contact.pivoting_moment * 16 / (3 * std::numbers::pi);
                               }}},
               .limit = "M <= (3 pi/16) coefficient patch_radius N",
               .needs = {"<use_patch_radius>true</use_patch_radius> in both surfaces"},
               .settings = {{"use_patch_radius", Cone::box, arm_of}, {"patch_radius 0 (default)", Cone::box, no_arm}}},
      .face = {},
      .combination = "the smaller of the two coefficients, the larger of the two patch radii: set both",
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
      .ball = {.parameters = {{"material.friction", "", "f", friction_of},
                              {"material.spin_friction", "m", arm_formula, arm_of}},
               .limit = "M <= spin_friction N",
               .needs = {},
               .settings = {{"spin_friction", Cone::box, arm_of}, {"spin_friction 0 (default)", Cone::box, no_arm}}},
      .face = face_on_rim("material.friction", Cone::points),
      .combination = "friction the geometric mean of the two materials, spin_friction the larger: set both",
      .remarks = {},
      .sources = {"src/edyn/constraints/constraint_row_spin_friction.cpp:5-28",
                  "include/edyn/dynamics/material_mixing.hpp:16-22", "include/edyn/comp/material.hpp:18",
                  "src/edyn/collision/collide/collide_cylinder_plane.cpp:34-54"},
  };
}

Engine jolt() {
  return {
      .name = "jolt",
      .title = "Jolt Physics",
      .repository = "jrouwe/JoltPhysics",
      .version = "commit 3b47ec3 (after 5.5.0; its friction is of 31 May 2026)",
      .ball = {.parameters = {},
               .limit = "one contact point: none",
               .needs = {"two contact points or more, for any moment at all"},
               .settings = {{"one contact point, as a ball has", Cone::box, no_arm}}},
      .face = face_on_rim("mFriction", Cone::box),
      .combination = "friction the geometric mean of the two bodies",
      .remarks = {"A ball spins for ever: mAngularDamping (0.05 1/s by default) alone brakes it, on the ground and\n"
                  "in the air, by that share of its spin a second.",
                  "The force is bounded by f N and the moment by itself, so slip and spin do not know of each other.",
                  "A cylinder's face is an octagon, its contact points at most four of the corners."},
      .sources = {"Jolt/Physics/Constraints/ContactConstraintManager.cpp:146-180",
                  "Jolt/Physics/Constraints/ContactConstraintManager.cpp:1704-1744",
                  "Jolt/Physics/Constraints/ContactConstraintManager.h:81",
                  "Jolt/Physics/Constraints/ContactConstraintManager.h:554",
                  "Jolt/Physics/Collision/Shape/CylinderShape.cpp:35-45", "Docs/APIChanges.md:9"},
  };
}

Engine rapier() {
  return {
      .name = "rapier",
      .title = "Rapier",
      .repository = "dimforge/rapier",
      .version = "0.35.2 (commit ccd01cd)",
      .ball = {.parameters = {},
               .limit = "one contact point: none",
               .needs = {"two contact points or more, for any moment at all"},
               .settings = {{"one contact point, as a ball has", Cone::box, no_arm}}},
      .face =
          [] {
            EngineUse face = face_on_rim("friction", Cone::box);
            face.settings.push_back({"Coulomb, shape of radius a Psi(0)", Cone::points, arm_of});
            face.settings.push_back({"Coulomb, shape of its own radius", Cone::points, rim_arm_of});
            return face;
          }(),
      .combination = "friction the mean of the two colliders, unless a combine rule says otherwise",
      .remarks =
          {"The force is bounded by f N and the moment by itself, so slip and spin do not know of each other.",
           "FrictionModel::Coulomb has friction at each point in place of the twist; multibodies always have it."},
      .sources = {"src/dynamics/integration_parameters.rs:15-32",
                  "src/dynamics/solver/contact_constraint/contact_with_twist_friction.rs:319-336",
                  "src/dynamics/solver/contact_constraint/contact_with_twist_friction.rs:740-766",
                  "src/dynamics/coefficient_combine_rule.rs:39-42", "src/lib.rs:291"},
  };
}

Engine box3d() {
  constexpr auto as_rolling = [](const EngineContact& contact) { return contact.moment_arm() / contact.radius; };
  return {
      .name = "box3d",
      .title = "Box3D",
      .repository = "erincatto/box3d",
      .version = "0.1.0 (commit 30c67b5)",
      .ball = {.parameters = {{"friction", "", "f", friction_of},
                              {"rollingResistance", "", "f a Psi(0)/R", as_rolling}},
               .limit = "|M| <= rollingResistance R N, of the moment against the whole rotation, rolling and spin",
               .needs = {},
               .settings = {{"rollingResistance", Cone::box, arm_of},
                            {"rollingResistance 0 (default)", Cone::box, no_arm}}},
      .face = face_on_rim("friction", Cone::box),
      .combination = "friction the geometric mean of the two shapes, rollingResistance the larger",
      .remarks =
          {"The same number brakes the rolling: a ball that rolls without spin slows down at rollingResistance g\n"
           "over 1 + J/(m R^2), 5/7 of it if homogeneous. One that spins and rolls shares the moment between the two,\n"
           "which the times here leave out.",
           "Of more contact points the force is bounded by f N and the moment by f times the sum of distance to\n"
           "their middle times load, each for itself. There are four at most; a cylinder is a hull of flat sides."},
      .sources = {"src/contact_solver.c:491-525", "src/contact_solver.c:235-239", "src/contact.c:651-690",
                  "include/box3d/types.h:406-408", "src/physics_world.c:154-158", "include/box3d/constants.h:107"},
  };
}

Engine bepu() {
  constexpr auto four_times = [](const EngineContact& contact) { return 4 * contact.friction; };
  return {
      .name = "bepu",
      .title = "bepuphysics2",
      .repository = "bepu/bepuphysics2",
      .version = "2.5.0-beta.28 (commit 956a679)",
      .ball = {.parameters = {},
               .limit = "M <= FrictionCoefficient penetration N",
               .needs = {},
               .settings = {{"one contact point, no penetration", Cone::box, no_arm}}},
      .face = {.parameters = {{"FrictionCoefficient", "", "4 f", four_times},
                              {"radius of the shape", "m", "a Psi(0)", spinning_radius_of}},
               .limit = "n points: M <= (FrictionCoefficient/n) sum(distance to their middle, times the load of each)",
               .needs = {"the body's own mass and inertia: those of a smaller shape are smaller"},
               .settings = {{"shape of radius a Psi(0)", Cone::box, arm_of},
                            {"shape of its own radius", Cone::box, rim_arm_of},
                            {"FrictionCoefficient f, its own radius", Cone::box,
                             [](const EngineContact& contact) { return rim_arm_of(contact) / 4; }, 0.25}}},
      .combination = "none: the program that uses it says FrictionCoefficient for each pair",
      .remarks =
          {"A ball's moment follows from how far it sinks in, that is from the contact's spring: f a Psi(0) takes\n"
           "a penetration of a Psi(0).",
           "With n contact points friction is 1/n of what is typed in: a cylinder on its face, which has four,\n"
           "needs four times the coefficient of a ball."},
      .sources = {"BepuPhysics/Constraints/Contact/ContactConvexTypes.cs:320-327",
                  "BepuPhysics/Constraints/Contact/ContactConvexTypes.cs:813-822",
                  "BepuPhysics/Constraints/Contact/TwistFriction.cs:31-44",
                  "BepuPhysics/CollisionDetection/CollisionTasks/BoxCylinderTester.cs:58-82",
                  "BepuPhysics/CollisionDetection/INarrowPhaseCallbacks.cs:15"},
  };
}

Engine pooltool() {
  return {
      .name = "pooltool",
      .title = "pooltool",
      .repository = "ekiefl/pooltool",
      .version = "commit 9a8abfe (after 0.6.0)",
      .ball = {.parameters = {{"u_s", "", "f", friction_of},
                              {"u_sp_proportionality", "1/m", "f a Psi(0)/R^2",
                               [](const EngineContact& contact) {
                                 return contact.moment_arm() / contact.radius / contact.radius;
                               }}},
               .limit = "M = u_sp R N with u_sp = u_sp_proportionality R",
               .needs = {},
               .settings = {{"u_sp_proportionality", Cone::box, arm_of},
                            {"u_sp_proportionality 0.444 (default)", Cone::box,
                             [](const EngineContact& contact) {
                               return 10 * 2.0 / 5 / 9 * contact.radius * contact.radius;
                             }}}},
      .face = {},
      .combination = "none: the table has no numbers of its own",
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
      .ball = {.parameters = {{"muS", "", "f", friction_of},
                              {"rho", "m", "3 f a Psi(0)/(2 mu), mu = 0.0055",
                               [](const EngineContact& contact) { return 1.5 * contact.moment_arm() / rolling; }}},
               .limit = "M = (2/3) mu rho N with its rolling friction mu = 0.0055",
               .needs = {},
               .settings = {{"rho", Cone::box, arm_of},
                            {"rho 0.045 m (default)", Cone::box,
                             [](const EngineContact& /*any*/) { return 2.0 / 3 * rolling * 0.045; }}}},
      .face = {},
      .combination = "none: the table has no numbers of its own",
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
      .ball = {.parameters = {},
               .limit =
                   "point contact: none; hydroelastic contact: none of its own, the moment is that of the pressure",
               .needs = {"hydroelastic contact, for any moment at all"},
               .settings = {{"point contact", Cone::box, no_arm}}},
      .face = {.parameters = {},
               .limit = "point contact: none; hydroelastic contact: that of the law",
               .needs = {"hydroelastic contact, for any moment at all"},
               .settings = {{"point contact", Cone::box, no_arm}}},
      .combination = "of friction only",
      .remarks =
          {"A compliant ball on a rigid half-space has the pressure 1 - rho^2 over its overlap: --law paraboloid.",
           "A torsional friction in a MuJoCo file is ignored, with a warning.",
           "What rests under a tangential load of f N/2 creeps at half of stiction_tolerance, that is by default at\n"
           "0.05 mm/s (continuous time and the solver TAMSI)."},
      .sources = {"multibody/plant/multibody_plant_config.h:47", "multibody/plant/multibody_plant.h:6801-6822",
                  "multibody/plant/contact_model_doxygen.h:209-211",
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
  static const std::vector<Engine> entries{mujoco(), newton(), genesis(),  physx(),  bullet(), chrono(),
                                           ode(),    gazebo(), edyn(),     jolt(),   rapier(), box3d(),
                                           bepu(),   drake(),  pooltool(), tailuge()};
  return entries;
}

const std::vector<EngineAlias>& engine_aliases() {
  static const std::vector<EngineAlias> entries{
      {"isaac", "physx", "Isaac Sim stands on PhysX"},
      {"unity", "physx", "Unity's built-in 3D physics stands on PhysX"},
      {"unreal", "physx", "Unreal Engine 4 stands on PhysX; 5 has Chaos, whose source is not open and was not read"},
  };
  return entries;
}

const Engine* find_engine(std::string_view name) {
  const auto alias = std::ranges::find(engine_aliases(), name, &EngineAlias::name);
  const auto found =
      std::ranges::find(engines(), alias == engine_aliases().end() ? name : alias->engine, &Engine::name);
  return found == engines().end() ? nullptr : &*found;
}

}  // namespace contensou::si
