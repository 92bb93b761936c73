// When slip and spin of a ball in an engine have fallen to 1e-3 of what they were.

/**
 * @param ball  {radius, slip, spin} in SI
 * @param step  advances the engine and gives {slip, spin}
 * @param dt    s, that a step lasts
 * @param end   s, when to give up
 * @returns {slip, spin, left}: s, Infinity for what has not; spin that is left
 */
export function fading(ball, step, dt, end) {
  const times = { slip: Infinity, spin: Infinity };
  let last = { slip: ball.slip, spin: ball.spin };
  for (let i = 1; i * dt <= end && !(times.slip < Infinity && times.spin < Infinity); ++i) {
    const now = step();
    for (const name of ["slip", "spin"]) {
      const target = 1e-3 * ball[name];
      if (times[name] === Infinity && now[name] <= target)
        times[name] = (i - (target - now[name]) / (last[name] - now[name])) * dt;
    }
    last = now;
  }
  return { ...times, left: last.spin };
}

/** The speed of the point of a ball that touches the plane, of its velocity and angular velocity in the world. */
export const slipOf = (radius, v, w) => Math.hypot(v[0] - radius * w[1], v[1] + radius * w[0]);
