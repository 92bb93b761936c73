// A rectangle of a figure with its two axes: from numbers to pixels, and back.
import { ticks, tickText } from "./numbers.js";
import { widthOf } from "./surface.js";

export class Frame {
  /**
   * @typedef {{left: number, top: number, width: number, height: number}} Box  in pixels
   * @typedef {{low: number, high: number, label?: string, tick?: (value: number) => string, ticks?: Tick[]}} Range
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

  /** Whether a pixel is in the frame, its border included. */
  contains(pixelX, pixelY) {
    return pixelX >= this.left - 1 && pixelX <= this.left + this.width + 1 && pixelY >= this.top - 1 && pixelY <= this.top + this.height + 1;
  }

  /** The numbers at a pixel, kept inside the frame. */
  at(pixelX, pixelY) {
    const within = (fraction) => Math.min(1, Math.max(0, fraction));
    return {
      x: this.x.low + within((pixelX - this.left) / this.width) * (this.x.high - this.x.low),
      y: this.y.high - within((pixelY - this.top) / this.height) * (this.y.high - this.y.low),
    };
  }

  /** The lines through a flat column of points x0, y0, x1, y1, ..., NaN between them, in pixels. */
  lines(/** @type {ArrayLike<number>} */ points) {
    /** @type {number[][]} */
    const lines = [[]];
    for (let i = 0; i < points.length; i += 2) {
      if (Number.isNaN(points[i])) lines.push([]);
      else lines[lines.length - 1].push(this.px(points[i]), this.py(points[i + 1]));
    }
    return lines;
  }

  /** The line through columns of numbers, as long as the shorter one; without those that are not finite. */
  line(xs, ys) {
    const line = [];
    for (let i = 0; i < Math.min(xs.length, ys.length); ++i) {
      if (Number.isFinite(ys[i])) line.push(this.px(xs[i]), this.py(ys[i]));
    }
    return line;
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
    const bottom = this.top + this.height;
    surface.lines([[this.left, this.top, this.left, bottom, this.left + this.width, bottom]], { colour: theme.soft });
    for (const { at, text } of this.ticksOf(this.x, this.width / 85)) {
      const x = this.px(at);
      surface.lines([[x, bottom, x, bottom + 4]], { colour: theme.soft });
      if (this.x.label !== undefined) surface.text(x, bottom + 6, text, { ...style, align: "center", baseline: "top" });
    }
    for (const { at, text } of this.ticksOf(this.y, this.height / 55)) {
      const y = this.py(at);
      surface.lines([[this.left - 4, y, this.left, y]], { colour: theme.soft });
      surface.text(this.left - 6, y, text, { ...style, align: "right", baseline: "middle" });
    }
    const label = { colour: theme.ink, size: size + 1 };
    if (this.x.label) {
      surface.text(this.left + this.width / 2, bottom + 6 + 1.5 * size, this.x.label, { ...label, align: "center", baseline: "top" });
    }
    if (this.y.label) {
      surface.text(this.left - Math.max(3.6 * size, this.roomForTicks(size) + size), this.top + this.height / 2, this.y.label, { ...label, align: "center", baseline: "middle", turned: true });
    }
  }
}
