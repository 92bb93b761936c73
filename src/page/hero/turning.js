// Rotations of a ball as matrices [row, row, row], in axes with z up.

export const product = (a, b) => a.map((row) => [0, 1, 2].map((j) => row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]));

/** The rotation by an angle |w| about the axis w. */
export function rotation(w) {
  const angle = Math.hypot(...w);
  const [a, b, c] = w.map((component) => component / (angle || 1));
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const across = [[0, -c, b], [c, 0, -a], [-b, a, 0]];
  return across.map((row, i) => row.map((value, j) => (i === j ? cos : 0) + sin * value + (1 - cos) * [a, b, c][i] * [a, b, c][j]));
}

export const turnedBy = (matrix, /** @type {number[]} */ [x, y, z]) => matrix.map((row) => row[0] * x + row[1] * y + row[2] * z);

/**
 * Returns a ride of the library in the axes of the picture: {xs, ys, at(share)}. at returns place, path and rotation at a share of the time.
 * @param heading    direction that points to the right in the picture
 * @param spinShown  share of the spin that is drawn
 */
export function rideOn({ t, x, y, wx, wy, wz, rest }, heading, spinShown) {
  const back = rotation([0, 0, -heading]);
  const places = Array.from(x, (x, i) => turnedBy(back, [x, y[i], 0]));
  const [xs, ys] = [0, 1].map((k) => places.map((place) => place[k]));
  let run = 0;
  const path = xs.map((x, i) => (run += i ? Math.hypot(x - xs[i - 1], ys[i] - ys[i - 1]) : 0));
  const drawn = [wx, wy, wz.map((w) => spinShown * w)];
  /** Returns the rotation in a part of a step. */
  const turn = (i, part) => rotation(turnedBy(back, drawn.map((w) => (part * (t[i + 1] - t[i]) * (w[i] + w[i + 1])) / 2)));
  const turned = [rotation([0, 0, 0])];  // rotation before each step, for all steps requested so far
  /** Returns the step of a share of the time, and the part of the step that has passed. Times grow as squares. @returns {[number, number]} */
  const rowAt = (share) => {
    const i = Math.min(t.length - 2, Math.floor(Math.sqrt(Math.min(1, share)) * (t.length - 1)));
    return [i, (Math.min(1, share) * t.at(-1) - t[i]) / (t[i + 1] - t[i])];
  };
  const between = (column, /** @type {[number, number]} */ [i, part]) => column[i] + part * (column[i + 1] - column[i]);
  return {
    xs, ys, rest,
    /** The line of the path until a share of the time: x0, y0, x1, y1, ... */
    until(share) {
      const row = rowAt(share);
      return [...xs.slice(0, row[0] + 1).flatMap((x, i) => [x, ys[i]]), between(xs, row), between(ys, row)];
    },
    at(share) {
      const row = rowAt(share);
      const [i, part] = row;
      for (let j = turned.length - 1; j < i; ++j) turned.push(product(turn(j, 1), turned[j]));
      const [px, py, far] = [xs, ys, path].map((column) => between(column, row));
      return { x: px, y: py, path: far, turn: product(turn(i, part), turned[i]) };
    },
  };
}
