// A start that is pulled: along its ray it runs through its copies, c times as large; across, it changes curve.
import { shown } from "../numbers.js";

const narrow = 8;    // degrees beside the ray, with both speeds in units of the start's
const most = 12;     // starts of one pull whose curves stay
const apart = 0.12;  // of the start: how far they are from each other

/** How many times as large a start is as another, and whether it is a copy of it: both speeds by one factor. */
export function sizeOf({ u, v }, base) {
  const [x, y] = [u / base.u, v / base.v];
  if (base.u === 0 || base.v === 0) return { c: base.u === 0 ? y : x, along: base.u === 0 ? u === 0 : v === 0 };
  const angle = (Math.atan2(y, x) * 180) / Math.PI;
  return { c: Math.hypot(x, y) / Math.SQRT2, along: Math.abs(angle - 45) < narrow };
}

export class Copies {
  /** @type {{from: unknown, index: number, base: Speeds, at: Speeds, stop: number, key: string} | null} the pull, and where the start is now */
  pull = null;
  /** @type {{u: number, v: number, stop: number, motion: Motion, lines: Float64Array[]}[]} where it has been */
  ghosts = [];

  constructor(store) {
    this.store = store;
  }

  /** What the curves depend on but for their starts. */
  get key() {
    const { law, mu, chi, gamma, view, window } = this.store.request;
    return JSON.stringify([law, mu, chi, gamma, view, window ?? this.store.portrait.window]);
  }

  /** Where the start goes that is pulled to a place: on its ray, if that is near. @param from  the same during one pull */
  to(at, index, from) {
    const { store, store: { library: { plane } } } = this;
    if (!this.pull || this.pull.from !== from) {
      const { u, v } = store.state.orbits[index];
      this.pull = { from, index, base: { u, v }, at: { u, v }, stop: plane.stop(u, v), key: this.key };
      this.ghosts = [1, 1 / 2, 1 / 4, 1 / 8].map((c) => this.ghost({ u: c * u, v: c * v }));
    }
    const { pull, pull: { base } } = this;
    const { c, along } = sizeOf(at, base);
    const times = Number(c.toPrecision(3));
    return (pull.at = along ? { u: times * base.u, v: times * base.v } : at);
  }

  /** Remembers where the start is now, and says what it is. */
  note() {
    const { pull, ghosts, store: { orbit, motion } } = this;
    if (!pull) return "";
    const { base } = pull;
    const share = (a, b, of) => Math.abs(a - b) / (Math.abs(of) || 1);
    const near = ghosts.some(({ u, v }) => Math.max(share(u, orbit.u, base.u), share(v, orbit.v, base.v)) < apart);
    if (!near) this.ghosts = [...ghosts.slice(-most + 1), this.ghost(orbit)];
    return pullWords(sizeOf(orbit, base), pull.stop, motion.stop, this.store);
  }

  ghost({ u, v }) {
    const { library: { plane } } = this.store;
    const motion = plane.motion(u, v);
    const places = Array.from(motion.u, (at, i) => plane.place(at, motion.v[i]));
    const panels = places[0].length / 2;
    const lines = Array.from({ length: panels }, (_, panel) => Float64Array.from(places.flatMap((place) => [...place.subarray(2 * panel, 2 * panel + 2)])));
    return { u, v, stop: plane.stop(u, v), motion, lines };
  }

  /** The pull, while the start is where it was pulled to. */
  get now() {
    const { pull, store: { state, orbit } } = this;
    const stays = pull && orbit && pull.index === state.chosen && pull.key === this.key && pull.at.u === orbit.u && pull.at.v === orbit.v;
    if (!stays && pull) [this.pull, this.ghosts] = [null, []];
    return this.pull;
  }
}

/** What is said of a start that many times as large, before and after: stop times. */
export const pullWords = ({ c, along }, before, after, { contact, timeFactor }) => {
  const time = (tau) => (contact ? `${shown(tau * timeFactor, 4)} s` : `τ = ${shown(tau, 4)}`);
  return along ? `A copy, c = ${shown(c, 3)}: it stops after ${time(after)}, c times ${time(before)}.`
    : `Another curve: it stops after ${time(after)}, the first after ${time(before)}.`;
};
