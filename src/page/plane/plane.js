// The plane under the reader's hand: pointing, starting and choosing orbits, zooming.
import { $, write } from "../dom.js";
import { Copies } from "./copies.js";
import { listen } from "../drawing/gestures.js";
import { drawPortrait } from "../drawing/figure.js";
import { plain } from "../drawing/runs.js";
import { shown } from "../numbers.js";
import { moved, startOf } from "../state/page_state.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { Zooming } from "./zooming.js";

const none = [];
const reach = { touch: 24, mouse: 10 };  // pixels from which a start or an orbit is taken hold of

export class Plane {
  /** @type {Frame[]} */
  frames = [];
  planeScene = /** @type {ReturnType<Plane["scene"]>} */ ({});
  /** @type {{of: Figure, figure: Figure} | null} the figure, and its form outside the Lab */
  bare = null;
  /** @type {{panel: number, x: number, y: number} | null} */
  cross = null;
  announce = (text) => write($("pointed"), text || "\u00a0");

  /** @param {Store} store */
  constructor(store) {
    this.store = store;
    this.copies = new Copies(store);
    this.zooming = new Zooming(store);
    this.surface = new ScreenSurface($("plane"), (surface) => {
      surface.fit(store.library.rowsOf(store.portrait.figure, surface.width));
      this.planeScene = this.scene();
      this.frames = drawPortrait(surface, this.planeScene, store);
    });
    listen($("plane"), {
      hold: (x, y, kind) => this.startAt(x, y, kind),
      pull: (x, y, index, from) => this.moveStart(this.pointed(x, y), index, from, true),
      release: () => store.move({ isochrone: 0 }),
      tap: (x, y, kind) => {
        this.cross = null;
        this.choose(x, y, kind);
      },
      drag: (x, y) => this.drawIsochrone(x, y),
      point: (x, y) => this.describe(this.pointed(x, y)),
      leave: () => {
        if (!this.cross) return;
        this.cross = null;
        this.draw();
      },
      move: (dx, dy) => this.moveCross(dx, dy),
      panel: () => this.moveCross(0, 0, ((this.cross?.panel ?? -1) + 1) % this.frames.length),
      enter: () => this.atCross((x, y) => this.choose(x, y, "key")),
      isochrone: () => this.atCross((x, y) => this.drawIsochrone(x, y)),
      clear: () => this.clear(),
      zoom: (factor) => this.zooming.by(factor),
      remove: () => store.motion && this.removeOrbit(store.state.chosen),
    });
    const { zooming } = this;
    const buttons = { "zoom-in": () => zooming.by(0.7), "zoom-out": () => zooming.by(1 / 0.7), "fit": () => zooming.fit(), "clear-isochrone": () => this.clear() };
    for (const [id, action] of Object.entries(buttons)) $(id).addEventListener("click", action);
    store.shows.push(() => this.label());
  }

  /** The portrait's figure; outside the Lab without title, legend and symbols. */
  get figure() {
    const { state: { lab, ball }, portrait: { figure }, view } = this.store;
    if (lab || view.name !== "uv") return figure;
    if (this.bare?.of !== figure) {
      const unit = ball ? ", m/s" : "";
      const panels = figure.panels.map((panel) => ({
        ...panel, x: { ...panel.x, name: `rim speed of the spin${unit}` }, y: { ...panel.y, name: `sliding speed${unit}` },
        lines: panel.lines.map((line) => ({ ...line, legend: "" })), marks: panel.marks.map((mark) => ({ ...mark, legend: "" })),
      }));
      this.bare = { of: figure, figure: { ...figure, panels, title: "", colour_bar: undefined } };
    }
    return this.bare.figure;
  }

  scene() {
    const { state, motions, motion, now, isochrone, library } = this.store;
    const own = motions.map((orbit, index) => {
      const { u, v } = state.orbits[index];
      return { ...orbit, index, chosen: index === state.chosen, start: library.plane.place(u, v) };
    }).sort((a, b) => Number(a.chosen) - Number(b.chosen));
    return {
      figure: this.figure, isochrone, ghosts: this.copies.now ? this.copies.ghosts : none, own, cross: this.cross,
      marker: now && now.tau < motion.stop ? { index: state.chosen, places: now.places } : null,
    };
  }

  draw() {
    this.surface.drawInSight();
    $("clear-isochrone").hidden = !this.store.state.isochrone;
  }

  /** Sets the label of the plane for screen readers, without values that change with the moment. */
  label() {
    const { portrait, state, motion } = this.store;
    this.announce("");
    const legend = portrait.figure.panels.flatMap((panel) => panel.lines).map((layer) => plain(layer.legend)).filter(Boolean);
    const count = state.orbits.length;
    $("plane").setAttribute("aria-label",
      `Phase portrait, view ${this.store.view.title}: ${plain(portrait.figure.title)}; it shows ` +
      `${[...new Set(legend)].join(", ") || "orbits"}; ${count} ${count === 1 ? "orbit" : "orbits"} of yours` +
      (motion ? `; the chosen one stops at ${this.store.stopText(motion.stop)}` : ""));
  }

  /** The panel under a pixel, with the numbers there; none beside and between them. */
  panelAt(x, y) {
    const index = this.frames.findIndex((frame) => frame.contains(x, y));
    return index < 0 ? null : { index, frame: this.frames[index], ...this.frames[index].at(x, y) };
  }

  pointed(x, y) {
    const at = this.panelAt(x, y);
    return at && this.store.library.plane.at(at.index, at.x, at.y);
  }

