// A start that is pulled: along its ray it runs through its copies, c times as large; across, it changes curve. And the slider of
// the size: all starts and the window grow together, so that the numbers change and the curves do not.
import { $ } from "../dom.js";
import { forgiveTouches } from "../controls/fields.js";
import { shown } from "../numbers.js";

const narrow = 8;    // degrees beside the ray, with both speeds in units of the start's
const most = 12;     // starts of one pull whose curves stay
const apart = 0.12;  // of the start: how far they are from each other
const decades = 1.5;  // to either end of the slider; no body is faster, or slower

/** How many times as large a start is as another, and whether it is a copy of it: both speeds by one factor. */
export function sizeOf({ u, v }, base) {
  const [x, y] = [u / base.u, v / base.v];
  if (base.u === 0 || base.v === 0) return { c: base.u === 0 ? y : x, along: base.u === 0 ? u === 0 : v === 0 };
  const angle = (Math.atan2(y, x) * 180) / Math.PI;
  return { c: Math.hypot(x, y) / Math.SQRT2, along: Math.abs(angle - 45) < narrow };
}

export class Copies {
  /**
   * The pull, and where the start is now.
   *
   * @type {{from: unknown, index: number, base: Speeds, at: Speeds, window: [number, number], stop: number, keys: string[]} | null}
   */
  pull = null;
  /** @type {(OwnOrbit & {start: Speeds})[]} where it has been */
  ghosts = [];
  /** @type {{orbits: Start[], window: number[], now: Start[]} | null} what the slider began with, and what it has made of the starts */
  size = null;

  /** @param {Store} store */
  constructor(store, announce) {
    this.store = store;
    this.announce = announce;
    this.slider = $("size");
    this.slider.addEventListener("input", () => this.resize(10 ** ((decades * Number(this.slider.value)) / 1000)));
    forgiveTouches(this.slider);
  }

  /** Where the slider is. */
  show() {
    this.slider.disabled = !this.store.orbit;
    if (this.isSized) return;
    this.size = null;
    this.slider.value = 0;
  }

  /** What the curves depend on but for their starts; and where they lie in the panels. */
  get keys() {
    const { law, mu, chi, gamma, view, window } = this.store.request;
    return [[law, mu, chi, gamma], [view, window ?? this.store.portrait.window]].map((key) => JSON.stringify(key));
  }

  /** The pull of a start: a new one, unless one that is from the same goes on. @param sizes  of copies that are seen from the beginning */
  begin(index, from, sizes = /** @type {number[]} */ ([])) {
    const { store: { state, portrait: { window }, library: { plane } } } = this;
    if (this.now && this.now.from === from) return this.now;
    const { u, v } = state.orbits[index];
    this.ghosts = sizes.map((c) => this.ghost({ u: c * u, v: c * v }));
    return (this.pull = { from, index, base: { u, v }, at: { u, v }, window, stop: plane.stop(u, v), keys: this.keys });
  }

  /** Where the start goes that is pulled to a place: on its ray, if that is near. @param from  the same during one pull */
  to(at, index, from) {
    const pull = this.begin(index, from, [1, 1 / 2, 1 / 4, 1 / 8]);
    const { c, along } = sizeOf(at, pull.base);
    const times = Number(c.toPrecision(3));
    return (pull.at = along ? { u: times * pull.base.u, v: times * pull.base.v } : at);
  }

  /** Whether the starts are as the slider has made them. */
  get isSized() {
    return this.size !== null && JSON.stringify(this.size.now) === JSON.stringify(this.store.state.orbits);
  }

  /** All starts and the window, c times as large. */
  resize(c) {
    const { store } = this;
    const { orbits, window } = this.size && this.isSized ? this.size : { orbits: store.state.orbits, window: store.portrait.window };
    const times = (speed) => Number((c * speed).toPrecision(6));
    const now = orbits.map(({ u, v, along, across, heading }) => ({ u: times(u), v: times(v), along: times(along), across: times(across), heading }));
    store.ask((state) => {
      this.size = { orbits, window, now };
      Object.assign(state, { orbits: now, window: window.map(times), fraction: 0, isochrone: 0 });
    }, () => this.announce(`Both speeds × ${shown(c, 3)}: the same curves, ${shown(c, 3)} × the time: ${store.stopText(store.motion.stop)}.`));
  }

  /** Remembers where the start is now. */
  note() {
    const { pull, ghosts, store: { orbit } } = this;
    if (!pull) return;
    const share = (a, b, of) => Math.abs(a - b) / (Math.abs(of) || 1);
    const near = ghosts.some(({ start: { u, v } }) => Math.max(share(u, orbit.u, pull.base.u), share(v, orbit.v, pull.base.v)) < apart);
    if (!near) this.ghosts = [...ghosts.slice(-most + 1), this.ghost(orbit)];
  }

  ghost(/** @type {Speeds} */ { u, v }) {
    const { request, portrait: { window }, library: { plane } } = this.store;
    return { start: { u, v }, ...plane.own({ ...request, window, orbits: [{ u, v }], chosen: 0, ball: null })[0] };
  }

  /** The pull, while the start is where it was pulled to. */
  get now() {
    const { pull, keys: [system, place], store: { state, orbit } } = this;
    const stays = pull && orbit && pull.index === state.chosen && pull.keys[0] === system && pull.at.u === orbit.u && pull.at.v === orbit.v;
    if (pull && (!stays || pull.keys[1] !== place)) this.ghosts = [];
    if (stays) pull.keys = [system, place];
    else this.pull = null;
    return this.pull;
  }

  /** What is said of the start: how large it is, and when it stops. */
  get words() {
    const { pull, store: { orbit, motion, contact, timeFactor } } = this;
    if (!pull) return "";
    const { c, along } = sizeOf(orbit, pull.base);
    const [before, after] = [pull.stop, motion.stop].map((tau) => (contact ? `${shown(tau * timeFactor, 4)} s` : `τ = ${shown(tau, 4)}`));
    return along ? `Speeds × ${shown(c, 3)}: same curve, ${shown(c, 3)} × the time: ${after}.`
      : `Another curve: it stops after ${after} (before: ${before}).`;
  }
}
