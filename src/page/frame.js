// A rectangle of a figure with its two axes: from numbers to pixels, and back.
import { ticks, tickText } from "./numbers.js";

export class Frame {
  /**
   * @param place  {left, top, width, height} in pixels
   * @param x, y   {low, high, label, tick}: the range; tick, if given, turns a tick into its text
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

  /** The numbers at a pixel, kept inside the frame. */
  at(pixelX, pixelY) {
    const within = (share) => Math.min(1, Math.max(0, share));
    return {
      x: this.x.low + within((pixelX - this.left) / this.width) * (this.x.high - this.x.low),
      y: this.y.high - within((pixelY - this.top) / this.height) * (this.y.high - this.y.low),
    };
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

  draw(surface, theme) {
    const size = theme.textSize;
    const style = { colour: theme.soft, size };
    const grid = { x: ticks(this.x.low, this.x.high, Math.max(2, this.width / 85)), y: ticks(this.y.low, this.y.high, Math.max(2, this.height / 55)) };
    const step = (values) => (values.length > 1 ? values[1] - values[0] : 1);
    const bottom = this.top + this.height;
    surface.lines([[this.left, this.top, this.left, bottom, this.left + this.width, bottom]], { colour: theme.soft });
    for (const value of grid.x) {
      const x = this.px(value);
      surface.lines([[x, bottom, x, bottom + 4]], { colour: theme.soft });
      if (this.x.label === undefined) continue;
      const text = this.x.tick ? this.x.tick(value) : tickText(value, step(grid.x));
      surface.text(x, bottom + 6, text, { ...style, align: "center", baseline: "top" });
    }
    for (const value of grid.y) {
      const y = this.py(value);
      surface.lines([[this.left - 4, y, this.left, y]], { colour: theme.soft });
      const text = this.y.tick ? this.y.tick(value) : tickText(value, step(grid.y));
      surface.text(this.left - 6, y, text, { ...style, align: "right", baseline: "middle" });
    }
    const label = { colour: theme.ink, size: size + 3, italic: true };
    if (this.x.label) {
      surface.text(this.left + this.width / 2, bottom + 6 + 1.5 * size, this.x.label, { ...label, align: "center", baseline: "top" });
    }
    if (this.y.label) {
      surface.text(this.left - 3.6 * size, this.top + this.height / 2, this.y.label, { ...label, align: "center", baseline: "middle", turned: true });
    }
  }
}
