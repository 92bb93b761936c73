// The C++ library, compiled to WebAssembly. README.md lists the functions, index.d.ts describes each.
import loadContensou from "./contensou.mjs";

const wasm = new URL("contensou.wasm", import.meta.url);
const wasmBinary = wasm.protocol === "file:" ? await (await import("node:fs/promises")).readFile(wasm)
  : await (await fetch(wasm)).arrayBuffer();
const library = await loadContensou({ wasmBinary });

export const laws = library.laws();
export const bodies = library.bodies();
export const balls = Object.fromEntries(library.catalogue().map(({ name, ...ball }) => [name, ball]));

const lawOfBody = { disc: "uniform", puck: "uniform", ring: "ring" };

const ofStart = ["u", "v"];

/** Returns the error for an unknown name. */
const noSuch = (kind, kinds, typed, names) =>
  new Error(`no such ${kind} '${typed}'${library.suggestion(String(typed), names)}; ${kinds}: ${names.join(", ")}`);

const bodyCalled = (name) => {
  const body = bodies.find((each) => each.name === name);
  if (!body) throw noSuch("body", "bodies", name, bodies.map((each) => each.name));
  return body;
};

const isColumn = (given) => typeof given === "object" && given !== null;
const texts = ["law", "body", "title", "sources", "patchBy"];
const vectors = { motion: 3, velocity: 2, angularVelocity: 3, youngs_modulus: 2, poisson_ratio: 2 };

/** Throws if a value has another type than its name needs. JavaScript would convert true, [1] and "1" to the number 1. */
const need = (call, name, value, several = false) => {
  const check = (fits, needed, of = name, got = value) => {
    if (fits) return;
    const shown = isColumn(got) ? "an object" : typeof got === "string" ? `'${got}'` : String(got) + (typeof got === "bigint" ? "n" : "");
    throw new TypeError(`${call}: ${of}: ${needed} is needed; got ${shown}`);
  };
  const isNumber = (each) => typeof each === "number";
  if (texts.includes(name)) return check(typeof value === "string", "a string");
  if (Object.hasOwn(vectors, name)) {
    return check(isColumn(value) && value.length === vectors[name] && Array.from(value).every(isNumber), `an array of ${vectors[name]} numbers`);
  }
  if (!several || !isColumn(value)) return check(isNumber(value), several ? "a number or an array of numbers" : "a number");
  check(isNumber(value.length), "a number or an array of numbers");
  if (ArrayBuffer.isView(value)) {
    try {
      new Uint8Array(value.buffer);
    } catch {
      throw new TypeError(`${call}: ${name}: its memory was given away (the array is detached): copy it before`);
    }
  }
  for (let i = 0, end = ArrayBuffer.isView(value) ? Math.min(1, value.length) : value.length; i < end; ++i) {
    if (!isNumber(value[i])) check(false, "a number", `${name}[${i}]`, value[i]);
  }
};

/** Returns the options of a call. Throws for an unknown one, and for a value of another type. */
const only = (call, options, names, more = []) => {
  if (options === null || typeof options !== "object") throw new Error(`${call}: options are needed, {${names.join(", ")}}; got ${options}`);
  for (const [name, value] of Object.entries(options)) {
    if (!names.includes(name) && !more.includes(name)) {
      throw new Error(`${call}: unknown option '${name}'${library.suggestion(name, names)}; options: ${names.join(", ")}`);
    }
    if (value !== undefined) need(call, name, value, call === "stopTimes" && ["mu", ...ofStart].includes(name));
  }
  return options;
};

const ofSystem = ["mu", "law", "body", "chi", "gamma", "drive"];

/** Returns law, mu, chi, gamma and drive of a system. */
const systemOf = ({ mu, law, body = "ball", chi, gamma, drive = 0 }) => {
  const known = bodyCalled(body);
  const patch = mu ?? known.mu;
  if (patch === undefined) throw new Error("mu is missing: the radius of the contact patch divided by that of the body");
  const inertia = [chi ?? known.chi, gamma ?? known.gamma];
  if (!inertia.every((each) => each > 0)) throw new Error(`chi = ${inertia[0]}, gamma = ${inertia[1]}: chi and gamma must be positive`);
  const another = chi !== undefined || gamma !== undefined;
  const complaint = !another ? library.complaint(body, patch) : patch > 0 ? "" : "mu > 0 is required";
  if (complaint) throw new Error(`mu = ${patch}: ${complaint.replace("--mu", "mu")}`);
  return [law ?? lawOfBody[body] ?? "exact", patch, ...inertia, drive];
};

