// The C++ library, compiled to WebAssembly. README.md says what there is, index.d.ts what each thing is.
import loadContensou from "./contensou.mjs";

const wasm = new URL("contensou.wasm", import.meta.url);
const wasmBinary = wasm.protocol === "file:" ? await (await import("node:fs/promises")).readFile(wasm)
  : await (await fetch(wasm)).arrayBuffer();
const library = await loadContensou({ wasmBinary });

export const laws = library.laws();
export const bodies = library.bodies();
export const balls = Object.fromEntries(library.catalogue().map(({ name, ...ball }) => [name, ball]));

const lawOfBody = { disc: "uniform", puck: "uniform", ring: "ring" };

/** The error for a name that is none of the allowed ones. */
const noSuch = (kind, kinds, typed, names) =>
  new Error(`no such ${kind} '${typed}'${library.suggestion(String(typed), names)}; ${kinds}: ${names.join(", ")}`);

const bodyCalled = (name) => {
  const body = bodies.find((each) => each.name === name);
  if (!body) throw noSuch("body", "bodies", name, bodies.map((each) => each.name));
  return body;
};

/** Returns the options of a call. Throws for an unknown one. */
const only = (call, options, names, more = []) => {
  if (options === null || typeof options !== "object") throw new Error(`${call}: options are needed, {${names.join(", ")}}; got ${options}`);
  for (const name of Object.keys(options)) {
    if (names.includes(name) || more.includes(name)) continue;
    throw new Error(`${call}: unknown option '${name}'${library.suggestion(name, names)}; options: ${names.join(", ")}`);
  }
  return options;
};

const ofStart = ["u", "v"];
const ofSystem = ["mu", "law", "body", "chi", "gamma", "drive"];

/** Gives a plane its system. */
const choose = (plane, { mu, law, body = "ball", chi, gamma, drive = 0 }) => {
  const known = bodyCalled(body);
  const patch = mu ?? known.mu;
  if (patch === undefined) throw new Error("mu is missing: the radius of the contact patch divided by that of the body");
  const inertia = [chi ?? known.chi, gamma ?? known.gamma];
  if (!inertia.every((each) => each > 0)) throw new Error(`chi = ${inertia[0]}, gamma = ${inertia[1]}: chi and gamma must be positive`);
  const another = chi !== undefined || gamma !== undefined;
  const complaint = !another ? library.complaint(body, patch) : patch > 0 ? "" : "mu > 0 is required";
  if (complaint) throw new Error(`mu = ${patch}: ${complaint.replace("--mu", "mu")}`);
  return plane.choose(law ?? lawOfBody[body] ?? "exact", patch, ...inertia, drive);
};

const isColumn = (given) => typeof given === "object" && given !== null;

/** Returns numbers and arrays as functions of the index, and their number. */
const columnsOf = (given) => {
  const lengths = Object.entries(given).filter(([, each]) => isColumn(each)).map(([name, { length }]) => [name, length]);
  const count = lengths[0]?.[1] ?? 1;
  if (lengths.some(([, length]) => length !== count)) {
    throw new Error(`arrays of one length are needed; got ${lengths.map(([name, length]) => `${name} of ${length}`).join(", ")}`);
  }
  const at = Object.fromEntries(Object.entries(given).map(([name, each]) => [name, isColumn(each) ? (i) => each[i] : () => each]));
  return { count, at };
};

const stopOr = (plane, u, v) => Number.isFinite(u) && Number.isFinite(v) && v >= 0 ? plane.stop(u, v) : NaN;

export class Flow {
  #plane = new library.Plane();

