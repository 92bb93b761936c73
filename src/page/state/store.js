// The state of the page and all values that follow from it. Each value is computed again only if its inputs have changed.
import { bodyOf, fromFragment, initialState, startOf, takeBall, toFragment } from "./page_state.js";
import { portraitRequest, shotOf } from "../plane/portrait_request.js";
import { passageOf, rightOf, stoneOf } from "../hero/tries.js";
import { rideOn } from "../hero/turning.js";
import { shown } from "../numbers.js";
import { isDark, themeOf } from "../drawing/theme.js";

const longest = 10;    // s, longest rolling that is shown
const slow = 1 / 500;  // slip below which a body without units rolls, divided by the largest slip in the patch at the start

/** Returns a body for a motion without units: its radius is free, and one second is one unit of tau. */
const ballOf = (radius) =>
  ({ mass: 1, radius, friction: 2 / (3 * Math.PI), gravity: 1, patchBy: "patch_radius", patch: radius, body: "ball", rollingFriction: 0, slope: 0 });

export class Store {
  /** Called after each change; with true if only the moment or the isochrone has changed. */
  changed = (/** @type {boolean} */ _moment) => {};
  /** @type {((state: State) => void)[]} functions by which each part of the page shows the state, except the moment */
  shows = [];
  /** Shows the reader the reason why the library rejects something; "" removes it. */
  tell = (/** @type {string} */ _problem) => {};
  moves = true;    // motions play by themselves; else the end is shown
  kept = new Map();
  settled = false;
  held = false;    // true: the reader holds something; all changes until the release are one
  /** @type {Contact | null} */
  contact = null;
  view = /** @type {View} */ ({});
  request = /** @type {PortraitRequest} */ ({});
  portrait = /** @type {Portrait} */ ({});
  /** @type {[string, number, number, number, number]} law, mu, chi, gamma and drive */
  system = ["", 1, 1, 1, 0];
  body = { chi: 1, gamma: 1, mu: /** @type {number | undefined} */ (undefined) };
  /** @type {OwnOrbit[]} */
  motions = [];
  /** @type {number[] | null} their stop times under the law of comparison, in tau */
  others = null;
  /** @type {Figure | null} the plane of the typed equations */
  typed = null;
  /** @type {Measured | null} the last film */
  measured = null;
  /** The chosen motion; undefined without an orbit. */
  motion = /** @type {OwnOrbit} */ (/** @type {unknown} */ (undefined));
  timeFactor = 1;  // shown time divided by tau
  end = 1;         // end of the time slider, in tau

  /** @param {Library} library @param {State} state */
  constructor(library, state) {
    this.library = library;
    this.state = state;
  }

  show() { for (const show of this.shows) show(this.state); }

  /** Runs an action that may throw, and shows the reader the reason together with `remarks`. */
  attempt(action, remarks = []) {
    try {
      action();
      this.tell(remarks.join(" "));
    } catch (error) {
      this.tell([error.message, ...remarks].join(" "));
    }
  }

  /** Changes the state as the reader asks for it. */
  ask(edit, done = () => {}, remarks = /** @type {string[]} */ ([])) {
    this.attempt(() => {
      this.change(edit);
      done();
    }, remarks);
  }

  /** Changes the state; if the library rejects the new one, the old one stays and the reason is thrown. */
  change(edit) {
    const before = this.state;
    const next = structuredClone(before);
    edit(next);
    next.chosen = Math.max(0, Math.min(next.chosen, next.orbits.length - 1));
    // In the game only the reader's throws run.
    if (!this.moves && next.fraction === 0 && !(next.line && next.chosen === 0)) next.fraction = 1;
    try {
      this.compute(next);
    } catch (error) {
      // The library did not foresee this fault; its report needs the link of what was asked.
      if (error.name === "Fault") error.message += `#${toFragment(next)}`;
      if (this.settled) this.compute(before);
      else this.openWithout(next);
      throw error;
    }
    this.state = next;
    this.settled = true;
    this.changed(false);
  }

