// A start that the reader pulls. Along its ray it becomes a copy, c times as large; across the ray it moves to another curve.
import { shown } from "../numbers.js";

const narrow = 8;    // degrees beside the ray that count as on it, with both speeds divided by those of the start
const most = 12;     // starts of one pull whose curves stay
const apart = 0.12;  // least distance between two of them, divided by the start

/** Returns c, the size of a start divided by that of another, and along: true for a copy, with both speeds times c. */
export function sizeOf({ u, v }, base) {
  const [x, y] = [u / base.u, v / base.v];
  if (base.u === 0 || base.v === 0) return { c: base.u === 0 ? y : x, along: base.u === 0 ? u === 0 : v === 0 };
  const angle = (Math.atan2(y, x) * 180) / Math.PI;
  return { c: Math.hypot(x, y) / Math.SQRT2, along: Math.abs(angle - 45) < narrow };
}

export class Copies {
  /**
   * The pull, with the place of the start now.
   * @type {{from: unknown, index: number, base: Speeds, at: Speeds, window: [number, number], stop: number, keys: string[]} | null}
   */
  pull = null;
  /** @type {(OwnOrbit & {start: Speeds})[]} orbits from earlier places of the start */
  ghosts = [];

  /** @param {Store} store */
  constructor(store) { this.store = store; }

  /** Keys of the curves except their starts, and of their places in the panels. */
  get keys() {
    const { law, mu, chi, gamma, view, window } = this.store.request;
    return [[law, mu, chi, gamma], [view, window ?? this.store.portrait.window]].map((key) => JSON.stringify(key));
  }

  /** Returns the pull of a start: the present one if `from` is the same, else a new one. @param sizes  sizes of copies that are shown at once */
  begin(index, from, sizes = /** @type {number[]} */ ([])) {
    const { store: { state, portrait: { window }, library: { plane } } } = this;
    if (this.now && this.now.from === from) return this.now;
    const { u, v } = state.orbits[index];
    this.ghosts = sizes.map((c) => this.ghost({ u: c * u, v: c * v }));
    return (this.pull = { from, index, base: { u, v }, at: { u, v }, window, stop: plane.stop(u, v), keys: this.keys });
  }

  /** Returns the start for a place to which it is pulled: on its ray if this is near. @param from  the same during one pull */
  to(at, index, from) {
    const pull = this.begin(index, from, [1, 1 / 2, 1 / 4, 1 / 8]);
    const { c, along } = sizeOf(at, pull.base);
    const times = Number(c.toPrecision(3));
    return (pull.at = along ? { u: times * pull.base.u, v: times * pull.base.v } : at);
  }

  /** Keeps the present orbit as an earlier one. */
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

  /** The pull; null if the start has moved in another way. */
  get now() {
    const { pull, keys: [system, place], store: { state, orbit } } = this;
    const stays = pull && orbit && pull.index === state.chosen && pull.keys[0] === system && pull.at.u === orbit.u && pull.at.v === orbit.v;
    if (pull && (!stays || pull.keys[1] !== place)) this.ghosts = [];
    if (stays) pull.keys = [system, place];
    else this.pull = null;
    return this.pull;
  }

  /** A sentence about the start: its size and its stop time. */
  get words() {
    const { pull, store: { orbit, motion, contact, timeFactor } } = this;
    if (!pull) return "";
    const { c, along } = sizeOf(orbit, pull.base);
    const [before, after] = [pull.stop, motion.stop].map((tau) => (contact ? `${shown(tau * timeFactor, 4)} s` : `τ = ${shown(tau, 4)}`));
    return along ? `Speeds × ${shown(c, 3)}: same curve, ${shown(c, 3)} × the time: ${after}.`
      : `Another curve: it stops after ${after} (before: ${before}).`;
  }
}
