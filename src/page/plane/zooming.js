// The window of the plane: as the library chooses it for the orbits, or as the reader has zoomed.
import { isStill } from "../dom.js";
import { superscript } from "../numbers.js";

const farthest = 30;  // decades that one zoom goes on for

export class Zooming {
  /** @type {number[] | null | undefined} the window before the reader zoomed */
  before = undefined;
  running = {};

  /** @param {import("../state/store.js").Store} store @param act  ask(edit, done), announce(text) */
  constructor(store, act) {
    this.store = store;
    this.act = act;
  }

  /** Keeps the window as it is, in this view. */
  freeze(state) {
    if (this.before === undefined) this.before = state.window;
    state.window ??= this.store.portrait.window;
  }

  by(factor, from = this.store.portrait.window, text = "") {
    this.act.ask((state) => {
      this.freeze(state);
      state.window = from.map((side) => Number((side * factor).toPrecision(4)));
    }, () => text && this.act.announce(text));
  }

  /** A decade a second, until the reader does something; a decade where he wants no motion. */
  forEver() {
    const from = this.store.portrait.window;
    const run = this.running = {};
    const to = (decades) => this.by(10 ** -decades, from, `${decades < 1 ? "Closer" : `10${superscript(Math.floor(decades))} times closer`}: the numbers run, the curves stand still. All sizes are one.`);
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
    this.act.ask((state) => (state.window = null));
  }

  /** Another view, in a window of its own. */
  view(name) {
    this.act.ask((state) => {
      if (this.before !== undefined) state.window = this.before;
      this.before = undefined;
      state.view = name;
    });
  }
}
