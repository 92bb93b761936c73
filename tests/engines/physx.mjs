// A ball on a plane in PhysX.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fading, slipOf } from "./fading.mjs";

// The package is compiled for browsers, and refuses to be loaded where it sees node.
const { versions } = process;
Object.defineProperty(process, "versions", { value: { ...versions, node: undefined }, configurable: true });
globalThis.window = globalThis;
const { default: loadPhysX } = await import("physx-js-webidl");
const px = await loadPhysX({
  wasmBinary: readFileSync(createRequire(import.meta.url).resolve("physx-js-webidl").replace(/mjs$/, "wasm")),
});
Object.defineProperty(process, "versions", { value: versions });
delete globalThis.window;

const version = px.PHYSICS_VERSION;
const foundation = px.CreateFoundation(version, new px.PxDefaultAllocator(), new px.PxDefaultErrorCallback());
const physics = px.CreatePhysics(version, foundation, new px.PxTolerancesScale());
const vector = (x, y, z) => new px.PxVec3(x, y, z);
const at = (x, y, z) => new px.PxTransform(vector(x, y, z), new px.PxQuat(px.PxIDENTITYEnum.PxIdentity));
const components = (v) => [v.get_x(), v.get_y(), v.get_z()];

/**
 * @param solver  "eTGS" or "ePGS"
 * @param radius  {min, patch}: the minTorsionalPatchRadius and the torsionalPatchRadius of both shapes, m
 * @param end     s
 */
export function physxTimes(ball, solver, { min = 0, patch = 0 }, end, dt = 5e-4) {
  const description = new px.PxSceneDesc(physics.getTolerancesScale());
  description.set_gravity(vector(0, 0, -ball.gravity));
  description.set_cpuDispatcher(px.DefaultCpuDispatcherCreate(0));
  description.set_filterShader(px.DefaultFilterShader());
  description.set_solverType(px.PxSolverTypeEnum[solver]);
  const scene = physics.createScene(description);
  const material = physics.createMaterial(ball.friction, ball.friction, 0);
  const flags = new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE);
  const add = (actor, geometry) => {
    const shape = physics.createShape(geometry, material, true, flags);
    shape.setSimulationFilterData(new px.PxFilterData(1, 1, 0, 0));
    shape.setMinTorsionalPatchRadius(min);
    shape.setTorsionalPatchRadius(patch);
    shape.setContactOffset(1e-3);
    actor.attachShape(shape);
    scene.addActor(actor);
    return actor;
  };
  add(physics.createRigidStatic(at(0, 0, -1)), new px.PxBoxGeometry(50, 50, 1));
  const body = physics.createRigidDynamic(at(0, 0, ball.radius));
  body.setMass(ball.mass);
  const inertia = 0.4 * ball.mass * ball.radius ** 2;
  body.setMassSpaceInertiaTensor(vector(inertia, inertia, inertia));
  body.setAngularDamping(0);
  body.setMaxAngularVelocity(1e4);
  body.setSleepThreshold(0);
  add(body, new px.PxSphereGeometry(ball.radius));
  const step = () => {
    scene.simulate(dt);
    scene.fetchResults(true);
    const w = components(body.getAngularVelocity());
    return { slip: slipOf(ball.radius, components(body.getLinearVelocity()), w), spin: w[2] };
  };
  for (let i = 0; i < 200; ++i) step(); // until it lies
  body.setLinearVelocity(vector(ball.slip, 0, 0));
  body.setAngularVelocity(vector(0, 0, ball.spin));
  return fading(ball, step, dt, end);
}