  constructor(system) {
    const of = choose(this.#plane, only("Flow", system, ofSystem));
    this.terminalRatio = of.terminalRatio;
    this.meaning = of.meaning;
  }

  stopTime(start) {
    const { u, v } = only("stopTime", start, ofStart);
    return this.#plane.stop(u, v);
  }

  stopTimes(starts) {
    const { u, v } = only("stopTimes", starts, ofStart);
    const { count, at } = columnsOf({ u, v });
    return Float64Array.from({ length: count }, (_, i) => stopOr(this.#plane, at.u(i), at.v(i)));
  }

  motion(start) {
    const { u, v } = only("motion", start, ofStart);
    return this.#plane.motion(u, v);
  }

  at(start, tau) {
    const { u, v } = only("at", start, ofStart);
    const { places: _, ...state } = this.#plane.instant(u, v, tau);
    return state;
  }

  check(start) {
    const { u, v } = only("check", start, ofStart);
    return this.#plane.checks(u, v);
  }
}

export const stopTime = (given) => {
  const { u, v, ...system } = only("stopTime", given, [...ofStart, ...ofSystem]);
  return new Flow(system).stopTime({ u, v });
};

export const stopTimes = (given) => {
  const { u, v, mu, ...system } = only("stopTimes", given, [...ofStart, ...ofSystem]);
  if (!isColumn(mu)) return new Flow({ mu, ...system }).stopTimes({ u, v });
  const { count, at } = columnsOf({ mu, u, v });
  const taus = new Float64Array(count).fill(NaN);
  const plane = new library.Plane();
  let last = NaN;
  // Starts with one mu, one after the other: a plane is solved once for them.
  const order = [...taus.keys()].filter((i) => !Number.isNaN(at.mu(i))).sort((i, j) => at.mu(i) - at.mu(j));
  for (const i of order) {
    if (at.mu(i) !== last) choose(plane, { mu: last = at.mu(i), ...system });
    taus[i] = stopOr(plane, at.u(i), at.v(i));
  }
  plane.delete();
  return taus;
};

const ofBall = ["body", "law", "radius", "mass", "friction", "gravity", "patch_radius", "spin_deceleration", "youngs_modulus",
  "poisson_ratio", "slip", "spin"];
const flat = ["disc", "puck", "ring"];

export class Ball {
  #plane = new library.Plane();
  #fields;

  constructor(ball, changes = {}) {
    if (typeof ball === "string" && !Object.hasOwn(balls, ball)) throw noSuch("ball", "balls", ball, Object.keys(balls));
    const { patchBy, patch, ...given } = typeof ball === "string" ? balls[ball] : only("Ball", ball, ofBall, ["title", "sources", "patchBy", "patch"]);
    only("Ball", changes, ofBall);
    const changesPatch = "patch_radius" in changes || "spin_deceleration" in changes;
    this.#fields = { body: "ball", gravity: 9.80665, ...given, ...(patchBy && patchBy !== "whole_face" && !changesPatch ? { [patchBy]: patch } : {}), ...changes };
    this.law = this.#fields.law ?? lawOfBody[this.#fields.body] ?? "exact";
    const { mu, patchRadius, spinDeceleration } = library.contact(this.law, this.#shot({ slip: 0, spin: 0 }));
    Object.assign(this, { mu, patchRadius, spinDeceleration });
    const { chi, gamma } = bodyCalled(this.#fields.body);
    this.#plane.choose(this.law, mu, chi, gamma, 0);
  }

  #shot(start) {
    const { slip = this.#fields.slip, spin = this.#fields.spin, velocity, angularVelocity } = only("roll", start, ["slip", "spin", "velocity", "angularVelocity"]);
    if ((velocity || angularVelocity) && (start.slip !== undefined || start.spin !== undefined)) {
      throw new Error("slip, spin and velocity, angularVelocity exclude each other: give slip and spin, or velocity and angularVelocity");
    }
    const { slip: _, spin: __, title, sources, law, ...fields } = this.#fields;
    return velocity || angularVelocity ? { ...fields, velocity: velocity ?? [0, 0], angular_velocity: angularVelocity ?? [0, 0, 0] } : { ...fields, slip, spin };
  }

  roll(start = {}, options = {}) {
    const { rollingFriction = 0, rollingBelow = library.rollingSlip } = only("roll", options, ["rollingFriction", "rollingBelow"]);
    const { body } = this.#fields;
    if (options.rollingBelow !== undefined && flat.includes(body)) throw new Error(`rollingBelow: a ${body} lies flat and never rolls: leave it out`);
    if (!(rollingBelow >= 0)) throw new Error(`rollingBelow: 0 or more is needed, in m/s; got ${rollingBelow}`);
    const shot = this.#shot(start);
    const { end, path, turned, stop } = this.#plane.slide(shot, rollingFriction, rollingBelow);
    return {
      slidesUntil: end, path, turned, stopTime: stop,
      motion: (until = stop) => this.#plane.ride(shot, rollingFriction, until),
    };
  }
}
