#include "contensou/si/engine.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace contensou::si {

namespace {

constexpr EngineNumber f_alone{1, true}, f_a_psi{1, true, true, true}, a_psi{1, false, true, true}, nothing{0},
    pure_one{}, f_a{1, true, true}, two_a{2, false, true}, f_a_psi_by_R{1, true, true, true, -1},
    f_a_psi_by_R2{1, true, true, true, -2};
/// 16/(3 pi) a Psi(0): the patch radius for an engine that multiplies by Hertz's Psi(0) = 3 pi/16 itself.
constexpr EngineNumber hertz_radius{16 / (3 * std::numbers::pi), false, true, true};
constexpr EngineNumber f_load{1, true, false, false, 0, true}, f_a_psi_load{1, true, true, true, 0, true};
constexpr EngineNumber five_millimetres{0.005};  ///< default of MuJoCo, and of engines that copy it

/// Returns the use of an engine whose contact points lie on the rim of a cylinder. The distance of the points from the
/// middle determines the moment. The user therefore sets the radius of the collision shape, and no torsional friction.
/// @param name  name of f in the engine
/// @param cone  box for an engine with one row of twist, points for an engine with friction at each point
EngineUse face_on_rim(std::string_view name, Cone cone, std::vector<std::string_view> needs = {},
                      std::vector<EngineSetting> settings = {}) {
  needs.insert(needs.begin(), "the body's own mass and inertia: those of a smaller shape are smaller");
  settings.insert(settings.begin(),
                  {{"shape of radius a Psi(0)", cone, f_a_psi}, {"shape of its own radius", cone, f_a}});
  return {{{name, "", f_alone, ActsOn::both}, {"radius of the shape", "m", a_psi}},
          cone == Cone::box ? "M <= f sum(distance of a contact point to their middle, times its load)"
                            : "at each contact point: friction <= f times its load",
          std::move(needs),
          std::move(settings)};
}

}  // namespace

double EngineNumber::operator()(const EngineContact& contact) const {
  double product = factor;
  if (f) product *= contact.friction;
  if (a) product *= contact.patch_radius;
  if (psi) product *= contact.pivoting_moment;
  for (int i = 0; i < radius; ++i) product *= contact.radius;
  for (int i = radius; i < 0; ++i) product /= contact.radius;
  return load ? product * contact.load : product;
}

std::string EngineNumber::formula() const {
  std::string text = factor == 1 ? "" : fmt::format("{:.6g}", factor);
  for (const auto& [power, name] :
       {std::pair{f, "f"}, std::pair{a, "a"}, std::pair{psi, "Psi(0)"}, std::pair{load, "N"}}) {
    if (power) text += (text.empty() ? "" : " ") + std::string(name);
  }
  return text.empty() ? "1" : text + (radius == -2 ? "/R^2" : radius == -1 ? "/R" : "");
}

EngineContact contact_of(const Experiment& experiment, const reduction::Law& law) {
  return {.friction = experiment.contact.friction,
          .patch_radius = patch_radius_of(experiment, law),
          .pivoting_moment = law.pivoting_moment(),
          .radius = experiment.ball.radius,
          .load = experiment.environment.load.value_or(experiment.ball.mass * experiment.environment.gravity)};
}

bool EngineParameter::acts_on_force() const {
  return acts_on == ActsOn::both || (acts_on == ActsOn::by_value && !value.a);
}

bool EngineParameter::acts_on_moment() const {
  return acts_on == ActsOn::both || acts_on == ActsOn::moment || (acts_on == ActsOn::by_value && value.a);
}

