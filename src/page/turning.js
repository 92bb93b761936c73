// How a ball turns: rotations as matrices [row, row, row], in axes with z up.

const product = (a, b) => a.map((row) => [0, 1, 2].map((j) => row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]));

/** The rotation by an angle |w| about the axis w. */
export function rotation([x, y, z]) {
  const angle = Math.hypot(x, y, z);
  if (angle === 0) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const [a, b, c] = [x / angle, y / angle, z / angle];
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const rest = 1 - cos;
  return [
    [cos + a * a * rest, a * b * rest - c * sin, a * c * rest + b * sin],
    [b * a * rest + c * sin, cos + b * b * rest, b * c * rest - a * sin],
    [c * a * rest - b * sin, c * b * rest + a * sin, cos + c * c * rest],
  ];
}

export const turnedBy = (matrix, /** @type {number[]} */ [x, y, z]) => matrix.map((row) => row[0] * x + row[1] * y + row[2] * z);

/**
 * A ball on the table in equal times: xs, ys, and at(share) with the place and the rotation at a share of the time.
 *
 * @param course  columns slid and u: the path that the contact point has slid and R times the spin
 * @param start   v, x, y, heading: slip along x, velocity of the centre; the direction that is to the right
 * @param duration, chi, radius  of the course, and of the body: the centre loses 1/chi of what the slip loses
 * @param spinShown  the share of the spin that is drawn
 */
export function rideOn(course, start, { duration, chi, radius, spinShown }) {
  const pieces = course.slid.length - 1;
  const step = duration / pieces;
  const alongs = Array.from(course.slid, (slid, i) => (start.x - start.v / chi) * i * step + slid / chi);
  const back = rotation([0, 0, -start.heading]);
  const places = alongs.map((x, i) => turnedBy(back, [x, start.y * i * step, 0]));
  const [xs, ys] = [0, 1].map((k) => places.map((place) => place[k]));
  const turns = alongs.slice(1).map((x, i) => turnedBy(back, [
    -(start.y * step) / radius, (x - alongs[i] - (course.slid[i + 1] - course.slid[i])) / radius,
    (spinShown * step * (course.u[i] + course.u[i + 1])) / 2 / radius,
  ]));
  const matrices = [rotation([0, 0, 0])];
  for (const turn of turns) matrices.push(product(rotation(turn), matrices.at(-1)));
  return {
    xs, ys,
    at(share) {
      const place = Math.min(1, share) * pieces;
      const i = Math.min(pieces - 1, Math.floor(place));
      const part = place - i;
      const between = (column) => column[i] + part * (column[i + 1] - column[i]);
      return { x: between(xs), y: between(ys), slid: between(course.slid), turn: product(rotation(turns[i].map((w) => part * w)), matrices[i]) };
    },
  };
}