  /** The number of the orbit whose start lies under a pixel; the chosen one first. */
  startAt(x, y, kind) {
    const at = this.panelAt(x, y);
    if (!at) return null;
    const near = this.planeScene.own.filter(({ start }) =>
      Math.hypot(at.frame.px(start[2 * at.index]) - x, at.frame.py(start[2 * at.index + 1]) - y) <= reach[kind]);
    return near.at(-1)?.index ?? null;
  }

  /** The number of the orbit that passes under a pixel. */
  orbitAt(x, y, kind) {
    const at = this.panelAt(x, y);
    if (!at) return null;
    /** @type {number | null} */
    let nearest = null;
    let least = reach[kind] ** 2;
    for (const { panels, index } of this.planeScene.own) {
      for (const line of at.frame.lines(panels[at.index].line)) for (let i = 0; i + 3 < line.length; i += 2) {
        const [dx, dy] = [line[i + 2] - line[i], line[i + 3] - line[i + 1]];
        const along = Math.max(0, Math.min(1, ((x - line[i]) * dx + (y - line[i + 1]) * dy) / (dx * dx + dy * dy || 1)));
        const distance = (line[i] + along * dx - x) ** 2 + (line[i + 1] + along * dy - y) ** 2;
        if (distance <= least) [nearest, least] = [index, distance];
      }
    }
    return nearest;
  }

  choose(x, y, kind) {
    const { store } = this;
    const index = kind === "key" ? null : this.startAt(x, y, kind) ?? this.orbitAt(x, y, kind);
    const start = this.pointed(x, y);
    if (index !== null) this.chooseOrbit(index);
    else if (start) this.startOrbit(rounded(start, store.portrait));
    else this.announce("Nothing is here.");
  }

  chooseOrbit(index) { this.store.ask((state) => Object.assign(state, { chosen: index, fraction: 0 })); }

  removeOrbit(index) {
    this.store.ask((state) => {
      state.orbits.splice(index, 1);
      if (state.chosen >= index) state.chosen -= 1;
      state.fraction = 0;
    });
  }

  /** @param start  speeds, heading of a throw, and along and across of a stroke @param ask  store.ask, or a function that throws the reason of a rejection */
  startOrbit({ u, v, along = v, across = 0, heading = 0 }, ask = (edit, done) => this.store.ask(edit, done)) {
    const { store } = this;
    ask((state) => {
      this.zooming.freeze(state, { u, v });
      state.orbits.push(startOf(u, v, along, across, heading));
      Object.assign(state, { chosen: state.orbits.length - 1, fraction: 0, isochrone: 0 });
    }, () => this.announce(
      `Orbit from u = ${shown(u, 4)}, v = ${shown(v, 4)}: it stops at ${store.stopText(store.motion.stop)}.`));
  }

  /** @param from  the same during one pull @param held  true: shows its isochrone, too */
  moveStart(at, index, from, held = false) {
    if (!at) return;
    const { u, v } = this.copies.to(rounded(at, this.store.portrait), index, from);
    const isochrone = held ? this.store.library.plane.stop(u, v) : 0;
    this.store.ask((state) => {
      this.zooming.freeze(state);
      state.orbits[index] = moved(state.orbits[index], u, v);
      Object.assign(state, { chosen: index, fraction: 0, isochrone });
    }, () => {
      const { ghosts } = this.copies;
      this.copies.note();
      this.announce(this.copies.words);
      if (ghosts !== this.copies.ghosts) this.draw();
    });
  }

  drawIsochrone(x, y) {
    const at = this.pointed(x, y);
    if (!at) return;
    const tau = this.store.library.plane.stop(at.u, at.v);
    this.store.move({ isochrone: tau });
    this.announce(`All states on the dotted line stop at ${this.store.stopText(tau)}. ✕ clears it.`);
  }

  clear() {
    this.cross = null;
    this.announce("");
    this.store.move({ isochrone: 0 });
  }

  /** The cross that keys move. */
  moveCross(dx, dy, panel = Math.min(this.cross?.panel ?? 0, this.frames.length - 1)) {
    const frame = this.frames[panel];
    const { x, y } = this.cross?.panel === panel ? this.cross : { x: (frame.x.low + 2 * frame.x.high) / 3, y: (frame.y.low + frame.y.high) / 2 };
    const moved = frame.at(frame.px(x) + dx * frame.width / 40, frame.py(y) - dy * frame.height / 40);
    this.cross = { panel, ...moved };
    this.draw();
    this.describe(this.pointed(frame.px(moved.x), frame.py(moved.y)), "Nothing is here.");
  }

  atCross(action) {
    if (!this.cross) return;
    const frame = this.frames[this.cross.panel];
    action(frame.px(this.cross.x), frame.py(this.cross.y));
  }

  describe(at, otherwise = "") {
    if (!at) return this.announce(otherwise);
    const { store, store: { state: { mu }, library: { plane } } } = this;
    this.announce(`u = ${shown(at.u, 4)}, v = ${shown(at.v, 4)}, k = ${shown(at.v / (mu * Math.abs(at.u)), 4)}: ` +
      `stops at ${store.stopText(plane.stop(at.u, at.v))}`);
  }
}

/** Returns a start rounded to the digits that a pixel resolves. */
function rounded({ u, v }, { window: [U, V] }) {
  const to = (value, side) => {
    const digits = Math.max(3, 4 - Math.floor(Math.log10(side / Math.max(Math.abs(value), 1e-300))));
    return Number(value.toPrecision(Math.min(4, digits)));
  };
  return { u: Math.abs(u) < 1e-9 * U ? 0 : to(u, U), v: to(v, V) };
}