  /**
   * Opens a state instead of a link that the library rejects. The first possible one is taken: the motion in a plain plane,
   * the body with its own start, or the initial state.
   */
  openWithout(/** @type {State} */ asked) {
    const { lab, theme, embed, project, body, law, mu } = asked;
    const { view, window, field, against, system, points } = initialState();
    const own = { ...initialState(), ...(asked.ball ? {} : { body, law, mu }) };
    if (asked.ball) takeBall(own, asked.ball.initial);
    for (const state of [{ ...asked, view, window, field, against, system, points }, own, fromFragment("", this.library)]) {
      Object.assign(state, { lab, theme, embed, project });
      try {
        this.compute(state);
      } catch {
        continue;
      }
      this.state = state;
      this.settled = true;
      return this.changed(false);
    }
  }

  /** Ends holding: the library draws the portrait again, with space for the reader's orbits. */
  release() {
    const { portrait } = this;
    this.held = false;
    this.compute(this.state);
    if (this.portrait !== portrait) this.move({});
  }

  /** Changes the moment or the isochrone, on which no other value depends. */
  move(values) {
    Object.assign(this.state, values);
    this.changed(true);
  }

  /** Returns the value with a name. It is computed again only if its key has changed. */
  keep(name, key, make) {
    const text = JSON.stringify(key);
    if (this.kept.get(name)?.text !== text) {
      this.kept.delete(name);
      this.kept.set(name, { text, value: make() });
    }
    return this.kept.get(name).value;
  }

  /** Everything that depends on law, body, patch and starts, but not on the moment. */
  compute(/** @type {State} */ state) {
    const { library, library: { plane } } = this;
    const orbit = state.orbits[state.chosen];
    this.body = bodyOf(state, library);
    this.view = /** @type {View} */ (library.views.find(({ name }) => name === state.view));
    const { chi, gamma } = this.body;
    // Under a slope or rolling friction, the drive depends on the direction of sliding.
    const rolling = chi === 1 ? 0 : state.ball?.rollingFriction ?? 0;
    const slides = state.ball?.slope || rolling ? orbit : undefined;
    const contactBy = (law) => library.contact(law, shotOf(state.ball, slides ?? startOf(0, 0), slides ? rolling : 0));
    this.contact = state.ball ? this.keep("contact", [state.law, state.ball, slides], () => contactBy(state.law)) : null;
    if (this.contact) state.mu = this.contact.mu;
    this.timeFactor = this.contact?.secondsPerTau ?? 1;
    const drive = this.contact?.drive ?? 0;
    this.system = [state.law, state.mu, chi, gamma, drive];
    this.facts = this.keep("facts", this.system, () => plane.choose(...this.system));
    this.request = portraitRequest(state, { chi, gamma, drive, resistance: this.contact?.without ? 0 : rolling }, isDark(state.theme));
    // While the reader holds something and the window stays, the portrait behind his orbits stays, too.
    const stays = this.held && state.window !== null;
    const behind = stays ? { ...this.request, orbits: [], chosen: 0, ball: null } : this.request;
    this.portrait = this.keep("portrait", behind, () => plane.portrait(this.request));
    this.motions = this.keep("own", [behind, this.request], () => plane.own({ ...this.request, window: this.portrait.window }));
    const { against } = this.request;
    this.others = against ? this.keep("others", [...this.system, against, state.ball, state.orbits], () => {
      const mu = state.ball ? contactBy(against).mu : state.mu;
      return state.orbits.map(({ u, v }) => plane.stopBy(against, mu, u, v));
    }) : null;
    this.motion = this.motions[state.chosen];
    const { system, points } = state;
    this.typed = system ? this.keep("typed", [system, points, isDark(state.theme)], () => library.typedPortrait(system, points.flat(), isDark(state.theme))) : null;
    this.ride = orbit ? this.rideOf(state, state.chosen) : null;
    this.end = this.ride?.end ?? 1;
  }

