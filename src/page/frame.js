// A rectangle of a figure with its two axes: from numbers to pixels, and back.
import { ticks, tickText } from "./numbers.js";
import { widthOf } from "./surface.js";

export class Frame {
  /**
   * @param place  {left, top, width, height} in pixels
   * @param x, y   {low, high, label, tick, ticks}: the range; tick, if given, turns a tick into its text; ticks, if given
   *               and not empty, are {at, text}. A label of undefined: nothing is written below the axis
   */
  constructor(place, x, y) {
    Object.assign(this, place, { x, y });
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
    const within = (share) => Math.min(1, Math.max(0, share));
    return {
      x: this.x.low + within((pixelX - this.left) / this.width) * (this.x.high - this.x.low),
      y: this.y.high - within((pixelY - this.top) / this.height) * (this.y.high - this.y.low),
    };
  }

  /** The line through a flat column of points x0, y0, x1, y1, ...; what lies beyond one side is left out. */
  path(points) {
    const { left, top, width, height } = this;
    const [perX, perY] = [width / (this.x.high - this.x.low), height / (this.y.high - this.y.low)];
    const sideOf = (x, y) => (x < left ? 1 : x > left + width ? 2 : 0) | (y < top ? 4 : y > top + height ? 8 : 0);
    const line = [];
    let [lastX, lastY, lastSide] = [NaN, NaN, 0];
    let waiting = false;  // whether the last point was left out
    for (let i = 0; i < points.length; i += 2) {
      const x = this.bounded(left + (points[i] - this.x.low) * perX, left, width);
      const y = this.bounded(top + (this.y.high - points[i + 1]) * perY, top, height);
      if (Number.isNaN(x) || Number.isNaN(y)) continue;
      const side = sideOf(x, y);
      const leftOut = i + 2 < points.length && line.length > 0 &&
        ((side !== 0 && side === lastSide) || (Math.abs(x - line.at(-2)) < 0.3 && Math.abs(y - line.at(-1)) < 0.3));
      // The line comes back from where it was last, not from where it went out.
      if (!leftOut && waiting && side !== lastSide) line.push(lastX, lastY);
      if (!leftOut) line.push(x, y);
      waiting = leftOut;
      [lastX, lastY, lastSide] = [x, y, side];
    }
    return line;
  }

  /** The line through columns of numbers, as long as the shorter one, without points that nobody would see. */
  line(xs, ys) {
    const line = [];
    let [lastX, lastY] = [NaN, NaN];
    const count = Math.min(xs.length, ys.length);
    for (let i = 0; i < count; ++i) {
      const [x, y] = [this.bounded(this.px(xs[i]), this.left, this.width), this.bounded(this.py(ys[i]), this.top, this.height)];
      if (Number.isNaN(x) || Number.isNaN(y)) continue;
      if (Math.abs(x - lastX) < 0.3 && Math.abs(y - lastY) < 0.3 && i + 1 < count) continue;
      line.push(x, y);
      [lastX, lastY] = [x, y];
    }
    return line;
  }

  /** Far outside the frame is as good as farther, and pixels stay small numbers. */
  bounded(pixel, start, size) {
    return Math.min(start + 50 * size, Math.max(start - 49 * size, pixel));
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
