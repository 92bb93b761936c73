// A start that is pulled, or made larger by the slider: along its ray it runs through its copies, c times as large; across,
// it changes curve.
import { $ } from "../dom.js";
import { forgiveTouches } from "../controls/fields.js";
import { shown } from "../numbers.js";
import { moved } from "../state/page_state.js";

const narrow = 8;    // degrees beside the ray, with both speeds in units of the start's
const most = 12;     // starts of one pull whose curves stay
const apart = 0.12;  // of the start: how far they are from each other
const decades = 4;      // to either end of the slider
const vanished = 0.04;  // of the window: a start so small is looked for in the blown-up origin
const hints = { uv: "", disc: " The outer circle is infinity.", blowup: " The inner circle is rest." };

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
  /** @type {(Speeds & {stop: number, motion: Motion, lines: Float64Array[]})[]} where it has been */
  ghosts = [];

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
    if (this.now?.from !== this.slider) this.slider.value = 0;
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

  /**
   * The chosen start, c times as large: one that leaves the plane flies to the rim of the disc, one that vanishes in it into
   * the blown-up origin.
   */
  resize(c) {
    const { slider, store, store: { state: { chosen }, orbit } } = this;
    if (!orbit) return;
    const pull = this.begin(chosen, slider);
    const { base, window } = pull;
    const at = pull.at = { u: Number((c * base.u).toPrecision(6)), v: Number((c * base.v).toPrecision(6)) };
    const share = Math.max(Math.abs(at.u) / window[0], at.v / window[1]);
    const view = share > 1 ? "disc" : share < vanished ? "blowup" : "uv";
    store.ask((state) => {
      state.orbits[chosen] = moved(orbit, at.u, at.v);
      Object.assign(state, { view, window, fraction: 0, isochrone: 0 });
    }, () => this.announce(this.words + hints[view]));
  }

  /** Remembers where the start is now. */
  note() {
    const { pull, ghosts, store: { orbit } } = this;
    if (!pull) return;
    const share = (a, b, of) => Math.abs(a - b) / (Math.abs(of) || 1);
    const near = ghosts.some(({ u, v }) => Math.max(share(u, orbit.u, pull.base.u), share(v, orbit.v, pull.base.v)) < apart);
    if (!near) this.ghosts = [...ghosts.slice(-most + 1), this.ghost(orbit)];
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