  /** Returns the ride of an orbit's body over the table, and that of a body without spin: SI units, `end` in tau. */
  rideOf(state, index) {
    const { library, library: { plane }, body: { chi }, timeFactor } = this;
    const orbit = state.orbits[index];
    const ofSystem = (name, key, make) => this.keep(`${name} ${index}`, [...this.system, ...key], make);
    const rolls = chi !== 1;
    const { v } = orbit;
    const ball = state.ball ?? ballOf(1);
    // The slip below which a ball rolls.
    const least = state.ball ? library.rollingSlip : slow * (v + state.mu * Math.abs(orbit.u));
    const resistance = rolls ? ball.rollingFriction : 0;
    const starts = { plain: { ...orbit, u: 0 }, own: orbit };
    // A ball that is held by rolling friction creeps as long as it spins. The end of sliding is therefore computed without it.
    const slide = (name) => {
      if (v === 0 && starts[name].u === 0) return { end: 0, path: 0, turned: 0, stop: 0 };
      const shot = shotOf(ball, starts[name]);
      return ofSystem(`${name} slide`, [shot, least], () => plane.slide(shot, 0, least));
    };
    const plain = slide("plain");
    const own = { ...slide("own"), ...(resistance > 0 && !this.contact?.without ? { stop: this.motions[index].stop * timeFactor } : {}) };
    const radius = state.ball?.radius ?? (Math.max(own.path, plain.path) / 4 || 1);
    const ride = (name, until, kept = `${name} ride`) => {
      const shot = shotOf(state.ball ?? ballOf(radius), starts[name]);
      return ofSystem(kept, [shot, until], () => plane.ride(shot, resistance, until * timeFactor));
    };
    const rest = rolls && (resistance > 0 || ball.slope) ? ride("own", 0, "rest").rest : null;
    const stop = own.stop / timeFactor;
    // Show also the rolling of a ball that rolls soon, and the passage of the mark behind a stone.
    const speed = state.ball && rolls ? Math.hypot(orbit.along - v / chi, orbit.across) : 0;
    const rolling = speed > 0 ? Math.min(longest, Math.max(6 * radius, 2 * state.line) / speed) / timeFactor : 0;
    const whole = state.part === "whole" || v <= least;
    // At rest the time slider has a length, too.
    const lasts = Math.max(rolling, whole ? Math.max(stop, (rest?.t ?? 0) / timeFactor) : Math.min(stop, (1.3 * own.end) / timeFactor)) || 1;
    const stone = stoneOf(state, rolls);
    const passage = stone && ofSystem("passage", [shotOf(ball, orbit), orbit.heading, stone, lasts], () => {
      const course = ride("own", lasts);
      return passageOf(rideOn(course, rightOf(orbit, course, stone), 1), stone);
    });
    // The motion of a ball that touches the stone ends there.
    const end = lasts * (passage?.until || 1);
    return { own, plain, least, end, rolls, rest, radius, stone, passage, courses: [ride("plain", end), ride("own", end)] };
  }

  /** Returns a stop time as text. */
  stopText(tau) {
    const inTau = `τ* = ${shown(tau, 7)}${this.contact ? " m/s" : ""}`;
    return this.contact ? `${shown(tau * this.timeFactor, 6)} s  (${inTau})` : inTau;
  }

  /** The real ball that moves, if it can roll. */
  get roller() { return this.body.chi !== 1 && this.orbit ? this.state.ball : null; }
  get theme() { return themeOf(this.state.theme); }
  get orbit() { return this.state.orbits[this.state.chosen]; }

  /** States with the stop time that the reader chose. */
  get isochrone() {
    const { state: { isochrone }, request, library } = this;
    return isochrone ? this.keep("isochrone", [isochrone, request], () => library.plane.isochrone(isochrone)) : null;
  }

  get now() {
    const { orbit, state: { fraction }, end, request, library: { plane } } = this;
    const at = fraction * end;
    return orbit ? this.keep("now", [orbit.u, orbit.v, at, request], () => plane.instant(orbit.u, orbit.v, at)) : null;
  }
}