const std::vector<Engine>& engines() {
  using enum Cone;
  const EngineUse one_point{{},
                            "one contact point: none",
                            {"two contact points or more, for any moment at all"},
                            {{"one contact point, as a ball has", box, nothing}}};
  static const std::vector<Engine> table{
      {"mujoco",
       "MuJoCo",
       "google-deepmind/mujoco",
       "commit a725507 (after 3.12.0)",
       {{{"friction[0]", "", f_alone}, {"friction[1]", "m", f_a_psi}},
        "M <= friction[1] N",
        {"condim=\"4\" (or 6): with 3, the default, there is no moment",
         "<option cone=\"elliptic\"/>: \"pyramidal\" is the default"},
        {{"cone elliptic", elliptic, f_a_psi},
         {"cone pyramidal (default)", pyramid, f_a_psi},
         {"cone elliptic, friction[1] 0.005 (default)", elliptic, five_millimetres},
         {"cone elliptic, friction[1] the diameter", elliptic, two_a},
         {"condim 3 (default)", box, nothing}}},
       face_on_rim("friction[0]", points),
       "the larger of the two geoms, number by number: set both; a geom of higher priority counts alone",
       {"The manual calls friction[1] the diameter of the contact patch; f and Psi(0) are missing in that.",
        // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): one note of two lines
        "Under the pyramidal cone a ball that slides and spins never rolls before its spin ends: its slip\n"
        "stays at (friction[1]/f) omega. Shown for a slip along a tangent axis; across, friction is weaker.",
        "Of friction[0] the larger counts, too: a plane with its default of 1 has friction 1.",
        "Either cone also lifts what slides: on a stiff contact the ball hops, and the slip of a pool ball\n"
        "ends 9 % later than here.",
        "A cylinder that lies on its face has three contact points on the rim, each with a moment of its own\n"
        "under condim 4: give it condim 3."},
       {"doc/computation/index.rst:965-968", "doc/computation/index.rst:984-999", "doc/XMLreference.rst:400",
        "doc/XMLreference.rst:2703", "src/engine/engine_collision_driver.c:1766-1829",
        "src/engine/engine_core_constraint.c:2228-2232", "src/engine/engine_util_misc.c:1584-1601",
        "src/engine/engine_collision_primitive.c:101-204"}},
      {"newton",
       "Newton",
       "newton-physics/newton",
       "commit 41a5392",
       {{{"mu", "", f_alone}, {"mu_torsional", "m", f_a_psi}},
        "M <= mu_torsional N",
        {"SolverMuJoCo(cone=\"elliptic\"): \"pyramidal\" is the default",
         "SolverMuJoCo: the shape's custom attribute mujoco:condim 4: with 3, the default, there is no\n"
         "moment"},
        {{"SolverMuJoCo, cone elliptic", elliptic, f_a_psi},
         {"SolverMuJoCo, cone pyramidal (default)", pyramid, f_a_psi},
         {"SolverMuJoCo, condim 3 (default)", box, nothing},
         {"SolverXPBD", box, f_a_psi},
         {"SolverXPBD, mu_torsional 0.005 (default)", box, five_millimetres}}},
       face_on_rim("mu", points,
                   {"SolverXPBD: mu_torsional 0: by default each contact point has 5 mm times its load on top"}),
       "SolverXPBD the mean of the two shapes, SolverMuJoCo the larger: give both shapes the same",
       {"The other solvers do not read mu_torsional.",
        "mu_torsional is documented in m, for SolverXPBD and SolverMuJoCo alike.",
        "A cylinder on its face has three contact points on the rim, 120 degrees apart, which stay where they\n"
        "are in the world while it turns, and its deepest one where it is tilted."},
       {"newton/_src/sim/builder.py:519-520", "newton/_src/geometry/collision_primitive.py:535-645",
        "newton/_src/solvers/xpbd/kernels.py:2308-2361", "newton/_src/solvers/mujoco/kernels.py:146-177",
        "newton/_src/solvers/mujoco/solver_mujoco.py:855-865", "newton/_src/solvers/xpbd/kernels.py:2261-2279",
        "newton/_src/solvers/xpbd/kernels.py:2353-2376", "newton/_src/solvers/mujoco/kernels.py:2484-2488",
        "newton/_src/solvers/mujoco/solver_mujoco.py:5423-5424"}},
      {"genesis",
       "Genesis",
       "Genesis-Embodied-AI/genesis-world",
       "commits 3a9e32b (solver), 25ef489 (options), 29d7ade (materials), 7bf5f6a (contact points)",
       {{{"friction", "", f_alone}, {"friction_torsional", "m", f_a_psi}},
        "M <= friction_torsional N",
        {"RigidOptions(enable_torsional_friction=True)",
         "RigidOptions(friction_cone=gs.friction_cone.elliptic): pyramidal is the default",
         "RigidOptions(contact_resolution=gs.contact_resolution.convex): signorini is the default of the\n"
         "elliptic cone"},
        {{"friction_cone elliptic, convex", elliptic, f_a_psi},
         {"friction_cone elliptic, signorini (default)", box, f_a_psi},
         {"friction_cone pyramidal (default)", pyramid, f_a_psi},
         {"friction_cone elliptic, 0.005 (default)", box, five_millimetres},
         {"enable_torsional_friction=False (default)", box, nothing}}},
       face_on_rim("friction", points),
       "the larger of the two materials, number by number: set both",
       {"Its documentation calls the number the effective radius of the contact patch; f and Psi(0) are missing\n"
        "in that.",
        "Since pull request 3126 friction no longer lifts what slides; in return slip and spin are bounded each\n"
        "for itself and no longer know of each other. Before 3139 convex was called impedance.",
        "A cylinder on its face has up to five contact points on the rim: that of the pose, and of four that are\n"
        "tilted a little. Each would have a moment of its own: leave enable_torsional_friction off."},
       {"genesis/engine/materials/rigid.py:35-39", "genesis/options/solvers.py (RigidOptions, contact_resolution)",
        "genesis/engine/solvers/rigid/constraint/solver.py (_friction_blocks, _func_disc_middle)",
        "genesis/engine/solvers/rigid/collider/narrowphase.py:546-556",
        "genesis/engine/solvers/rigid/collider/narrowphase.py:606-628",
        "genesis/engine/solvers/rigid/collider/narrowphase.py:868-937"}},
      {"physx",
       "PhysX",
       "NVIDIA-Omniverse/PhysX",
       "5.6.1 (commit a3d8a64)",
       {{{"dynamicFriction", "", f_alone, ActsOn::both}, {"minTorsionalPatchRadius", "m", a_psi}},
        "M <= f N max(minTorsionalPatchRadius, sqrt(penetration torsionalPatchRadius))",
        {"solverType eTGS: under ePGS, the default, the numbers are ignored",
         "a contact with a single anchor point, as a ball has"},
        {{"eTGS", box, f_a_psi},
         {"eTGS, minTorsionalPatchRadius = a", box, f_a},
         {"eTGS, torsionalPatchRadius alone", box, nothing},
         {"ePGS (default)", box, nothing}}},
       face_on_rim("dynamicFriction", points),
       "the larger of the two shapes",
       {"Neither number is the radius of the patch: Psi(0) is missing in the first, and the second is multiplied\n"
        "by the penetration, which is near 0, under a root: it is a radius of curvature.",
        "A face has two anchors, as far apart as its contact points are, each with half of the friction and\n"
        "neither with a moment of its own.",
        "Isaac Sim 4.1 gives each FixedCuboid and DynamicCuboid, however small, a minTorsionalPatchRadius of\n"
        "0.8 m: on a single anchor it stops at once (omni/isaac/core/objects/cuboid.py)."},
       {"physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:779-810",
        "physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:3136-3168",
        "physx/source/simulationcontroller/src/ScShapeInteraction.cpp:1063-1064", "physx/include/PxShape.h:470-512",
        "physx/include/PxSceneDesc.h:1044", "physx/source/lowleveldynamics/src/DyFrictionCorrelation.cpp:184-280",
        "physx/source/lowleveldynamics/src/DyTGSContactPrep.cpp:679"}},
      {"bullet",
       "Bullet",
       "bulletphysics/bullet3",
       "commit 6c888f4 (after 3.25)",
       {{{"setFriction of the ball", "", f_alone},
         {"setFriction of the plane", "", pure_one, ActsOn::both},
         {"setSpinningFriction of the ball", "m", f_a_psi}},
        "M <= s N with s = sA fB + sB fA; and the impulse of M is at most the number s in each step",
        {"setRollingFriction above 0, however small: without it spinning friction is ignored"},
        {{"rolling friction > 0", box, f_a_psi}, {"rolling friction 0 (default)", box, nothing}}},
       face_on_rim("setFriction of the body", points,
                   {"setFriction(1) of the plane: friction is the product",
                    "spinning friction 0, the default: each contact point would have a moment of its own"}),
       "friction f = fA fB, spinning friction s = sA fB + sB fA: the plane has 1 and 0",
       {"The cap bites where the load times the time step exceeds 1 N s: a heavy body spins on.",
        "A btCylinderShape on a btStaticPlaneShape gets one contact point in a step, on its rim. It keeps four at\n"
        "most, each until it has moved by 2 % of the shape's size: of a puck that slides or turns by more in a\n"
        "step one is left, the load is on the rim, and it rocks. A box or hull gets several at once: what is said\n"
        "here of a face is of one that stands on points around it.",
        "Friction at a point acts along its own slip, in one row (SOLVER_USE_2_FRICTION_DIRECTIONS: two).",
        "btMultiBody needs no rolling friction and has no cap, but solverMode SOLVER_USE_2_FRICTION_DIRECTIONS."},
       {"src/BulletCollision/CollisionDispatch/btManifoldResult.cpp:43-60",
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
        "src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp:1339-1344"}},
      {"chrono",
       "Chrono (NSC)",
       "projectchrono/chrono",
       "commit 7689fbc",
       {{{"SetFriction", "", f_alone}, {"SetSpinningFriction", "m", f_a_psi}},
        "M <= spinning_friction N",
        {"ChSystemNSC with ChContactMaterialNSC"},
        {{"on both materials", box, f_a_psi}, {"on one material only", box, nothing}}},
       {},
       "the smaller of the two materials: set both",
       {"ChSystemSMC: spinning_friction has no effect. Chrono::DEM: SetSpinningCoeff_* have none.",
        "Chrono::Multicore SMC: M <= spinning_friction r_c N with r_c from the overlap: f a Psi(0)/r_c."},
       {"src/chrono/solver/ChConstraintRollingNormal.cpp:56-89", "src/chrono/physics/ChContactMaterial.h:161",
        "src/chrono/physics/ChContactMaterialNSC.cpp:96-111", "src/chrono/physics/ChContactMaterialSMC.cpp:120",
        "src/chrono_multicore/solver/ChIterativeSolverMulticoreSMC.cpp:387-404",
        "src/chrono_dem/gpu/ChDemHelpers.cuh:198-241"}},
      {"edyn",
       "edyn",
       "xissburg/edyn",
       "commit 42d2ec2 (after 1.3.1)",
       {{{"material.friction", "", f_alone}, {"material.spin_friction", "m", f_a_psi}},
        "M <= spin_friction N",
        {},
        {{"spin_friction", box, f_a_psi}, {"spin_friction 0 (default)", box, nothing}}},
       face_on_rim("material.friction", points),
       "friction the geometric mean of the two materials, spin_friction the larger: set both",
       {},
       {"src/edyn/constraints/constraint_row_spin_friction.cpp:5-28", "include/edyn/dynamics/material_mixing.hpp:16-22",
        "include/edyn/comp/material.hpp:18", "src/edyn/collision/collide/collide_cylinder_plane.cpp:34-54"}},
      {"jolt",
       "Jolt Physics",
       "jrouwe/JoltPhysics",
       "commit 3b47ec3 (after 5.5.0; its friction is of 31 May 2026)",
       one_point,
       face_on_rim("mFriction", box),
       "friction the geometric mean of the two bodies",
       {"A ball spins for ever: mAngularDamping (0.05 1/s by default) alone brakes it, on the ground and\n"
        "in the air, by that share of its spin a second.",
        "The force has the limit f N and the moment a limit of its own: slip and spin do not affect each other.",
        "A cylinder's face is an octagon, its contact points at most four of the corners."},
       {"Jolt/Physics/Constraints/ContactConstraintManager.cpp:146-180",
        "Jolt/Physics/Constraints/ContactConstraintManager.cpp:1704-1744",
        "Jolt/Physics/Constraints/ContactConstraintManager.h:81",
        "Jolt/Physics/Constraints/ContactConstraintManager.h:554",
        "Jolt/Physics/Collision/Shape/CylinderShape.cpp:35-45", "Docs/APIChanges.md:9"}},
      {"rapier",
       "Rapier",
       "dimforge/rapier",
       "0.35.2 (commit ccd01cd)",
       one_point,
       face_on_rim(
           "friction", box, {},
           {{"Coulomb, shape of radius a Psi(0)", points, f_a_psi}, {"Coulomb, shape of its own radius", points, f_a}}),
       "friction the mean of the two colliders, unless a combine rule says otherwise",
       {"The force is bounded by f N and the moment by itself, so slip and spin do not know of each other.",
        "FrictionModel::Coulomb has friction at each point in place of the twist; multibodies always have it."},
       {"src/dynamics/integration_parameters.rs:15-32",
        "src/dynamics/solver/contact_constraint/contact_with_twist_friction.rs:319-336",
        "src/dynamics/solver/contact_constraint/contact_with_twist_friction.rs:740-766",
        "src/dynamics/coefficient_combine_rule.rs:39-42", "src/lib.rs:291"}},
      {"box3d",
       "Box3D",
       "erincatto/box3d",
       "0.1.0 (commit 30c67b5)",
       {{{"friction", "", f_alone}, {"rollingResistance", "", f_a_psi_by_R}},
        "|M| <= rollingResistance R N, of the moment against the whole rotation, rolling and spin",
        {},
        {{"rollingResistance", box, f_a_psi}, {"rollingResistance 0 (default)", box, nothing}}},
       face_on_rim("friction", box),
       "friction the geometric mean of the two shapes, rollingResistance the larger",
       {"The same number brakes the rolling: a ball that rolls without spin slows down at rollingResistance g\n"
        "over 1 + J/(m R^2), 5/7 of it if homogeneous. One that spins and rolls shares the moment between the two,\n"
        "which the times here leave out.",
        "Of more contact points the force is bounded by f N and the moment by f times the sum of distance to\n"
        "their middle times load, each for itself. There are four at most; a cylinder is a hull of flat sides."},
       {"src/contact_solver.c:491-525", "src/contact_solver.c:235-239", "src/contact.c:651-690",
        "include/box3d/types.h:406-408", "src/physics_world.c:154-158", "include/box3d/constants.h:107"}},
      {"ode",
       "ODE",
       "odedevs/ode",
       "commit 624b1c1 (after 0.16.6)",
       {{{"mu = mu2", "", f_alone}, {"rhoN", "m", f_a_psi}},
        "M <= rhoN N",
        {"surface.mode: dContactRolling, dContactAxisDep and dContactApprox1: without the last the limits\n"
         "are mu in N and rhoN in N m, whatever the load",
         "rho = rho2 = 0: they brake the rolling"},
        {{"dContactRolling, dContactAxisDep", box, f_a_psi}, {"no dContactRolling (default)", box, nothing}}},
       face_on_rim("mu", points, {"no dContactRolling: each contact point would have a moment of its own"}),
       "none: the program that uses it fills dSurfaceParameters for each contact",
       {"dContactAxisDep is dContactMu2 under another name: with it mu2 counts, too, and must be set.",
        "rho takes the place of rho2 and rhoN without dContactAxisDep: it brakes the rolling as well.",
        "Friction is limited by mu N along each of two axes: for a slip between them it is up to 1.41 times as\n"
        "large. Shown for a slip along an axis.",
        "A cylinder on a plane has four contact points on the rim, 90 degrees apart, which stay where they are in\n"
        "the world while it turns."},
       {"ode/src/joints/contact.cpp:73-116", "ode/src/joints/contact.cpp:254-293", "ode/src/joints/contact.cpp:300-344",
        "include/ode/contact.h:34-73", "ode/src/lcp.cpp:933-949", "ode/src/quickstep.cpp:3017-3023",
        "ode/src/collision_cylinder_plane.cpp:121-213"}},
      {"gazebo",
       "Gazebo classic (with ODE)",
       "gazebosim/gazebo-classic",
       "commits be2dc76 (contact), 73be891 (collision), b48a8d4 (solver), 49811db (cylinder)",
       {{{"mu = mu2", "", f_alone},
         {"torsional coefficient", "", f_alone, ActsOn::moment},
         {"patch_radius", "m", hertz_radius}},
        "M <= (3 pi/16) coefficient patch_radius N",
        {"<surface><friction><torsional>: coefficient, patch_radius and use_patch_radius true",
         "the physics engine ode"},
        {{"patch_radius", box, f_a_psi},
         {"patch_radius a, coefficient 1 (default)", box, EngineNumber{3 * std::numbers::pi / 16, false, true}},
         {"patch_radius 0 (default)", box, nothing}}},
       face_on_rim("mu = mu2", points,
                   {"patch_radius 0, the default: each contact point would have a moment of its own"}),
       "mu, mu2 and coefficient the smaller of the two surfaces, patch_radius the larger: set both;\n"
       "use_patch_radius must be true on both",
       {"3 pi/16 is Psi(0) of Hertz's pressure: for it patch_radius is the radius of the patch itself.",
        ("The tutorial writes mu3 inside <ode> and takes use_patch_radius true for surface_radius. The source\n"
         "reads <torsional><coefficient>, and use_patch_radius true takes patch_radius."),
        ("The radius is sqrt(surface_radius depth) if use_patch_radius is false, with the depth of the simulated\n"
         "contact."),
        ("Friction is limited by mu N along each of two axes, unless friction_model is cone: for a slip between\n"
         "them it is up to 1.41 times as large. Shown for a slip along an axis."),
        "Gazebo Sim (gz-sim), its successor, was not read."},
       {"deps/opende/src/joints/contact.cpp (dxJointContact::getInfo2)",
        "gazebo/physics/ode/ODEPhysics.cc (ODEPhysics::Collide)",
        "gazebo/physics/ode/ODESurfaceParams.cc (ODESurfaceParams::Load)",
        "deps/opende/src/quickstep_pgs_lcp.cpp (ComputeRows)",
        "deps/opende/src/collision_cylinder_plane.cpp (dCollideCylinderPlane)",
        "gazebosim/sdformat 8e777e0, sdf/1.7/surface.sdf (torsional)",
        "osrf/gazebo_tutorials 192b21b, torsional_friction/tutorial.md"}},
      {"webots",
       "Webots",
       "cyberbotics/webots",
       "commits eee8e09 (contacts), 8364fc9 (its copy of ODE), 0207bfd (manual)",
       {{{"coulombFriction", "", f_alone}, {"rollingFriction rhoN", "m", f_a_psi}},
        "M <= rhoN N, with rhoN the third number of rollingFriction",
        {"a ContactProperties node for the two contactMaterials: without one friction is 1, without a moment",
         "rollingFriction 0 0 rhoN: the first two numbers brake the rolling"},
        {{"rollingFriction 0 0 rhoN", box, f_a_psi}, {"rollingFriction 0 0 0 (default)", box, nothing}}},
       face_on_rim("coulombFriction", points,
                   {"rollingFriction 0 0 0, the default: each contact point would have a moment of its own"}),
       "none: ContactProperties belong to a pair of materials",
       {"Before pull request 6618 (August 2024) rhoN > 0 left the friction along the second axis undefined.",
        "-1 stands for infinity.",
        "Friction is limited by f N along each of two axes: for a slip between them it is up to 1.41 times as\n"
        "large. Shown for a slip along an axis.",
        "A cylinder on a plane has four contact points on the rim, 90 degrees apart, which turn with it."},
       {"src/webots/engine/WbSimulationCluster.cpp (fillSurfaceParameters)",
        "src/ode/ode/src/joints/contact.cpp (dxJointContact::getInfo2)",
        "src/ode/ode/src/collision_cylinder_plane.cpp (_cldInitCylinderPlane)",
        "docs/reference/contactproperties.md (rollingFriction)", "github.com/cyberbotics/webots/pull/6618"}},
      {"box2d",
       "Box2D",
       "erincatto/box2d",
       "2.4.2 (commit 411acc3) and 3.2.0 (commit 617d32a)",
       {{}, "none: it is plane, and no ball rolls in it", {}, {}},
       {{{"maxForce", "N", f_load}, {"maxTorque", "N m", f_a_psi_load}},
        "F <= maxForce and M <= maxTorque, whatever the load",
        {"a world without gravity that is seen from above",
         "2.4: a b2FrictionJoint to the ground, anchored at the body's centre of mass",
         "3.2: a b2MotorJoint to the ground with velocities 0: maxVelocityForce, maxVelocityTorque"},
        {{"maxForce and maxTorque", box, f_a_psi},
         {"maxTorque = maxForce a", box, f_a},
         {"maxTorque 0 (default)", box, nothing}}},
       "none: the joint belongs to a pair of bodies",
       {"For a disc under uniform pressure maxTorque is (2/3) f m g R.",
        "The force is clamped as a vector, the torque by itself: slip and spin do not affect each other.",
        "Version 3 has no b2FrictionJoint: its b2MotorJoint contains it."},
       {"src/dynamics/b2_friction_joint.cpp:147-182 (2.4.2)", "include/box2d/b2_friction_joint.h:37-55 (2.4.2)",
        "src/motor_joint.c:332-423 (3.2.0)", "include/box2d/types.h:707-725 (3.2.0)", "docs/migration.md:210 (3.2.0)"}},
      {"bepu",
       "bepuphysics2",
       "bepu/bepuphysics2",
       "2.5.0-beta.28 (commit 956a679)",
       {{}, "M <= FrictionCoefficient penetration N", {}, {{"one contact point, no penetration", box, nothing}}},
       {{{"FrictionCoefficient", "", EngineNumber{4, true}, ActsOn::both}, {"radius of the shape", "m", a_psi}},
        "n points: M <= (FrictionCoefficient/n) sum(distance to their middle, times the load of each)",
        {"the body's own mass and inertia: those of a smaller shape are smaller"},
        {{"shape of radius a Psi(0)", box, f_a_psi},
         {"shape of its own radius", box, f_a},
         {"FrictionCoefficient f, its own radius", box, EngineNumber{0.25, true, true}, 0.25}}},
       "none: the program that uses it says FrictionCoefficient for each pair",
       {"A ball's moment follows from how far it sinks in, that is from the contact's spring: f a Psi(0) takes\n"
        "a penetration of a Psi(0).",
        "With n contact points friction is 1/n of what is typed in: a cylinder on its face, which has four,\n"
        "needs four times the coefficient of a ball."},
       {"BepuPhysics/Constraints/Contact/ContactConvexTypes.cs:320-327",
        "BepuPhysics/Constraints/Contact/ContactConvexTypes.cs:813-822",
        "BepuPhysics/Constraints/Contact/TwistFriction.cs:31-44",
        "BepuPhysics/CollisionDetection/CollisionTasks/BoxCylinderTester.cs:58-82",
        "BepuPhysics/CollisionDetection/INarrowPhaseCallbacks.cs:15"}},
      {"drake",
       "Drake",
       "RobotLocomotion/drake",
       "commit be259df (after 1.56.0)",
       {{},
        "point contact: none; hydroelastic contact: none of its own, the moment is that of the pressure",
        {"hydroelastic contact, for any moment at all"},
        {{"point contact", box, nothing}}},
       {{},
        "point contact: none; hydroelastic contact: that of the law",
        {"hydroelastic contact, for any moment at all"},
        {{"point contact", box, nothing}}},
       "of friction only",
       {"A compliant ball on a rigid half-space has the pressure 1 - rho^2 over its overlap: --law paraboloid.",
        "A torsional friction in a MuJoCo file is ignored, with a warning.",
        "What rests under a tangential load of f N/2 creeps at half of stiction_tolerance, that is by default at\n"
        "0.05 mm/s (continuous time and the solver TAMSI)."},
       {"multibody/plant/multibody_plant_config.h:47", "multibody/plant/multibody_plant.h:6801-6822",
        "multibody/plant/contact_model_doxygen.h:209-211", "multibody/parsing/detail_mujoco_parser.cc:958-971"}},
      {"pooltool",
       "pooltool",
       "ekiefl/pooltool",
       "commit 9a8abfe (after 0.6.0)",
       {{{"u_s", "", f_alone}, {"u_sp_proportionality", "1/m", f_a_psi_by_R2}},
        "M = u_sp R N with u_sp = u_sp_proportionality R",
        {},
        {{"u_sp_proportionality", box, f_a_psi},
         {"u_sp_proportionality 0.444 (default)", box, EngineNumber{10 * 2.0 / 5 / 9, false, false, false, 2}}}},
       {},
       "none: the table has no numbers of its own",
       {"The default is written 10 * 2 / 5 / 9: a spin deceleration of 10 rad/s^2, with 9 in place of g and\n"
        "without R; what acts is 10.9 rad/s^2."},
       {"pooltool/objects/ball/params.py:77", "pooltool/objects/ball/params.py:102",
        "pooltool/physics/evolve/__init__.py:113-123", "pooltool/physics/evolve/__init__.py:170",
        "pooltool/physics/utils.py:77", "pooltool/physics/utils.py:95"}},
      {"lammps",
       "LAMMPS (pair_style granular)",
       "lammps/lammps",
       "commits 07b704c (source), 3e36acc (manual)",
       {{{"mu_s of tangential", "", f_alone}, {"mu_twist of twisting sds", "m", f_a_psi}},
        "M <= mu_twist N; twisting marshall: M <= (2/3) mu_s sqrt(R overlap) N",
        {"twisting sds or marshall, in pair_coeff or fix wall/gran granular: none is the default",
         "twisting sds: a stiff spring, such as k_twist = k_n a^3/2",
         "twisting marshall: hertz with k_n = N R/a^3: the overlap under the load N is then a^2/R"},
        {{"twisting sds", box, f_a_psi},
         {"twisting marshall", box, EngineNumber{2.0 / 3, true, true}},
         {"twisting none (default)", box, nothing}}},
       {},
       "the geometric mean of two types, number by number, unless pair_coeff I J sets their own; a wall has its\n"
       "own numbers",
       {"marshall has the moment of a uniform disc under every normal model. For Hertz's pressure it is 13 % too\n"
        "large: a spin without slip ends after 88 % of its time.",
        "The force has the limit f N and the moment a limit of its own: slip and spin do not affect each other.\n"
        "At a slip of a omega, marshall's moment is 3 times that of Hertz's pressure, at 3 a omega 10 times.",
        "Under hertz a stiffness k_n that is 1000 times too small, for longer time steps, makes the moment of\n"
        "marshall 10 times as large.",
        "Under tangential mindlin the spring of marshall is k_t a^2/2 and lacks a factor a; in the version of\n"
        "September 2021 it is k_t a^3/2. The limit of the moment is the same."},
       {"src/GRANULAR/gran_sub_mod_twisting_kernel.h:41-77", "src/GRANULAR/gran_sub_mod_normal_kernel.h:48-53",
        "src/GRANULAR/gran_sub_mod_tangential_kernel.h (gran_tangential_mindlin)",
        "src/GRANULAR/gran_sub_mod_twisting.cpp (GranSubModTwistingMarshall::init)",
        "doc/src/pair_granular.rst (twisting, mixing)"}}};
  return table;
}

