// The ruler of the balls' picture, or the bar of its scale: dragged by an end or as a whole, or moved by keys, it measures any length.
import { length } from "../numbers.js";

const reach = { touch: 20, mouse: 9 };  // pixels beside it from which it is taken hold of
const level = 6;  // pixels of height between its ends that count as none
const parts = ["to", "from", "both"];  // that keys move, in turn
const names = { to: "its far end", from: "its near end", both: "all of it" };

/**
 * @typedef {{x: number, y: number}} Place  m, of the table of the second body
 * @typedef {{part: string, from: Place, to: Place, at: number[]}} Held  as it was when it was taken hold of; at: in pixels
 */
export class Ruler {
  /** @type {{from: Place, to: Place, of: string} | null} where the reader has put it, on the table of what */
  own = null;
  /** @type {string | undefined} what keys move */
  part = undefined;

  /** @param {Hero} hero */
  constructor(hero) {
    this.hero = hero;
  }

  /** What the ruler is of. */
  get table() {
    const { state: { ball, body } } = this.hero.store;
    return ball?.name ?? body;
  }

  /** The reader's, if he has moved it. */
  get placed() {
    if (this.own && this.own.of !== this.table) this.reset();
    return this.own;
  }

  get words() {
    const { own, hero: { store } } = this;
    return own ? length(Math.hypot(own.to.x - own.from.x, own.to.y - own.from.y), store.contact ? "m" : "") : "";
  }

  /** What of it lies under a pixel. @returns {Held | null} */
  at(x, y, kind) {
    const { rulerEnds: ends, toTable } = this.hero;
    if (!ends) return null;
    const near = ends.map(([ex, ey]) => Math.hypot(ex - x, ey - y));
    const [[ax, ay], [bx, by]] = ends;
    const share = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2 || 1);
    const beside = Math.hypot(ax + share * (bx - ax) - x, ay + share * (by - ay) - y);
    const part = Math.min(...near) <= reach[kind] ? (near[1] <= near[0] ? "to" : "from") : share > 0 && share < 1 && beside <= reach[kind] ? "both" : null;
    return part && { part, from: toTable(ax, ay), to: toTable(bx, by), at: [x, y] };
  }

  /** Moves what is held as the hand has gone. */
  pull({ part, from, to, at }, x, y) {
    const { hero, hero: { toTable } } = this;
    const [a, b] = [toTable(at[0], at[1]), toTable(x, y)];
    const moved = (end, name) => (part === name || part === "both" ? { x: end.x + b.x - a.x, y: end.y + b.y - a.y } : { ...end });
    const own = this.own = { from: moved(from, "from"), to: moved(to, "to"), of: this.table };
    const pixel = toTable(x, y + level).y - b.y;
    if (part !== "both" && Math.abs(own.to.y - own.from.y) < Math.abs(pixel)) own[part].y = own[part === "to" ? "from" : "to"].y;
    hero.lanes.draw();
  }

  /** The next part is what keys move; after the last, none. */
  next() {
    this.part = parts[this.part ? parts.indexOf(this.part) + 1 : 0];
    if (this.part) this.move(0, 0);
    else this.hero.say("");
  }

  move(dx, dy) {
    const { rulerEnds: ends, toTable } = this.hero;
    if (!ends || !this.part) return;
    const [from, to] = this.own ? [this.own.from, this.own.to] : ends.map(([x, y]) => toTable(x, y));
    this.pull({ part: this.part, from, to, at: [0, 0] }, dx, -dy);
    this.hero.say(`The ruler: ${this.words}. Arrow keys move ${names[this.part]}, r goes to the next part, Escape puts the ruler back.`);
  }

  reset() {
    this.own = null;
    this.part = undefined;
    this.hero.say("");
  }
}
