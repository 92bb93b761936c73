// A rectangle of a figure with its two axes: from numbers to pixels, and back.

/** @typedef {{low: number, high: number}} Range */
export class Frame {
  /** @param {Box} place @param {Range} x @param {Range} y @param letter  the size of words in it */
  constructor(place, x, y, letter = 0) {
    this.left = place.left;
    this.top = place.top;
    this.width = place.width;
    this.height = place.height;
    this.letter = letter;
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
}