const Engine& unknown_engine() {
  using enum Cone;
  static const Engine engine{
      "",
      "any engine",
      "",
      "",
      {{{"limit of the force/load", "", f_alone}, {"limit of the moment/load", "m", f_a_psi}},
       "F <= f N, M <= f a Psi(0) N, and one rule for both",
       {"friction proportional to the load N of the contact",
        "a moment about the normal of the contact: without it a ball spins for ever",
        "one rule for both limits: with the elliptic rule slip and spin end together, as under the law"},
       {{"(F/F0)^2 + (M/M0)^2 <= 1", elliptic, f_a_psi},
        {"F <= F0 and M <= M0", box, f_a_psi},
        {"F/F0 + M/M0 <= 1", pyramid, f_a_psi},
        {"no moment", box, nothing}}},
      {{{"limit of the force/load", "", f_alone}, {"limit of the moment/load", "m", f_a_psi}},
       "F <= f N, M <= f a Psi(0) N, and one rule for both",
       {"friction proportional to the load N of the contact",
        "either a moment of one contact, or contact points at a Psi(0) from their middle, not both"},
       {{"(F/F0)^2 + (M/M0)^2 <= 1", elliptic, f_a_psi},
        {"F <= F0 and M <= M0", box, f_a_psi},
        {"F/F0 + M/M0 <= 1", pyramid, f_a_psi},
        {"contact points at a Psi(0)", points, f_a_psi},
        {"one contact point without a moment", box, nothing}}},
      "see how it makes one number of the numbers of two bodies: smaller, larger, product or mean",
      {"If its number for the moment is a pure number, ask by which length it is multiplied: divide by that.",
       "contensou/wrench_kernel.h has the force and the moment of the law itself, in one header for any engine."},
      {}};
  return engine;
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
