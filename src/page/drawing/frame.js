// A rectangle of a figure with its two axes: from numbers to pixels, and back.

/** @typedef {{low: number, high: number}} Range */
export class Frame {
  /** @param {Box} place @param {Range} x @param {Range} y @param letter  size of its letters, pixels */
  constructor(place, x, y, letter = 0) {
    this.left = place.left;
    this.top = place.top;
    this.width = place.width;
    this.height = place.height;
    this.letter = letter;
    this.x = x;
    this.y = y;
  }

  px(value) { return this.left + ((value - this.x.low) / (this.x.high - this.x.low)) * this.width; }
  py(value) { return this.top + ((this.y.high - value) / (this.y.high - this.y.low)) * this.height; }

  /** Returns the pixel of a point of a flat column. */
  pixel(/** @type {ArrayLike<number>} */ points, at = 0) { return [this.px(points[at]), this.py(points[at + 1])]; }

  /** Returns true if a pixel lies in the frame or on its border. */
  contains(pixelX, pixelY) {
    const near = (value, from, size) => value >= from - 1 && value <= from + size + 1;
    return near(pixelX, this.left, this.width) && near(pixelY, this.top, this.height);
  }

  /** Returns the numbers at a pixel, or at the nearest pixel of the frame. */
  at(pixelX, pixelY) {
    const within = (fraction) => Math.min(1, Math.max(0, fraction));
    return {
      x: this.x.low + within((pixelX - this.left) / this.width) * (this.x.high - this.x.low),
      y: this.y.high - within((pixelY - this.top) / this.height) * (this.y.high - this.y.low),
    };
  }

  /** The lines through a flat column of points x0, y0, x1, y1, ..., in pixels; NaN separates two lines. */
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
}
