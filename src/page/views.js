// The views of the phase plane: each maps a state to two numbers and back.
//
// States come as columns {u, v, lnU, lnV}: near the stop v underflows long before its logarithm does. A context has mu,
// the window [U, V], the limit of k at the stop (regime 0: zero, 1: ray, 2: infinity; terminalRatio), and `aspect`,
// height over width of the figure. Where a view has many scales, so have its times.

const decades = Math.LN10;

export const views = [
  {
    name: "uv",
    title: "plane",
    hint: "The paper's plane: sliding v against pivoting u = R ω, ω the spin about the vertical. Every orbit runs into the origin.",
    bothSigns: true,
    axes: ({ window: [U, V] }) => [{ low: -U, high: U, label: "u" }, { low: 0, high: V, label: "v" }],
    x: (s, i) => s.u[i],
    y: (s, i) => s.v[i],
    state: (x, y) => ({ u: x, v: y }),
  },
  {
    name: "patch",
    title: "patch",
    hint: "Both speeds as the rim of the patch has them, on one scale: the slope of a ray is k = v/(μ|u|), dashed where k = 1.",
    bothSigns: true,
    guides: [1],
    axes: ({ mu, window: [U], aspect }) => [
      { low: -mu * U, high: mu * U, label: "μ u" }, { low: 0, high: 2 * mu * U * aspect, label: "v" }],
    x: (s, i, { mu }) => mu * s.u[i],
    y: (s, i) => s.v[i],
    state: (x, y, { mu }) => ({ u: x / mu, v: y }),
  },
  {
    name: "log",
    title: "log",
    manyScales: true,
    hint: "Logarithms of both speeds. Scaling moves an orbit along the diagonal: all of them are copies of one curve.",
    guides: [1],
    axes: ({ mu, window: [U, V] }) => [
      { low: Math.log10(mu * U) - 4, high: Math.log10(mu * U) + 0.2, label: "log₁₀ μ|u|" },
      { low: Math.log10(V) - 8, high: Math.log10(V) + 0.2, label: "log₁₀ v" }],
    x: (s, i, { mu }) => (s.lnU[i] + Math.log(mu)) / decades,
    y: (s, i) => s.lnV[i] / decades,
    state: (x, y, { mu }) => ({ u: 10 ** x / mu, v: 10 ** y }),
    shifts: (context) => spread(Math.log(context.window[0]) - 9, Math.log(context.window[0]) + 8, 26),
  },
  {
    name: "similarity",
    title: "similarity",
    manyScales: true,
    hint: "Canonical coordinates: here scaling is a shift along p = ln v, and every orbit is the same curve, shifted.",
    axes: ({ window: [, V] }) => [
      { low: -8, high: 8, label: "ln k" }, { low: Math.log(V) - 12, high: Math.log(V) + 0.5, label: "p = ln v" }],
    x: (s, i, { mu }) => s.lnV[i] - s.lnU[i] - Math.log(mu),
    y: (s, i) => s.lnV[i],
    state: (x, y, { mu }) => ({ u: Math.exp(y - x) / mu, v: Math.exp(y) }),
    shifts: ({ window: [U] }) => spread(Math.log(U) - 14, Math.log(U) + 8, 28),
  },
  {
    name: "blowup",
    title: "blow-up",
    hint: "The origin blown up: u against k = v/(μu). The bottom line is the origin, seen by direction; dots are its singular points.",
    axes: ({ window: [U] }) => [{ low: 0, high: 4, label: "k = v/(μ u)" }, { low: 0, high: U, label: "u" }],
    x: (s, i, { mu }) => Math.exp(s.lnV[i] - s.lnU[i]) / mu,
    y: (s, i) => Math.abs(s.u[i]),
    state: (x, y, { mu }) => ({ u: y, v: mu * x * y }),
    shifts: ({ window: [U] }) => Array.from({ length: 24 }, (_, i) => Math.log((U * (i + 0.5)) / 14)),
    points: ({ regime, terminalRatio }) => [
      { x: 0, y: 0, stable: regime === 0 }, ...(regime === 1 ? [{ x: terminalRatio, y: 0, stable: true }] : [])],
  },
  {
    name: "disc",
    title: "disc",
    endless: true,
    manyScales: true,
    hint: "The whole half-plane on Poincaré's disc: infinity is the circle. ● node, ○ saddle.",
    bothSigns: true,
    bare: true,
    axes: ({ aspect }) => {
      const half = Math.max(1.06, 1.2 / (2 * aspect));
      const margin = (2 * half * aspect - 1) / 2;
      return [{ low: -half, high: half }, { low: -margin, high: 1 + margin }];
    },
    x: (s, i, { window: [U, V] }) => onDisc(s.u[i] / U, s.v[i] / V)[0],
    y: (s, i, { window: [U, V] }) => onDisc(s.u[i] / U, s.v[i] / V)[1],
    state: (x, y, { window: [U, V] }) => {
      const rest = 1 - x * x - y * y;
      return rest > 1e-9 && y >= 0 ? { u: (U * x) / Math.sqrt(rest), v: (V * y) / Math.sqrt(rest) } : null;
    },
    shifts: ({ window: [U] }) => spread(4, 86, 14).map((degrees) => Math.log(U * Math.tan((Math.PI * degrees) / 180))),
    border: () => Array.from({ length: 181 }, (_, i) => [Math.cos((Math.PI * i) / 180), Math.sin((Math.PI * i) / 180)]),
    points: ({ mu, window: [U, V], regime, terminalRatio }) => [
      { x: 0, y: 0, stable: true },
      { x: 1, y: 0, stable: regime !== 0 }, { x: -1, y: 0, stable: regime !== 0 },
      { x: 0, y: 1, stable: regime !== 2 },
      ...(regime === 1 ? [1, -1].map((sign) => {
        const length = Math.hypot(1 / U, (mu * terminalRatio) / V);
        return { x: sign / U / length, y: (mu * terminalRatio) / V / length, stable: false };
      }) : [])],
  },
];

export const viewNamed = (name) => views.find((view) => view.name === name) ?? views[0];

function spread(low, high, count) {
  return Array.from({ length: count }, (_, i) => low + ((high - low) * i) / (count - 1));
}

function onDisc(x, y) {
  const far = Math.hypot(1, x, y);
  return Number.isFinite(far) ? [x / far, y / far] : [Math.sign(x) * (Number.isFinite(y) ? 1 : 0), Number.isFinite(y) ? 0 : 1];
}

/** Columns of states from columns u and v. */
export function states(u, v) {
  return { u, v, lnU: u.map((value) => Math.log(Math.abs(value))), lnV: v.map((value) => Math.log(value)) };
}

/** The same states with u of the other sign. */
export const mirrored = (s) => ({ ...s, u: s.u.map((value) => -value) });

/** A curve of the library (ln k, ln u and the time left) with both speeds multiplied by exp(shift). */
export function scaledBranch(branch, shift, mu) {
  const lnU = branch.lnU.map((value) => value + shift);
  const lnV = branch.lnK.map((value, i) => value + lnU[i] + Math.log(mu));
  return { u: lnU.map(Math.exp), v: lnV.map(Math.exp), lnU, lnV, left: branch.left.map((value) => value * Math.exp(shift)) };
}

/** The ray on which k has one value, from far inside to far outside. */
export function ray(k, { mu, window: [U] }) {
  const u = Float64Array.from(spread(-30, 12, 85), (exponent) => U * Math.exp(exponent));
  return states(u, u.map((value) => mu * k * value));
}