/** Returns the start of a motion. */
const startOf = (call, start) => {
  const { u, v } = only(call, start, ofStart);
  for (const [name, value] of [["u", u], ["v", v]]) need(call, name, value, call === "stopTimes");
  return { u, v };
};

/** Returns numbers and arrays as arrays of one length. */
const columnsOf = (given) => {
  const lengths = Object.entries(given).filter(([, each]) => isColumn(each)).map(([name, { length }]) => [name, length]);
  const count = lengths[0]?.[1] ?? 1;
  if (lengths.some(([, length]) => length !== count)) {
    throw new Error(`arrays of one length are needed; got ${lengths.map(([name, length]) => `${name} of ${length}`).join(", ")}`);
  }
  return Object.values(given).map((each) => isColumn(each) ? each : new Float64Array(count).fill(each));
};

export class Flow {
  #plane = new library.Plane();
  #system;

  constructor(system) {
    this.#system = systemOf(only("Flow", system, ofSystem));
    const of = this.#plane.choose(...this.#system);
    this.terminalRatio = of.terminalRatio;
    this.meaning = of.meaning;
  }

  stopTime(start) {
    const { u, v } = startOf("stopTime", start);
    return this.#plane.stop(u, v);
  }

  stopTimes(starts) {
    return library.stopTimes(...this.#system, ...columnsOf(startOf("stopTimes", starts)));
  }

  motion(start) {
    const { u, v } = startOf("motion", start);
    return this.#plane.motion(u, v);
  }

  at(start, tau) {
    const { u, v } = startOf("at", start);
    need("at", "tau", tau);
    const { places: _, ...state } = this.#plane.instant(u, v, tau);
    return { ...state, force: this.#plane.force(state.u, state.v) };
  }

  check(start) {
    const { u, v } = startOf("check", start);
    return library.checks(...this.#system, u, v);
  }
}

export const stopTime = (given) => {
  const { u, v, ...system } = only("stopTime", given, [...ofStart, ...ofSystem]);
  startOf("stopTime", { u, v });
  return library.stopTime(...systemOf(system), u, v);
};

export const stopTimes = (given) => {
  const { u, v, mu, ...system } = only("stopTimes", given, [...ofStart, ...ofSystem]);
  const start = startOf("stopTimes", { u, v });
  if (!isColumn(mu)) return library.stopTimes(...systemOf({ mu, ...system }), ...columnsOf(start));
  const [mus, ...starts] = columnsOf({ mu, ...start });
  let least = Infinity, largest = -Infinity;
  for (let i = 0; i < mu.length; ++i) {
    if (mu[i] < least) least = mu[i];
    if (mu[i] > largest) largest = mu[i];
  }
  if (least > largest) return new Float64Array(mu.length).fill(NaN);
  systemOf({ mu: least, ...system });
  const [law, , ...numbers] = systemOf({ mu: largest, ...system });
  return library.stopTimesOfMu(law, mus, ...numbers, ...starts);
};

const ofStep = ["law", "motion", "load", "friction", "radius", "byForce", "byMoment", "dt"];

export const step = (given) => {
  only("step", given, ofStep);
  for (const name of ofStep.slice(1)) if (given[name] === undefined) need("step", name);
  const [law, motion, ...numbers] = ofStep.map((name) => given[name]);
  const [vx, vy, omega, fx, fy, moment] = library.step(law ?? "exact", ...motion, ...numbers);
  return { motion: [vx, vy, omega], force: [fx, fy], moment };
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
      motion: (until = stop) => {
        need("motion", "until", until);
        return this.#plane.ride(shot, rollingFriction, until);
      },
    };
  }
}
