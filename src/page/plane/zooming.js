// The window of the plane: chosen by the library for the orbits, or zoomed by the reader.

export class Zooming {
  /** @type {number[] | null | undefined} the window before the reader zoomed */
  before = undefined;

  /** @param {Store} store */
  constructor(store) { this.store = store; }

  /** Keeps the present window in this view, unless a new start lies outside it. */
  freeze(state, { u, v } = { u: 0, v: 0 }) {
    const [U, V] = this.store.portrait.window;
    if (this.before === undefined) this.before = state.window;
    if (state.line) return;  // a link of the game has no window
    state.window = Math.abs(u) > U || v > V ? null : state.window ?? [U, V];
  }

  by(factor) {
    this.store.ask((state) => {
      this.freeze(state);
      state.window = this.store.portrait.window.map((side) => Number((side * factor).toPrecision(4)));
    });
  }

  /** Returns to the window that the library chooses. */
  fit() {
    this.before = undefined;
    this.store.ask((state) => (state.window = null));
  }

  /** Changes to another view, with a window of its own. */
  view(name) {
    this.store.ask((state) => {
      if (this.before !== undefined) state.window = this.before;
      this.before = undefined;
      state.view = name;
    });
  }
}
