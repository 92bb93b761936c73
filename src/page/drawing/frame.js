// A rectangle of a figure with its two axes: from numbers to pixels, and back.
import { ticks, tickText } from "../numbers.js";
import { widthOf } from "./surface.js";

export class Frame {
  /**
   * @typedef {{left: number, top: number, width: number, height: number}} Box  in pixels
   * @typedef {{low: number, high: number, label?: Words, tick?: (value: number) => string, ticks?: Tick[]}} Range
   *   tick turns a tick into its text; ticks count if there are any; without a label nothing is written below the axis
   * @param {Box} place
   * @param {Range} x
   * @param {Range} y
   */
  constructor(place, x, y) {
    this.left = place.left;
    this.top = place.top;
    this.width = place.width;
    this.height = place.height;
    this.x = x;
    this.y = y;
  }

  px(value) {
    return this.left + ((value - this.x.low) / (this.x.high - this.x.low)) * this.width;
  }

  py(value) {
    return this.top + ((this.y.high - value) / (this.y.high - this.y.low)) * this.height;
  }

  /** Where a point of a flat column is. */
  pixel(/** @type {ArrayLike<number>} */ points, at = 0) {
    return [this.px(points[at]), this.py(points[at + 1])];
  }

  /** Whether a pixel is in the frame, its border included. */
  contains(pixelX, pixelY) {
    const near = (value, from, size) => value >= from - 1 && value <= from + size + 1;
    return near(pixelX, this.left, this.width) && near(pixelY, this.top, this.height);
  }

  /** The numbers at a pixel, kept inside the frame. */
  at(pixelX, pixelY) {
    const within = (fraction) => Math.min(1, Math.max(0, fraction));
    return {
      x: this.x.low + within((pixelX - this.left) / this.width) * (this.x.high - this.x.low),
      y: this.y.high - within((pixelY - this.top) / this.height) * (this.y.high - this.y.low),
    };
  }

  /** The lines through a flat column of points x0, y0, x1, y1, ..., in pixels; what is not finite lies between two lines. */
  lines(/** @type {ArrayLike<number>} */ points) {
    /** @type {number[]} */
    let line = [];
    const lines = [line];
    for (let i = 0; i < points.length; i += 2) {
      if (Number.isFinite(points[i] + points[i + 1])) line.push(this.px(points[i]), this.py(points[i + 1]));
      else lines.push((line = []));
    }
    return lines;
  }

  /** The texts of the ticks: {at, text} of each, about `wanted` of them. */
  ticksOf(axis, wanted) {
    if (axis.ticks?.length) return axis.ticks;
    const values = ticks(axis.low, axis.high, Math.max(2, wanted));
    const step = values.length > 1 ? values[1] - values[0] : 1;
    return values.map((at) => ({ at, text: axis.tick ? axis.tick(at) : tickText(at, step) }));
  }

  /** The room that the ticks of y need beside the frame. */
  roomForTicks(size) {
    return 6 + Math.max(0, ...this.ticksOf(this.y, this.height / 55).map(({ text }) => widthOf(text, { size })));
  }

  draw(surface, theme) {
    const size = theme.textSize;
    const style = { colour: theme.soft, size };
    const label = { colour: theme.ink, size: size + 1, align: "center" };
    const [bottom, right] = [this.top + this.height, this.left + this.width];
    const lines = [[this.left, this.top, this.left, bottom, right, bottom]];
    let free = -Infinity;
    for (const { at, text } of this.ticksOf(this.x, this.width / 85)) {
      const [x, half] = [this.px(at), widthOf(text, { size }) / 2];
      lines.push([x, bottom, x, bottom + 4]);
      if (this.x.label === undefined || x - half < free) continue;
      free = x + half + 0.4 * size;
      surface.text(x, bottom + 6, text, { ...style, align: "center", baseline: "top" });
    }
    for (const { at, text } of this.ticksOf(this.y, this.height / 55)) {
      const y = this.py(at);
      lines.push([this.left - 4, y, this.left, y]);
      surface.text(this.left - 6, y, text, { ...style, align: "right", baseline: "middle" });
    }
    surface.shape(lines, { stroke: theme.soft });
    if (this.x.label) surface.text(this.left + this.width / 2, bottom + 6 + 1.5 * size, this.x.label, { ...label, baseline: "top" });
    if (this.y.label) {
      const beside = Math.max(3.6 * size, this.roomForTicks(size) + size);
      surface.text(this.left - beside, this.top + this.height / 2, this.y.label, { ...label, baseline: "middle", turned: true });
    }
  }
}
