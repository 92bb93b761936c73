// The window of the plane: as the library chooses it for the orbits, or as the reader has zoomed.
import { isStill } from "../dom.js";
import { superscript } from "../numbers.js";

const farthest = 30;  // decades that one zoom goes on for

export class Zooming {
  /** @type {number[] | null | undefined} the window before the reader zoomed */
  before = undefined;
  running = {};

  /** @param {Store} store */
  constructor(store, announce) {
    this.store = store;
    this.announce = announce;
  }

  /** Keeps the window as it is, in this view; unless a start lies beyond it, which is to be seen. */
  freeze(state, { u, v } = { u: 0, v: 0 }) {
    const [U, V] = this.store.portrait.window;
    if (this.before === undefined) this.before = state.window;
    state.window = Math.abs(u) > U || v > V ? null : state.window ?? [U, V];
  }

  by(factor, from = this.store.portrait.window, text = "") {
    this.store.ask((state) => {
      this.freeze(state);
      state.window = from.map((side) => Number((side * factor).toPrecision(4)));
    }, () => text && this.announce(text));
  }

  /** A decade a second, until the reader does something; a decade where he wants no motion. */
  forEver() {
    const from = this.store.portrait.window;
    const run = this.running = {};
    const closer = (decades) => (decades < 1 ? "Closer" : `10${superscript(Math.floor(decades))} times closer`);
    const to = (decades) => this.by(10 ** -decades, from,
      `${closer(decades)}: the numbers on the axes change, the curves do not. Every size looks alike.`);
    if (isStill()) return to(1);
    const began = performance.now();
    const step = (time) => {
      if (this.running !== run) return;
      const decades = Math.max(0, time - began) / 1000;
      to(Math.min(farthest, decades));
      if (decades < farthest) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    const stop = () => (this.running = {});
    for (const event of ["pointerdown", "keydown", "wheel"]) addEventListener(event, stop, { once: true, capture: true });
  }

  /** The library's choice again. */
  fit() {
    this.before = undefined;
    this.store.ask((state) => (state.window = null));
  }

  /** Another view, in a window of its own. */
  view(name) {
    this.store.ask((state) => {
      if (this.before !== undefined) state.window = this.before;
      this.before = undefined;
      state.view = name;
    });
  }
}
