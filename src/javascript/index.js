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
const bodyCalled = (name) => {
  const body = bodies.find((each) => each.name === name);
  if (!body) throw new Error(`no such body: ${name}; there are ${bodies.map((each) => each.name).join(", ")}`);
  return body;
};

export class Flow {
  #plane = new library.Plane();

  constructor({ mu, law, body = "ball", chi, gamma, drive = 0 }) {
    const known = bodyCalled(body);
    const patch = mu ?? known.mu;
    if (patch === undefined) throw new Error("mu is missing: the radius of the contact patch divided by that of the body");
    const another = chi !== undefined || gamma !== undefined;
    const complaint = another ? "" : library.complaint(body, patch);
    if (complaint) throw new Error(`mu = ${patch}: ${complaint}`);
    const of = this.#plane.choose(law ?? lawOfBody[body] ?? "exact", patch, chi ?? known.chi, gamma ?? known.gamma, drive);
    this.terminalRatio = of.terminalRatio;
    this.meaning = of.meaning;
  }

  stopTime({ u, v }) { return this.#plane.stop(u, v); }

  motion({ u, v }) { return this.#plane.motion(u, v); }

  at({ u, v }, tau) {
    const { places: _, ...state } = this.#plane.instant(u, v, tau);
    return state;
  }

  check({ u, v }) { return this.#plane.checks(u, v); }
}

export const stopTime = ({ u, v, ...system }) => new Flow(system).stopTime({ u, v });

export class Ball {
  #plane = new library.Plane();
  #fields;

  constructor(ball, changes = {}) {
    if (typeof ball === "string" && !balls[ball]) throw new Error(`no such ball: ${ball}; there are ${Object.keys(balls).join(", ")}`);
    const { patchBy, patch, ...given } = typeof ball === "string" ? balls[ball] : ball;
    const changesPatch = "patch_radius" in changes || "spin_deceleration" in changes;
    this.#fields = { body: "ball", gravity: 9.80665, ...given, ...(patchBy && patchBy !== "whole_face" && !changesPatch ? { [patchBy]: patch } : {}), ...changes };
    this.law = this.#fields.law ?? lawOfBody[this.#fields.body] ?? "exact";
    const { mu, patchRadius, spinDeceleration } = library.contact(this.law, this.#shot({ slip: 0, spin: 0 }));
    Object.assign(this, { mu, patchRadius, spinDeceleration });
    const { chi, gamma } = bodyCalled(this.#fields.body);
    this.#plane.choose(this.law, mu, chi, gamma, 0);
  }

  #shot({ slip = this.#fields.slip, spin = this.#fields.spin, velocity, angularVelocity }) {
    const { slip: _, spin: __, title, sources, law, ...fields } = this.#fields;
    return velocity || angularVelocity ? { ...fields, velocity: velocity ?? [0, 0], angular_velocity: angularVelocity ?? [0, 0, 0] } : { ...fields, slip, spin };
  }

  roll(start = {}, { rollingFriction = 0, rollingBelow = library.rollingSlip } = {}) {
    const shot = this.#shot(start);
    const { end, path, turned, stop } = this.#plane.slide(shot, rollingFriction, rollingBelow);
    return {
      slidesUntil: end, path, turned, stopTime: stop,
      motion: (until = stop) => this.#plane.ride(shot, rollingFriction, until),
    };
  }
}
